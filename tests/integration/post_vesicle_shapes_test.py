"""Tests of vesicle_shapes.py: exact relations of shapes of least bending energy, limits in closed form, published numbers."""

import math
import unittest

import numpy

from post_fixture import InFolder
from tanktread_post.red_cell import RedCell
from tanktread_post.vesicle_shapes import shape

# One of each branch, away from where it begins or ends.
SHAPES = (("oblate", 0.65), ("prolate", 0.7), ("stomatocyte", 0.6))


def energy(branch, v):
    return shape(branch, v).energy


def crossing(one, other, low, high):
    """v between low and high where the energies of two branches are equal, to 1e-5: false position, whose error is quadratic in the interval."""
    for _ in range(2):
        ends = [energy(one, v) - energy(other, v) for v in (low, high)]
        v = low - ends[0] * (high - low) / (ends[1] - ends[0])
        low, high = v - 5e-4, v + 5e-4
    return v


class Equations(unittest.TestCase):
    def order(self, error, message):
        """Errors at 200, 400 and 800 intervals a profile, by formulae of the second order: each a quarter of that before it. The next term is
        a share of the square of the steps of 1/200 over the sharpest curvature's length, below a tenth: 0.15 of the order."""
        errors = [error(points) for points in (201, 401, 801)]
        for coarse, fine in zip(errors, errors[1:]):
            self.assertAlmostEqual(math.log2(coarse / fine), 2, delta=0.15, msg=message)

    def test_the_shape_equation(self):
        # Helfrich's, in another form than the one integrated: Laplacian of h + h (h^2/2 - 2 K) = P + Sigma h, K the Gaussian curvature. By
        # differences along the profile; the mean square of what is left.
        def residual(branch, v, points):
            a = shape(branch, v, points)
            step, h = a.arc_length[1], a.curvature_sum[1:-1]
            q = numpy.sin(a.tangent_angle[1:-1]) / a.r[1:-1]
            flux = (a.r[1:] + a.r[:-1]) / 2 * numpy.diff(a.curvature_sum) / step
            left = numpy.diff(flux) / step / a.r[1:-1] + h * (h**2 / 2 - 2 * q * (h - q)) - a.pressure - a.tension * h
            return math.sqrt(numpy.mean(left**2))

        for branch, v in SHAPES:
            self.order(lambda points: residual(branch, v, points), branch)

    def test_area_volume_energy_and_curvature_are_those_of_the_profile(self):
        # Frusta between its points; the trapezoidal rule; the turn of the chords. In units of the radius of equal area.
        def parts(branch, v, points):
            a = shape(branch, v, points)
            step, dr, dz = a.arc_length[1], numpy.diff(a.r), numpy.diff(a.z)
            area = float(numpy.sum((a.r[1:] + a.r[:-1]) * numpy.hypot(dr, dz))) / 4
            volume = -float(numpy.sum(dz * (a.r[1:] ** 2 + a.r[1:] * a.r[:-1] + a.r[:-1] ** 2))) / 4
            bending = float(numpy.sum(a.r * a.curvature_sum**2)) * step / 8
            turn = numpy.diff(numpy.unwrap(numpy.arctan2(-dz, dr))) / step
            sum_of_both = turn + numpy.sin(a.tangent_angle[1:-1]) / a.r[1:-1]
            return area - 1, volume - v, bending - a.energy, numpy.max(numpy.abs(sum_of_both - a.curvature_sum[1:-1]))

        for branch, v in SHAPES:
            for k, name in enumerate(("area", "volume", "energy", "curvature")):
                self.order(lambda points: abs(parts(branch, v, points)[k]), (branch, name))

    def test_the_profile_goes_from_pole_to_pole(self):
        for branch, v in SHAPES:
            a = shape(branch, v)
            # The ends are conditions of the collocation, met to rounding.
            numpy.testing.assert_allclose([a.r[0], a.r[-1], a.tangent_angle[0], a.tangent_angle[-1] - math.pi], 0, atol=1e-12)
            self.assertGreater(min(a.r[1:-1]), 0)
            self.assertAlmostEqual(a.z[0], -a.z[-1], delta=1e-12)
            if branch != "stomatocyte":
                numpy.testing.assert_allclose([a.r - a.r[::-1], a.z + a.z[::-1]], 0, atol=1e-12)

    def test_the_size_of_a_shape_does_not_matter_to_its_energy(self):
        # 2 Sigma A + 3 P V = 0, in shares of its terms: the tolerance of the equations, 1e-8, over a profile some tens of the
        # lengths long on which shapes change.
        for branch, v in (*SHAPES, ("oblate", 0.999), ("prolate", 0.2), ("stomatocyte", 0.3)):
            a = shape(branch, v)
            self.assertAlmostEqual(1 + a.pressure * v / (2 * a.tension), 0, delta=1e-7, msg=branch)

    def test_the_pressure_is_what_the_energy_changes_by(self):
        # dE/dv = -P/6, integrated by Gauss and Legendre's rule, with which the difference falls to that of the energies, 1e-9 each. Three
        # and four points tell how far the rule is.
        for branch, low, high in (("oblate", 0.55, 0.65), ("prolate", 0.85, 0.95), ("stomatocyte", 0.5, 0.6)):
            integrals = []
            for points in (3, 4):
                node, weight = numpy.polynomial.legendre.leggauss(points)
                pressures = [shape(branch, v).pressure for v in low + (high - low) * (node + 1) / 2]
                integrals.append(-(high - low) / 2 * float(weight @ pressures) / 6)
            left = abs(integrals[1] - (energy(branch, high) - energy(branch, low)))
            self.assertLess(left, 2e-9 + abs(integrals[1] - integrals[0]) / 5, branch)

    def test_a_hundredth_of_the_tolerance_is_about_a_hundredth_of_the_error(self):
        # The collocation and its residual, which the tolerance is of, are both of the fourth order; where the mesh is refined differs. At 1e-8
        # the energy has more digits than are promised.
        for branch, v in SHAPES[:2]:
            exact = shape(branch, v, tolerance=1e-9).energy
            coarse, fine = (abs(shape(branch, v, tolerance=tolerance).energy - exact) for tolerance in (1e-6, 1e-8))
            self.assertTrue(0.5 < math.log(coarse / fine) / math.log(100) < 1.5, (branch, coarse, fine))
            self.assertLess(fine, 1e-9)


class Limits(unittest.TestCase):
    def test_near_the_sphere(self):
        # P = 12 and Sigma = -6 up to the root of 1 - v, of which oblates and prolates have opposite shares: half their difference is of order 1/2
        # and their mean of order 1. The next orders are as much smaller as sqrt(1e-4), with factors of some units: 0.03.
        def pressures(epsilon):
            one, other = (shape(branch, 1 - epsilon).pressure for branch in ("oblate", "prolate"))
            return (one - other) / 2, (one + other) / 2 - 12

        coarse, fine = pressures(1e-3), pressures(1e-4)
        self.assertAlmostEqual(math.log10(coarse[0] / fine[0]), 0.5, delta=0.03)
        self.assertAlmostEqual(math.log10(coarse[1] / fine[1]), 1.0, delta=0.03)
        self.assertGreater(fine[0], 0)
        self.assertAlmostEqual(shape("oblate", 1 - 1e-6).energy, 1 + 2e-6, delta=1e-8)

    def test_spheroids_are_as_good_up_to_the_second_order(self):
        # A family with the right first order, a spheroid's, has the least energy up to (1 - v)^2; and never less than the least.
        def excess(ratio):
            spheroid = RedCell(1.0, (2 * ratio, 0.0, 0.0))
            branch = "oblate" if ratio < 1 else "prolate"
            return 1 - spheroid.reduced_volume, spheroid.bending_energy - energy(branch, spheroid.reduced_volume)

        for sign in (-1, 1):
            (far, more), (near, less) = excess(1 + sign * 0.2), excess(1 + sign * 0.1)
            self.assertGreater(less, 0)
            # The next order is the root of 1 - v = 0.008 or less smaller, with a factor of some units: 0.3 of the order.
            self.assertAlmostEqual(math.log(more / less) / math.log(far / near), 2, delta=0.3)

    def test_long_prolates_are_cylinders_with_caps(self):
        # A cylinder of radius a has P = 2/a^3 and Sigma = -3/(2 a^2), and 2 Sigma A + 3 P V = 0 makes a = 2 v/3. What the caps do dies away along it:
        # 1e-4 at v = 0.5, 1e-7 at 0.4, less than the tolerance at 0.3. Integrated, E = 9/(16 v^2) and a constant.
        caps = []
        for v in (0.3, 0.2):
            a = shape("prolate", v)
            self.assertAlmostEqual(a.pressure * 4 * v**3 / 27, 1, delta=1e-8)
            self.assertAlmostEqual(a.tension * 8 * v**2 / 27, -1, delta=1e-8)
            caps.append(a.energy - 9 / (16 * v**2))
        self.assertAlmostEqual(*caps, delta=1e-8)
        self.assertAlmostEqual(caps[0], 0.49737, delta=5e-6)

    def test_a_cup_of_little_volume_is_two_spheres_one_in_the_other(self):
        # Of energy 2 together, from which the neck takes off a little (its surface is near one without h). Closer and closer as v falls.
        energies = [energy("stomatocyte", v) for v in (0.6, 0.4, 0.2)]
        self.assertEqual(energies, sorted(energies))
        self.assertTrue(0 < 2 - energies[-1] < (2 - energies[0]) / 10)


class Published(unittest.TestCase):
    def test_where_the_branches_cross(self):
        # 0.651 and 0.592 (Seifert, Berndl and Lipowsky, Phys. Rev. A 44, 1182, 1991), one unit of the last digit.
        self.assertAlmostEqual(crossing("oblate", "prolate", 0.64, 0.66), 0.651, delta=1e-3)
        self.assertAlmostEqual(crossing("oblate", "stomatocyte", 0.58, 0.60), 0.592, delta=1e-3)

    def test_which_one_has_the_least_energy(self):
        for v, least in ((0.66, "prolate"), (0.62, "oblate"), (0.57, "stomatocyte")):
            energies = {branch: energy(branch, v) for branch in ("oblate", "prolate", "stomatocyte")}
            self.assertEqual(min(energies, key=energies.get), least)

    def test_a_red_cell_has_more_energy_than_the_discocyte_of_its_reduced_volume(self):
        cell = RedCell()
        least = energy("oblate", cell.reduced_volume)
        self.assertAlmostEqual(least, 1.84052, delta=1e-5)  # ours
        self.assertGreater(cell.bending_energy, 1.04 * least)


class Ends(InFolder):
    def test_oblates_end_where_their_poles_touch(self):
        # From both sides of v = 0.50267. The distance grows with v at about 1.3.
        self.assertTrue(0 < 2 * shape("oblate", 0.5028).z[0] < 1e-3)
        self.assert_refused(["0.5025", "poles"], shape, "oblate", 0.5025)

    def test_stomatocytes_end_where_they_meet_others(self):
        # From both sides of v = 0.6608, towards which the pressure grows without end to its rate.
        rates = [(shape("stomatocyte", v + 1e-3).pressure - shape("stomatocyte", v).pressure) for v in (0.655, 0.659)]
        self.assertGreater(rates[1], 1.5 * rates[0])
        self.assert_refused(["0.662", "no stomatocyte"], shape, "stomatocyte", 0.662)

    def test_bad_arguments(self):
        for v in (1.0, 1.2, 0.05, 0.0, math.nan):
            self.assert_refused(["reduced volume", "0.15"], shape, "prolate", v)
        self.assert_refused(["torus", "prolate"], shape, "torus", 0.7)


if __name__ == "__main__":
    unittest.main()
