"""Tests of the cost of an answer, on runs whose error is of second order in the grid step; and of the map of the step."""

import shutil
import unittest

from post_fixture import ROOT, InFolder, said, write_run

from tanktread_post import case_analysis, case_results

CASE = ROOT / "cases/cost-of-accuracy"
cost_of_accuracy = case_analysis.module_of(CASE / "analyse.py")

EXACT = {"elastic": (0.44, 23.0), "viscous": (0.35, 16.0)}  # D and inclination of the finest grid
SECOND_ORDER, TURN = 10.0, 1000.0  # D is more by the share SECOND_ORDER/L^2, the inclination by TURN/L^2 degrees
SPEEDS = {40: 1.2e-2, 60: 8e-3, 80: 6e-3}
HEADER = "run,box,mesh,shear_rate_by,shear_time,deformation,inclination_deg,volume_ratio,fluid_percent\n"
SETTINGS = """title = "made for a test"
[analyse]
shear_time = 4.0
mlups_a_core = 50.0
fluid_percent = 96.0
cost_ratio = 30
widths = [40, 60, 80]
level = 4
step_deformation = 0.005
step_inclination = 0.2
"""
ENTRY = """[[analyse.measured]]
way = "{way}"
capsule = "{capsule}"
file = "{capsule}.csv"
run = "{run}"
"""


class CostOfAccuracy(InFolder):
    def setUp(self):
        super().setUp()
        case = self.folder / "case"
        case.mkdir()
        shutil.copy(CASE / "analyse.py", case)
        runs = (("thesis", "mesh-3"), ("thesis, half the step", "half"))
        entries = [ENTRY.format(way=way, capsule=capsule, run=run) for capsule in EXACT for way, run in runs]
        (case / "compare.toml").write_text(SETTINGS + "".join(entries))
        self.thesis()

    def thesis(self, deformation=0.01, inclination=0.5):
        """The thesis's way with an error of D as a share and one of the inclination, both in proportion to its step."""
        for capsule, exact in EXACT.items():
            text = HEADER
            for run, speed, share in (("mesh-3", 0.004, 1.0), ("half", 0.002, 0.5)):
                found = f"{exact[0] * (1 + share * deformation)!r},{exact[1] + share * inclination!r}"
                text += f"{run},120 x 120 x 120,sphere level 4,wall_speed {speed},4,{found},0.999,96\n{run},,,,10,0,0,1,96\n"
            (self.folder / "case" / f"{capsule}.csv").write_text(text)

    def run_of(self, name, capsule, width, speed, deformation, inclination, level=4, corrected=True, start="rest", inertia=False, relaxation_time=1.0):
        """A finished run of a case, and its log, in which the fluid takes 80 % of the time."""
        folder = self.folder / "out" / name
        viscous = {"scheme": "fd", "boussinesq_shear": 10.0} if capsule == "viscous" else {"scheme": "none"}
        write_run(folder, deformation=deformation, inclination=inclination, shear_time=4.0, width=width, radius=width / 6.2, inertia=inertia, viscous=viscous, corrected=corrected)
        echo = (folder / "echo.toml").read_text().replace("level = 3", f"level = {level}")
        echo = echo.replace("reynolds_number = 0.1", f"wall_speed = {speed}\nrelaxation_time = {relaxation_time}\nstart = '{start}'")
        (folder / "echo.toml").write_text(echo)
        (folder / "parameters.toml").write_text(f"commit = 'abc'\n[flow]\nsteps_per_shear_time = {width / (2 * speed)!r}\n")
        table = "\ntime of seconds %\n  fluid 80.000 80.0\n  spreading 15.000 15.0\n  membranes 5.000 5.0\n"
        (self.folder / "out" / f"{name}.log").write_text(table + "ended at step 9 with 40.0 MLUPS; results\n")

    def new_runs(self, capsules=tuple(EXACT), widths=(40, 60, 80)):
        for capsule in capsules:
            for width in widths:
                found = EXACT[capsule][0] * (1 + SECOND_ORDER / width**2), EXACT[capsule][1] + TURN / width**2
                self.run_of(f"new-{capsule}-{width}", capsule, width, SPEEDS[width], *found)

    def compare(self):
        return said(case_results.judge, self.folder / "out", self.folder / "case")

    def study(self):
        return cost_of_accuracy.read_study(self.folder / "out", self.folder / "case")

    def test_the_converged_value_and_the_cost_are_found(self):
        self.new_runs()
        # A cheap run of another mesh must not change what the others converge to.
        self.run_of("new-elastic-60-1280", "elastic", 60, SPEEDS[60], 0.5, 30.0, level=3)
        study = self.study()
        for capsule, exact in EXACT.items():
            # The line in 1/L^2 is exact here: rounding alone is left, of a fit with a condition of some 100.
            for quantity, value in zip(cost_of_accuracy.QUANTITIES, exact):
                self.assertAlmostEqual(study.converged(capsule, quantity), value, delta=1e-11)
        fine = next(r for r in study.ways if r.run == "new-viscous-80")
        errors = study.errors(fine)
        self.assertAlmostEqual(errors[0], SECOND_ORDER / 80**2, delta=1e-11)
        self.assertAlmostEqual(errors[1], TURN / 80**2, delta=1e-11)
        # 80/(2 x 0.006) steps a shear time, four shear times, 80^3 nodes, 50 million a second; and 96/80 of that.
        self.assertAlmostEqual(study.core_seconds(fine), 4 * 80 / 0.012 * 80**3 / 50e6, delta=1e-9)
        self.assertAlmostEqual(study.whole_core_seconds(fine), 1.2 * study.core_seconds(fine), delta=1e-9)
        # At one Reynolds number and one box less the cost goes as L^5: (120/60)^5 = 32.
        self.assertIn("1/32", self.compare()[1])

    def test_judges_error_and_cost(self):
        self.new_runs()
        # At 60^3, for 1/32, the error is 0.28 % and 0.28 degrees; at 80^3, for 1/7.6, 0.16 % and 0.16 degrees.
        for deformation, inclination, code in ((0.01, 0.5, 0), (-0.01, -0.5, 0), (0.002, 0.5, 1), (0.01, 0.2, 1), (0.0029, 0.29, 0)):
            with self.subTest(deformation=deformation, inclination=inclination):
                self.thesis(deformation, inclination)
                found, text = self.compare()
                self.assertEqual(found, code)
                self.assertEqual(text.count("OUTSIDE"), 2 * code)
        compare = self.folder / "case/compare.toml"
        compare.write_text(compare.read_text().replace("cost_ratio = 30", "cost_ratio = 33"))
        self.thesis(0.0029, 0.29)
        self.assertEqual(self.compare()[0], 1, "60^3 costs 1/32, and the error of 40^3 is larger")

    def test_the_earlier_default_does_not_reach_it(self):
        self.new_runs()
        self.thesis(0.0001, 0.01)
        self.run_of("earlier-elastic-40", "elastic", 40, SPEEDS[40], *EXACT["elastic"], corrected=False, inertia=True)
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn("earlier default", text)
        self.assertNotIn("reaches it", text)

    def test_the_thesis_without_inertia_is_the_end_of_its_line(self):
        self.new_runs()
        self.assertIn("at Re = 0, by a line through its two steps: D = 0.44000 (+0.00 %), 23.000 degrees (+0.00)", self.compare()[1].replace("-0.00", "+0.00"))

    def test_judges_nothing_before_a_series_is_whole(self):
        self.new_runs(capsules=("elastic",))
        self.new_runs(capsules=("viscous",), widths=(40, 60))
        code, text = self.compare()
        self.assertEqual(code, 0)
        self.assertEqual((text.count("judged: "), text.count("not judged yet")), (1, 1))
        self.thesis(0.002, 0.5)
        self.assertEqual(self.compare()[0], 1)

    def test_maps_the_step(self):
        # The smallest step of all is with inertia: it is not what the others are held against.
        steps = (4e-3, 1.0, False, 0.0), (8e-3, 1.0, False, 0.004), (1.6e-2, 1.0, False, 0.006), (1.6e-2, 2.0, True, -0.02), (2e-3, 1.0, True, 0.03)
        for speed, time, inertia, change in steps:
            self.run_of(f"u{speed}-{time}-{inertia}", "elastic", 60, speed, 0.44 * (1 + change), 23.0, level=3, start="developed", inertia=inertia, relaxation_time=time)
        code, text = self.compare()
        self.assertEqual(code, 0)
        self.assertIn("the largest step that keeps 0.5 % of D and 0.2 degrees: tau+ = 1, U0 = 0.008, 15000 steps", text)
        for word in ("+0.40 %", "+0.60 %", "-2.00 %", "+3.00 %"):
            self.assertIn(word, text)
        self.assertEqual(len(self.study().steps), 5)
        # They are no part of what is converged, and without that there is nothing to draw.
        self.assertEqual(case_results.draw(self.folder / "out", self.folder / "case"), [])

    def test_draws_and_keeps_the_errors(self):
        self.new_runs()
        files = case_results.draw(self.folder / "out", self.folder / "case")
        self.assertEqual([file.name for file in files], ["deformation.png", "inclination.png"])
        for file in files:
            self.assertGreater(file.stat().st_size, 1000)
        rows = cost_of_accuracy.measured(self.folder / "out", self.folder / "case")["cost.csv"].splitlines()
        self.assertEqual(len({row.count(",") for row in rows}), 1)
        self.assertEqual(len(rows), 1 + 2 * (2 + 3))

    def test_what_is_measured_elsewhere_must_be_there(self):
        self.new_runs()
        (self.folder / "case/elastic.csv").write_text(HEADER)
        self.assert_refused(["elastic.csv", "0 rows have run 'mesh-3'"], case_results.judge, self.folder / "out", self.folder / "case")
        compare = self.folder / "case/compare.toml"
        compare.write_text(compare.read_text().replace('way = "thesis"', 'name = "thesis"'))
        self.assert_refused(["[[analyse.measured]]", "'way' is missing"], case_results.judge, self.folder / "out", self.folder / "case")

    def test_says_that_nothing_is_there(self):
        self.assert_refused("no finished run", case_results.judge, self.folder / "out", self.folder / "case")


if __name__ == "__main__":
    unittest.main()
