"""What other programs may put into files of surfaces: all of it is read, or left out as the manual says, or refused; never a part of it taken for the whole. OBJ, STL, PLY, OFF and MSH."""

import struct
import unittest

import meshio
import numpy
from surface_files_fixture import POINTS, TRIANGLES, Files, rows
from surface_shapes import CUBE_OF_QUADS

from tanktread_post import convert_surface


class Obj(Files):
    def text(self, face, more=""):
        """An OBJ whose faces are written so: of a node a, with its normal n and its texture t."""
        normals, textures = rows(numpy.eye(3)), rows(numpy.zeros((9, 2)))
        lines = ["v " + line for line in rows(POINTS).splitlines()] + ["vn " + line for line in normals.splitlines()] + ["vt " + line for line in textures.splitlines()]
        faces = ["f " + " ".join(face.format(a=a + 1, back=a - len(POINTS), n=1 + a % 3, t=1 + a) for a in corners) for corners in TRIANGLES]
        return "\n".join(["# made for a test", "mtllib a.mtl", *lines, "g one", "usemtl red", "s off", *faces[:4], "o two", "g two three", "s 1", *faces[4:], more, ""])

    def test_normals_and_textures_of_faces_do_not_decide(self):
        # Three normals of six nodes, as drawing programs write: as many as there are directions.
        for face in ("{a}", "{a}//{n}", "{a}/{t}", "{a}/{t}/{n}", "{back}", "{back}//{n}"):
            with self.subTest(face):
                self.assert_octahedron(self.put("in.obj", self.text(face)))

    def test_a_cube_of_eight_points_and_six_normals(self):
        points, quads = CUBE_OF_QUADS
        text = "".join("v " + line + "\n" for line in rows(points).splitlines()) + "vn 0 0 1\n" * 6
        text += "".join("f " + " ".join(f"{a + 1}//{k + 1}" for a in quad) + "\n" for k, quad in enumerate(quads))
        self.assertIn("a membrane can be made of it: 8 nodes, 12 triangles, volume 1", convert_surface.convert(self.put("in.obj", text), None))

    def test_colours_weights_comments_and_long_lines(self):
        text = self.text("{a}").replace("\nvn", " 0.1 0.2 0.3\nvn", 1).replace("f 1 3 5", "f 1 \\\n 3 5 # the first")
        self.assertIn("\\", text)
        self.assert_octahedron(self.put("in.obj", text.replace("\n", "\r\n")))

    def test_lines_are_left_out_with_a_word(self):
        self.assertIn("left out: cells of kind line, vertex", convert_surface.convert(self.put("in.obj", self.text("{a}", "l 1 2 3\np 4")), None))

    def test_nodes_that_are_not_there(self):
        self.refused(self.put("in.obj", self.text("{a}", "f 0 1 2")), "line 35: a face names node 0; nodes count from 1")
        self.refused(self.put("in.obj", self.text("{a}", "f 1 2 -7")), "a face names node -7", "-6, the first so far")
        self.refused(self.put("in.obj", self.text("{a}", "f 1 2 7")), "face 8 names node 6, of 0 to 5")
        self.refused(self.put("in.obj", self.text("{a}", "f 1 2 x")), "line 35: 'x' is no whole number; the file is damaged")
        self.refused(self.put("in.obj", self.text("{a}", "f 1 2 0_3")), "line 35: '0_3' is no whole number")
        self.refused(self.put("in.obj", self.text("{a}", "v 1 2 1_0")), "line 35: '1_0' is no number")


class Stl(Files):
    def facets(self, chosen, normal="0 0 1"):
        return "".join(
            f" facet normal {normal}\n  outer loop\n" + "".join(f"   vertex {line}\n" for line in rows(POINTS[corners]).splitlines()) + "  endloop\n endfacet\n"
            for corners in TRIANGLES[chosen]
        )

    def test_several_solids_are_one_file(self):
        text = f"solid one # a name\n{self.facets(slice(3))}endsolid one\n\nsolid\n{self.facets(slice(3, 8))}endsolid\n\n"
        self.assert_octahedron(self.put("in.stl", text))
        self.assert_octahedron(self.put("in.stl", text.upper().replace("\n", "\r\n")))
        two = text + f"solid far\n{self.facets(slice(8)).replace('vertex ', 'vertex 2')}endsolid far\n"  # 1.0 becomes 21.0
        self.refused(self.put("in.stl", two), "2 separate bodies")

    def test_normals_do_not_decide(self):
        for normal in ("nan nan nan", "-nan(ind) 0 0", ""):
            self.assert_octahedron(self.put("in.stl", f"solid\n{self.facets(slice(8), normal)}endsolid\n"))

    def test_a_binary_one_that_begins_as_text_does(self):
        record = numpy.zeros(8, dtype=[("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("colour", "<u2")])
        record["corners"], record["colour"] = POINTS[TRIANGLES], 0xFFFF
        self.assert_octahedron(self.put("in.stl", b"solid as some programs write".ljust(80) + struct.pack("<I", 8) + record.tobytes()))
        self.refused(self.put("in.stl", b"exported".ljust(80) + struct.pack("<I", 9) + record.tobytes()), "9 triangles, as its head says, are 534 bytes, it has 484")

    def test_what_is_no_stl(self):
        self.refused(self.put("in.stl", f"solid\n{self.facets(slice(8))}cube 1\nendsolid\n"), "line 58: it begins with 'cube'")
        self.refused(self.put("in.stl", f"solid\n{self.facets(slice(8))}".replace(" endfacet", "  vertex 1 2 3\n endfacet", 1) + "endsolid\n"), "has not three vertices")
        self.refused(self.put("in.stl", f"solid\n{self.facets(slice(8))}"), "it ends within a solid, after 8 facets")


class Ply(Files):
    def written(self, form, vertex, face, others=()):
        """A PLY in a form of properties (type, name, values), where a list is (length type, type, name, values); `others`: further elements."""
        order = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}[form]
        head, body = f"ply\nformat {form} 1.0\ncomment made for a test\nobj_info of nothing\n", b""
        for element, properties in (*others, ("vertex", vertex), ("face", face)):
            head += f"element {element} {len(properties[0][-1])}\n"
            for *types, name, _ in properties:
                head += "property " + ("list " if len(types) == 2 else "") + " ".join(types) + f" {name}\n"
            for k in range(len(properties[0][-1])):
                row = []
                for *types, _, values in properties:
                    row += [(types[0], len(values[k]))] if len(types) == 2 else []
                    row += [(types[-1], value) for value in numpy.atleast_1d(values[k]).tolist()]
                body += self.row(order, row)
        return self.put("in.ply", f"{head}end_header\n".encode() + body)

    def row(self, order, values):
        if order is None:
            return (" ".join(str(value) for _, value in values) + "\n").encode()
        codes = {"uchar": "B", "int": "i", "uint": "I", "ushort": "H", "float": "f", "double": "d", "int32": "i", "uint8": "B", "float64": "d", "short": "h"}
        return b"".join(struct.pack(order + codes[kind], value) for kind, value in values)

    def test_properties_and_elements_besides(self):
        corners = ("uchar", "int", "vertex_indices", TRIANGLES.tolist())
        place = [("double", axis, POINTS[:, k].tolist()) for k, axis in enumerate("xyz")]
        normals = [("float", f"n{axis}", [0.5] * 6) for axis in "xyz"]
        colours = [("uchar", "red", [13] * 6), ("uchar", "alpha", [10] * 6)]  # of line ends
        of_faces = [("short", "flags", [3] * 8), ("uchar", "float", "texcoord", [[0.5] * 6] * 8)]
        edges = ("edge", [("int", "vertex1", [0, 1]), ("int", "vertex2", [2, 3])])
        strips = ("material", [("uchar", "uchar", "name", [[1, 2], []])])
        for form in ("ascii", "binary_little_endian", "binary_big_endian"):
            for vertex, face, others in (
                (place, [corners], ()),
                (place + normals + colours, [corners], ()),
                (normals + place[::-1] + colours, [corners], ()),
                (place, [corners, *of_faces], ()),
                (place, [*of_faces, corners], ()),
                (place, [("uint8", "uint", "vertex_index", TRIANGLES.tolist())], ()),
                (place, [("int32", "ushort", "vertex_indices", TRIANGLES.tolist())], (edges, strips)),
            ):
                with self.subTest(form, vertex=[p[-2] for p in vertex], face=[p[-2] for p in face], others=len(others)):
                    self.assert_octahedron(self.written(form, vertex, face, others))

    def test_single_precision_stays_what_it_is(self):
        place = [("float", axis, POINTS[:, k].tolist()) for k, axis in enumerate("xyz")]
        for form in ("ascii", "binary_little_endian"):  # whole numbers are exact in it
            self.assert_octahedron(self.written(form, place, [("uchar", "int", "vertex_indices", TRIANGLES.tolist())]))

    def test_what_is_no_surface(self):
        place = [("double", axis, POINTS[:, k].tolist()) for k, axis in enumerate("xyz")]
        corners = ("uchar", "int", "vertex_indices", TRIANGLES.tolist())
        self.refused(self.written("ascii", place, [("uchar", "int", "corners", TRIANGLES.tolist())]), "no element face with a list called vertex_indices or vertex_index")
        self.refused(self.written("ascii", place[:2], [corners]), "its head is not that of a PLY with x, y and z")
        data = self.written("ascii", place, [corners]).read_bytes()
        self.refused(self.put("in.ply", data.replace(b"property double z", b"property quad z")), "'property quad z' is no line of the head")
        self.refused(self.put("in.ply", data.replace(b"face 8", b"face 1000000000000")), "fewer numbers than its head says")
        self.refused(self.put("in.ply", data.replace(b"face 8", b"face -8")), "its head is not that")
        self.refused(self.put("in.ply", data.replace(b"5.0 4.0 5.0", b"5_0 4.0 5.0")), "something that is no number")
        self.refused(self.put("in.ply", data.replace(b"\n3 0 2 4", b"\n3 0 2 4.5")), "a fraction among its nodes")


class Off(Files):
    FACES = rows(numpy.insert(TRIANGLES, 0, 3, axis=1))

    def test_comments_colours_and_where_the_counts_stand(self):
        points, colours = rows(POINTS), " 255 0 0 # red\n"
        for text in (
            f"OFF\n6 8 12\n{points}{self.FACES}",
            f"OFF 6 8 12\n{points}{self.FACES}",
            f"# first\n\nOFF # second\n\n  6   8\t0\n# third\n{points}\n# fourth\n{self.FACES}\n\n",
            f"OFF\n6 8 12\n{points}{self.FACES.replace(chr(10), colours)}",
            "COFF\n6 8 0\n" + points.replace("\n", " 0.1 0.2 0.3 1\n") + self.FACES,
            "NOFF\n6 8 0\n" + points.replace("\n", " 0 0 1\n") + self.FACES,
        ):
            self.assert_octahedron(self.put("in.off", text))

    def test_quadrilaterals(self):
        points, quads = CUBE_OF_QUADS
        text = f"OFF\n8 6 12\n{rows(points)}{rows(numpy.insert(quads, 0, 4, axis=1))}"
        self.assertIn("split 6 quadrilaterals", " ".join(convert_surface.convert(self.put("in.off", text), None)))

    def test_what_is_no_off(self):
        text = f"OFF\n6 8 12\n{rows(POINTS)}{self.FACES}"
        self.refused(self.put("in.off", text.replace("OFF", "4OFF")), "its first word is '4OFF'")
        self.refused(self.put("in.off", text.replace("OFF", "OFF BINARY")), "must be OFF, COFF, NOFF or STOFF, in text")
        self.refused(self.put("in.off", text.replace("3 0 2 4\n", "3 0 2\n")), "line 9: 2 numbers where 3 must be")
        self.refused(self.put("in.off", text.replace("6 8 12", "six 8 12")), "line 2: 'six' is no whole number")


class Gmsh(Files):
    """As Gmsh writes them: names, groups of some entities only, points and lines and volumes besides the surface."""

    KINDS = (("vertex", [[0]]), ("line", [[0, 2]]), ("triangle", TRIANGLES), ("tetra", [[0, 2, 4, 5]]))

    def test_several_kinds_of_elements(self):
        for version in ("2.2", "4.0", "4.1"):
            for binary in (False, True):
                with self.subTest(version, binary=binary):
                    ones = [numpy.ones(len(data), dtype=numpy.int32) for _, data in self.KINDS]
                    mesh = meshio.Mesh(POINTS, list(self.KINDS), cell_data={"gmsh:physical": ones, "gmsh:geometrical": ones})
                    mesh.point_data = {"gmsh:dim_tags": numpy.full((6, 2), (2, 1))} if version == "4.1" else {}
                    meshio.gmsh.write(self.folder / "in.msh", mesh, fmt_version=version, binary=binary)
                    self.assert_octahedron(self.folder / "in.msh")
                    self.assertIn("left out: cells of kind line, tetra, vertex", convert_surface.convert(self.folder / "in.msh", None))

    def test_groups_and_names_do_not_decide(self):
        # Two surfaces of a model, of which one is in a group, and data for one element only; in text, as Gmsh's manual has it.
        nodes = "".join(f"{k + 1}\n" for k in range(6)) + rows(POINTS)
        elements = [f"2 {tag} 2 4\n" + "".join(f"{4 * (tag - 1) + k + 1} {' '.join(str(a + 1) for a in TRIANGLES[4 * (tag - 1) + k])}\n" for k in range(4)) for tag in (1, 2)]
        text = (
            "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Comments\nmade for a test\n$EndComments\n"
            '$PhysicalNames\n1\n2 7 "upper half"\n$EndPhysicalNames\n'
            "$Entities\n0 0 2 0\n1 0 0 0 1 1 1 1 7 0\n2 0 0 0 1 1 1 0 0\n$EndEntities\n"
            f"$Nodes\n1 6 1 6\n2 1 0 6\n{nodes}$EndNodes\n$Elements\n2 8 1 8\n{''.join(elements)}$EndElements\n"
            '$ElementData\n1\n"a"\n1\n0.0\n3\n0\n1\n1\n1 3.5\n$EndElementData\n'
        )
        self.assert_octahedron(self.put("in.msh", text))
        self.assert_octahedron(self.put("in.msh", text.replace("\n", "\r\n")))
        self.refused(self.put("in.msh", text.replace("$Nodes\n1 6 1 6\n2 1 0 6", "$Nodes\n1 6 1 6\n2 1 1 6")), "in.msh")

    def test_versions(self):
        self.refused(self.put("in.msh", "$MeshFormat\n1.0 0 8\n$EndMeshFormat\n$Nodes\n$EndNodes\n$Elements\n$EndElements\n"), "it is of version 1.0", "write it as version 2.2, 4.0 or 4.1")
        for version, called in (("2.2", "2"), ("4.0", "4"), ("4.1", "4")):
            file = self.folder / "in.msh"
            ones = [numpy.ones(8, dtype=numpy.int32)]
            meshio.gmsh.write(file, meshio.Mesh(POINTS, [("triangle", TRIANGLES)], cell_data={"gmsh:physical": ones, "gmsh:geometrical": ones}), version, binary=False)
            self.assert_octahedron(self.put("in.msh", file.read_bytes().replace(version.encode() + b" 0", called.encode() + b" 0")))
        self.refused(self.put("in.msh", "$NOD\n"), "0 whole sections $MeshFormat")


if __name__ == "__main__":
    unittest.main()
