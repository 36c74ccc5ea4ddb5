"""Tests of the theory of a viscous capsule at small deformation."""

import csv
import unittest

from post_fixture import ROOT, InFolder

from tanktread_post import small_deformation
from tanktread_post.viscous_capsule import start_up, steady_state


class SteadyState(InFolder):
    # The next order is a share of Ca of D and of 45 degrees: 1e-6 of them at Ca = 1e-6.
    def test_without_viscosity_is_the_limit_of_barthes_biesel_and_rallison(self):
        for area_ratio in (0.0, 1.0, 10.0):
            membrane = {"elastic_law": "skalak", "area_ratio": area_ratio, "capillary_number": 1e-6, "capillary_modulus": "G_s"}
            limit = small_deformation.theory(membrane)
            deformation, inclination = steady_state(1e-6, area_modulus=small_deformation.area_to_shear_modulus(membrane))
            self.assertAlmostEqual(deformation / limit, 1, delta=1e-5)
            self.assertAlmostEqual(inclination, 45, delta=1e-3)

    def test_a_membrane_so_viscous_that_its_elasticity_does_not_matter_is_steady_along_the_flow(self):
        # The membrane turns while its strain rate lags behind its stress by a quarter of a turn: 45 degrees less 45.
        deformation, inclination = steady_state(1e4, boussinesq_shear=1e6, boussinesq_dilatational=3e6)
        self.assertAlmostEqual(deformation * 1e6, 25 / 12, delta=1e-4)
        self.assertAlmostEqual(inclination, 0, delta=1e-3)

    def test_the_reference_of_the_case_is_this_theory(self):
        lines = (ROOT / "cases/small-deformation-viscous/reference/theory.csv").read_text().splitlines()
        rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        self.assertEqual(len(rows), 5)
        for row in rows:
            deformation, inclination = steady_state(0.02, float(row["bq_s"]), float(row["bq_d"]))
            self.assertAlmostEqual(deformation, float(row["deformation"]), delta=1e-6)
            self.assertAlmostEqual(inclination, float(row["inclination_deg"]), delta=1e-4)


class StartUp(unittest.TestCase):
    # The slowest part decays by the elasticity behind the viscosity: here by exp(-60/8) or more. The spring, of a modulus of 1e6
    # beside the 50 of the membrane, leaves 1e-4.
    def test_ends_in_the_steady_state(self):
        deformation, inclination = start_up(200.0, 0.02, 40, 1e-5)
        expected, angle = steady_state(0.02, 40)
        self.assertAlmostEqual(deformation / expected, 1, delta=1e-3)
        self.assertAlmostEqual(inclination, angle, delta=0.03)

    def test_goes_with_the_flow_at_first(self):
        # Without viscosity D = t/2 at 45 degrees less half the turn; what elasticity does is of the order of t/Ca.
        deformation, inclination = start_up(1e-3, 1e2, 0, 1.0)
        self.assertAlmostEqual(deformation / 0.5e-3, 1, delta=1e-3)
        self.assertAlmostEqual(inclination, 45, delta=0.02)

    def test_a_membrane_that_cannot_shear_grows_and_shrinks_in_area_alone(self):
        # Then v = 0, by a force along grad_s Y that brings the 1/2 of the flow to rest: with the mobilities 2/35 and 1/5 it is -7/2,
        # and its radial velocity -3/5, which leaves 2/5 of the strain rate g/2. What is not rigid is of the order of 1e-6/1e-3.
        deformation, _ = start_up(1e-3, 1e6, 1e9, 1e-12)
        self.assertAlmostEqual(deformation / 1e-3, 2 / 5 / 2, delta=1e-3)


if __name__ == "__main__":
    unittest.main()
