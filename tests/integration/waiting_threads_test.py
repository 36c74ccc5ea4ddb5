"""Threads that wait for each other, on cores that are shared with other programs. Usage: waiting_threads_test.py TANKTREAD [unittest arguments].

A run that shares its cores has threads which sleep, so that libgomp takes it for one with more threads than cores, and spins shortly.
"""

import collections
import os
import pathlib
import shutil
import subprocess
import sys
import time
import unittest

from outside_fixture import OutsideTest, steps

CORES = len(os.sched_getaffinity(0))
LONG = 100_000_000  # steps: the run is ended
WORKING = 2  # threads


def setUpModule():
    """With LLVM's OpenMP nothing is done."""
    libraries = subprocess.run(["ldd", OutsideTest.program], capture_output=True, text=True, check=True).stdout
    if "libgomp" not in libraries:
        raise unittest.SkipTest("the program does not use libgomp")
    if not pathlib.Path("/proc/self/schedstat").exists():
        raise unittest.SkipTest("this system does not tell how long threads wait for a core")


class WaitingThreads(OutsideTest):
    def setUp(self):
        super().setUp()
        self.set(OMP_WAIT_POLICY=None, GOMP_SPINCOUNT=None)  # the tests themselves may run under one of them

    def set(self, **variables):
        """Sets or removes variables of the environment until the test is over."""
        for name, value in variables.items():
            before = os.environ.pop(name, None)
            if value is not None:
                os.environ[name] = value
            self.addCleanup(os.environ.pop, name, None)
            if before is not None:
                self.addCleanup(os.environ.__setitem__, name, before)

    def start(self, *words, **options):
        """A process that is killed at the end of the test."""
        process = subprocess.Popen([*map(str, words)], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, **options)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        return process

    def keep_all_cores_busy(self):
        """Two busy programs a core, so that ours gets a third whatever else runs."""
        for _ in range(2 * CORES):
            self.start("/usr/bin/python3", "-c", "while True: pass")

    def start_run(self):
        keys = [f"run.threads={WORKING}", f"run.shear_time={LONG / 600!r}"]
        return self.start(self.program, *self.arguments("out", *keys))

    def threads_of(self, run):
        """The names of a run's threads, how many of each."""
        names = [file.read_text().strip() for file in pathlib.Path(f"/proc/{run.pid}/task").glob("*/comm")]
        return collections.Counter(names)

    def wait_for(self, run, is_there, seconds):
        """Whether it is there, of the run's threads, within that time."""
        end = time.monotonic() + seconds
        while not is_there(self.threads_of(run)) and time.monotonic() < end:
            time.sleep(0.05)
        return is_there(self.threads_of(run))

    def test_a_run_that_shares_its_cores_has_threads_that_sleep(self):
        self.keep_all_cores_busy()
        run = self.start_run()
        self.assertTrue(self.wait_for(run, lambda threads: threads["sleeping"] == CORES, 60), self.threads_of(run))
        self.assertEqual(self.threads_of(run)["watching cores"], 1)

    def test_what_the_user_set_stays(self):
        self.keep_all_cores_busy()
        for variables in ({"OMP_WAIT_POLICY": "active"}, {"OMP_WAIT_POLICY": "passive"}, {"GOMP_SPINCOUNT": "7"}):
            with self.subTest(**variables):
                self.set(**variables)
                run = self.start_run()
                self.assertTrue(self.wait_for(run, lambda threads: threads.total() >= WORKING, 60))
                self.assertFalse(self.wait_for(run, lambda threads: threads.keys() > {"tanktread"}, 2), self.threads_of(run))
                run.kill()
                run.wait()
                self.set(**dict.fromkeys(variables))
                shutil.rmtree(self.folder / "out", ignore_errors=True)

    def test_results_are_the_same(self):
        self.keep_all_cores_busy()
        self.run_case("shared", *steps(200), "run.threads=2")
        self.set(OMP_WAIT_POLICY="passive")
        self.run_case("passive", *steps(200), "run.threads=2")
        self.assert_same_results("shared", "passive")


if __name__ == "__main__":
    OutsideTest.program = sys.argv.pop(1)
    unittest.main()
