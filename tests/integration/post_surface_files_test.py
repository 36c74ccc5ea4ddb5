"""What other programs may put into files of surfaces: all of it is read, or left out as the manual says, or refused; never a part of it taken for the whole. Whole files, and those of VTK."""

import os
import resource
import struct
import unittest
import unittest.mock

import numpy
from post_fixture import octahedron
from surface_files_fixture import POINTS, TRIANGLES, Files, rows
from surface_shapes import CUBE_OF_QUADS
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import VTK_PIXEL, VTK_TRIANGLE, vtkCellArray, vtkPolyData, vtkUnstructuredGrid
from vtkmodules.vtkFiltersCore import vtkStripper
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter, vtkXMLUnstructuredGridWriter

from tanktread_post import convert_surface, surface_files, vtk_head, vtk_reading
from tanktread_post.observables import InputError
from tanktread_post.surface import Surface
from tanktread_post.surface_repair import repaired


class Whole(Files):
    """The kind of error that matters most: a part of a file that passes for the whole."""

    FORMS = [
        (".stl", False, None), (".stl", True, None), (".obj", False, None), (".ply", False, None), (".ply", True, None), (".off", False, None),
        (".msh", False, "4.1"), (".msh", True, "4.1"), (".msh", False, "2.2"), (".msh", True, "2.2"), (".vtu", False, None),
    ]  # fmt: skip

    def written(self, suffix, ascii, version):
        file = self.folder / f"whole{suffix}"
        surface_files.write_surface(file, suffix, Surface(POINTS, TRIANGLES, None, None), ascii, version)
        return file

    def test_a_file_that_is_cut_off_is_refused_wherever_it_is_cut(self):
        for form in self.FORMS:
            with self.subTest(form):
                file = self.written(*form)
                data = file.read_bytes()
                self.assert_octahedron(file)
                for length in range(1, len(data.rstrip()), 11):
                    with self.assertRaises(InputError, msg=f"{length} of {len(data)} bytes"):
                        repaired(surface_files.read_surface(self.put(file.name, data[:length]))[0], file)

    def test_a_head_that_says_another_number_is_refused(self):
        counts = {
            (".stl", False, None): [(struct.pack("<I", 8), struct.pack("<I", n)) for n in (7, 9)],
            (".ply", False, None): [(b"vertex 6", b"vertex 5"), (b"vertex 6", b"vertex 7"), (b"face 8", b"face 7"), (b"face 8", b"face 9")],
            (".ply", True, None): [(b"vertex 6", b"vertex 5"), (b"vertex 6", b"vertex 7"), (b"face 8", b"face 7"), (b"face 8", b"face 9")],
            (".off", False, None): [(b"6 8 0", b"5 8 0"), (b"6 8 0", b"7 8 0"), (b"6 8 0", b"6 7 0"), (b"6 8 0", b"6 9 0")],
            (".msh", True, "4.1"): [(b"\n1 6 1 6\n", b"\n1 5 1 6\n"), (b"\n1 6 1 6\n", b"\n1 7 1 6\n"), (b"\n1 8 1 8\n", b"\n1 7 1 8\n"), (b"\n1 8 1 8\n", b"\n1 9 1 8\n")],
            (".msh", True, "2.2"): [(b"\n6\n", b"\n5\n"), (b"\n6\n", b"\n7\n"), (b"\n8\n", b"\n9\n")],
            (".vtu", False, None): [(b'Points="6"', b'Points="7"'), (b'Cells="8"', b'Cells="9"')],
        }
        for form, changes in counts.items():
            file = self.written(*form)
            data = file.read_bytes()
            for old, new in changes:
                with self.subTest(form, new=new):
                    self.assertEqual(data.count(old), 1)
                    self.refused(self.put(file.name, data.replace(old, new)))

    def test_numbers_behind_the_last_one_are_refused(self):
        for form in ((".ply", True, None), (".off", False, None)):
            file = self.written(*form)
            self.refused(self.put(file.name, file.read_bytes() + b"3 0 1 2\n"))
        file = self.written(".msh", True, "2.2")
        nodes = file.read_bytes().split(b"$Elements")[0]
        self.refused(self.put("twice.msh", file.read_bytes() + nodes[nodes.index(b"$Nodes") :]), "2 whole sections $Nodes, must be one")


class Vtk(Files):
    """.vtu and .vtp."""

    def grid(self, *bodies, version="1.0"):
        """A .vtu in text: a piece for each (points, triangles)."""
        pieces = [
            f'<Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(triangles)}"><Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">\n'
            f'{rows(points)}</DataArray></Points><Cells><DataArray type="Int64" Name="connectivity" format="ascii">\n{rows(triangles)}</DataArray>'
            f'<DataArray type="Int64" Name="offsets" format="ascii">{" ".join(str(3 * k + 3) for k in range(len(triangles)))}</DataArray>'
            f'<DataArray type="UInt8" Name="types" format="ascii">{"5 " * len(triangles)}</DataArray></Cells></Piece>\n'
            for points, triangles in bodies
        ]
        text = f'<VTKFile type="UnstructuredGrid" version="{version}" byte_order="LittleEndian"><UnstructuredGrid>{"".join(pieces)}</UnstructuredGrid></VTKFile>\n'
        return self.put("in.vtu", text)

    def data(self, kind=vtkPolyData):
        """The octahedron as VTK's data."""
        positions, cells, data = vtkPoints(), vtkCellArray(), kind()
        positions.SetDataTypeToDouble()
        positions.SetData(numpy_to_vtk(POINTS, deep=True))
        cells.SetData(numpy_to_vtkIdTypeArray(numpy.arange(0, 25, 3), deep=True), numpy_to_vtkIdTypeArray(TRIANGLES.ravel(), deep=True))
        data.SetPoints(positions)
        data.SetPolys(cells) if kind is vtkPolyData else data.SetCells(VTK_TRIANGLE, cells)
        return data

    def written(self, writer, data, name):
        writer.SetInputData(data)
        writer.SetFileName(str(self.folder / name))
        self.assertEqual(writer.Write(), 1)
        return self.folder / name

    def test_two_bodies_in_two_pieces_are_two_bodies(self):
        file = self.grid((POINTS, TRIANGLES), (POINTS + 9, TRIANGLES))
        self.refused(file, "2 separate bodies", "body 1 of 8 triangles about (12, 13, 14)")
        convert_surface.convert(file, self.folder / "out.vtu", body=0)
        self.assert_octahedron(self.folder / "out.vtu")

    def test_one_body_in_two_pieces_is_one(self):
        file = self.grid((POINTS, TRIANGLES[:3]), (POINTS, TRIANGLES[3:]))
        self.assert_octahedron(file)
        self.assertIn("merged 5 points with another one", convert_surface.convert(file, None))  # of 6: three triangles on four corners, five on six

    def test_empty_pieces_are_none(self):
        nothing = (numpy.empty((0, 3)), numpy.empty((0, 3), dtype=int))
        for bodies in ((nothing, (POINTS, TRIANGLES)), ((POINTS, TRIANGLES), nothing)):
            self.assert_octahedron(self.grid(*bodies))
        self.refused(self.grid(nothing), "there are no triangles")

    def test_versions(self):
        for version in ("0.1", "1.0", "2.0", "2.2"):
            self.assert_octahedron(self.grid((POINTS, TRIANGLES), version=version))
        self.refused(self.grid((POINTS, TRIANGLES), version="9.0"), "File version: 9.0 is higher", "write it for VTK 9.")

    def test_all_that_vtk_writes(self):
        for kind, make, name in ((vtkUnstructuredGrid, vtkXMLUnstructuredGridWriter, "in.vtu"), (vtkPolyData, vtkXMLPolyDataWriter, "in.vtp")):
            for mode in ("Ascii", "Binary", "Appended"):
                for compressor in ("None", "ZLib", "LZ4", "LZMA"):
                    for encode in (0, 1):
                        with self.subTest(name, mode=mode, compressor=compressor, encode=encode):
                            writer = make()
                            getattr(writer, f"SetDataModeTo{mode}")()
                            getattr(writer, f"SetCompressorTypeTo{compressor}")()
                            writer.SetEncodeAppendedData(encode)
                            self.assert_octahedron(self.written(writer, self.data(kind), name))

    def test_the_end_of_the_file_must_be_there(self):
        # Harmless here: all numbers are there, the end tag is not.
        writer = vtkXMLUnstructuredGridWriter()
        writer.SetDataModeToAppended()
        writer.EncodeAppendedDataOff()
        file = self.written(writer, self.data(vtkUnstructuredGrid), "in.vtu")
        self.refused(self.put("in.vtu", file.read_bytes().rstrip()[:-3]), "it does not end with </VTKFile>")

    def test_vtk_is_held_against_the_head(self):
        file = self.grid((POINTS, TRIANGLES))
        with unittest.mock.patch.object(vtk_head, "read", return_value=("UnstructuredGrid", 6, 12)):
            self.refused(file, "its head says 6 points and 12 cells, VTK reads 6 and 8")

    def test_strips_of_triangles(self):
        stripper = vtkStripper()
        stripper.SetInputData(self.data())
        stripper.Update()
        self.assertGreater(stripper.GetOutput().GetNumberOfStrips(), 0)
        file = self.written(vtkXMLPolyDataWriter(), stripper.GetOutput(), "in.vtp")
        said = convert_surface.convert(file, self.folder / "out.vtu")
        self.assertNotIn("turned", " ".join(said))
        surface = surface_files.read_surface(self.folder / "out.vtu")[0]
        self.assertEqual((len(surface.triangles), surface.volume()), (8, 64 / 6))  # 4/3 r^3; whole numbers all the way

    def test_pixels_are_quadrilaterals(self):
        points, quads = CUBE_OF_QUADS
        positions, cells, data = vtkPoints(), vtkCellArray(), vtkUnstructuredGrid()
        positions.SetData(numpy_to_vtk(points, deep=True))
        cells.SetData(numpy_to_vtkIdTypeArray(numpy.arange(0, 25, 4), deep=True), numpy_to_vtkIdTypeArray(quads[:, [0, 1, 3, 2]].ravel(), deep=True))
        data.SetPoints(positions)
        data.SetCells(VTK_PIXEL, cells)
        said = convert_surface.convert(self.written(vtkXMLUnstructuredGridWriter(), data, "in.vtu"), None)
        self.assertIn("a membrane can be made of it: 8 nodes, 12 triangles, volume 1", said)
        self.assertNotIn("turned", " ".join(said))

    def test_lines_and_points_are_left_out(self):
        data, lines, verts = self.data(), vtkCellArray(), vtkCellArray()
        lines.SetData(2, numpy_to_vtkIdTypeArray(numpy.array([0, 1]), deep=True))
        verts.SetData(1, numpy_to_vtkIdTypeArray(numpy.array([3]), deep=True))
        data.SetLines(lines)
        data.SetVerts(verts)
        file = self.written(vtkXMLPolyDataWriter(), data, "in.vtp")
        self.assert_octahedron(file)
        self.assertIn("left out: cells of kind line, vertex", convert_surface.convert(file, None))

    def test_what_is_wrong_is_said_in_words_without_addresses(self):
        file = self.grid((POINTS, TRIANGLES))
        text = file.read_text()
        self.refused(self.put("in.vtp", text), "it holds UnstructuredGrid, where its name says PolyData; its name must end with .vtu")
        self.refused(self.put("in.vtu", text.replace('Points="6"', 'Points="100000"')), "100000 points and 8 cells, which a file of")
        self.refused(self.put("in.vtu", text.replace(' NumberOfPoints="6"', "")), "does not say how many")
        self.refused(self.put("in.vtu", text.replace("1.0 4.0 5.0", "1.0 x 5.0")), "it cannot be read: Cannot read points array from Points in piece 0")
        self.refused(self.put("in.vtu", text.replace('Points="6"', 'Points="5"')), "piece 0 has 18 numbers in 'Points' of its Points, 15 by its head")
        self.refused(self.put("in.vtu", text.replace('Cells="8"', 'Cells="7"')), "piece 0 has 8 numbers in 'offsets' of its Cells, 7 by its head")
        self.refused(self.put("in.vtu", text.replace("</VTKFile>", "")), "it is not VTK's XML")
        with self.assertRaises(InputError) as caught:
            surface_files.read_mesh(self.put("in.vtu", text.replace('Name="offsets"', 'Name="others"')))
        self.assertNotRegex(str(caught.exception), r"0x|vtkXML|ERROR")

    def test_a_library_that_ends_its_process_ends_nothing_else(self):
        file = self.put("in.vtu", "")
        self.assert_refused(["in.vtu: the library that reads it broke down over it"], vtk_reading.apart, lambda: os._exit(1), file)
        self.assert_refused("as it was thrown", vtk_reading.apart, lambda: (_ for _ in ()).throw(InputError("as it was thrown")), file)
        self.assertEqual(vtk_reading.apart(lambda: 3, file), 3)
        allowed = vtk_reading.apart(lambda: resource.getrlimit(resource.RLIMIT_AS)[0], file)
        self.assertGreater(allowed, 2**30)  # no limit is -1
        with self.assertRaises(MemoryError):
            vtk_reading.apart(lambda: len(bytearray(allowed)), file)


if __name__ == "__main__":
    unittest.main()
