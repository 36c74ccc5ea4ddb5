"""Tests of red_cell.py: the numbers of Evans and Fung's cell, spheres and spheroids in closed form, dimensionless numbers of usual values."""

import math
import unittest

import numpy

from post_fixture import InFolder
from tanktread_post.red_cell import RedCell, dimensionless_numbers

MICROMETRE = 1e-6


class Shape(unittest.TestCase):
    def test_numbers_of_evans_and_fung(self):
        # To half a unit of the digits that are known.
        cell = RedCell()
        known = (
            (cell.diameter / MICROMETRE, 7.82, 0.005), (cell.volume / MICROMETRE**3, 94.09, 0.005), (cell.area / MICROMETRE**2, 134.09, 0.005),
            (cell.least_thickness / MICROMETRE, 0.81, 0.005), (cell.largest_thickness / MICROMETRE, 2.566, 0.0005),
            (cell.reduced_volume, 0.6444, 0.00005), (cell.radius_of_equal_volume / MICROMETRE, 2.8215, 0.00005),
            (cell.bending_energy, 1.92874, 0.000005),
        )  # fmt: skip
        for ours, expected, half_a_digit in known:
            self.assertAlmostEqual(ours, expected, delta=half_a_digit)

    def test_a_sphere(self):
        # With h = 2 a sqrt(1 - x^2). All integrals are of polynomials in the sine and cosine: 64 points have them to rounding.
        cell = RedCell(2.0, (4.0, 0.0, 0.0))
        self.assertAlmostEqual(cell.volume, 4 * math.pi / 3 * 8, delta=1e-11)
        self.assertAlmostEqual(cell.area, 16 * math.pi, delta=1e-11)
        self.assertAlmostEqual(cell.bending_energy, 1, delta=1e-12)
        self.assertAlmostEqual(cell.reduced_volume, 1, delta=1e-12)
        self.assertAlmostEqual(cell.largest_thickness, 4, delta=1e-12)

    def test_spheroids(self):
        # Area: 2 pi a^2 + pi b^2/e ln((1 + e)/(1 - e)), e^2 = 1 - b^2/a^2. Energy: with u = cos t and w^2 = b^2 + (a^2 - b^2) u^2 the curvatures of
        # a = 1 are b/w^3 and b/w, and dA = 4 pi w du; by the midpoint rule of 20000 strips, 1e-9.
        a, b = 1.0, 0.4
        e = math.sqrt(1 - b * b)
        cell = RedCell(a, (2 * b, 0.0, 0.0))
        self.assertAlmostEqual(cell.area, 2 * math.pi + math.pi * b * b / e * math.log((1 + e) / (1 - e)), delta=1e-12)
        self.assertAlmostEqual(cell.volume, 4 * math.pi / 3 * b, delta=1e-12)
        u = (numpy.arange(20000) + 0.5) / 20000
        square = b * b + (a * a - b * b) * u**2  # of w, u = cos t
        h = b * (1 / square**1.5 + 1 / square**0.5)
        self.assertAlmostEqual(cell.bending_energy, float(numpy.mean(h**2 * numpy.sqrt(square))) / 4, delta=1e-8)

    def test_the_profile_has_its_volume_and_area(self):
        # Frusta between its points: second order, from both sides; the next term is a share of (pi/200)^2.
        cell, errors = RedCell().scaled(1 / MICROMETRE), []
        for points in (201, 401):
            r, z = cell.profile(points)
            dr, dz = numpy.diff(r), numpy.diff(z)
            volume = -math.pi / 3 * float(numpy.sum(dz * (r[1:] ** 2 + r[1:] * r[:-1] + r[:-1] ** 2)))
            area = math.pi * float(numpy.sum((r[1:] + r[:-1]) * numpy.hypot(dr, dz)))
            errors.append((abs(volume - cell.volume), abs(area - cell.area)))
        for coarse, fine in zip(*errors):
            self.assertAlmostEqual(math.log2(coarse / fine), 2, delta=0.05)
        r, z = cell.profile()
        self.assertEqual(r[100], max(r))
        self.assertAlmostEqual(z[0], 0.405, delta=1e-12)
        self.assertAlmostEqual(2 * max(z), cell.largest_thickness, delta=1e-3)

    def test_a_larger_cell_has_the_same_energy(self):
        one, other = RedCell(), RedCell().scaled(3.0)
        self.assertAlmostEqual(other.bending_energy / one.bending_energy, 1, delta=1e-12)
        self.assertAlmostEqual(other.volume / one.volume, 27, delta=1e-10)
        self.assertAlmostEqual(other.reduced_volume / one.reduced_volume, 1, delta=1e-12)


class Numbers(InFolder):
    CELL = {"radius": 2.8215e-6, "shear_modulus": 5e-6, "shear_rate": 100.0, "inner_viscosity": 8e-3, "membrane_shear_viscosity": 0.42e-6}

    def test_of_usual_values(self):
        # Bq_s 124 in plasma and 5 in dextran of 28.9 mPa s, in the digits given.
        plasma = dimensionless_numbers(viscosity=1.2e-3, **self.CELL)
        dextran = dimensionless_numbers(viscosity=28.9e-3, **self.CELL)
        self.assertAlmostEqual(plasma["boussinesq_shear"], 124, delta=0.5)
        self.assertAlmostEqual(dextran["boussinesq_shear"], 5, delta=0.5)
        self.assertAlmostEqual(plasma["viscosity_ratio"], 6.667, delta=5e-4)
        self.assertAlmostEqual(dextran["viscosity_ratio"], 0.277, delta=5e-4)
        self.assertAlmostEqual(plasma["capillary_number"], 0.0677, delta=5e-5)
        self.assertAlmostEqual(plasma["retardation_time"], 0.084, delta=1e-12)
        self.assertNotIn("foeppl_von_karman_number", plasma)

    def test_with_a_bending_modulus(self):
        # K_s = 3 G_s: Y = 3 G_s. 3 * 5e-6 * 2.8215e-6^2/2.5e-19 = 477.65.
        numbers = dimensionless_numbers(viscosity=1.2e-3, area_modulus=15e-6, bending_modulus=2.5e-19, **self.CELL)
        self.assertAlmostEqual(numbers["foeppl_von_karman_number"], 477.65, delta=0.005)
        self.assertAlmostEqual(numbers["foeppl_von_karman_number"] * numbers["bending_number"], 3, delta=1e-12)

    def test_bad_values(self):
        for key, value in (("radius", 0.0), ("shear_modulus", -1.0), ("shear_rate", math.nan), ("membrane_shear_viscosity", -1e-9)):
            self.assert_refused([key, "SI"], dimensionless_numbers, viscosity=1.2e-3, **{**self.CELL, key: value})


if __name__ == "__main__":
    unittest.main()
