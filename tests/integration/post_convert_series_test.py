"""A run as XDMF and as tables. Usage: post_convert_series_test.py TANKTREAD [unittest arguments]."""

import csv
import os
import subprocess
import sys
import unittest
import unittest.mock
import xml.etree.ElementTree

import meshio
import numpy
from post_fixture import ROOT, InFolder, octahedron, write_series

from tanktread_post import convert_series, series

# A run of a second: two capsules, three times.
SMALL = [
    "flow.box=[32,24,24]", "capsule.0.radius=4", "capsule.0.position=[9,12,12]", "capsule.0.mesh.level=1", "run.shear_time=0.05",
    "output.membrane_every=0.02", "run.threads=1",
]  # fmt: skip
SECOND_CAPSULE = '\n[[capsule]]\nradius = 3\nposition = [22, 11, 13]\nmesh = { shape = "sphere", level = 1 }\n[membrane]\n'
TENSOR = [f"_{a}{b}" for a in "xyz" for b in "xyz"]
AXES = ["_x", "_y", "_z"]
POINT_COLUMNS = {"velocity": AXES, "elastic_force": AXES, "total_force": AXES}
CELL_COLUMNS = {"principal_stretches": ["_1", "_2"], "stress": TENSOR, "viscous_stress": TENSOR, "area_ratio": [""], "capsule": [""]}


def bits(values):
    """The shape and the bits: -0.0 is not 0.0, NaN is itself."""
    values = numpy.ascontiguousarray(values, dtype=float)
    return values.shape, values.ravel().view(numpy.uint64).tolist()


def read_columns(file):
    """{name: numbers as Python reads them} of a table."""
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(stream))
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


class Series(InFolder):
    def run_case(self):
        """The folder of a small run of two capsules, and its [(shear time, surface), ...]."""
        case = (ROOT / "cases/shear-capsule/case.toml").read_text()
        (self.folder / "case.toml").write_text(case.replace("\n[membrane]\n", SECOND_CAPSULE))
        output = self.folder / "out"
        command = [PROGRAM, "run", self.folder / "case.toml", "--output", output, *(f"--set={value}" for value in SMALL)]
        ended = subprocess.run(command, capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        return output, [(time, meshio.read(file)) for time, file in series.read_series(output / "membrane.pvd")]

    def assert_same(self, file, surfaces):
        """The XDMF as meshio reads it holds the times and every bit of every array."""
        with meshio.xdmf.TimeSeriesReader(file) as reader:
            points, cells = reader.read_points_cells()
            self.assertEqual(bits(points), bits(surfaces[0][1].points))
            self.assertEqual(cells[0].data.tolist(), surfaces[0][1].cells[0].data.tolist())
            self.assertEqual(reader.num_steps, len(surfaces))
            for k, (time, surface) in enumerate(surfaces):
                found_time, point_data, cell_data = reader.read_data(k)
                self.assertEqual(found_time, time)
                self.assertEqual(bits(point_data.pop("position")), bits(surface.points))
                self.assertEqual(list(point_data), list(surface.point_data))
                self.assertEqual(list(cell_data), list(surface.cell_data))
                for name, values in point_data.items():
                    self.assertEqual(bits(values), bits(surface.point_data[name]), name)
                for name, blocks in cell_data.items():
                    self.assertEqual(bits(blocks[0]), bits(surface.cell_data[name][0]), name)

    def test_a_run_as_xdmf(self):
        output, surfaces = self.run_case()
        self.assertGreaterEqual(len(surfaces), 3)
        self.assertNotEqual(bits(surfaces[0][1].points), bits(surfaces[-1][1].points))
        environment = os.environ | {"PYTHONPATH": str(ROOT / "post")}
        command = [sys.executable, "-m", "tanktread_post", "convert-series", output, self.folder / "run.xdmf"]
        ended = subprocess.run(command, capture_output=True, text=True, env=environment)
        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
        self.assertIn(f"{len(surfaces)} times", ended.stdout)
        self.assert_same(self.folder / "run.xdmf", surfaces)
        # Each time has its own geometry: the membrane moves in programs that draw the grids.
        grids = xml.etree.ElementTree.parse(self.folder / "run.xdmf").findall("./Domain/Grid/Grid")
        for grid, (_, surface) in zip(grids, surfaces, strict=True):
            drawn = numpy.array(grid.find("Geometry/DataItem").text.split(), dtype=float).reshape(-1, 3)
            self.assertEqual(bits(drawn), bits(surface.points))
        again = subprocess.run(command, capture_output=True, text=True, env=environment)
        self.assertEqual(again.returncode, 2)
        self.assertIn("run.xdmf: it is there already", again.stderr)

    def test_a_run_as_tables(self):
        output, surfaces = self.run_case()
        convert_series.convert(output, self.folder / "run.xdmf", self.folder / "tables")
        with open(self.folder / "tables/times.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        self.assertEqual([float(row["shear_time"]) for row in rows], [time for time, _ in surfaces])
        self.assertEqual([float(row["step"]) for row in rows], [surface.field_data["step"][0] for _, surface in surfaces])
        self.assertEqual(len(list((self.folder / "tables").iterdir())), 1 + 2 * len(rows))
        for row, (_, surface) in zip(rows, surfaces, strict=True):
            points, cells = (read_columns(self.folder / "tables" / row[name]) for name in ("points", "cells"))
            self.assert_columns(points, "node", "xyz", surface.points, POINT_COLUMNS, surface.point_data)
            corners = ["node_1", "node_2", "node_3"]
            blocks = {name: blocks[0] for name, blocks in surface.cell_data.items()}
            self.assert_columns(cells, "triangle", corners, surface.cells[0].data, CELL_COLUMNS, blocks)

    def assert_columns(self, found, number, labels, first, columns, arrays):
        """The table has a number, the first array and all others, in this order and to the last bit."""
        self.assertEqual(set(columns), set(arrays))
        names = [name + label for name in arrays for label in columns[name]]
        self.assertEqual(list(found), [number, *labels, *names])
        self.assertEqual(found.pop(number), list(range(len(first))))
        expected = numpy.concatenate([first, *(values.reshape(len(first), -1) for values in arrays.values())], axis=1)
        self.assertEqual(bits(numpy.array(list(found.values())).T), bits(expected))

    def write(self, triangles=None, values=None):
        """A run of two times made for a test."""
        points, faces = octahedron(numpy.zeros(3), 1 / 3)
        for k in (0, 1):
            cells = [("triangle", faces if triangles is None or k == 0 else triangles)]
            speed = {"speed": numpy.arange(6.0) if values is None else values}
            meshio.write(self.folder / f"membrane_{k}.vtu", meshio.Mesh(points * (1 + k), cells, point_data=speed))
        write_series(self.folder / "membrane.pvd", [(k / 3, f"membrane_{k}.vtu") for k in (0, 1)])

    def test_numbers_that_are_hard_to_write(self):
        self.write(values=numpy.array([-0.0, 5e-324, numpy.nan, -numpy.inf, 0.1, 1.7976931348623157e308]))
        convert_series.convert(self.folder, self.folder / "run.xdmf", self.folder / "tables")
        surfaces = [(k / 3, meshio.read(self.folder / f"membrane_{k}.vtu")) for k in (0, 1)]
        self.assert_same(self.folder / "run.xdmf", surfaces)
        speed = read_columns(self.folder / "tables/points_0.csv")["speed"]
        self.assertEqual(bits(speed), bits(surfaces[0][1].point_data["speed"]))

    def test_a_membrane_that_is_named_again_is_converted_once(self):
        self.write()
        write_series(self.folder / "membrane.pvd", [(0.0, "membrane_0.vtu"), (0.1, "membrane_0.vtu"), (1 / 3, "membrane_1.vtu"), (0.5, "membrane_1.vtu")])
        convert_series.convert(self.folder, self.folder / "run.xdmf", self.folder / "tables")
        self.assert_same(self.folder / "run.xdmf", [(k / 3, meshio.read(self.folder / f"membrane_{k}.vtu")) for k in (0, 1)])
        with open(self.folder / "tables/times.csv", newline="") as stream:
            self.assertEqual([float(row["shear_time"]) for row in csv.DictReader(stream)], [0.0, 1 / 3])

    def test_says_what_paraview_does_not_read(self):
        self.write()
        for most, said in ((18, []), (17, ["an array has 18 numbers"])):
            with unittest.mock.patch.object(convert_series, "LARGEST_IN_PARAVIEW", most):
                lines = convert_series.convert(self.folder, self.folder / "run.xdmf", force=True)
            self.assertEqual([line.split(":")[0] for line in lines[1:]], said)

    def refused(self, words, target="run.xdmf", tables=None):
        """Refused with these words, and nothing is there that was not before."""
        before = sorted(self.folder.rglob("*"))
        self.assert_refused(words, convert_series.convert, self.folder, self.folder / target, tables)
        self.assertEqual(sorted(self.folder.rglob("*")), before)

    def test_refusals(self):
        self.refused(["membrane.pvd: there is no such file", "the output of a run?"])
        write_series(self.folder / "membrane.pvd", [])
        self.refused("membrane.pvd: it lists no files")
        self.write(triangles=octahedron(0.0, 1.0)[1][:, ::-1], values=None)
        self.refused("membrane_1.vtu: its triangles differ")
        self.write()
        self.refused("run.vtk: its name must end with .xdmf", target="run.vtk")
        self.refused("there is no folder", target="none/run.xdmf")
        self.refused("choose the name of a new or empty folder", tables=self.folder)
        (self.folder / "membrane_1.vtu").write_text("<VTKFile")
        self.refused("membrane_1.vtu: it is not VTK's XML", tables=self.folder / "tables")
        (self.folder / "membrane_1.vtu").unlink()
        self.refused("membrane_1.vtu: there is no such file")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
