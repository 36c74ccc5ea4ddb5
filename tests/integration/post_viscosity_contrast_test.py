"""Tests of the theory of small deformation with another viscosity inside: mobility, steady shapes, the way to them."""

import cmath
import math
import unittest

import numpy

from post_fixture import ROOT

from tanktread_post import case_analysis
from tanktread_post.viscous_capsule import (
    FLOW,
    INSIDE,
    OUTSIDE,
    drop_start_up,
    drop_steady_state,
    flow_on_sphere,
    sharp_mobility,
    start_up,
    steady_state,
)

small_deformation = case_analysis.module_of(ROOT / "cases/small-deformation/analyse.py")

VISCOSITY_RATIOS = (0.0, 0.2, 1.0, 5.0, 20.0, 100.0)
ROUNDING = 1e-13  # of numbers of about 1 through a 2 x 2 inverse of condition 30 or less


def of_drop(ratio, capillary_number):
    """(D, inclination, r) of the first-order theory of drops, at any Ca and lambda."""
    rate = 40 * (ratio + 1) / ((2 * ratio + 3) * (19 * ratio + 16) * capillary_number)
    return 2.5 / (2 * ratio + 3) / math.hypot(1, rate), math.degrees(math.atan(rate)) / 2, rate


def shape(deformation, inclination):
    """The complex amplitude whose modulus is D, and half of whose argument is the inclination."""
    return cmath.rect(deformation, 2 * math.radians(inclination))


class Mobility(unittest.TestCase):
    def test_of_one_fluid_is_the_single_layer_of_a_sphere(self):
        # (f_r, f_t) along grad_s Y - 3 Y e_r and grad_s Y + 2 Y e_r.
        for along, value in (((-3, 1), 2 / 35), ((2, 1), 1 / 5)):
            numpy.testing.assert_allclose(sharp_mobility() @ along, value * numpy.array(along), atol=ROUNDING)

    def test_is_reciprocal_and_takes_work(self):
        # The work of a force (f_r, f_t) on a velocity (w, v) is f_r w + 6 f_t v, for |grad_s Y|^2 is 6 Y^2 in the mean: symmetric, and positive.
        for ratio in VISCOSITY_RATIOS:
            work = numpy.diag([1, 6]) @ numpy.linalg.inv(sharp_mobility(ratio))
            numpy.testing.assert_allclose(work, work.T, atol=ROUNDING * numpy.max(work))
            self.assertGreater(min(numpy.linalg.eigvalsh(work)), 0)

    def test_tractions_are_those_of_flows_that_are_known(self):
        # A homogeneous strain inside has the stress 2 E; outside, -5/2 x x.E.x/r^5 with the pressure -5 x.E.x/r^5, together with
        # what makes it the flow about a rigid sphere in a strain (velocity -E.x on the sphere), has -3 E.n beside it: 5 E.n in all with 2 E.n of the strain.
        numpy.testing.assert_allclose(INSIDE @ [1, 0.5], [2, 1], atol=ROUNDING)
        numpy.testing.assert_allclose(OUTSIDE @ [-1, -0.5], [3, 1.5], atol=ROUNDING)

    def test_the_flow_strains_a_sphere_of_another_fluid_alike_everywhere(self):
        for ratio in VISCOSITY_RATIOS:
            numpy.testing.assert_allclose(flow_on_sphere(ratio), 5 / (2 * ratio + 3) * FLOW, atol=ROUNDING)


class Drop(unittest.TestCase):
    def test_is_that_of_first_order_theory_at_any_capillary_number(self):
        for ratio in VISCOSITY_RATIOS:
            for capillary_number in (1e-3, 0.02, 1.0, 50.0):
                with self.subTest(ratio=ratio, capillary_number=capillary_number):
                    deformation, inclination, _ = of_drop(ratio, capillary_number)
                    found = drop_steady_state(capillary_number, viscosity_ratio=ratio)
                    self.assertAlmostEqual(found[0] / deformation, 1, delta=1e-12)
                    self.assertAlmostEqual(found[1], inclination, delta=1e-10)

    def test_of_small_capillary_number_is_that_of_taylor_and_of_chaffey_and_brenner(self):
        for ratio in VISCOSITY_RATIOS:
            # Short of it by a share of 1/r^2, at most (100: 1e2 Ca)^2 = 1e-8; the angle by a third of that.
            deformation, inclination = drop_steady_state(1e-6, viscosity_ratio=ratio)
            self.assertAlmostEqual(deformation / 1e-6, (19 * ratio + 16) / (16 * ratio + 16), delta=1e-7)
            angle = (19 * ratio + 16) * (2 * ratio + 3) / (80 * (ratio + 1))
            self.assertAlmostEqual(math.radians(45 - inclination) / 1e-6 / angle, 1, delta=1e-7)

    def test_goes_to_its_steady_shape_at_the_rate_of_the_theory(self):
        # As seen from the flow the steady shape w_s is reached as w_s (1 - exp(-(r + i) t)).
        for ratio in VISCOSITY_RATIOS:
            deformation, inclination, rate = of_drop(ratio, 0.05)
            for time in (0.1 / rate, 1 / rate, 5 / rate):
                found = shape(*drop_start_up(time, 0.05, ratio)) / shape(deformation, inclination)
                self.assertAlmostEqual(abs(found - 1 + cmath.exp(-(rate + 1j) * time)), 0, delta=1e-12)


class ElasticCapsule(unittest.TestCase):
    def test_of_small_capillary_number_does_not_know_what_it_holds(self):
        # A share of (Ca over the slowest rate of decay at Ca = 1, 0.0056 with 100)^2 = 3e-10 is missing at Ca = 1e-7; rounding is a share of 1e-16/1e-7.
        for area_ratio in (0.0, 1.0, 10.0):
            membrane = {"elastic_law": "skalak", "area_ratio": area_ratio, "capillary_number": 1e-7, "capillary_modulus": "G_s"}
            limit, area = small_deformation.theory(membrane), small_deformation.area_to_shear_modulus(membrane)
            for ratio in VISCOSITY_RATIOS:
                deformation, inclination = steady_state(1e-7, area_modulus=area, viscosity_ratio=ratio)
                self.assertAlmostEqual(deformation / limit, 1, delta=1e-8)
                self.assertAlmostEqual(inclination, 45, delta=2e-3)
        self.assertAlmostEqual(steady_state(1e-7, viscosity_ratio=5.0)[0] / 1e-7, 25 / 12, delta=1e-7)

    def test_ends_in_the_steady_state(self):
        # 0.0056/Ca is the slowest rate of all (lambda = 100): exp(-0.0056/0.01 60) = 3e-15.
        for ratio in VISCOSITY_RATIOS:
            found, steady = start_up(60.0, 0.01, viscosity_ratio=ratio), steady_state(0.01, viscosity_ratio=ratio)
            self.assertAlmostEqual(found[0] / steady[0], 1, delta=1e-11)
            self.assertAlmostEqual(found[1], steady[1], delta=1e-9)

    def test_goes_with_the_flow_at_first(self):
        # D = 5/(2 (2 lambda + 3)) t, at 45 degrees less half of what the element has turned, t/4; elasticity changes both by a share of t/Ca = 1e-5
        # times a mobility that is largest, 1 or so, without a fluid inside, and of the moduli, 3.
        for ratio in VISCOSITY_RATIOS:
            deformation, inclination = start_up(1e-3, 1e2, viscosity_ratio=ratio)
            self.assertAlmostEqual(deformation / (2.5e-3 / (2 * ratio + 3)), 1, delta=6e-5)
            self.assertAlmostEqual(inclination, 45 - math.degrees(1e-3) / 4, delta=1e-4)


class VeryViscousInside(unittest.TestCase):
    # What is inside turns like a rigid sphere, and strains by 5/(2 lambda + 3) meanwhile: a share of 1e2/(lambda Ca) is the membrane's, which turns the shape by half of it.
    def test_any_membrane_is_strained_by_the_flow_alone(self):
        ratio = 1e9
        for found in (
            steady_state(0.1, viscosity_ratio=ratio),
            steady_state(0.1, boussinesq_shear=40, boussinesq_dilatational=10, viscosity_ratio=ratio),
            drop_steady_state(0.1, viscosity_ratio=ratio),
            drop_steady_state(0.1, boussinesq_shear=40, viscosity_ratio=ratio),
        ):
            self.assertAlmostEqual(found[0] * 2 * (2 * ratio + 3) / 5, 1, delta=1e-6)
            self.assertAlmostEqual(found[1], 0, delta=1e-4)


if __name__ == "__main__":
    unittest.main()
