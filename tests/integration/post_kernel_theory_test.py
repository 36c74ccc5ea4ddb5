"""Tests of kernel_theory.py: transforms and limits that are known, and the runs of cases/small-deformation against it.

Usage: post_kernel_theory_test.py PROGRAM
"""

import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy

from post_fixture import ROOT
from tanktread_post import case_analysis, case_results, study
from tanktread_post.kernel_theory import LARGEST_WAVENUMBER, mobility, read_kernel
from tanktread_post.observables import InputError
from tanktread_post.viscous_capsule import sharp_mobility, steady_state

PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else "tanktread"
CASE = ROOT / "cases/kernel-theory"


class KernelTheory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        for table in study.read_study(CASE)["table"]:
            command = [PROGRAM, "study", *table["arguments"], "--out", str(cls.folder / table["file"])]
            subprocess.run(command, check=True, capture_output=True)
        cls.kernels = {file.stem: read_kernel(file) for file in sorted(cls.folder.glob("*.csv"))}

    def test_transforms_in_closed_form(self):
        k = numpy.linspace(0.01, LARGEST_WAVENUMBER, 500)
        known = {
            "cosine4": numpy.sin(2 * k) / (2 * k) * (math.pi**2 / 4) / (math.pi**2 / 4 - k**2),
            "linear2": (numpy.sin(k / 2) / (k / 2)) ** 2,
        }
        for name, expected in known.items():
            # Simpson's rule at h = 1/64: h^4/180 times the fourth derivative, at most 1/4 (k + pi/2)^4, over a length of 4: 1.4e-5.
            numpy.testing.assert_allclose(self.kernels[name].transform(k), expected, atol=1.4e-5)

    def test_every_transform_begins_with_the_moments_of_its_kernel(self):
        # 1, for a partition of unity has that integral; and -M2 k^2/2, where M2 vanishes for stockie6 alone.
        for name, kernel in self.kernels.items():
            one, near = kernel.transform(numpy.array([0.0, 0.1]))
            self.assertAlmostEqual(one, 1.0, delta=1e-6, msg=name)
            # The next term is M4 k^4/24, with an M4 of less than 3.
            self.assertAlmostEqual(near, 1 - 0.005 * kernel.second_moment(), delta=2e-5, msg=name)
            self.assertEqual(abs(kernel.second_moment()) < 1e-5, name == "stockie6", name)

    def test_shortfall(self):
        # Closed forms (tests/unit/coupler_moments.hpp); a straight line between 64 values a step errs by h^2/8 times phi'' (1.2 at most): 4e-5 of
        # phi in a sum of up to 16 pairs, half of one sign and half of the other.
        self.assertAlmostEqual(self.kernels["cosine4"].shortfall(), 0.5 - 3 / (8 * math.pi), delta=1e-4)
        self.assertAlmostEqual(self.kernels["linear2"].shortfall(), 1 / 6, delta=1e-4)

    def test_a_large_sphere_has_the_sharp_mobility_but_for_the_shortfall(self):
        for name, kernel in self.kernels.items():
            far, near = (sharp_mobility() - mobility(kernel, radius) for radius in (24.0, 48.0))
            # Along the surface first order, with a C that is that of a sheet along the grid, or a fifth more.
            self.assertAlmostEqual(math.log2(far[1, 1] / near[1, 1]), 1.0, delta=0.1, msg=name)
            self.assertGreater(48 * near[1, 1], 0.98 * kernel.shortfall(), name)
            self.assertLess(48 * near[1, 1], (1.5 if name == "linear2" else 1.2) * kernel.shortfall(), name)
            # Along the normal there is no kink: second order, third where the second moment vanishes.
            order = math.log2(abs(far[0, 0] / near[0, 0]))
            low, high = (2.8, 3.2) if name == "stockie6" else (1.8, 2.2)
            self.assertTrue(low < order < high, (name, order))

    def test_the_mobility_is_symmetric(self):
        # In the power f_r w + 6 f_t v, for grad_s Y has six times the square of Y.
        for kernel in self.kernels.values():
            matrix = numpy.diag([1, 6]) @ mobility(kernel, 8.0)
            self.assertAlmostEqual(matrix[0, 1], matrix[1, 0], delta=1e-12)
            self.assertTrue((numpy.linalg.eigvalsh(matrix) > 0).all())

    def test_the_six_points_with_the_correction_are_within_half_a_per_cent_at_eight(self):
        for boussinesq in (0.0, 20.0, 40.0):
            deformation, inclination = steady_state(0.02, boussinesq, mobility=mobility(self.kernels["stockie6"], 8.0, corrected=True))
            sharp = steady_state(0.02, boussinesq)
            self.assertAlmostEqual(deformation / sharp[0], 1.0, delta=0.005)
            self.assertAlmostEqual(inclination, sharp[1], delta=0.1)

    def test_measured_runs_lie_in_the_band(self):
        table = case_analysis.load(CASE).tables(self.folder, CASE)[-1]
        self.assertNotIn(False, table.verdicts, table.rows)
        judged = {row[0].split(",")[0] for row, inside in zip(table.rows, table.verdicts) if inside}
        self.assertEqual(judged, set(self.kernels) - {"linear2"})

    def test_the_case_draws_and_judges(self):
        self.assertEqual(case_results.judge(self.folder, CASE), 0)
        (picture,) = case_results.draw(self.folder, CASE)
        self.assertTrue(picture.is_file())

    def test_a_table_of_other_distances_is_refused(self):
        file = self.folder / "bad.txt"
        for text in ("", "roma3,0,0.6\n", "roma3,0,0.6\nroma3,0.5,0.5\nroma3,1.5,0\n", "roma3,0,0.6\nroma3,0.2,0.5\n"):
            file.write_text("kernel,distance,phi\n" + text)
            with self.assertRaises(InputError):
                read_kernel(file)


if __name__ == "__main__":
    unittest.main()
