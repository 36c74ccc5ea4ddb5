"""Tests of the analysis of the cell that comes back, on series made by the formula that is fitted."""

import csv
import math
import shutil
import unittest

import numpy

from post_fixture import ROOT, InFolder, said

from tanktread_post import case_results
from tanktread_post.relaxation import length_over_width

CASE = ROOT / "cases/red-cell-relaxation"
COLUMNS = "step,shear_time,capsule,axial_diameter,transverse_diameter,volume_ratio,area_ratio,elastic_energy,load_power,speed".split(",")
MEMBRANE_TIMES = {"mu0.3": 0.06, "mu0.42": 0.084, "mu0.7": 0.14}  # mu_s/G_s, s, by case.toml and releases.csv


class RedCellRelaxation(InFolder):
    def setUp(self):
        super().setUp()
        self.case = self.folder / "case"
        self.case.mkdir()
        for name in ("analyse.py", "case.toml", "compare.toml", "releases.csv"):
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
