"""Surfaces to and from the formats of other programs. Usage: post_convert_test.py TANKTREAD [unittest arguments]."""

import contextlib
import io
import os
import subprocess
import sys
import unittest

import meshio
import numpy
from post_fixture import ROOT, InFolder, octahedron
from surface_shapes import CUBE_OF_QUADS, obj_text, projective_plane, soup, torus

from tanktread_post import convert_surface, surface_files
from tanktread_post.__main__ import main
from tanktread_post.surface import Edges

# Format, options for writing it, whether it keeps doubles.
FORMS = [
    ("stl", [], False), ("stl", ["--ascii"], True), ("obj", [], True), ("ply", [], True), ("ply", ["--ascii"], True), ("off", [], True),
    ("msh", [], True), ("msh", ["--ascii"], True), ("msh", ["--gmsh-version", "2.2"], True), ("msh", ["--gmsh-version", "2.2", "--ascii"], True),
]  # fmt: skip


class Surfaces(InFolder):
    """Tests that write a surface to a file and convert it."""

    def program(self, *arguments):
        return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True)

    def command(self, *arguments):
        """What a user's command would do, in this process: to start one with meshio takes longer than most conversions."""
        output, errors = io.StringIO(), io.StringIO()
        with contextlib.chdir(self.folder), contextlib.redirect_stdout(output), contextlib.redirect_stderr(errors):
            try:
                code = main(["convert-surface", *map(str, arguments)])
            except SystemExit as ended:  # of argparse
                code = ended.code
        return subprocess.CompletedProcess(arguments, code, output.getvalue(), errors.getvalue())

    def write(self, points, triangles, name="in.obj"):
        """A file of these triangles as they are, whatever is wrong with them."""
        file = self.folder / name
        file.write_text(obj_text(points, triangles))
        return file

    def convert(self, points, triangles, **options):
        """(the surface that comes out, what is said about it)"""
        target = self.folder / "out.vtu"
        said = convert_surface.convert(self.write(points, triangles), target, force=True, **options)
        return surface_files.read_surface(target)[0], "\n".join(said)

    def refused(self, words, points, triangles, **options):
        """The surface is refused with these words, each message with the name of the file; nothing is written."""
        self.assert_refused(["in.obj: ", *words], self.convert, points, triangles, **options)
        self.assertEqual([file.name for file in self.folder.iterdir()], ["in.obj"])


class RoundTrips(Surfaces):
    def sphere(self):
        file = self.folder / "sphere.vtu"
        self.program("mesh", "sphere", "--level", "3", "--radius", "9.7", "--centre", "30.1", "-31.2", "0.3", file)
        return meshio.read(file)

    def test_every_format_and_back(self):
        before = self.sphere()
        corners = before.points[before.cells_dict["triangle"]]
        for suffix, options, double in FORMS:
            with self.subTest(suffix=suffix, options=options):
                there = self.command("sphere.vtu", f"there.{suffix}", "--force", *options)
                back = self.command(f"there.{suffix}", "back.vtu", "--force")
                self.assertEqual((there.returncode, there.stderr, back.returncode, back.stderr), (0, "", 0, ""))
                after = meshio.read(self.folder / "back.vtu")
                self.assertEqual(after.points.dtype, numpy.float64)
                # Binary STL rounds a coordinate x to the nearest of 24 bits: by 2^-24 |x| at most. All else keeps every bit.
                bound = 0.0 if double else 2.0**-24 * abs(corners).max()
                moved = abs(after.points[after.cells_dict["triangle"]] - corners).max()
                self.assertLessEqual(moved, bound)
                self.assertEqual(moved > 0, not double)
                self.assert_membrane("back.vtu")

    def assert_membrane(self, name):
        info = self.program("mesh", "info", self.folder / name)
        self.assertEqual(info.returncode, 0, info.stderr)
        self.assertIn("outward yes", info.stdout)

    def test_text_and_binary_are_what_was_asked_for(self):
        self.sphere()
        for suffix, mark in (("stl", b"solid"), ("ply", b"ply\nformat ascii"), ("msh", b"$MeshFormat\n4.1 0")):
            for options, text in (([], False), (["--ascii"], True)):
                self.command("sphere.vtu", f"there.{suffix}", "--force", *options)
                self.assertEqual((self.folder / f"there.{suffix}").read_bytes().startswith(mark), text, suffix)
        self.command("sphere.vtu", "there.msh", "--force", "--gmsh-version", "2.2")
        self.assertTrue((self.folder / "there.msh").read_bytes().startswith(b"$MeshFormat\n2.2 1"))

    def test_a_case_takes_it_as_its_mesh(self):
        self.sphere()
        self.command("sphere.vtu", "there.stl")
        self.command("there.stl", "back.vtu", "--scale", "2")
        case = (ROOT / "cases/shear-capsule/case.toml").read_text()
        named = case.replace('mesh = { shape = "sphere", level = 3 }', 'mesh = { file = "back.vtu" }')
        self.assertNotEqual(named, case)
        (self.folder / "case.toml").write_text(named)
        plan = self.program("plan", self.folder / "case.toml")
        self.assertEqual(plan.returncode, 0, plan.stderr)
        self.assertRegex(plan.stdout, r"mesh +back\.vtu")


class Repairs(Surfaces):
    def setUp(self):
        super().setUp()
        self.points, self.triangles = octahedron(numpy.array([3.0, 4.0, 5.0]), 2.0)

    def test_shuffled_winding(self):
        turn = numpy.array([0, 1, 1, 0, 0, 1, 0, 0], dtype=bool)
        shuffled = numpy.where(turn[:, None], self.triangles[:, ::-1], self.triangles)
        for name, triangles, said in (("some", shuffled, "turned 3 triangles"), ("most", shuffled[:, ::-1], "turned 5 triangles")):
            with self.subTest(name):
                surface, lines = self.convert(self.points, triangles)
                self.assertIn(said, lines)
                self.assertEqual(surface.volume(), 64 / 6)  # 4/3 r^3; whole numbers all the way
                edges = Edges(surface.triangles)
                self.assertFalse(edges.clash(numpy.arange(24), numpy.zeros(8, dtype=bool)).any())

    def test_inside_out(self):
        surface, lines = self.convert(self.points, self.triangles[:, ::-1])
        self.assertIn("turned all triangles", lines)
        self.assertGreater(surface.volume(), 0)

    def test_what_is_right_stays_as_it_is(self):
        surface, lines = self.convert(self.points, self.triangles)
        self.assertEqual((surface.points.tolist(), surface.triangles.tolist()), (self.points.tolist(), self.triangles.tolist()))
        self.assertEqual(len(lines.splitlines()), 2)

    def test_points_are_merged_within_the_tolerance(self):
        # Every corner thrice or more, off by up to 1e-7 along each axis; the diagonal of the box is 4 sqrt(3) = 6.9.
        apart = soup(self.points, self.triangles)[0] + numpy.random.default_rng(1).uniform(-1e-7, 1e-7, (24, 3))
        surface, lines = self.convert(apart, numpy.arange(24).reshape(8, 3))
        self.assertIn("merged 18 points", lines)
        # The first of each is kept as it is.
        self.assertTrue((surface.points[:, None] == apart[None]).all(axis=2).any(axis=1).all())
        self.assertEqual((len(surface.points), len(surface.triangles)), (6, 8))
        # They lie up to 2e-7 sqrt(3) = 3.5e-7 apart, 5e-8 of the diagonal. At 1e-11 of it none are equal.
        (self.folder / "out.vtu").unlink()
        self.refused(["open: 24 edges", "--merge-tolerance (1e-11)"], apart, numpy.arange(24).reshape(8, 3), merge_tolerance=1e-11)

    def test_leftovers_are_dropped_and_counted(self):
        points = numpy.concatenate([self.points, [[9.0, 9.0, 9.0]], self.points[:1]])
        # Twice the same, once turned; and one that collapses since point 7 is point 0.
        triangles = numpy.concatenate([self.triangles, self.triangles[[3]], self.triangles[[4], ::-1], [[0, 7, 2]]])
        surface, lines = self.convert(points, triangles)
        for said in ("dropped 1 point of no triangle", "merged 1 point", "dropped 1 triangle with a corner twice", "dropped 2 triangles with the"):
            self.assertIn(said, lines)
        self.assertEqual((surface.points.tolist(), surface.triangles.tolist()), (self.points.tolist(), self.triangles.tolist()))

    def test_quadrilaterals_are_split_along_the_shorter_diagonal(self):
        points, quads = CUBE_OF_QUADS
        sheared = points + numpy.outer(points[:, 1], [0.5, 0.0, 0.0])
        surface, lines = self.convert(sheared, quads)
        self.assertIn("split 6 quadrilaterals", lines)
        self.assertEqual(len(surface.triangles), 12)
        self.assertAlmostEqual(surface.volume(), 1.0, delta=1e-15)  # a few roundings of numbers below 1
        # Diagonals of the sheared faces: sqrt(0.5^2 + 1) or sqrt(1.5^2 + 1); of the others at most sqrt(2.25).
        self.assertLess(surface.sides().max(), 1.51)

    def test_faces_of_more_corners_are_split(self):
        # An L of six corners, which no fan about its first one fills, and its copy above it.
        flat = numpy.array([[1, 0], [2, 0], [2, 2], [0, 2], [0, 1], [1, 1]], float)
        points = numpy.concatenate([numpy.insert(flat, 2, height, axis=1) for height in (0.0, 1.0)])
        walls = [[k, (k + 1) % 6, 6 + (k + 1) % 6, 6 + k] for k in range(6)]
        self.write(points, [[5, 4, 3, 2, 1, 0], *walls, [6, 7, 8, 9, 10, 11]])
        said = convert_surface.convert(self.folder / "in.obj", self.folder / "out.vtu")
        self.assertIn("split 2 faces of five corners or more into triangles", said)
        surface = surface_files.read_surface(self.folder / "out.vtu")[0]
        self.assertEqual(len(surface.triangles), 2 * 4 + 6 * 2)
        self.assertAlmostEqual(surface.volume(), 3.0, delta=1e-14)  # roundings of a few numbers below 2
        self.assertGreater(surface.areas().min(), 0.49)  # the L is made of halves of unit squares, or larger triangles

    def test_what_a_run_says_of_its_membrane_is_left_out_with_a_word(self):
        arrays = {"area_ratio": [numpy.ones(8)]}
        meshio.write(self.folder / "in.vtu", meshio.Mesh(self.points, [("triangle", self.triangles)], {"velocity": self.points}, arrays))
        said = convert_surface.convert(self.folder / "in.vtu", None)
        self.assertIn("left out: arrays velocity, area_ratio", said)

    def test_scale_and_body(self):
        points = numpy.concatenate([self.points, self.points * 3])
        surface, lines = self.convert(points, numpy.concatenate([self.triangles, self.triangles + 6]), body=1, scale=0.5)
        self.assertEqual(surface.points.tolist(), (self.points * 1.5).tolist())
        self.assertIn("took body 1 of 2", lines)

    def test_check_only_and_force(self):
        source = self.write(self.points, self.triangles)
        checked = self.command(source, "--check-only")
        self.assertEqual((checked.returncode, [file.name for file in self.folder.iterdir()]), (0, ["in.obj"]))
        self.assertIn("a membrane can be made of it", checked.stdout)
        self.assertEqual(self.command(source, "out.off").returncode, 0)
        written = (self.folder / "out.off").read_bytes()
        again = self.command(source, "out.off", "--scale", "2")
        self.assertEqual((again.returncode, (self.folder / "out.off").read_bytes()), (2, written))
        self.assertIn("out.off: it is there already", again.stderr)
        self.assertEqual(self.command(source, "out.off", "--scale", "2", "--force").returncode, 0)
        self.assertNotEqual((self.folder / "out.off").read_bytes(), written)

    def test_force_replaces_files_only(self):
        source = self.write(self.points, self.triangles)
        os.mkfifo(self.folder / "out.off")
        refused = self.command(source, "out.off", "--force")
        self.assertEqual(refused.returncode, 2)
        self.assertIn("out.off: it is no file, so it cannot be replaced; choose another name", refused.stderr)
        self.assertTrue((self.folder / "out.off").is_fifo())


class Refusals(Surfaces):
    def setUp(self):
        super().setUp()
        self.points, self.triangles = octahedron(numpy.zeros(3), 1.0)

    def test_open(self):
        self.refused(["open: 3 edges with one triangle", "node 0 at (1, 0, 0) to node 2 at (0, 1, 0) (face 3)"], self.points, self.triangles[1:])

    def test_numbers_are_those_of_the_file(self):
        # Before the octahedron without its first triangle: a point that nothing uses, a triangle that is dropped.
        points, triangles = numpy.concatenate([[[9.0, 9.0, 9.0]], self.points]), numpy.concatenate([[[1, 1, 2]], self.triangles[1:] + 1])
        self.refused(["node 1 at (1, 0, 0) to node 3 at (0, 1, 0) (face 4)"], points, triangles)

    def test_an_edge_of_three_triangles(self):
        fin = numpy.concatenate([self.points, [[2.0, 2.0, 0.0]]])
        triangles = numpy.concatenate([self.triangles, [[0, 2, 6]]])
        self.refused(["1 edge with three triangles", "node 0 at (1, 0, 0) to node 2 at (0, 1, 0) (face 0, 4, 8)"], fin, triangles)

    def test_several_bodies(self):
        points, triangles = numpy.concatenate([self.points, self.points + 5]), numpy.concatenate([self.triangles, self.triangles + 6])
        self.refused(["2 separate bodies", "body 1 of 8 triangles about (5, 5, 5)", "--body K"], points, triangles)
        self.refused(["--body 2", "2 separate bodies, numbered from 0"], points, triangles, body=2)

    def test_one_side_only(self):
        self.refused(["one side only", "the windings clash at", "(face "], *projective_plane())

    def test_a_triangle_without_area(self):
        # Node 6 halves the edge from 0 to 2 for one of its triangles; a flat triangle closes the gap.
        points = numpy.concatenate([self.points, [(self.points[0] + self.points[2]) / 2]])
        triangles = numpy.concatenate([[[0, 6, 4], [6, 2, 4]], self.triangles[1:], [[0, 2, 6]]])
        words = ["1 triangle without area: face 9 of nodes 0, 2, 6 about (0.5"]
        self.refused(words, points, triangles)
        # The height that counts as none is 1e-6 of the diagonal, 2 sqrt(3).
        height = points + numpy.outer(numpy.arange(7) == 6, [numpy.sqrt(0.5), numpy.sqrt(0.5), 0.0]) * 2e-6 * numpy.sqrt(3)
        self.refused(words, points + 0.99 * (height - points), triangles)
        self.assertEqual(len(self.convert(points + 1.01 * (height - points), triangles)[0].triangles), 10)

    def test_a_node_where_it_touches_itself(self):
        points, triangles = meshio_sphere(self)
        far = int(numpy.argmax(numpy.linalg.norm(points - points[0], axis=1)))
        triangles = numpy.where(triangles == far, 0, triangles)
        self.refused(["touches itself in 1 node: node 0 at", "with 2 fans"], points, triangles)

    def test_a_handle(self):
        self.refused(["not one sphere", "is 0, must be 2"], *torus())

    def test_no_volume(self):
        square = numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
        self.refused(["encloses no volume"], square, numpy.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]]))

    def test_all_defects_at_once(self):
        points, triangles = numpy.concatenate([self.points, self.points + 5]), numpy.concatenate([self.triangles[1:], self.triangles + 6])
        self.refused(["in.obj: the surface is open", "in.obj: it has 2 separate bodies"], points, triangles)

    def test_numbers(self):
        self.points[2, 1] = numpy.nan
        self.refused(["1 point without finite coordinates: node 2 at (0, nan, 0)"], self.points, self.triangles)
        self.points[2, 1] = numpy.inf
        self.refused(["node 2 at (0, inf, 0)"], self.points, self.triangles)
        self.assert_refused("in.obj, line 1: 2 numbers where 3 must be", self.convert, self.points[:, :2], self.triangles)
        self.refused(["names node 6, of 0 to 5"], octahedron(0.0, 1.0)[0], self.triangles + 1)

    def test_two_closed_bodies_whose_euler_numbers_have_the_sum_of_one(self):
        # nodes - edges + triangles is 0 of a torus and 2 of a tetrahedron: together that of a sphere.
        ring, around = torus()
        points = numpy.concatenate([ring, self.points[[0, 2, 4, 1]] + 9])
        triangles = numpy.concatenate([around, len(ring) + numpy.array([[0, 1, 2], [0, 2, 3], [0, 3, 1], [1, 3, 2]])])
        self.refused(["2 separate bodies", "body 1 of 4 triangles"], points, triangles)
        self.refused(["not one sphere", "is 0, must be 2"], points, triangles, body=0)
        surface, said = self.convert(points, triangles, body=1)
        self.assertEqual((len(surface.triangles), "took body 1 of 2" in said), (4, True))

    def test_cells(self):
        points, quads = CUBE_OF_QUADS
        self.refused(["face 0 of 6 corners is degenerate or cuts through itself"], points, [[0, 1, 2, 3, 0, 1]])
        self.refused(["there are no triangles"], points, [])
        for kind, n, words in (("triangle6", 6, ["curved cells (triangle6)", "of order 1"]), ("line", 2, ["no triangles, only cells of kind line"])):
            meshio.write(self.folder / "in.vtu", meshio.Mesh(points, [(kind, [list(range(n))])]))
            self.assert_refused(["in.vtu", *words], convert_surface.convert, self.folder / "in.vtu", None)

    def test_files(self):
        out = self.folder / "out.vtu"
        for suffix in surface_files.READERS:
            file = self.folder / f"in{suffix}"
            self.assert_refused(f"in{suffix}: there is no such file", convert_surface.convert, file, out)
            file.write_bytes(b"")
            self.assert_refused(f"in{suffix}: it is empty", convert_surface.convert, file, out)
            file.write_bytes(bytes(range(256)) * 4)
            self.assert_refused([f"in{suffix}"], convert_surface.convert, file, out)
        self.assert_refused(["in.iges", ".stl, .obj"], convert_surface.convert, self.folder / "in.iges", out)
        self.assert_refused(["out.vtp", ".msh, .vtu, which"], convert_surface.convert, self.write(self.points, self.triangles), self.folder / "out.vtp")
        self.assertFalse(out.exists())

    def test_options(self):
        source = self.write(self.points, self.triangles)
        for options, words in (
            (["out.vtu", "--scale", "0"], "--scale 0: it must be a positive number"),
            (["out.vtu", "--scale", "nan"], "'nan' is no number"),
            (["out.vtu", "--merge-tolerance", "0.1"], "from 0 to 0.01"),
            (["out.obj", "--ascii"], "out.obj: --ascii is for .stl, .ply, .msh only"),
            (["none/out.stl"], "there is no folder none"),
            (["out.xyz"], "out.xyz: its name must end with"),
            ([], "name the file to write"),
        ):
            ended = self.command(source, *options)
            self.assertEqual((ended.returncode, ended.stdout), (2, ""))
            self.assertIn(words, ended.stderr)
        self.assertEqual([file.name for file in self.folder.iterdir()], ["in.obj"])


def meshio_sphere(test):
    """Points and triangles of a sphere that the program makes."""
    test.program("mesh", "sphere", "--level", "1", test.folder / "sphere.vtu")
    mesh = meshio.read(test.folder / "sphere.vtu")
    (test.folder / "sphere.vtu").unlink()
    return mesh.points, mesh.cells_dict["triangle"]


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
