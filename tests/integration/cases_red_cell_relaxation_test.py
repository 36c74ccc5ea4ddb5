"""Tests of the analysis of the cell that comes back, on series made by the formula that is fitted."""

import csv
import math
import shutil
import unittest

import numpy

from post_fixture import ROOT, InFolder, said, write_observables

from tanktread_post import case_analysis, case_results
from tanktread_post.relaxation import length_over_width

CASE = ROOT / "cases/red-cell-relaxation"
COLUMNS = "step,shear_time,capsule,axial_diameter,transverse_diameter,volume_ratio,area_ratio,elastic_energy,load_power,speed".split(",")
MEMBRANE_TIMES = {"mu0.3": 0.06, "mu0.42": 0.084, "mu0.7": 0.14}  # mu_s/G_s, s, by case.toml and releases.csv


class RedCellRelaxation(InFolder):
    def setUp(self):
        super().setUp()
        self.case = self.folder / "case"
        self.case.mkdir()
        for name in ("analyse.py", "case.toml", "case_fluid.toml", "compare.toml", "releases.csv"):
            shutil.copy(CASE / name, self.case)
        shutil.copytree(CASE / "reference", self.case / "reference")

    def release(self, run, time):
        """A cell that comes back with t_c = time (s); 100 shear times are a second."""
        folder = self.folder / "out" / run
        folder.mkdir(parents=True)
        seconds = numpy.linspace(0, 5 * time, 60)
        ratio = length_over_width(seconds, time, 2.0, 1.1)
        with open(folder / "drag.csv", "w", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerow(COLUMNS)
            # L W = 1: any two numbers of that ratio will do.
            writer.writerows([k, 100 * t, 0, math.sqrt(q), 1 / math.sqrt(q), 1, 1, 0, 0, 0] for k, (t, q) in enumerate(zip(seconds, ratio)))

    def release_in_a_fluid(self, run, time, until=30.0, end=80.0, reached=None):
        """A run that is stretched up to `until` (shear times) and comes back with t_c = time (s)."""
        folder = self.folder / "out" / run
        folder.mkdir(parents=True)
        (folder / "echo.toml").write_text(
            f"[run]\nshear_time = {end}\n[si]\nshear_rate_per_s = 100\n[membrane]\n[[capsule]]\n[capsule.load]\nuntil = {until}\n[capsule.membrane]\n"
        )
        shear_times = numpy.linspace(0, end if reached is None else reached, 801)
        write_observables(folder, [{"shear_time": repr(t)} for t in shear_times.tolist()])
        # While it is stretched any ratio will do that is none of the formula's.
        ratio = numpy.where(shear_times < until, 3.0, length_over_width((shear_times - until) / 100, time, 2.0, 1.1))
        with open(folder / "measures.csv", "w", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerow(["step", "shear_time", "capsule", "axial_diameter", "transverse_diameter"])
            writer.writerows([k, repr(t), 0, math.sqrt(q), 1 / math.sqrt(q)] for k, (t, q) in enumerate(zip(shear_times.tolist(), ratio.tolist())))

    def all_with(self, slope, start=0.0, factor=None):
        for run, time in MEMBRANE_TIMES.items():
            self.release(run, (slope * time + start) * (factor or {}).get(run, 1))

    def judge(self):
        return said(case_results.judge, self.folder / "out", self.case)

    def test_a_straight_line_is_found(self):
        self.all_with(1.05, 0.004)
        code, text = self.judge()
        self.assertEqual(code, 0, text)
        self.assertIn("1.050", text)
        self.assertIn("0.0040", text)

    def test_a_slope_that_is_not_one_is_outside(self):
        for slope, wanted in ((0.79, 1), (0.81, 0), (1.19, 0), (1.21, 1)):
            with self.subTest(slope=slope):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.all_with(slope)
                self.assertEqual(self.judge()[0], wanted)

    def test_times_that_are_not_on_a_line_are_outside(self):
        self.all_with(1.0, factor={"mu0.42": 1.2})
        code, text = self.judge()
        self.assertEqual(code, 1, text)
        self.assertIn("OUTSIDE", text)

    def test_within_the_measured_times(self):
        self.release("mu0.7", 0.14)  # of 0.106 to 0.160 s
        self.release("mu0.3", 0.06)
        code, text = self.judge()
        self.assertEqual((code, text.count("within the measured")), (0, 1), text)
        self.assertNotIn("The line", text)  # two runs are on any line

    def test_a_line_of_its_own_in_a_fluid(self):
        self.all_with(1.0)
        self.release_in_a_fluid("fluid-mu0", 0.02)
        for run, time in MEMBRANE_TIMES.items():
            self.release_in_a_fluid(f"fluid-{run}", 1.1 * time + 0.02)
        code, text = self.judge()
        self.assertEqual(code, 0, text)
        for line in (("the membrane alone", "1.000"), ("in plasma", "1.100")):
            self.assertTrue(any(all(word in row for word in line) for row in text.splitlines()), text)
        self.assertTrue(any("fluid-mu0 " in row and "0.0200" in row and "shown only" in row for row in text.splitlines()), text)

    def test_a_line_in_a_fluid_that_is_not_straight_is_outside(self):
        for run, time in MEMBRANE_TIMES.items():
            self.release_in_a_fluid(f"fluid-{run}", time * (1.2 if run == "mu0.42" else 1))
        self.assertEqual(self.judge()[0], 1)

    def test_a_run_that_is_not_finished_is_left_out(self):
        self.release("mu0.3", 0.06)
        self.release_in_a_fluid("fluid-mu0.3", 0.06, reached=70.0)
        self.assertNotIn("fluid-mu0.3", self.judge()[1])

    def test_both_pictures(self):
        self.all_with(1.0)
        self.release_in_a_fluid("fluid-mu0", 0.02)
        made = case_analysis.load(self.case).pictures(self.folder / "out", self.case)
        self.assertEqual([file.name for file in made], ["relaxation.png", "times.png"])

    def test_kept_table(self):
        self.release("mu0.7", 0.14)
        case_results.keep(self.folder / "out", self.case, "a command")
        line = (self.case / "measured/relaxation.csv").read_text().splitlines()[2].split(",")
        self.assertEqual(line[:4], ["mu0.7", "7e-07", "0.14", "20"])
        for text, wanted in zip(line[4:8], (0.14, 0.14, 2.0, 1.1)):
            self.assertAlmostEqual(float(text), wanted, delta=1e-5)
        self.assertTrue((self.case / "measured/relaxation.png").is_file())

    def test_without_results(self):
        self.assert_refused(["there are no results"], case_results.judge, self.folder / "out", self.case)


if __name__ == "__main__":
    unittest.main()
