"""Tests of plots, and of the picture drawn without a screen (run under xvfb-run)."""

import os
import unittest
import unittest.mock

import matplotlib.image
import numpy
from post_fixture import ROOT, InFolder, write_pictures, write_run, write_series

from tanktread_post import case_results, plot, reference


class Plots(InFolder):
    def test_a_run_with_its_reference(self):
        write_run(self.folder / "out", shear_time=4.2)
        for file in plot.plot_observables(self.folder / "out", ROOT / "cases/shear-capsule"):
            self.assertGreater(len(numpy.unique(matplotlib.image.imread(file)[..., 0])), 10)

    def test_runs_side_by_side(self):
        write_run(self.folder / "out/a")
        write_run(self.folder / "out/b")
        self.assertEqual([file.name for file in plot.plot_observables(self.folder / "out")], ["deformation.png", "inclination.png"])

    def test_a_case_says_which_runs_are_drawn_together(self):
        case, output = self.folder / "case", self.folder / "out"
        case.mkdir()
        values = "".join(f'[[value]]\nrun = "{run}"\nname = "deformation"\nshear_time = {time}\nreference = 0.1\n' for run, time in (("b", 1.0), ("c", 2.0)))
        comparison = 'title = "pictures"\n' + values + "".join(
            f'[[picture]]\nfile = "{file}.png"\nname = "{name}"\nruns = {runs}\n'
            for file, name, runs in (("both", "deformation", ["b", "a"]), ("late", "inclination_deg", ["c"]), ("one", "inclination_deg", ["a", "c"]))
        )
        (case / "compare.toml").write_text(comparison)
        for run in ("a", "b"):
            write_run(output / run)
        with unittest.mock.patch.object(plot, "_plot_quantity", side_effect=plot._plot_quantity) as drawn:
            files = plot.plot_observables(output, case)
        self.assertEqual([file.name for file in files], ["both.png", "one.png"])
        self.assertEqual([(call.args[0], list(call.args[1])) for call in drawn.call_args_list], [("deformation", ["b", "a"]), ("inclination_deg", ["a"])])
        self.assertEqual([[value["run"] for value in call.args[2]] for call in drawn.call_args_list], [["b"], []])
        write_run(self.folder / "others/d")
        self.assertEqual([file.name for file in plot.plot_observables(self.folder / "others", case)], ["deformation.png", "inclination.png"])

    def test_a_picture_is_no_file_of_another_kind(self):
        from tanktread_post import render

        (self.folder / "case.toml").write_text("mine")
        self.assert_refused(["case.toml: a picture is a PNG"], render.render, self.folder, file=self.folder / "case.toml")
        self.assert_refused(["there is no folder"], render.render, self.folder, file=self.folder / "none/a.png")
        self.assertEqual((self.folder / "case.toml").read_text(), "mine")

    def test_every_quantity_of_a_plot_may_be_pictured(self):
        self.assertEqual(tuple(plot.PLOTS), reference.PICTURED)

    def test_a_picture_that_cannot_be_is_refused_before_a_run(self):
        case = self.folder / "case"
        case.mkdir()
        picture = 'title = "pictures"\n[[picture]]\nfile = "a.png"\nname = "{}"\nruns = ["a", "b"]\n'
        for text, words in (
            (picture.format("length"), "no picture of 'length', only of deformation, inclination_deg"),
            (picture.format("deformation"), "no run is called 'b'"),
            (picture.format("deformation").replace("a.png", "observables.csv"), "file = 'observables.csv', must be a name without a folder that ends with .png"),
            (picture.format("deformation").replace("a.png", "../a.png"), "file = '../a.png', must be a name without a folder"),
        ):
            (case / "runs.csv").write_text("run,groups\na,all\n")
            (case / "compare.toml").write_text(text)
            self.assert_refused(words, reference.read_comparison, case)

    def test_a_snapshot_is_of_the_nearest_membrane_and_not_of_a_run_that_has_yet_to_get_there(self):
        case, output = self.folder / "case", self.folder / "out"
        case.mkdir()
        times = {"a": [2.0, 4.0, 4.5], "b": [2.0, 4.0]}
        (case / "compare.toml").write_text(
            "title = 'snapshots'\n" + "".join(f"[[snapshot]]\nrun = '{run}'\nshear_time = 4.17\nlabel = 'of {run}'\n" for run in ["a", "b", "c"])
        )
        for run, of_run in times.items():
            write_run(output / run)
            write_series(output / run / "membrane.pvd", [(time, f"membrane_{time}.vtu") for time in of_run])
        reached = [(entry["label"], run.name, time) for entry, run, time in case_results.reached_snapshots(output, case)]
        self.assertEqual(reached, [("of a", "a", 4.0)])
        # A membrane that is named again where a fluid file is has its own time, and the run is no further.
        write_series(output / "b/membrane.pvd", [(2.0, "membrane_2.vtu"), (4.0, "membrane_4.vtu"), (4.17, "membrane_4.vtu"), (4.3, "membrane_4.vtu")])
        write_series(output / "a/membrane.pvd", [(4.0, "membrane_4.vtu"), (4.16, "membrane_4.vtu"), (4.5, "membrane_5.vtu")])
        reached = [(entry["label"], run.name, time) for entry, run, time in case_results.reached_snapshots(output, case)]
        self.assertEqual(reached, [("of a", "a", 4.0)])

        from tanktread_post import snapshots

        (output / "a/membrane.pvd").unlink()
        self.assert_refused(["has come to", "compare.toml"], snapshots.draw_snapshots, output, case)

    def test_says_that_nothing_is_there(self):
        self.assert_refused("neither the output of a run", plot.plot_observables, self.folder)

    def test_a_capsule_is_not_drawn_without_a_display(self):
        from tanktread_post import render

        with unittest.mock.patch.dict(os.environ):
            os.environ.pop("DISPLAY", None)
            self.assert_refused("xvfb-run -a", render.render, self.folder)


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

    def test_the_flow_is_the_last_one_of_that_time(self):
        output = self.folder / "out"
        write_run(output)
        write_pictures(output)
        write_series(output / "membrane.pvd", [(3.3, "membrane/membrane_1.vtu")])
        # The nearer one is yet to come, and is not there.
        write_series(output / "fluid.pvd", [(2.0, "fluid/fluid_1.vti"), (3.5, "fluid/gone.vti")])
        from tanktread_post import render

        self.assertTrue(render.render(output).is_file())

    def test_refuses_a_field_that_is_not_there(self):
        self.assert_refused(["'strain'", "area_ratio"], self.render, field="strain")

    def test_a_strip_has_a_panel_a_time(self):
        from tanktread_post import strip

        output = self.folder / "out"
        write_run(output, width=12, radius=3.0)
        write_pictures(output, fluid=False)
        picture = matplotlib.image.imread(strip.draw(output, [0.0, 1.0, 3.0]))[..., :3]
        self.assertEqual(picture.shape, (420, 3 * 420, 3))
        for k in range(3):
            panel = picture[:, 420 * k : 420 * (k + 1)]
            red = (panel[..., 0] > panel[..., 1] + 0.15) & (panel[..., 0] > panel[..., 2] + 0.15)
            # An octahedron with corners at one radius, of which the smooth surface is about half as wide, in a frame 3.5 radii wide.
            self.assertTrue(0.01 < red.mean() < 0.3, red.mean())
            self.assertTrue(red[210, 210])
            self.assertEqual(panel[5, 5].tolist(), [1.0, 1.0, 1.0])

    def test_a_strip_is_of_one_capsule_that_is_there(self):
        from tanktread_post import strip

        output = self.folder / "out"
        self.assert_refused(["there is no such folder"], strip.draw, output, [1.0])
        write_run(output, width=12, radius=3.0)
        self.assert_refused(["cells.txt: a picture is a PNG"], strip.draw, output, [1.0], self.folder / "cells.txt")
        write_series(output / "membrane.pvd", [])
        self.assert_refused(["there is nothing to draw"], strip.draw, output, [1.0])
        with open(output / "echo.toml", "a") as stream:
            stream.write("[[capsule]]\nradius = 3.0\n[capsule.membrane]\n")
        self.assert_refused(["2 capsules"], strip.draw, output, [1.0])


if __name__ == "__main__":
    unittest.main()
