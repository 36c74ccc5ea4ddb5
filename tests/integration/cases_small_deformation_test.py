"""Tests of the comparison with the limit of small deformation, on runs made by the formula it assumes."""

import shutil
import unittest

from post_fixture import ROOT, InFolder, said, write_run

from tanktread_post import case_analysis, case_results

ANALYSE = ROOT / "cases/small-deformation/analyse.py"
small_deformation = case_analysis.module_of(ANALYSE)

SETTINGS = """title = "made for a test"
[analyse]
shear_time = 3.0
band = 0.02
laws = ["skalak", "neo-hookean"]
kernel = "cosine4"
slope_kernels = ["cosine4"]
judged_kernel = "cosine4"
kernels = ["cosine4", "roma3"]
kernel_law = "skalak"
kernel_capillary_number = 0.02
box_in_radii = 9
least_radius = 8.0
box_radius = 8.0
"""
SECOND_ORDER, RESOLUTION, BOX = -6.0, 0.6, 9.0  # k, r, w of the formula in analyse.py


class SmallDeformation(InFolder):
    def setUp(self):
        super().setUp()
        (self.folder / "case").mkdir()
        shutil.copy(ANALYSE, self.folder / "case")
        (self.folder / "case/compare.toml").write_text(SETTINGS)

    def run_of(self, name, law="skalak", number=0.02, radius=8.0, width=72, factor=1.0, kernel="cosine4", **more):
        """A run that follows the formula, times a factor."""
        theory = 25 / 12 * number
        coarse = 1.05 if radius < 8 else 1.0  # what a grid below least_radius does must not matter
        ratio = coarse * (1 + SECOND_ORDER * number**2) * (1 + RESOLUTION / radius) * (1 + BOX * (radius / width) ** 3) * factor
        folder = self.folder / "out" / name
        write_run(folder, deformation=theory * ratio, law=law, capillary_number=number, radius=radius, width=width, kernel=kernel, **more)

    def runs(self, factor=1.0):
        for law in ("skalak", "neo-hookean"):
            for radius, width in ((5.0, 45), (8.0, 72), (10.0, 90), (12.0, 108)):
                for number in (0.005, 0.02, 0.05):
                    self.run_of(f"{law}-{radius}-{number}", law, number, radius, width, factor)
        for width in (48, 96):
            self.run_of(f"box-{width}", width=width, factor=factor)

    def compare(self):
        return said(case_results.judge, self.folder / "out", self.folder / "case")

    def test_theory(self):
        skalak = {"elastic_law": "skalak", "capillary_number": 0.3, "capillary_modulus": "G_s", "area_ratio": 1.0}
        self.assertAlmostEqual(small_deformation.theory(skalak), 25 / 12 * 0.3, delta=1e-15)
        self.assertAlmostEqual(small_deformation.theory(skalak | {"capillary_modulus": "E_s"}), 25 / 12 * 0.6, delta=1e-15)
        # C = 10: K_s = 21 G_s.
        self.assertAlmostEqual(small_deformation.theory(skalak | {"area_ratio": 10}), 5 / 8 * 0.3 * (3 + 1 / 21), delta=1e-15)
        # nu_s = 1/2: K_s = 3 G_s.
        hookean = {"elastic_law": "hookean", "capillary_number": 0.3, "capillary_modulus": "G_s", "poisson_ratio": 0.5}
        self.assertAlmostEqual(small_deformation.theory(hookean), 25 / 12 * 0.3, delta=1e-15)
        self.assert_refused("no shear modulus", small_deformation.theory, hookean | {"capillary_modulus": "gamma"})

    def test_the_limits_of_the_formula_are_found(self):
        self.runs()
        series = small_deformation.Series(small_deformation.read_runs(self.folder / "out", 3.0), SETTINGS_VALUES)
        # The lines in Ca_G^2, 1/a and (a/L)^3 are exact here, so only rounding is left: a condition of some 100
        # of the least-squares fits times the 1e-16 of a double.
        for law in ("skalak", "neo-hookean"):
            self.assertAlmostEqual(small_deformation.extrapolated(series.slopes(law, "cosine4"), series.factor(), 8.0), 1.0, delta=1e-12)
            self.assertAlmostEqual(series.slopes(law, "cosine4")[8.0], (1 + RESOLUTION / 8) * (1 + BOX / 9**3), delta=1e-12)
        self.assertAlmostEqual(series.factor(), 1 + BOX / 9**3, delta=1e-12)

    def test_judges_by_the_band(self):
        for factor, code in ((1.019, 0), (1.021, 1), (0.981, 0), (0.979, 1)):
            with self.subTest(factor=factor):
                self.runs(factor)
                self.assertEqual(self.compare()[0], code)
        self.assertIn("OUTSIDE", self.compare()[1])

    def test_judges_one_kernel_and_shows_the_others(self):
        settings = SETTINGS.replace('slope_kernels = ["cosine4"]', 'slope_kernels = ["cosine4", "roma3"]')
        self.runs(1.1)
        (self.folder / "case/compare.toml").write_text(settings)
        self.assertEqual(self.compare()[0], 1)
        (self.folder / "case/compare.toml").write_text(settings.replace('judged_kernel = "cosine4"', 'judged_kernel = "roma3"'))
        code, text = self.compare()
        self.assertEqual(code, 0)
        self.assertIn("shown only", text)

    def test_judges_the_default_at_each_radius_without_the_box(self):
        settings = SETTINGS + """corrected_kernel = "stockie6"
corrected_bands = [[5.0, 0.02], [8.0, 0.01]]
corrected_inclination_band = 0.5
corrected_box_radius = 5.0
"""
        (self.folder / "case/compare.toml").write_text(settings)

        def run_of(name, error, radius, width, turned=0.0):
            deformation = 25 / 12 * 0.02 * (1 + error) * (1 + BOX * (radius / width) ** 3)
            inclination = 42.69 + turned  # of the theory, to the two digits of cases/small-deformation-viscous
            more = {"kernel": "stockie6", "corrected": True, "inertia": False, "inclination": inclination}
            write_run(self.folder / "out" / name, deformation=deformation, capillary_number=0.02, radius=radius, width=width, **more)

        for wrong, turned, code in ((0.0099, 0.49, 0), (0.0101, 0, 1), (-0.0101, 0, 1), (0, 0.51, 1), (0, -0.51, 1)):
            with self.subTest(wrong=wrong, turned=turned):
                run_of("a5", 0.0199, 5.0, 45)
                run_of("a5-box", 0.0199, 5.0, 30)
                run_of("a8", wrong, 8.0, 72, turned)
                self.assertEqual(self.compare()[0], code)
        run_of("a5", 0.0201, 5.0, 45)
        run_of("a5-box", 0.0201, 5.0, 30)
        run_of("a8", 0, 8.0, 72)
        code, text = self.compare()
        self.assertEqual(code, 1)
        self.assertIn(f"changes D by {100 * BOX / 9**3:+.2f} %", text)

    def test_shows_what_is_there(self):
        self.run_of("one")
        self.run_of("roma", kernel="roma3", factor=1.1)
        self.run_of("stokes", inertia=False, factor=1.2)
        self.run_of("unfinished", number=0.05, end=1.0)
        code, text = self.compare()
        self.assertEqual(code, 0)
        at_8 = (1 + SECOND_ORDER * 0.02**2) * (1 + RESOLUTION / 8) * (1 + BOX / 9**3)
        for word in ("not judged yet", f"{100 * (at_8 - 1):+.2f} %", f"{100 * (1.1 * at_8 - 1):+.2f} %", f"{100 * (1.2 * at_8 - 1):+.2f} %"):
            self.assertIn(word, text)
        series = small_deformation.Series(small_deformation.read_runs(self.folder / "out", 3.0), SETTINGS_VALUES)
        self.assertAlmostEqual(series.kernel_ratios("cosine4")[8.0], at_8, delta=1e-12)
        files = case_results.draw(self.folder / "out", self.folder / "case")
        self.assertGreater(files[0].stat().st_size, 1000)

    def test_says_that_nothing_is_there(self):
        self.assert_refused("no finished run", case_results.judge, self.folder / "out", self.folder / "case")


SETTINGS_VALUES = {
    "kernel": "cosine4", "kernel_law": "skalak", "kernel_capillary_number": 0.02, "box_in_radii": 9, "box_radius": 8.0,
}  # fmt: skip


if __name__ == "__main__":
    unittest.main()
