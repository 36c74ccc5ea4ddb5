"""A program in the place of the fluid. Usage: outside_fluid_test.py TANKTREAD [unittest arguments]."""

import csv
import sys
import unittest

from outside_fixture import HERE, OutsideTest, command, steps

PROGRAM = HERE / "outside_fluid.py"


class FluidTest(OutsideTest):
    def fluid(self, *arguments):
        """The key that puts the program of these tests in the place of the fluid."""
        return "flow.command=" + command("/usr/bin/python3", PROGRAM, self.program, self.folder / "case.toml", *arguments)

    def rows(self, name):
        """observables.csv of a run, without the highest speed; and that."""
        with open(self.folder / name / "observables.csv", newline="") as stream:
            rows = list(csv.DictReader(stream))
        return rows, [float(row.pop("max_speed")) for row in rows]


class Results(FluidTest):
    def test_the_solver_as_a_program_is_the_solver_bit_for_bit(self):
        self.run_case("library", *steps(10))
        output = self.run_case("program", *steps(10), self.fluid())
        self.assertIn("  program                 python3 outside_fluid.py", output)
        (rows, speeds), (wanted, wanted_speeds) = self.rows("program"), self.rows("library")
        self.assertEqual(rows, wanted)
        # The solver finds it among the velocities that it collides with, not among those that it gives out: the same
        # momentum over density, in another order of sums.
        for ours, expected in zip(speeds, wanted_speeds):
            self.assertAlmostEqual(ours, expected, delta=1e-13)
        ours, expected = self.results("program"), self.results("library")
        series = [name for name in expected if name.startswith(("membrane/", "fluid/"))]
        self.assertEqual(len(series), 12)
        for name in series:
            self.assertTrue(ours[name] == expected[name], f"{name} differs")

    def test_a_killed_run_goes_on_bit_for_bit_with_the_state_of_the_program(self):
        # A killed process leaves its packets where they are: here, and not in memory.
        keys = [*steps(16), self.fluid(), "run.command_directory=packets"]
        self.run_case("whole", *keys)
        self.assertEqual(self.kill_and_resume("killed", 4, *keys), -9)
        self.assert_same_results("whole", "killed")

    def test_body_force_and_walls_come_with_the_packet(self):
        import outside_fluid

        keys = [*steps(2), "flow.kind=poiseuille", "flow.body_force=[0, 1e-6, 0]", "run.command_directory=packets"]
        case = self.folder / "case.toml"
        case.write_text(case.read_text().replace('kind = "shear"', 'kind = "poiseuille"'))
        self.run_case("out", *keys, self.fluid())
        numbers = outside_fluid.read(self.folder / "packets/fluid/input_0.vti").GetFieldData()
        driving = 8 / 6 * 0.02 / 24**2
        wanted = {
            "step": [1], "schema_version": [1], "kinematic_viscosity": [1 / 6], "relaxation_time": [1], "inertia": [1],
            "wall_speed": [0], "wall_axis": [2], "flow_axis": [0], "body_force": [driving, 1e-6, 0],
        }  # fmt: skip
        for name, values in wanted.items():
            found = [numbers.GetArray(name).GetComponent(0, k) for k in range(len(values))]
            for ours, expected in zip(found, values):
                self.assertAlmostEqual(ours, expected, delta=1e-15, msg=name)
        self.run_case("periodic", *steps(2)[:1], "flow.kind=periodic", "flow.start=rest", "run.command_directory=more", self.fluid(), case=self.periodic())
        axis = outside_fluid.read(self.folder / "more/fluid/input_1.vti").GetFieldData().GetArray("wall_axis")
        self.assertEqual(axis.GetValue(0), -1)

    def periodic(self):
        """The case file, changed to one of a box without walls."""
        case = self.folder / "case.toml"
        text = case.read_text().replace("wall_speed = 0.02", "shear_rate = 1.6666666666666667e-3").replace('"developed"', '"rest"')
        case.write_text(text.replace("[flow]", '[flow]\nkind = "periodic"'))
        return case

    def test_beside_a_membrane_that_is_a_program(self):
        key = "membrane.command=" + command("/usr/bin/python3", HERE / "outside_membrane.py")
        self.run_case("one", *steps(4), key)
        self.run_case("both", *steps(4), key, self.fluid())
        self.assertEqual(self.rows("both")[0], self.rows("one")[0])

    def test_recorded_steps_are_repeated_bit_for_bit(self):
        self.run_case("out", *steps(4), self.fluid(), more=["--record", "record"])
        code, output = self.tanktread("replay", "record", "--only", "fluid")
        self.assertEqual(code, 0, output)


class Failures(FluidTest):
    # What the program does from step 3 on, and what is said of it.
    CASES = {
        "die": "it ended with exit code 7 and gave no answer",
        "nan": "the velocity at node (1, 2, 3) is (nan, ",
        "fast": "both must be finite, and the speed below flow.speed_limit, 0.1",
        "no-density": "the array 'density' is missing; expected point data 'density' of 13824 x 1 numbers (Float64); there are: velocity",
        "plane": "'velocity' has 2 components; expected point data 'velocity' of 13824 x 3 numbers (Float64)",
        "float32": "array 'velocity' is of single precision (Float32)",
        "moved": "a grid of 24 x 24 x 24 nodes from (0, 0, 0) with spacing (1, 1, 1); the case has flow.box = [24, 24, 24], from (0.5, 0.5, 0.5)",
        "late": "of step 99; expected one of step 3",
    }

    def test_each_is_named_with_step_program_and_what_was_expected(self):
        for what, words in self.CASES.items():
            with self.subTest(what=what):
                code, output = self.tanktread(*self.arguments(what, *steps(6), self.fluid(what, 3)))
                self.assertEqual(code, 3, output)
                self.assertIn(f"tanktread: error: step 3: the program of the fluid, /usr/bin/python3 {PROGRAM} ", output)
                self.assertIn(words, output)
                self.assertIn(f"last good state: {self.folder}/{what}/checkpoints/step_0000000002", output)

    def test_a_state_of_another_solver_is_refused(self):
        self.run_case("library", *steps(2))
        state = self.folder / "library/checkpoints/step_0000000002/fluid.vti"
        (self.folder / "out").mkdir()
        code, output = self.tanktread("fluid", "--case", "case.toml", "--set", self.fluid(), "--state", state, "--out", "next.vti")
        self.assertEqual(code, 2, output)
        self.assertIn("does not fit the case: the array 'density' is missing", output)


if __name__ == "__main__":
    OutsideTest.program = sys.argv.pop(1)
    unittest.main()
