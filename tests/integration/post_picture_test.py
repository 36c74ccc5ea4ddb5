"""Tests of plots, of the picture drawn without a screen (run under xvfb-run), and of mesh conversion."""

import os
import unittest

import matplotlib.image
import meshio
import numpy
from post_fixture import ROOT, InFolder, octahedron, write_pictures, write_run

from tanktread_post import mesh, plot


class Plots(InFolder):
    def test_a_run_with_its_reference(self):
        write_run(self.folder / "out", shear_time=4.2)
        for file in plot.plot_observables(self.folder / "out", ROOT / "cases/shear-capsule"):
            self.assertGreater(len(numpy.unique(matplotlib.image.imread(file)[..., 0])), 10)

    def test_runs_side_by_side(self):
        write_run(self.folder / "out/a")
        write_run(self.folder / "out/b")
        self.assertEqual([file.name for file in plot.plot_observables(self.folder / "out")], ["deformation.png", "inclination.png"])

    def test_says_that_nothing_is_there(self):
        self.assert_refused("neither the output of a run", plot.plot_observables, self.folder)


@unittest.skipUnless(os.environ.get("DISPLAY"), "needs a display: run it under xvfb-run")
class Picture(InFolder):
    def render(self, fluid=True, **options):
        from tanktread_post import render

        write_run(self.folder / "out")
        write_pictures(self.folder / "out", fluid=fluid)
        return matplotlib.image.imread(render.render(self.folder / "out", **options))[..., :3]

    def test_capsule_in_the_flow(self):
        picture = self.render()
        self.assertEqual(picture.shape, (900, 1200, 3))
        # The centre shows the membrane, in a colour (not white, not grey); above it the flow to the right is
        # red, below it the flow to the left is blue.
        centre = picture[450, 600]
        above, below = (picture[rows, 400:700].mean(axis=(0, 1)) for rows in (slice(120, 200), slice(720, 780)))
        self.assertGreater(numpy.ptp(centre), 0.1)
        self.assertGreater(above[0], above[2] + 0.05)
        self.assertGreater(below[2], below[0] + 0.05)

    def test_without_flow_and_by_another_field(self):
        picture = self.render(fluid=False, field="stress", file=self.folder / "stress.png")
        self.assertGreater(numpy.ptp(picture[450, 600]), 0.1)
        self.assertEqual(picture[5, 5].tolist(), [1.0, 1.0, 1.0])

    def test_refuses_a_field_that_is_not_there(self):
        self.assert_refused(["'strain'", "area_ratio"], self.render, field="strain")


class Meshes(InFolder):
    def test_an_stl_becomes_a_closed_surface(self):
        points, triangles = octahedron(numpy.zeros(3), 5.0)
        meshio.write(self.folder / "a.stl", meshio.Mesh(points, [("triangle", triangles)]), binary=True)
        self.assertEqual(mesh.convert(self.folder / "a.stl", self.folder / "a.vtu"), (6, 8))
        read = meshio.read(self.folder / "a.vtu")
        self.assertEqual(read.points.dtype, numpy.float64)
        # Every edge has two triangles that run through it in opposite directions: closed, and wound as before.
        edges = {(t[k], t[(k + 1) % 3]) for t in read.cells_dict["triangle"].tolist() for k in range(3)}
        self.assertEqual(len(edges), 24)
        self.assertTrue(all((b, a) in edges for a, b in edges))
        p = read.points[read.cells_dict["triangle"]]
        volume = numpy.einsum("ni,ni->", p[:, 0], numpy.cross(p[:, 1], p[:, 2])) / 6
        self.assertAlmostEqual(volume, 4 / 3 * 5**3, delta=1e-4)  # the coordinates of an STL are single precision

    def test_refuses_what_has_no_triangles(self):
        meshio.write(self.folder / "a.vtu", meshio.Mesh(numpy.zeros((2, 3)), [("line", numpy.array([[0, 1]]))]))
        self.assert_refused(["no triangles", "line"], mesh.convert, self.folder / "a.vtu", self.folder / "b.vtu")
        self.assert_refused("cannot be read", mesh.convert, self.folder / "none.stl", self.folder / "b.vtu")


if __name__ == "__main__":
    unittest.main()
