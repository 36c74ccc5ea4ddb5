"""Tests of post/paraview: options, choice of arrays, camera; and of the whole script where ParaView's pvbatch is installed."""

import contextlib
import io
import itertools
import math
import os
import re
import shutil
import subprocess
import sys
import unittest

import matplotlib.image
import meshio
import numpy
from post_fixture import ROOT, InFolder, octahedron, write_echo, write_pictures, write_series
from vtkmodules.vtkRenderingCore import vtkCamera

SCRIPTS = ROOT / "post/paraview"
sys.path.insert(0, str(SCRIPTS))
import output_camera as camera  # noqa: E402
import output_fields as fields  # noqa: E402
import output_options  # noqa: E402

AREA_RATIO = fields.Array("CELLS", "area_ratio", 1)
STRETCHES = fields.Array("CELLS", "principal_stretches", 2)
VELOCITY = fields.Array("POINTS", "velocity", 3)
VISCOUS_STRESS = fields.Array("CELLS", "viscous_stress", 9)
ARRAYS = [AREA_RATIO, STRETCHES, VELOCITY, VISCOUS_STRESS]


def parse(*words, in_window=True):
    return output_options.parse(output_options.build_parser("made for a test"), words, in_window)


class Options(InFolder):
    def assert_exits(self, words, *arguments, in_window=True):
        """The options are refused with exit code 2 and a message that has all the words."""
        with contextlib.redirect_stderr(io.StringIO()) as said, self.assertRaises(SystemExit) as caught:
            parse(*arguments, in_window=in_window)
        self.assertEqual(caught.exception.code, 2)
        for word in words:
            self.assertIn(word, said.getvalue())

    def test_defaults(self):
        options = parse("out")
        self.assertEqual((options.output, options.picture, options.color, options.component), ("out", None, "area_ratio", None))
        self.assertEqual((options.range, options.slices, options.no_slice, options.size), (None, None, False, [1200, 900]))

    def test_negative_numbers_are_no_options(self):
        options = parse("out", "--range", "-1e-3", "2.5E-3", "--velocity-range", "-.5", "-0.25", "--slice", "x:-2e1")
        self.assertEqual((options.range, options.velocity_range, options.slices), ([-1e-3, 2.5e-3], [-0.5, -0.25], [(0, -20.0)]))

    def test_slices(self):
        self.assertEqual(parse("out", "--slice", "y", "--slice", "z:30.5").slices, [(1, None), (2, 30.5)])
        for word in ("w", "yz", "", "y30", "Y"):
            self.assert_exits([f"'{word}' does not begin with x, y or z"], "out", "--slice", word)
        for word in ("", "nan", "middle"):
            self.assert_exits([f"'{word}' is not a finite number"], "out", "--slice", "y:" + word)

    def test_refuses_contradictions_and_what_cannot_be(self):
        for option in ("--range", "--velocity-range"):
            self.assert_exits([f"{option} 2 1: LOW must be below HIGH"], "out", option, "2", "1")
            self.assert_exits(["LOW must be below HIGH"], "out", option, "1", "1")
            self.assert_exits(["'inf' is not a finite number"], "out", option, "1", "inf")
        self.assert_exits(["--no-slice and --slice"], "out", "--no-slice", "--slice", "x")
        self.assert_exits(["--frames saves all"], "out", "--frames", "f", "--shear-time", "1")
        self.assert_exits(["'-3' is not 0 or a number of arrows from 2"], "out", "--arrows", "-3")
        self.assert_exits(["'1' is not 0"], "out", "--arrows", "1")
        self.assertEqual([parse("out", "--arrows", n).arrows for n in ("0", "2")], [0, 2])
        self.assert_exits(["'901' is odd"], "out", "--size", "1200", "901")
        self.assert_exits(["'0'", "0.01"], "out", "--zoom", "0")

    def test_what_to_make_is_told_unless_in_the_window(self):
        self.assert_exits(["nothing to make", "PICTURE, --frames DIR or --list"], "out", in_window=False)
        self.assertTrue(parse("out", "--list", in_window=False).list)
        self.assertEqual(parse("out", "--frames", "f", in_window=False).frames, "f")

    def test_a_picture_that_cannot_be_saved(self):
        self.assert_exits(["a.gif", ".png"], "out", "a.gif")
        self.assert_exits([f"there is no folder {self.folder}/none"], "out", f"{self.folder}/none/a.png")
        self.assertEqual(parse("out", f"{self.folder}/a.PNG").picture, f"{self.folder}/a.PNG")
        (self.folder / "file").write_text("")
        self.assert_exits(["is no folder"], "out", "--frames", f"{self.folder}/file")

    def test_words_from_the_environment(self):
        words = output_options.words_from_environment
        self.assertEqual(words({"TANKTREAD_OUTPUT": "my out", "TANKTREAD_OPTIONS": "--color stress"}), ["my out", "--color", "stress"])
        self.assertEqual(words({"TANKTREAD_OPTIONS": "--list"}), [])

    def test_the_film_of_frames(self):
        said = output_options.film_command("my 5% run", 21)
        self.assertIn("-i 'my 5%% run/frame_%04d.png' -frames:v 21 ", said)
        self.assertTrue(said.endswith(" 'my 5% run/film.mp4'"))


class Fields(InFolder):
    def test_an_array_by_its_name(self):
        self.assertEqual(fields.choose_array(ARRAYS, "velocity"), VELOCITY)
        names = "area_ratio, principal_stretches, velocity, viscous_stress"
        self.assert_refused(["'viscos_stress'", names, "did you mean viscous_stress?"], fields.choose_array, ARRAYS, "viscos_stress")

    def test_a_component_by_number_or_name(self):
        for component, expected in ((None, -1), ("magnitude", -1), ("0", 0), ("xx", 0), ("XZ", 2), ("yx", 3), ("8", 8), ("zz", 8)):
            self.assertEqual(fields.choose_field(VISCOUS_STRESS, component), (VISCOUS_STRESS, expected))
        self.assertEqual(fields.choose_field(VELOCITY, "y").component, 1)
        # Numbers count from 0: the first principal stretch is 0 or "first".
        self.assertEqual([fields.choose_field(STRETCHES, c).component for c in ("0", "first", "1", "second")], [0, 0, 1, 1])
        self.assertEqual([fields.choose_field(AREA_RATIO, c).component for c in (None, "0")], [0, 0])

    def test_refuses_components_that_are_not_there(self):
        self.assert_refused(["--component 9", "viscous_stress", "0 (xx)", "8 (zz)", "magnitude"], fields.choose_field, VISCOUS_STRESS, "9")
        self.assert_refused(["--component -1", "0 (x)"], fields.choose_field, VELOCITY, "-1")
        self.assert_refused(["area_ratio has one component"], fields.choose_field, AREA_RATIO, "1")
        self.assert_refused(["has the components 0, 1, 2, 3, and magnitude"], fields.choose_field, fields.Array("CELLS", "other", 4), "x")

    def test_titles(self):
        titles = [fields.title(fields.Field(*pair)) for pair in ((AREA_RATIO, 0), (VISCOUS_STRESS, 1), (VELOCITY, -1), (STRETCHES, 0))]
        self.assertEqual(
            titles, ["area ratio", "viscous stress xy\n(lattice units)", "velocity\nmagnitude\n(lattice units)", "principal stretches\nfirst"]
        )

    def test_ranges_of_colours(self):
        for values in ((0.9, 1.2), (-0.01, 1.0)):
            self.assertEqual(fields.colour_range(*values), values)
        for values, expected in (((-2.0, 1.0), (-2.0, 2.0)), ((0.0, 0.0), (0.0, 1.0)), ((-3.0, -3.0), (-3.0, 0.0))):
            self.assertEqual(fields.colour_range(*values), expected)
        self.assertEqual([fields.goes_both_ways(limits) for limits in ((-2.0, 2.0), (0.9, 1.2), (-0.01, 1.0))], [True, False, False])
        self.assertEqual(fields.labels((-1.0, 1.0)), [-1.0, -0.5, 0.0, 0.5, 1.0])

    def test_times_of_a_series(self):
        write_pictures(self.folder)
        write_series(self.folder / "membrane.pvd", [(0.5, "membrane/membrane_1.vtu"), (3.0, "membrane/membrane_1.vtu")])
        # A file that is named again is no other file.
        self.assertEqual(fields.open_times(str(self.folder), "membrane"), [0.5])
        self.assertEqual(fields.open_entries(str(self.folder), "membrane"), [(0.5, 0.5), (3.0, 0.5)])
        write_series(self.folder / "fluid.pvd", [])
        self.assertEqual(fields.open_times(str(self.folder), "fluid"), [])
        write_series(self.folder / "fluid.pvd", [(0.5, "fluid/gone.vti")])
        self.assert_refused(["gone.vti", "is not there"], fields.open_times, str(self.folder), "fluid")
        self.assert_refused(["none/membrane.pvd", "is none the output of a run?"], fields.open_times, "none", "membrane")

    def test_moments(self):
        self.assertEqual([fields.nearest([0.0, 0.5, 1.0], t) for t in (None, 0.7, 9.0, -1.0)], [1.0, 0.5, 1.0, 0.0])
        whole = [(0.0, 0.0), (1.0, 1.0), (2.0, 2.0)]
        self.assertEqual(fields.flow_lag([0.0, 1.0], whole), (0.0, 0.0))
        # Between two entries ParaView 5.11 shows the later one (seen below), and after the last that one.
        self.assertEqual([fields.time_shown(whole, t) for t in (0.25, 1.0, 1.75, 9.0)], [1.0, 1.0, 2.0, 2.0])
        self.assertEqual(fields.flow_lag([0.25, 1.75], whole), (0.0, 0.75))
        # As a run writes it: the last file is named again.
        self.assertEqual(fields.flow_lag([0.25, 1.75], [(0.0, 0.0), (0.25, 0.0), (1.0, 1.0), (1.75, 1.0), (2.0, 2.0)]), (0.75, 0.0))

    def test_axes_of_the_run(self):
        self.assertEqual(fields.axes_of_run(str(self.folder)), (0, 1, 2))
        write_echo(self.folder)
        file = self.folder / "echo.toml"
        file.write_text(file.read_text().replace("wall_axis = 'z'", "wall_axis = 'x'").replace("flow_axis = 'x'", "flow_axis = 'y'"))
        self.assertEqual(fields.axes_of_run(str(self.folder)), (1, 2, 0))

    def test_slices_through_the_fluid(self):
        bounds = [0.5, 59.5, 0.5, 39.5, 0.5, 19.5]
        self.assertEqual(fields.place_slices(None, bounds, 1), [(1, 20.0)])
        self.assertEqual(fields.place_slices([(0, None), (2, 0.5)], bounds, 1), [(0, 30.0), (2, 0.5)])
        self.assert_refused(["--slice z:20", "from 0.5 to 19.5 along z"], fields.place_slices, [(2, 20.0)], bounds, 1)
        self.assert_refused("output.fluid_every", fields.place_slices, [(2, None)], None, 1)
        self.assertEqual(fields.place_slices(None, None, 1), [])
        self.assertEqual(fields.place_slices(None, [3.5, 3.5, 0.5, 39.5, 7.5, 7.5], 1), [])
        sheet = [0.5, 59.5, 0.5, 39.5, 7.5, 7.5]
        self.assertEqual(fields.place_slices(None, sheet, 1), [(2, 7.5)])
        self.assert_refused(["--slice y", "sheet of nodes across z"], fields.place_slices, [(1, None)], sheet, 1)

    def test_slices_that_might_hide_something_are_translucent(self):
        membrane = [20, 40, 20, 40, 20, 40]
        self.assertEqual(fields.slice_opacity([(1, 30.0)], membrane), 1.0)
        self.assertEqual(fields.slice_opacity([(1, 30.0)], None), 1.0)
        self.assertLess(fields.slice_opacity([(1, 41.0)], membrane), 1.0)
        self.assertLess(fields.slice_opacity([(1, 30.0), (2, 30.0)], membrane), 1.0)

    def test_the_list(self):
        said = fields.listing("my out", [("membrane", ARRAYS, [0.0, 0.25]), ("fluid", [], [])]).splitlines()
        self.assertEqual(said[0], "membrane: 2 times: 0 0.25")
        self.assertEqual(said[1].split(), ["area_ratio", "triangles"])
        self.assertEqual(said[3].split(), ["velocity", "nodes", "x", "y", "z"])
        self.assertIn("fluid: no files (output.fluid_every is 0?)", said)


class Camera(unittest.TestCase):
    def test_flow_to_the_right_gradient_up(self):
        for normal, axes in itertools.product(range(3), itertools.permutations(range(3))):
            right, up = camera.view_axes(normal, axes)
            self.assertEqual({right, up, normal}, {0, 1, 2})
            if normal == axes[1]:
                self.assertEqual((right, up), (axes[0], axes[2]))
            across, upwards, to_camera = camera.directions(right, up, 0.0, 0.0)
            self.assertEqual((across[right], upwards[up]), (1.0, 1.0))
            # What is to the right of what is up is seen so from where right x up points.
            numpy.testing.assert_array_equal(to_camera, numpy.cross(across, upwards))

    def test_all_is_seen_and_fills_the_picture(self):
        # The projection is VTK's own. Its coordinates are sums and quotients of numbers below 1000: rounding stays below 1e-9.
        slab, cube = [0.5, 59.5, 30.0, 30.0, 0.5, 59.5], [20.0, 80.0, 18.0, 43.0, 25.0, 35.0]
        for boxes, aspect, oblique in itertools.product(([slab], [cube], [slab, cube]), (0.5, 4 / 3, 3.0), (False, True)):
            across = []
            for zoom in (1.0, 0.5):
                position, focal_point, upwards = camera.place(boxes, 0, 2, aspect, oblique, zoom)
                x, y = self.project(boxes, position, focal_point, upwards, aspect)
                across.append(max(x / camera.WIDTH, y / camera.HEIGHT))
            self.assertAlmostEqual(across[0], 1.0, delta=1e-9)
            self.assertLess(across[1], 0.6)

    def project(self, boxes, position, focal_point, upwards, aspect):
        """The greatest |x| and |y| of the corners of boxes in a picture that reaches from -1 to 1."""
        eye = vtkCamera()
        eye.SetPosition(*position)
        eye.SetFocalPoint(*focal_point)
        eye.SetViewUp(*upwards)
        eye.SetViewAngle(camera.VIEW_ANGLE)
        matrix = eye.GetCompositeProjectionTransformMatrix(aspect, -1, 1)
        corners = [matrix.MultiplyPoint((x, y, z, 1.0)) for box in boxes for x in box[0:2] for y in box[2:4] for z in box[4:6]]
        return max(abs(x / w) for x, _, _, w in corners), max(abs(y / w) for _, y, _, w in corners)

    def test_places_of_arrows(self):
        corners, numbers, spacing = camera.lattice([0, 80, 7, 9, 0, 40], 1, 8.0, 8)
        self.assertEqual((corners, numbers, spacing), ([[5, 8, 5], [75, 8, 5], [5, 8, 35]], [8, 4], 10))
        # Across z the shorter side has two, not none.
        self.assertEqual(camera.lattice([0, 80, 7, 9, 0, 40], 2, 20.0, 8)[:2], ([[5, 7.5, 20], [75, 7.5, 20], [5, 8.5, 20]], [8, 2]))

    def test_boxes(self):
        self.assertEqual(camera.flat_box([0, 1, 2, 3, 4, 5], 1, 2.5), [0, 1, 2.5, 2.5, 4, 5])
        self.assertEqual(camera.union([[0, 1, 2, 3, 4, 5], [-1, 0.5, 2.5, 9, 4, 4.5]]), [-1, 1, 2, 9, 4, 5])
        self.assertTrue(math.isclose(math.dist(camera.middle([0, 1, 2, 3, 4, 5]), [0.5, 2.5, 4.5]), 0.0))


@unittest.skipUnless(shutil.which("pvbatch") and os.environ.get("DISPLAY"), "needs ParaView's pvbatch, and a display: run it under xvfb-run")
class InParaView(InFolder):
    def setUp(self):
        super().setUp()
        self.output = self.folder / "out"
        self.output.mkdir()
        write_pictures(self.output)
        points, triangles = octahedron(numpy.full(3, 6.0), 3.0)
        cells = {"area_ratio": [numpy.linspace(0.8, 0.9, 8)], "stress": [numpy.full((8, 9), 0.5)]}
        meshio.write(self.output / "membrane/membrane_0.vtu", meshio.Mesh(points, [("triangle", triangles)], cell_data=cells))
        write_series(self.output / "membrane.pvd", [(1.0, "membrane/membrane_0.vtu"), (3.0, "membrane/membrane_1.vtu")])

    def run_script(self, *words, exit_code=0):
        """What it prints; fails unless it ends with that exit code."""
        command = ["pvbatch", str(SCRIPTS / "open_output.py"), str(self.output), *map(str, words)]
        run = subprocess.run(command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertEqual(run.returncode, exit_code, run.stdout)
        return run.stdout

    def test_list(self):
        said = self.run_script("--list")
        self.assertIn("membrane: 2 times: 1 3", said)
        self.assertRegex(said, r"stress +triangles +xx xy xz")
        self.assertRegex(said, r"velocity +grid +x y z")

    def test_an_array_that_is_not_there(self):
        said = self.run_script(self.folder / "a.png", "--color", "strss", exit_code=2)
        self.assertIn("'strss': the membrane has no such array; it has area_ratio, stress; did you mean stress?", said)
        self.assertFalse((self.folder / "a.png").exists())

    def test_a_picture_that_cannot_be_written(self):
        (self.folder / "a.png").mkdir()
        self.assertIn("a.png: could not be saved", self.run_script(self.folder / "a.png", exit_code=3))

    def test_a_picture(self):
        said = self.run_script(self.folder / "a.png", "--size", 600, 450)
        # Over both membrane files, whichever is drawn.
        self.assertIn("area ratio: colours from 0.8 to 1.1", said)
        picture = matplotlib.image.imread(self.folder / "a.png")[..., :3]
        self.assertEqual(picture.shape, (450, 600, 3))
        # In the middle the membrane, in a colour; above it the flow to the right is red, below it that to the left is blue.
        self.assertGreater(numpy.ptp(picture[225, 300]), 0.1)
        above, below = (picture[rows, 200:350].mean(axis=(0, 1)) for rows in (slice(60, 80), slice(370, 390)))
        self.assertGreater(above[0], above[2] + 0.05)
        self.assertGreater(below[2], below[0] + 0.05)

    def write_turned_flow(self):
        """fluid_0.vti: the flow of fluid_1.vti, the other way round."""
        text = (self.output / "fluid/fluid_1.vti").read_text()
        head, numbers, end = re.split('(?<="ascii">)|(?=</DataArray>)', text)
        (self.output / "fluid/fluid_0.vti").write_text(head + " ".join(repr(-float(word)) for word in numbers.split()) + end)

    def colours_above_and_below(self, time, *words):
        """What the script says, and the mean colours of the slice above and below the membrane at a time."""
        said = self.run_script(self.folder / "a.png", "--size", 600, 450, "--shear-time", time, *words)
        picture = matplotlib.image.imread(self.folder / "a.png")[..., :3]
        return said, *(picture[rows, 200:350].mean(axis=(0, 1)) for rows in (slice(60, 80), slice(370, 390)))

    def test_the_flow_of_a_run_is_never_one_that_is_yet_to_come(self):
        self.write_turned_flow()
        times = [(1.0, 0), (2.0, 0), (3.0, 1)]
        write_series(self.output / "fluid.pvd", [(time, f"fluid/fluid_{k}.vti") for time, k in times])
        names = ["membrane_0", "membrane_2", "membrane_1"]
        shutil.copy(self.output / "membrane/membrane_0.vtu", self.output / "membrane/membrane_2.vtu")
        write_series(self.output / "membrane.pvd", [(k + 1.0, f"membrane/{name}.vtu") for k, name in enumerate(names)])
        said, above, below = self.colours_above_and_below(2)
        self.assertIn("up to 1 shear times older than the membrane", said)
        # The flow of time 1, turned: to the left above, to the right below.
        self.assertGreater(above[2], above[0] + 0.05)
        self.assertGreater(below[0], below[2] + 0.05)

    def test_between_two_entries_paraview_shows_the_later_one(self):
        # What the scripts and post/README.md say of a series that does not name its last file again.
        self.write_turned_flow()
        shutil.copy(self.output / "membrane/membrane_0.vtu", self.output / "membrane/membrane_2.vtu")
        write_series(self.output / "membrane.pvd", [(1.0, "membrane/membrane_0.vtu"), (2.0, "membrane/membrane_2.vtu")])
        write_series(self.output / "fluid.pvd", [(1.0, "fluid/fluid_0.vti"), (3.0, "fluid/fluid_1.vti")])
        said, above, below = self.colours_above_and_below(2)
        self.assertIn("up to 1 shear times younger than the membrane", said)
        self.assertGreater(above[0], above[2] + 0.05)
        self.assertGreater(below[2], below[0] + 0.05)

    def test_frames_of_one_component_in_fixed_colours(self):
        words = ["--color", "stress", "--component", "xy", "--range", 0, 2, "--no-edges", "--slice", "x", "--slice", "z:3"]
        self.assertIn("-frames:v 2 ", self.run_script("--frames", self.folder / "f", *words))
        self.assertEqual(sorted(file.name for file in (self.folder / "f").iterdir()), ["frame_0000.png", "frame_0001.png"])
        frames = [matplotlib.image.imread(self.folder / f"f/frame_000{k}.png")[..., :3] for k in range(2)]
        # The bar at the right edge stays.
        numpy.testing.assert_array_equal(frames[0][280:600, 1000:], frames[1][280:600, 1000:])
        # The stress is 0.5, then 1: a quarter and a half of the range. Light scales all of a colour, but ParaView's is a little warm:
        # it took 0.031 of the blue. Scaled by their greatest part, the two colours differ by 0.4 in green.
        for frame, share in zip(frames, (0.25, 0.5)):
            seen, expected = frame[450, 600], numpy.array(matplotlib.colormaps["viridis"](share)[:3])
            numpy.testing.assert_allclose(seen / seen.max(), expected / expected.max(), atol=0.08)


if __name__ == "__main__":
    unittest.main()
