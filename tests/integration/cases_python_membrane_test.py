"""The case python-membrane. Usage: cases_python_membrane_test.py TANKTREAD [unittest arguments]."""

import sys
import unittest

from outside_fixture import ROOT, OutsideTest


class PythonMembrane(OutsideTest):
    def test_the_neo_hookean_membrane_in_python_is_the_one_of_the_library(self):
        # Re so high that twenty steps make strains of 0.17. Places are near x = 12, so that a deformation gradient, a sum
        # over corners times gradients of shape functions, is wrong by some 12 eps in either program, and a force by 12 eps
        # over the strain of its share: 10 * 12 * 2.2e-16/0.17 = 1.6e-13 for a node of six triangles.
        case = ROOT / "cases/python-membrane/case.toml"
        keys = [
            "flow.box=[24, 24, 24]", "flow.start=developed", "flow.reynolds_number=1.25", "capsule.0.radius=5",
            "capsule.0.position=[12, 12, 12]", "capsule.0.mesh.level=2", "run.shear_time=0.1666667", "run.threads=1",
        ]  # fmt: skip
        self.run_case("python", *keys, case=case)
        self.run_case("library", *keys, "membrane.command=[]", case=case)
        ours, wanted = (self.membrane_file(name, 20) for name in ("python", "library"))
        for a, b in ((ours.point_data["total_force"], wanted.point_data["total_force"]), (ours.points, wanted.points)):
            self.assertLess(abs(a - b).max(), 1e-12 * abs(b).max())
        self.assertGreater(wanted.cell_data["principal_stretches"][0].max(), 1.05)


if __name__ == "__main__":
    OutsideTest.program = sys.argv.pop(1)
    unittest.main()
