"""A small case for the tests of programs in the place of components, and runs of it."""

import pathlib
import re
import subprocess

from post_fixture import ROOT, InFolder

HERE = pathlib.Path(__file__).resolve().parent

# 600 steps a shear time.
CASE = """title = "Small capsule"
[flow]
box = [24, 24, 24]
wall_speed = 0.02
start = "developed"
[[capsule]]
radius = 5.0
position = [12.0, 12.0, 12.0]
mesh = { level = 2 }
[membrane]
elastic_law = "neo-hookean"
capillary_number = 0.3
[run]
threads = 1
"""
STEP = 1 / 600  # shear times


def steps(n_steps):
    """The keys of a run of so many steps that writes all it has every second step."""
    every = repr(2 * STEP)
    keys = ["run.checkpoint_every", "output.observables_every", "output.membrane_every", "output.fluid_every"]
    return [f"run.shear_time={n_steps * STEP!r}", *(f"{key}={every}" for key in keys)]


class OutsideTest(InFolder):
    """Runs of the small case in a folder of the test's own; the subclass's module sets `program`."""

    program = None  # tanktread

    def setUp(self):
        super().setUp()
        (self.folder / "case.toml").write_text(CASE)

    def tanktread(self, *arguments, timeout=300):
        """Exit code, standard output and error together."""
        ended = subprocess.run(
            [self.program, *map(str, arguments)], cwd=self.folder, text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, timeout=timeout
        )  # fmt: skip
        return ended.returncode, ended.stdout

    def arguments(self, name, *keys, case=None):
        """The command line of a run of the small case into the folder `name`."""
        sets = [word for key in keys for word in ("--set", key)]
        return ["run", case or self.folder / "case.toml", "--output", self.folder / name, *sets]

    def run_case(self, name, *keys, case=None, more=()):
        """A run that must go well; what it printed."""
        code, output = self.tanktread(*self.arguments(name, *keys, case=case), *more)
        self.assertEqual(code, 0, output)
        return output

    def results(self, name):
        """The bytes of all files that a run wrote, its checkpoints among them, but not what it was told."""
        folder = self.folder / name
        files = sorted(path for path in folder.rglob("*") if path.is_file() and path.name not in (".lock", "echo.toml"))
        return {str(path.relative_to(folder)): path.read_bytes() for path in files}

    def assert_same_results(self, first, second):
        """Two runs wrote the same files, bit for bit."""
        a, b = self.results(first), self.results(second)
        self.assertEqual(list(a), list(b))
        for name in a:
            self.assertTrue(a[name] == b[name], f"{name} differs")

    def membrane_file(self, name, step):
        """A membrane file of a run, read."""
        import meshio

        return meshio.read(self.folder / name / f"membrane/membrane_{step:010d}.vtu")

    def kill_and_resume(self, name, step, *keys):
        """A run that is killed when the checkpoint of that step is there, and goes on; the killed process's exit code."""
        process = subprocess.Popen([self.program, *map(str, self.arguments(name, *keys))], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        while process.poll() is None and not (self.folder / name / f"checkpoints/step_{step:010d}").exists():
            pass
        process.kill()
        code = process.wait()
        went_on, output = self.tanktread("run", "--resume", self.folder / name)
        self.assertEqual(went_on, 0, output)
        self.assertIn("resuming from", output)
        return code


def command(*words):
    """The value of a `command` key."""
    return "[" + ", ".join('"' + str(word) + '"' for word in words) + "]"


def packet_folder(output):
    """Where a program said that its packets were."""
    return pathlib.Path(re.search(r"packets are in (.*)", output).group(1))


__all__ = ["CASE", "HERE", "ROOT", "STEP", "OutsideTest", "command", "packet_folder", "steps"]
