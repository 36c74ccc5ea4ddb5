"""The program without MPI is that with it on one rank. Usage: without_mpi_test.py WITHOUT WITH [unittest arguments]."""

import pathlib
import subprocess
import sys
import unittest

from post_fixture import InFolder
from ranks_fixture import CASE, ENVIRONMENT


class WithoutMpi(InFolder):
    without = with_it = None  # the programs

    def call(self, program, *arguments, before=()):
        return subprocess.run(
            [*before, program, *arguments], cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=120)

    def test_runs_alike(self):
        (self.folder / "case.toml").write_text(CASE)
        for program, output in ((self.without, "without"), (self.with_it, "with")):
            done = self.call(program, "run", "case.toml", "--output", output)
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        done = self.call(self.with_it, "diff", "without", "with")
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)

    def test_refuses_to_be_several(self):
        """Each would take itself for the only one, and do all the work."""
        done = self.call(self.without, "--version", before=("mpirun", "-n", "2"))
        self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
        self.assertIn("TANKTREAD_MPI", done.stderr)


if __name__ == "__main__":
    WithoutMpi.without, WithoutMpi.with_it = (str(pathlib.Path(path).resolve()) for path in sys.argv[1:3])
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
