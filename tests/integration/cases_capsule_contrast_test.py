"""Tests of the comparison with boundary integrals at another viscosity inside, on runs whose limit of a wide box is known."""

import shutil
import unittest

from post_fixture import ROOT, InFolder, said, write_echo, write_observables, write_run

from tanktread_post import case_analysis, case_results

CASE = ROOT / "cases/capsule-contrast"
capsule_contrast = case_analysis.module_of(CASE / "analyse.py")

REFERENCE = """# made for a test
law,area_ratio,capillary_number,viscosity_ratio,deformation,uncertainty,inclination_deg
neo-hookean,,0.3,1,0.4,0.0003,25.0
neo-hookean,,0.3,5,0.25,0.0003,12.0
skalak,1,0.3,5,0.2,0.0003,10.0
"""
BOX, TURN = 3.0, -40.0  # the share of (a/L)^3 by which D grows, and the degrees by which the inclination does


class CapsuleContrast(InFolder):
    def setUp(self):
        super().setUp()
        self.case, self.output = self.folder / "case", self.folder / "out"
        (self.case / "reference").mkdir(parents=True)
        for file in ("analyse.py", "compare.toml"):
            shutil.copy(CASE / file, self.case)
        (self.case / "reference/capsule_boundary_integral.csv").write_text(REFERENCE)

    def runs(self, deformation, inclination, ratio=5.0, radius=8.0, boxes=(6, 9), **more):
        """Runs in boxes of some radii, whose unbounded D and inclination are those given."""
        for box in boxes:
            write_run(
                self.output / f"l{ratio:g}-a{radius:g}-box{box}", deformation=deformation * (1 + BOX / box**3), inclination=inclination + TURN / box**3,
                law="neo-hookean", capillary_number=0.3, radius=radius, width=round(box * radius), viscosity_ratio=ratio, inertia=False, **more,
            )  # fmt: skip

    def compare(self):
        return said(case_results.judge, self.output, self.case)

    def test_the_unbounded_values_are_found_and_held_against_their_own_row(self):
        self.runs(0.25, 12.0)
        self.runs(0.4, 25.0, ratio=1.0)
        self.runs(0.15, 6.0, ratio=10.0)
        _, found = capsule_contrast.compare(self.output, self.case)
        self.assertEqual([one.series.viscosity_ratio for one in found], [1.0, 5.0, 10.0])
        self.assertIsNone(found[2].reference)
        for one in found[:2]:
            # The line is exact here: what is left is the rounding of a line through two points, some 10 times that of a double, of 25 degrees.
            for quantity, exact in one.reference.items():
                self.assertAlmostEqual(one.limit(quantity), exact, delta=1e-12)
        self.assertAlmostEqual(found[2].limit("deformation"), 0.15, delta=1e-12)

    def test_judges_by_both_bands(self):
        for factor, turned, code in ((1.0149, 0, 0), (1.0151, 0, 1), (0.9851, 0, 0), (0.9849, 0, 1), (1, 0.59, 0), (1, 0.61, 1), (1, -0.61, 1)):
            with self.subTest(factor=factor, turned=turned):
                self.runs(0.25 * factor, 12.0 + turned)
                found, text = self.compare()
                self.assertEqual(found, code)
                self.assertEqual(text.count("OUTSIDE"), code)

    def test_other_viscosities_another_radius_and_one_box_are_only_shown(self):
        self.runs(0.3, 20.0, ratio=0.2)
        self.runs(0.5, 20.0, ratio=1.0)
        self.runs(0.35, 20.0, radius=16 / 3)
        self.runs(0.35, 20.0, boxes=(9,))
        self.runs(0.35, 20.0, boxes=(12,), end=1.0)  # unfinished
        code, text = self.compare()
        self.assertEqual((code, text.count("not judged yet"), text.count("shown only"), text.count("inside"), text.count("OUTSIDE")), (0, 2, 6, 0, 0))

    def test_goes_to_a_fine_grid_by_the_square_of_the_grid_step(self):
        for radius in (8.0, 16 / 3):
            self.runs(0.25 * (1 + 1.28 / radius**2), 12.0 + 6.4 / radius**2, radius=radius)
        found = capsule_contrast.compare(self.output, self.case)[1]
        # The boxes are whole grid steps wide, and both lines exact.
        for quantity, exact in (("deformation", 0.25), ("inclination_deg", 12.0)):
            ((mesh, (limit, _)),) = capsule_contrast.fine_grid(found, quantity).items()
            self.assertEqual(mesh, (5.0, 1280))
            self.assertAlmostEqual(limit, exact, delta=1e-11)
        self.assertIn("0.25000", self.compare()[1])

    def test_reads_the_end_of_a_run_and_the_farthest_volume(self):
        for box in (6, 9):
            folder = self.output / f"l5-box{box}"
            write_echo(folder, law="neo-hookean", capillary_number=0.3, width=8 * box, shear_time=18.0, inertia=False, viscosity_ratio=5.0)
            # It rings before shear time 17, and is 0.25 from there on.
            values = [(0.0, 0.6, 1.0), (16.9, 0.6, 0.999), (17.0, 0.25, 1.0), (18.0, 0.25, 1.0005)]
            rows = [{"shear_time": repr(t), "deformation": repr(d), "inclination_deg": "12.0", "volume_ratio": repr(v)} for t, d, v in values]
            write_observables(folder, rows)
        (one,) = capsule_contrast.compare(self.output, self.case)[1]
        self.assertAlmostEqual(one.limit("deformation"), 0.25, delta=1e-12)
        self.assertIn("within 0.100 %", self.compare()[1])

    def test_draws_and_keeps_what_is_known(self):
        self.assertEqual((self.runs(0.25, 12.0, boxes=(6,)), case_results.draw(self.output, self.case)), (None, []))
        self.runs(0.25, 12.0)
        self.runs(0.15, 6.0, ratio=10.0)
        for file in case_results.draw(self.output, self.case):
            self.assertGreater(file.stat().st_size, 1000)
        table = capsule_contrast.measured(self.output, self.case)["unbounded.csv"]
        self.assertEqual(table.splitlines()[1:], ["5,8,1280,0.25,12,0.25,12.0", "10,8,1280,0.15,6,,"])

    def test_says_that_nothing_is_there(self):
        self.assert_refused("no finished run", case_results.judge, self.output, self.case)


if __name__ == "__main__":
    unittest.main()
