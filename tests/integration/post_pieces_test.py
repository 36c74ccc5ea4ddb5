"""Surfaces and grids in pieces, .pvtu and .pvti, wherever a whole one is read: converted, drawn (run under xvfb-run), or refused."""

import os
import shutil
import unittest

import matplotlib.image
import meshio
import numpy
from pieces_fixture import cut_grid, write_surface_in_pieces
from post_fixture import InFolder, octahedron, write_pictures, write_run, write_series

from tanktread_post import convert_series, convert_surface, surface_files, vtk_pieces, vtk_surfaces


def capsule(number, centre, radius=1.0, **field_data):
    """An octahedron with arrays of a membrane file."""
    points, triangles = octahedron(numpy.array(centre, float), radius)
    places = number + numpy.arange(6.0) / 7
    cells = {"area_ratio": [numpy.linspace(0.9, 1.1, 8) + number], "stress": [numpy.arange(72.0).reshape(8, 9) + number]}
    return meshio.Mesh(points, [("triangle", triangles)], point_data={"velocity": numpy.stack([places] * 3, axis=1)}, cell_data=cells, field_data=field_data)


def together(meshes):
    """One mesh, by numbers that stand beside each other."""
    firsts = numpy.cumsum([0, *(len(mesh.points) for mesh in meshes)])
    return meshio.Mesh(
        numpy.concatenate([mesh.points for mesh in meshes]),
        [("triangle", numpy.concatenate([mesh.cells[0].data + first for mesh, first in zip(meshes, firsts)]))],
        point_data={name: numpy.concatenate([mesh.point_data[name] for mesh in meshes]) for name in meshes[0].point_data},
        cell_data={name: [numpy.concatenate([mesh.cell_data[name][0] for mesh in meshes])] for name in meshes[0].cell_data},
    )


THREE = [capsule(k, (4.0 * k, 1.0, 2.0)) for k in range(3)]


class Pieces(InFolder):
    def setUp(self):
        super().setUp()
        self.index = self.folder / "cells.pvtu"
        write_surface_in_pieces(self.index, THREE)

    def assert_same(self, found, expected):
        self.assertEqual([block.type for block in found.cells], [block.type for block in expected.cells])
        self.assertEqual(found.points.tolist(), expected.points.tolist())
        self.assertEqual(found.cells[0].data.tolist(), expected.cells[0].data.tolist())
        self.assertEqual({name: values.tolist() for name, values in found.point_data.items()}, {name: values.tolist() for name, values in expected.point_data.items()})
        self.assertEqual({name: blocks[0].tolist() for name, blocks in found.cell_data.items()}, {name: blocks[0].tolist() for name, blocks in expected.cell_data.items()})

    def test_are_put_together(self):
        self.assert_same(vtk_surfaces.read(self.index), together(THREE))

    def test_an_empty_one_adds_nothing(self):
        cells = "".join(f'<DataArray type="Int64" Name="{name}" format="ascii"></DataArray>' for name in ("connectivity", "offsets", "types"))
        points = '<DataArray type="Float64" NumberOfComponents="3" format="ascii"></DataArray>'
        piece = f'<Piece NumberOfPoints="0" NumberOfCells="0"><Points>{points}</Points><Cells>{cells}</Cells></Piece>'
        (self.folder / "cells/1.vtu").write_text(f'<VTKFile type="UnstructuredGrid" version="0.1"><UnstructuredGrid>{piece}</UnstructuredGrid></VTKFile>')
        self.assert_same(vtk_surfaces.read(self.index), together([THREE[0], THREE[2]]))

    def test_convert_surface_takes_one_body_of_them(self):
        self.assert_refused(["cells.pvtu", "3 separate bodies"], convert_surface.convert, self.index, None)
        convert_surface.convert(self.index, self.folder / "second.vtu", body=1)
        self.assertEqual(meshio.read(self.folder / "second.vtu").points.tolist(), THREE[1].points.tolist())

    def test_convert_surface_writes_whole_ones_only(self):
        self.assert_refused("must end with one of", convert_surface.convert, self.folder / "cells/0.vtu", self.folder / "out.pvtu")

    def test_a_series_of_them(self):
        whole = together(THREE)
        meshio.write(self.folder / "whole.vtu", whole)
        for name in ("whole.vtu", "cells.pvtu"):
            write_series(self.folder / "membrane.pvd", [(0.5, name)])
            convert_series.convert(self.folder, self.folder / f"{name}.xdmf", self.folder / f"{name}.tables")
        for kind in ("points", "cells"):
            of_whole, of_pieces = (self.folder / f"{name}.tables/{kind}_{name.split('.')[0]}.csv" for name in ("whole.vtu", "cells.pvtu"))
            self.assertEqual(of_whole.read_text(), of_pieces.read_text())
        self.assertEqual((self.folder / "whole.vtu.xdmf").read_text(), (self.folder / "cells.pvtu.xdmf").read_text())

    def test_numbers_of_the_whole_are_one_and_their_own_are_kept(self):
        meshes = [meshio.Mesh(mesh.points, mesh.cells, field_data={"step": numpy.array([7.0]), f"history_{k}": numpy.array([k + 0.5])}) for k, mesh in enumerate(THREE)]
        pieces = [self.folder / f"{k}.vtu" for k in range(3)]
        found = vtk_pieces.joined(meshes, pieces, self.index).field_data
        self.assertEqual({name: values.tolist() for name, values in found.items()}, {"step": [7.0], "history_0": [0.5], "history_1": [1.5], "history_2": [2.5]})
        meshes[2].field_data["step"] = numpy.array([8.0])
        self.assert_refused(["2.vtu: has another 'step'", "cells.pvtu"], vtk_pieces.joined, meshes, pieces, self.index)

    def test_refusals(self):
        text = self.index.read_text()
        for old, new, words in (
            ('GhostLevel="0"', 'GhostLevel="1"', "its pieces overlap"),
            ("cells/1.vtu", "cells/0.vtu", "it names a piece twice"),
            ("cells/1.vtu", "cells/7.vtu", "cells/7.vtu: there is no such file, a piece of "),
            ("Source", "Sauce", "without its Source"),
            ("</VTKFile>", "", "it is not VTK's XML"),
            ('type="PUnstructuredGrid"', 'type="PImageData"', "it holds PImageData"),
        ):
            self.index.write_text(text.replace(old, new, 1))
            self.assert_refused(words, surface_files.read_mesh, self.index)
        self.index.write_text(text)
        mesh = meshio.Mesh(THREE[1].points, THREE[1].cells, point_data=THREE[1].point_data)
        meshio.write(self.folder / "cells/1.vtu", mesh)
        self.assert_refused(["cells/1.vtu: of area_ratio, stress it has what", "the same arrays"], surface_files.read_mesh, self.index)
        (self.folder / "cells/1.vtu").write_text("<VTKFile")
        self.assert_refused("cells/1.vtu: it is not VTK's XML", surface_files.read_mesh, self.index)


@unittest.skipUnless(os.environ.get("DISPLAY"), "needs a display: run it under xvfb-run")
class Pictures(InFolder):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "out"
        write_run(self.output, width=12, radius=3.0)
        write_pictures(self.output)

    def put_in_pieces(self, *meshes):
        """The membrane of the series as these meshes together, and the same in pieces under another name."""
        meshio.write(self.output / "membrane/membrane_1.vtu", together(meshes))
        write_surface_in_pieces(self.output / "membrane/membrane_2.pvtu", meshes)

    def test_are_drawn_as_the_whole_is(self):
        from tanktread_post import render

        self.put_in_pieces(capsule(0, (3, 6, 6), 2.0), capsule(0.1, (9, 6, 6), 2.0))
        whole = matplotlib.image.imread(render.render(self.output, "stress"))
        write_series(self.output / "membrane.pvd", [(3.0, "membrane/membrane_2.pvtu")])
        cut_grid(self.output / "fluid/fluid_1.vti", 5)
        write_series(self.output / "fluid.pvd", [(3.0, "fluid/fluid_1.pvti")])
        in_pieces = matplotlib.image.imread(render.render(self.output, "stress"))
        self.assertGreater(len(numpy.unique(whole[..., 0])), 10)
        numpy.testing.assert_array_equal(in_pieces, whole)

    def test_a_strip_of_them(self):
        from tanktread_post import strip

        self.put_in_pieces(capsule(0, (6, 6, 6), 3.0))
        whole = matplotlib.image.imread(strip.draw(self.output, [3.0]))
        write_series(self.output / "membrane.pvd", [(3.0, "membrane/membrane_2.pvtu")])
        numpy.testing.assert_array_equal(matplotlib.image.imread(strip.draw(self.output, [3.0])), whole)

    def test_a_piece_that_is_gone_or_cut_off(self):
        from tanktread_post import render

        self.put_in_pieces(capsule(0, (3, 6, 6), 2.0), capsule(1, (9, 6, 6), 2.0))
        write_series(self.output / "membrane.pvd", [(3.0, "membrane/membrane_2.pvtu")])
        shutil.copy(self.output / "membrane/membrane_2/0.vtu", self.folder / "kept.vtu")
        (self.output / "membrane/membrane_2/0.vtu").unlink()
        self.assert_refused("membrane_2/0.vtu: there is no such file, a piece of ", render.render, self.output)
        data = (self.folder / "kept.vtu").read_bytes()
        (self.output / "membrane/membrane_2/0.vtu").write_bytes(data[: len(data) // 2])
        self.assert_refused(["membrane_2/0.vtu: it does not end with", "write or copy it again"], render.render, self.output)
        write_series(self.output / "membrane.pvd", [(3.0, "echo.toml")])
        self.assert_refused("echo.toml: the series names this file, and it is none of .vtu", render.render, self.output)


if __name__ == "__main__":
    unittest.main()
