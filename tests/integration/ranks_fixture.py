"""A small case for the tests of several ranks, and runs of it."""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import unittest

from post_fixture import InFolder

# More ranks than processors, as root: what the two MPI of Debian want to be told.
ENVIRONMENT = os.environ | {
    "OMP_NUM_THREADS": "1",
    "OMPI_ALLOW_RUN_AS_ROOT": "1",
    "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
    "OMPI_MCA_rmaps_base_oversubscribe": "1",
    "OMPI_MCA_hwloc_base_binding_policy": "none",
    "OMPI_MCA_mpi_yield_when_idle": "1",
    "OMPI_MCA_odls_base_sigkill_timeout": "0",  # else mpirun waits a second or two after each error
}

CASE = """
[flow]
kind = "shear"
box = [24, 20, 18]
wall_speed = 0.02
relaxation_time = 0.9

[[capsule]]
radius = 4
position = [12, 10, 9]
mesh = { shape = "sphere", level = 1 }

[membrane]
elastic_law = "skalak"
capillary_number = 0.3

[run]
shear_time = 0.06
checkpoint_every = 0.02

[output]
observables_every = 0.01
measures_every = 0.02
energy_every = 0.03
membrane_every = 0.03
fluid_every = 0.03
"""

SECOND = '[[capsule]]\nradius = 3\nposition = [5, 15, 6.4]\nmesh = { shape = "sphere", level = 1 }\n'

PIECES = ["--set", "output.whole_file_nodes=100", "--set", "output.whole_file_triangles=80"]


class OnRanks(InFolder):
    program = mpirun = None

    def setUp(self):
        super().setUp()
        (self.folder / "case.toml").write_text(CASE)

    def call(self, *arguments, ranks=1, timeout=120):
        """The finished process. @param ranks a number, or parts along x, y, z as "1,2,2"."""
        command = [self.program, *map(str, arguments)]
        if ranks != 1:
            n = ranks
            if isinstance(ranks, str):
                x, y, z = map(int, ranks.split(","))
                n = x * y * z
                command += ["--set", f"run.ranks=[{ranks}]"]
            command = [self.mpirun, "-n", str(n), *command]
        return subprocess.run(command, cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=timeout)

    def needs_open_mpi(self, reason):
        library = subprocess.run([self.mpirun, "--version"], capture_output=True, text=True).stdout
        if not re.search("Open MPI|OpenRTE", library):
            self.skipTest(reason)

    def run_well(self, *arguments, ranks=1):
        done = self.call(*arguments, ranks=ranks)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def assert_in_pieces(self, folders, expected, kind="fluid"):
        """Whether the files of a kind in the folders of that pattern are pieces with an index, or whole."""
        found = [path for folder in self.folder.glob(folders) for path in folder.iterdir() if path.name.startswith(kind) and path.is_file()]
        self.assertTrue(found)
        whole = {"fluid": ".vti", "membrane": ".vtu"}[kind]
        self.assertEqual({path.suffix for path in found}, {".p" + whole[1:] if expected else whole})
        self.assertEqual(sorted(path.stem for path in found), sorted(
            path.name if path.is_dir() else path.stem for folder in self.folder.glob(folders) for path in folder.glob(f"{kind}*")
            if path.is_dir() == expected))

    def assert_same(self, first, second):
        for run in (first, second):  # an earlier checkpoint has the case of that time: another run.shear_time
            for folder in sorted((self.folder / run / "checkpoints").glob("step_*"))[:-1]:
                shutil.rmtree(folder)
            for echo in (self.folder / run).rglob("echo.toml"):  # which says how the box was cut by hand, and what is in pieces
                text = re.sub(r"(?m)^ranks = .*$", "ranks = [0, 0, 0]", echo.read_text())
                echo.write_text(re.sub(r"(?m)^(whole_file_nodes|whole_file_triangles) = .*$", r"\1 = 1", text))
        done = subprocess.run([self.program, "diff", first, second], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        for table in ("observables.csv", "measures.csv", "energy.csv"):
            self.assertEqual((self.folder / first / table).read_bytes(), (self.folder / second / table).read_bytes(), table)


def main():
    """The command line of these tests: TANKTREAD MPIRUN [unittest arguments]."""
    OnRanks.program, OnRanks.mpirun = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
