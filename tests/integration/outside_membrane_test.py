"""A program in the place of a membrane. Usage: outside_membrane_test.py TANKTREAD [unittest arguments]."""

import signal
import subprocess
import sys
import unittest

import meshio
import numpy
from outside_fixture import HERE, OutsideTest, command, packet_folder, steps

PROGRAM = HERE / "outside_membrane.py"
NAME = "the program of the membrane of capsule 0, /usr/bin/python3 "


def membrane(*arguments):
    """The key that puts the program of these tests in the place of the membrane."""
    return "membrane.command=" + command("/usr/bin/python3", PROGRAM, *arguments)


class Results(OutsideTest):
    def test_what_the_laws_would_say_is_no_result(self):
        output = self.run_case("out", *steps(4), membrane())
        self.assertIn("membrane program        python3 outside_membrane.py", output)
        file = self.membrane_file("out", 4)
        for data in (file.point_data["elastic_force"], file.cell_data["stress"][0], file.cell_data["viscous_stress"][0]):
            self.assertTrue(numpy.isnan(data).all())
        self.assertGreater(abs(file.point_data["total_force"]).max(), 0)
        self.run_case("laws", *steps(4))
        law = self.membrane_file("laws", 4)
        for name in ("area_ratio", "principal_stretches"):
            self.assertLess(abs(file.cell_data[name][0] - law.cell_data[name][0]).max(), 1e-2)
        rows = [line.split(",") for line in (self.folder / "out/observables.csv").read_text().splitlines()]
        energies = [row[rows[0].index("elastic_energy")] for row in rows[1:]]
        self.assertEqual(energies, ["nan"] * 3)

    def test_what_the_program_says_is_taken(self):
        self.run_case("out", *steps(2), membrane("everything", 1))
        file = self.membrane_file("out", 2)
        self.assertTrue((file.point_data["elastic_force"] == 7).all())
        self.assertTrue((file.cell_data["stress"][0] == 8).all())
        self.assertTrue(numpy.isnan(file.cell_data["viscous_stress"][0]).all())
        self.assertEqual(file.cell_data["viscous_stress"][0].shape[1], 9)

    def test_each_capsule_has_its_own(self):
        capsule = '[[capsule]]\nradius = 4.0\nposition = [12.0, 26.0, 12.0]\nmesh = { level = 1 }\nmembrane = { command = [] }\n'
        case = self.folder / "case.toml"
        case.write_text(case.read_text().replace("[membrane]", capsule + "[membrane]").replace("24, 24, 24", "24, 36, 24"))
        self.run_case("out", *steps(2), membrane())
        file = self.membrane_file("out", 2)
        of_program = file.cell_data["capsule"][0] == 0
        self.assertTrue((numpy.isnan(file.cell_data["stress"][0]).any(axis=1) == of_program).all())

    def test_the_same_by_its_echo_and_through_files(self):
        self.run_case("out", *steps(6), membrane())
        (self.folder / "away").mkdir()
        echo = (self.folder / "out/echo.toml").rename(self.folder / "away/echo.toml")
        self.run_case("again", case=echo)
        self.assert_same_results("out", "again")
        self.run_case("files", *steps(6), membrane(), more=["--through-files"])
        self.assertTrue((self.folder / "files/packets").is_dir())
        for packet in (self.folder / "files/packets").iterdir():
            packet.unlink()
        self.assert_same_results("out", "files")

    def test_a_killed_run_goes_on_bit_for_bit_with_the_state_of_the_program(self):
        # A killed process leaves its packets where they are: here, and not in memory.
        keys = [*steps(40), membrane(), "run.command_directory=packets"]
        self.run_case("whole", *keys)
        self.assertEqual(self.kill_and_resume("killed", 8, *keys), -9)
        self.assert_same_results("whole", "killed")
        state = meshio.read(self.folder / "whole/checkpoints/step_0000000040/membrane.vtu").field_data
        self.assertGreater(abs(state["program_0_point_memory"]).max(), 0)
        self.assertTrue((state["program_0_cell_age"] == 40).all())

    def test_recorded_steps_are_repeated_bit_for_bit(self):
        self.run_case("out", *steps(8), membrane(), more=["--record", "record", "--from", "4"])
        code, output = self.tanktread("replay", "record", "--only", "membrane")
        self.assertEqual(code, 0, output)

    def test_a_stage_by_itself_goes_on_from_its_state(self):
        self.run_case("out", *steps(8), membrane(), more=["--record", "record", "--from", "4"])
        arguments = ["--case", "out/echo.toml", "--in", "record/node_velocity/node_velocity_0000000005.vtu", "--move"]
        code, output = self.tanktread("membrane", *arguments, "--state", "record/begin/membrane.vtu", "--out", "step.vtu")
        self.assertEqual(code, 0, output)
        ours = meshio.read(self.folder / "step.vtu").point_data["total_force"]
        wanted = meshio.read(self.folder / "record/node_force/node_force_0000000005.vtu").point_data["total_force"]
        self.assertTrue((ours == wanted).all())


class Packets(OutsideTest):
    def test_they_go_with_the_run_unless_they_have_a_place(self):
        output = self.run_case("out", *steps(2), membrane())
        self.assertFalse(packet_folder(output).exists())
        output = self.run_case("kept", *steps(4), membrane(), "run.command_directory=packets")
        self.assertEqual(packet_folder(output), self.folder / "packets/membrane_0")
        first, last = (meshio.read(self.folder / f"packets/membrane_0/input_{k}.vtu") for k in (1, 0))
        self.assertEqual((first.field_data["step"], last.field_data["step"]), (3, 4))

    def test_what_is_in_them(self):
        self.run_case("out", *steps(4), membrane(), "run.command_directory=packets")
        packet, file = meshio.read(self.folder / "packets/membrane_0/input_0.vtu"), self.membrane_file("out", 4)
        self.assertEqual(set(packet.point_data), {"velocity", "reference_position", "memory"})
        self.assertEqual(set(packet.cell_data), {"age"})
        self.assertTrue((packet.points == file.points).all())
        self.assertTrue((packet.point_data["velocity"] == file.point_data["velocity"]).all())
        self.assertTrue((packet.point_data["reference_position"] == self.membrane_file("out", 0).points).all())
        modulus = 5 / 6 / 600 / 0.3  # mu_o g a/Ca
        wanted = {
            "step": 4, "schema_version": 1, "shear_time": 4 / 600, "capsule": 0, "radius": 5, "shear_modulus": modulus,
            "area_modulus": 3 * modulus, "skalak_modulus": 0, "interfacial_tension": 0,
        }  # fmt: skip
        for name, value in wanted.items():
            self.assertAlmostEqual(packet.field_data[name][0], value, delta=1e-12 * value, msg=name)

    def test_they_go_with_a_stage_that_is_interrupted(self):
        slow = command("sh", "-c", f"echo started >&2; sleep 1; exec /usr/bin/python3 {PROGRAM}")
        self.run_case("out", *steps(2))
        stage = subprocess.Popen(
            [self.program, "membrane", "--case", "out/echo.toml", "--set", f"membrane.command={slow}",
             "--in", "out/membrane/membrane_0000000002.vtu", "--out", "step.vtu"],
            cwd=self.folder, text=True, stderr=subprocess.PIPE,
        )  # fmt: skip
        self.assertEqual(stage.stderr.readline(), "started\n")
        stage.send_signal(signal.SIGINT)
        said = stage.communicate(timeout=60)[1]
        self.assertEqual(stage.returncode, 130, said)
        self.assertFalse(packet_folder(said).exists())

    def test_two_runs_may_not_have_one_place(self):
        import fcntl

        (self.folder / "packets/membrane_0").mkdir(parents=True)
        with open(self.folder / "packets/membrane_0/.lock", "w") as lock:
            fcntl.flock(lock, fcntl.LOCK_EX)
            code, output = self.tanktread(*self.arguments("out", membrane(), "run.command_directory=packets"))
        self.assertEqual(code, 2, output)
        self.assertIn("another tanktread process", output)
        self.assertFalse((self.folder / "out").exists())


class Failures(OutsideTest):
    # What the program does from step 5 on, and what is said of it.
    CASES = {
        "die": "it ended with exit code 7 and gave no answer",
        "chat": "it answered with more than one line, 'hello...'",
        "nothing": "its answer '' is not the name of a packet that can be read",
        "nowhere": "its answer 'nowhere.vtu' is not the name of a packet that can be read: nowhere.vtu: no such file",
        "cut": "output.vtu: does not end with </VTKFile>",
        "input": "the array 'total_force' is missing; expected point data 'total_force' of 162 x 3 numbers (Float64); there are: velocity",
        "no-force": "the array 'total_force' is missing; expected point data 'total_force' of 162 x 3 numbers (Float64); there are: memory",
        "scalar": "'total_force' has 1 components; expected point data 'total_force' of 162 x 3 numbers (Float64)",
        "float32": "array 'total_force' is of single precision (Float32), which has lost half of its digits; write it as Float64",
        "text": "is written as ASCII, which need not keep every bit; write it as binary or appended data",
        "nan": "'total_force' is not finite at node 17: (",
        "fewer": "3 nodes and 1 triangles; expected those of the packet it was given, 162 and 320",
        "turned": "not of the packet it was given: the triangles are others",
        "stale": "not of the packet it was given: node 0 lies elsewhere",
    }

    def failure(self, what, step, *keys):
        """What a run says that the program makes fail, on one line."""
        code, output = self.tanktread(*self.arguments(what, *steps(10), membrane(what, step), *keys))
        self.assertEqual(code, 3, output)
        return output

    def test_each_is_named_with_step_program_and_what_was_expected(self):
        for what, words in self.CASES.items():
            with self.subTest(what=what):
                output = self.failure(what, 5)
                self.assertIn(f"tanktread: error: step 5: {NAME}{PROGRAM} {what} 5: ", output)
                self.assertIn(words, output)
                self.assertIn(f"last good state: {self.folder}/{what}/checkpoints/step_0000000004", output)
                self.assertFalse(packet_folder(output).exists())

    def test_a_name_that_no_file_of_ours_can_hold(self):
        output = self.failure("name", 5)
        self.assertIn(f"step 6: {NAME}", output)
        self.assertIn("point data array 'µ' has a character in its name that VTK would write wrongly", output)

    def test_no_answer_in_time(self):
        output = self.failure("hang", 5, "run.command_time_limit=20")
        self.assertIn("it gave no answer within 20 s (run.command_time_limit) and was killed", output)

    def test_dead_from_the_start(self):
        code, output = self.tanktread(*self.arguments("out", *steps(4), "membrane.command=" + command("sh", "-c", "exit 9")))
        self.assertEqual(code, 3, output)
        self.assertIn("step 1: the program of the membrane of capsule 0, sh -c exit 9: it ended with exit code 9", output)
        self.assertIn("checkpoints/step_0000000000", output)

    def test_forces_too_strong_stop_the_run_as_ever(self):
        self.assertIn("would move by", self.failure("strong", 5, "flow.speed_limit=1000"))

    def test_what_cannot_be_started_is_bad_input_and_writes_nothing(self):
        broken = self.folder / "broken"
        broken.write_text("neither a program nor a script")
        broken.chmod(0o755)
        for program, words in (("no-such-program", "there is no program 'no-such-program'"), ("broken", f"{broken}, cannot be started")):
            with self.subTest(program=program):
                code, output = self.tanktread(*self.arguments("out", "membrane.command=" + command(program)))
                self.assertEqual(code, 2, output)
                self.assertIn(words, output)
                self.assertFalse((self.folder / "out").exists())

    def test_a_run_that_failed_goes_on_when_the_program_is_repaired(self):
        # The program's name stays, what it does is another.
        program = self.folder / "mine.py"
        key = "membrane.command=" + command("/usr/bin/python3", "mine.py")
        source = PROGRAM.read_text()
        program.write_text(source)
        self.run_case("whole", *steps(10), key)
        program.write_text(source.replace('("good", 0)', '("nan", 5)'))
        code, output = self.tanktread(*self.arguments("out", *steps(10), key))
        self.assertEqual(code, 3, output)
        program.write_text(source)
        code, output = self.tanktread("run", "--resume", "out")
        self.assertEqual(code, 0, output)
        self.assert_same_results("whole", "out")


if __name__ == "__main__":
    OutsideTest.program = sys.argv.pop(1)
    unittest.main()
