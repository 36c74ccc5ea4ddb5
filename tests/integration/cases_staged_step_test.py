"""The case staged-step: its script, as it stands. Usage: cases_staged_step_test.py TANKTREAD [unittest arguments]."""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "cases/staged-step/run.sh"


class StagedStep(unittest.TestCase):
    program = ""

    def test_ten_steps_through_files_are_the_run(self):
        path = f"{pathlib.Path(self.program).resolve().parent}:{os.environ['PATH']}"
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [SCRIPT, f"{folder}/output"], capture_output=True, text=True, env=os.environ | {"PATH": path}, check=False
            )
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertRegex(done.stdout.splitlines()[-1], r"^identical: 2 files, \d\d arrays")


if __name__ == "__main__":
    StagedStep.program = sys.argv.pop(1)
    unittest.main()
