"""Tests of the comparison with boundary integrals at large deformation, on runs whose limit of a wide box is known."""

import shutil
import unittest

from post_fixture import ROOT, InFolder, said, write_echo, write_observables, write_run

from tanktread_post import case_analysis, case_results

CASE = ROOT / "cases/large-deformation"
large_deformation = case_analysis.module_of(CASE / "analyse.py")

REFERENCE = """# made for a test
law,area_ratio,capillary_number,viscosity_ratio,deformation,uncertainty,inclination_deg
neo-hookean,,0.3,1,0.4,0.0003,25.0
skalak,1,0.3,1,0.33,0.0003,28.0
neo-hookean,,0.3,5,0.2,0.0003,12.0
"""
BOX, TURN = 3.0, -40.0  # the share of (a/L)^3 by which D grows, and the degrees by which the inclination does


class LargeDeformation(InFolder):
    def setUp(self):
        super().setUp()
        case = self.folder / "case"
        (case / "reference").mkdir(parents=True)
        for file in ("analyse.py", "compare.toml"):
            shutil.copy(CASE / file, case)
        (case / "reference/capsule_boundary_integral.csv").write_text(REFERENCE)

    def run_of(self, name, deformation, inclination, width, law="neo-hookean", radius=8.0, **more):
        """A run in a box of its own, whose unbounded D and inclination are those given."""
        share = (radius / width) ** 3
        write_run(
            self.folder / "out" / name, deformation=deformation * (1 + BOX * share), inclination=inclination + TURN * share,
            law=law, capillary_number=0.3, radius=radius, width=width, kernel="stockie6", inertia=False, **more,
        )  # fmt: skip

    def runs(self, factor=1.0, turned=0.0):
        """Both rows of the reference with viscosity ratio 1, in two boxes; the neo-Hookean ones changed."""
        for width in (48, 72):
            self.run_of(f"neo-{width}", 0.4 * factor, 25.0 + turned, width)
            self.run_of(f"skalak-{width}", 0.33, 28.0, width, law="skalak")

    def compare(self):
        return said(case_results.judge, self.folder / "out", self.folder / "case")

    def test_the_unbounded_values_are_found(self):
        self.runs()
        _, series, comparisons = large_deformation.compare(self.folder / "out", self.folder / "case")
        self.assertEqual(len(series), 2)
        self.assertEqual([one.case.law for one in comparisons], ["neo-hookean", "skalak"])
        for one in comparisons:
            # The line is exact here: what is left is the rounding of a line through two points, some 10 times that of a double, of 25 degrees.
            for quantity, exact in one.reference.items():
                self.assertAlmostEqual(one.limit(quantity), exact, delta=1e-12)

    def test_judges_by_both_bands(self):
        for factor, turned, code in ((1.009, 0, 0), (1.011, 0, 1), (0.991, 0, 0), (0.989, 0, 1), (1, 0.39, 0), (1, 0.41, 1), (1, -0.41, 1)):
            with self.subTest(factor=factor, turned=turned):
                self.runs(factor, turned)
                found, text = self.compare()
                self.assertEqual(found, code)
                self.assertEqual(text.count("OUTSIDE"), code)

    def test_reads_the_end_of_a_run(self):
        for width in (48, 72):
            folder = self.folder / "out" / f"neo-{width}"
            write_echo(folder, law="neo-hookean", capillary_number=0.3, width=width, shear_time=3.0, inertia=False)
            # It is 0.4 from shear time 2.8 on, and was more before.
            values = [(0.0, 0.6), (2.7, 0.6), (2.8, 0.4), (2.9, 0.4), (3.0, 0.4)]
            write_observables(folder, [{"shear_time": repr(t), "deformation": repr(d), "inclination_deg": "25.0"} for t, d in values])
        comparison = large_deformation.compare(self.folder / "out", self.folder / "case")[2][0]
        self.assertAlmostEqual(comparison.limit("deformation"), 0.4, delta=1e-12)

    def test_one_box_is_not_judged_and_another_radius_is_only_shown(self):
        self.run_of("neo-72", 0.8, 25.0, 72)
        for width in (32, 48, 64):
            self.run_of(f"coarse-{width}", 0.7, 20.0, width, radius=16 / 3)
        self.run_of("unfinished-48", 0.8, 25.0, 48, end=1.0)
        code, text = self.compare()
        self.assertEqual(code, 0)
        self.assertEqual(text.count("not judged yet"), 4)  # two rows of the reference, two quantities
        # Every pair of the three boxes leads to the same limit.
        self.assertEqual((text.count("0.70000"), text.count("20.000")), (2, 2))
        self.assertEqual(case_results.draw(self.folder / "out", self.folder / "case"), [])

    def test_draws_and_keeps_what_is_judged(self):
        self.runs()
        for file in case_results.draw(self.folder / "out", self.folder / "case"):
            self.assertGreater(file.stat().st_size, 1000)
        table = large_deformation.measured(self.folder / "out", self.folder / "case")["unbounded.csv"]
        self.assertEqual(table.splitlines()[1:], ["neo-hookean,,0.3,8.0,0.4,25,0.4,25.0", "skalak,1.0,0.3,8.0,0.33,28,0.33,28.0"])

    def test_says_that_nothing_is_there(self):
        self.assert_refused("no finished run", case_results.judge, self.folder / "out", self.folder / "case")


if __name__ == "__main__":
    unittest.main()
