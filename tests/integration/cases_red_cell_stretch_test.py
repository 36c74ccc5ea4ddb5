"""Tests of the analysis of the stretched red cell, on results made up from the published sets."""

import csv
import shutil
import unittest

from post_fixture import ROOT, InFolder, said

from tanktread_post import case_analysis, case_results

CASE = ROOT / "cases/red-cell-stretch"
stretch = case_analysis.module_of(CASE / "analyse.py")
COLUMNS = "step,shear_time,capsule,axial_diameter,transverse_diameter,volume_ratio,area_ratio,elastic_energy,load_power,speed".split(",")
MICROMETRES = 2 * 2.8215  # of a diameter of 1 in drag.csv


class RedCellStretch(InFolder):
    def setUp(self):
        super().setUp()
        self.case = self.folder / "case"
        self.case.mkdir()
        for name in ("analyse.py", "case.toml", "compare.toml", "runs.csv"):
            shutil.copy(CASE / name, self.case)
        shutil.copytree(CASE / "reference", self.case / "reference")

    def drag(self, run, force, axial, transverse, speed=1e-4):
        """A cell that has moved from somewhere else to these diameters, in micrometres."""
        folder = self.folder / "out" / run / force
        folder.mkdir(parents=True)
        with open(folder / "drag.csv", "w", newline="") as stream:
            writer = csv.writer(stream)
            writer.writerows([COLUMNS, [0, 0, 0, 1, 1, 1, 1, 0, 0, 9]])
            writer.writerow([100, 1, 0, axial / MICROMETRES, transverse / MICROMETRES, 0.999, 1.001, 2, 0, speed])

    def judge(self):
        return said(case_results.judge, self.folder / "out", self.case)

    def test_between_the_sets_is_inside(self):
        self.drag("tweezers", "193.1", 15.7, 4.3)  # 15.29 and 16.24, 4.271 and 4.384
        code, text = self.judge()
        self.assertEqual(code, 0, text)
        self.assertEqual(text.count("between"), 2, text)

    def test_the_band_is_five_per_cent_beyond_either_set(self):
        # At 193.1 pN: axial up to 1.05 * 16.24 = 17.052, down to 0.95 * 15.29 = 14.526.
        for axial, wanted in ((17.04, 0), (17.06, 1), (14.54, 0), (14.51, 1)):
            with self.subTest(axial=axial):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.drag("tweezers", "193.1", axial, 4.3)
                code, text = self.judge()
                self.assertEqual((code, "OUTSIDE" in text), (wanted, wanted == 1), text)

    def test_both_diameters_are_judged(self):
        self.drag("tweezers", "193.1", 15.7, 4.7)  # above 1.05 * 4.384 = 4.603
        code, text = self.judge()
        self.assertEqual(code, 1, text)
        self.assertIn("+7.2 %", text)  # 4.7/4.384 - 1

    def test_between_two_measured_forces_a_set_is_a_straight_line(self):
        settings = {"reference": "reference/red_cell_stretch.csv", "band": 0.05}
        band = stretch.band_of(CASE, settings)
        low, high = band.published("axial_um", 183.05)  # halfway from 173.0 to 193.1 of the one set
        self.assertAlmostEqual(high, (16.06 + 16.24) / 2, delta=1e-12)
        # of the other: 172.8 to 193.1
        self.assertAlmostEqual(low, 14.83 + (183.05 - 172.8) / (193.1 - 172.8) * (15.29 - 14.83), delta=1e-12)

    def test_a_set_that_is_not_judged_is_shown(self):
        self.drag("by-shear", "193.1", 30.0, 1.0)
        code, text = self.judge()
        self.assertEqual(code, 0, text)
        self.assertIn("shown only, outside", text)

    def test_pictures_and_kept_tables(self):
        self.drag("tweezers", "193.1", 15.7, 4.3)
        self.drag("tweezers", "88", 13.4, 4.7)
        files = case_results.keep(self.folder / "out", self.case, "a command")
        self.assertEqual([file.name for file in files], ["stretch.csv", "stretch.png"])
        lines = (self.case / "measured/stretch.csv").read_text().splitlines()
        self.assertIn("a command", lines[0])
        self.assertEqual(lines[2:], ["tweezers,88,13.4,4.7,0.999,1.001", "tweezers,193.1,15.7,4.3,0.999,1.001"])
        self.assertTrue((self.case / "measured/stretch.png").is_file())

    def test_a_cell_that_still_moves_is_refused(self):
        self.drag("tweezers", "88", 13.4, 4.7, speed=2e-3)
        self.assert_refused(["tweezers/88/drag.csv", "0.002", "run longer"], case_results.judge, self.folder / "out", self.case)

    def test_without_results(self):
        self.assert_refused(["there are no results"], case_results.judge, self.folder / "out", self.case)


if __name__ == "__main__":
    unittest.main()
