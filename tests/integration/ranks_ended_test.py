"""How a run on several ranks ends: bad input, a breakdown, a signal, a rank that dies. Usage: ranks_ended_test.py TANKTREAD MPIRUN [unittest arguments]."""

import os
import pathlib
import signal
import subprocess
import time

from ranks_fixture import CASE, ENVIRONMENT, PIECES, SECOND, OnRanks, main


class Ended(OnRanks):
    def test_bad_input_is_said_once_and_nothing_is_written(self):
        for arguments, word, ranks in (
            (("run", "nothere.toml"), "nothere.toml", 2),
            (("run", "case.toml", "--set", "flow.bocks=1"), "flow.box", 3),
            (("run", "case.toml", "--set", "run.ranks=[1,1,3]"), "mpirun -n 3", 2),
            (("run", "case.toml", "--set", "run.ranks=[1,2,1]"), "mpirun -n 2", 1),
            (("run", "case.toml"), "run.ranks: 9 parts along x", "9,1,1"),
            (("run", "case.toml", "--set", "run.ranks=[0,1,2]"), "1 at least along each axis", 2),
            (("run", "case.toml", "--set", "run.ranks=[1000000,1000000,1000000]"), "is for 1000000000000000000 ranks", 2),
            (("run", "case.toml", "--set", 'flow.command=["sh"]', "--set", "output.energy_every=0"), "start without mpirun", 2),
        ):
            with self.subTest(arguments, ranks=ranks):
                done = self.call(*arguments, "--output", "out", ranks=ranks)
                self.assertEqual(done.returncode, 2, done.stderr)
                self.assertEqual(done.stderr.count("tanktread: error:"), 1, done.stderr)
                self.assertIn(word, done.stderr)
                self.assertFalse((self.folder / "out").exists())

    def test_a_run_that_goes_wrong_says_what_one_rank_says(self):
        (self.folder / "case.toml").write_text(CASE + SECOND)
        long = ["run.shear_time=1", "run.checkpoint_every=9", "output.energy_every=0"]
        for settings, word in (
            (["flow.speed_limit=0.0185", "flow.start=developed"], "fluid velocity at node ("),
            (["flow.speed_limit=0.57", "membrane.capillary_number=0.0005"], "of capsule 1"),
            (["capsule.0.load.force=60", "capsule.0.load.direction=[0,0,1]", "capsule.0.load.patch=0.2"], "from the wall at z = 0"),
            (["membrane.elastic_law=interfacial-tension", "membrane.capillary_modulus=gamma", "membrane.capillary_number=1",
              "flow.wall_speed=0.08", "run.shear_time=40", "output.observables_every=5", "output.measures_every=0"], "capsule 0: membrane element"),
            (["membrane.viscous.boussinesq_shear=50", "membrane.viscous.scheme=implicit", "coupler.implicit_tolerance=1e-13",
              "coupler.implicit_iterations=2"], "implicit viscous forces were not found"),
        ):
            messages = []
            for ranks in (1, 2, "2,1,3") if "fluid" in word else (1, 3):
                assignments = [part for setting in long + settings for part in ("--set", setting)]
                done = self.call("run", "case.toml", "--output", "out", "--force", *assignments, ranks=ranks)
                self.assertEqual(done.returncode, 3, done.stderr)
                lines = [line for line in done.stderr.splitlines() if line.startswith("tanktread: error:")]
                self.assertEqual(len(lines), 1, done.stderr)
                messages.append(lines[0])
            with self.subTest(word):
                self.assertIn(word, messages[0])
                self.assertEqual(messages[1:], messages[:1] * (len(messages) - 1))

    def test_a_piece_that_cannot_be_read_is_named(self):
        (self.folder / "case.toml").write_text(CASE + SECOND)
        self.run_well("run", "case.toml", "--output", "out", *PIECES, ranks=3)
        last = sorted((self.folder / "out/checkpoints").glob("step_*"))[-1]
        for name, other, of_other in (("fluid/1.vti", "fluid/2.vti", "do not belong together"), ("membrane/1.vtu", "membrane/0.vtu", "must be there once")):
            piece = last / name
            content = piece.read_bytes()
            middle = len(content) // 2
            changed = content[:middle] + bytes([content[middle] ^ 1]) + content[middle + 1 :]
            for spoil, word in (
                (lambda: piece.write_bytes(changed), "their hash is not the file's"),
                (lambda: piece.write_bytes((last / other).read_bytes()), of_other),
                (piece.unlink, "no such file, a piece of"),
            ):
                spoil()
                for ranks in (1, 2, 3):  # of two ranks both read the piece, of three one
                    with self.subTest(name, word=word, ranks=ranks):
                        before = sorted((self.folder / "out").rglob("*"))
                        done = self.call("run", "--resume", "out", "--shear-time", "0.1", ranks=ranks)
                        self.assertEqual(done.returncode, 2, done.stderr)
                        self.assertEqual(done.stderr.count("tanktread: error:"), 1, done.stderr)
                        if word != of_other or ranks > 1 or name.startswith("fluid"):
                            self.assertIn(word, done.stderr)
                        self.assertIn(name if word != of_other or name.startswith("fluid") else "membrane.pvtu", done.stderr)
                        self.assertIn("--from-step 18", done.stderr)
                        self.assertEqual(sorted((self.folder / "out").rglob("*")), before)
            piece.write_bytes(content)
        (last / "membrane/1.vtu").unlink()
        self.run_well("run", "--resume", "out", "--from-step", "18", ranks=2)

    def test_a_piece_that_one_rank_cannot_write_ends_all(self):
        """The files of the second rank have no room for more than 4 kB, those of the others have."""
        self.needs_open_mpi("MPICH cannot begin so: it has its shared memory in files")
        (self.folder / "case.toml").write_text(CASE + SECOND)
        shell = 'if [ "${OMPI_COMM_WORLD_RANK:-$PMI_RANK}" = 1 ]; then trap "" XFSZ; ulimit -f 8; fi; exec "$@"'
        for settings, piece in ((PIECES[:2], "fluid_0000000000/1.vti"), (PIECES[2:], "membrane_0000000000/1.vtu")):
            command = [self.mpirun, "-n", "3", "sh", "-c", shell, "sh", self.program, "run", "case.toml", "--output", "out", "--force", *settings]
            done = subprocess.run(command, cwd=self.folder, env=ENVIRONMENT, capture_output=True, text=True, timeout=120)
            with self.subTest(piece):
                self.assertEqual(done.returncode, 3, done.stdout + done.stderr)
                self.assertEqual(done.stderr.count("tanktread: error:"), 1, done.stderr)
                self.assertIn(piece, done.stderr)
                self.assertIn("File too large", done.stderr)
                self.assertEqual([path for path in (self.folder / "out").rglob("*") if path.suffix in (".pvti", ".pvtu")], [])

    def test_a_signal_to_the_first_rank_ends_the_run_with_a_checkpoint(self):
        child = self.started(2)
        os.kill(self.ranks_of(child)[0], signal.SIGTERM)
        child.communicate(timeout=60)
        self.assertEqual(child.returncode, 143)
        self.assertEqual(self.ranks_of(child), [])
        self.assertIn("stopped by a signal", (self.folder / "log").read_text())

    def test_threads_that_share_a_processor_are_told_of(self):
        self.needs_open_mpi("binds by an environment variable of Open MPI")
        for policy, threads, warned in (("core", "2", True), ("core", "1", False), ("none", "1", False)):
            environment = ENVIRONMENT | {"OMPI_MCA_hwloc_base_binding_policy": policy, "OMP_NUM_THREADS": threads}
            done = subprocess.run(
                [self.mpirun, "-n", "2", "--bind-to", policy, self.program, "run", "case.toml", "--output", "out", "--force",
                 "--shear-time", "0.01"],
                cwd=self.folder, env=environment, capture_output=True, text=True, timeout=120)
            with self.subTest(policy, threads=threads):
                self.assertEqual(done.returncode, 0, done.stderr)
                self.assertEqual("warning: the 2 threads of a rank have one processor to run on" in done.stdout, warned, done.stdout)

    def test_commands_of_the_first_rank_alone(self):
        """Under mpirun other commands are done once; a record is that of one rank; plan asks for no number of ranks."""
        self.run_well("plan", "case.toml", "--set", "run.ranks=[1,1,3]")
        self.assertEqual(self.run_well("mesh", "sphere", "--level", "1", "--radius", "4", "sphere.vtu", ranks=2).count("sphere.vtu"), 1)
        for name, ranks in (("one", 1), ("two", 4)):
            self.run_well("run", "case.toml", "--output", f"out-{name}", "--record", f"record-{name}", "--from", "3", "--to", "5", *PIECES, ranks=ranks)
        self.assert_in_pieces("out-two/fluid", False)  # the first rank gathers it
        self.assert_same("out-one", "out-two")
        done = subprocess.run([self.program, "diff", "record-one", "record-two"], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.run_well("replay", "record-two", "--only", "fluid", ranks=4)

    def started(self, ranks):
        """mpirun with a long run that has written its first checkpoint."""
        log = (self.folder / "log").open("w")
        self.addCleanup(log.close)
        child = subprocess.Popen(
            [self.mpirun, "-n", str(ranks), self.program, "run", "case.toml", "--output", "out", "--shear-time", "50",
             "--set", "run.checkpoint_every=0.01"],
            cwd=self.folder, env=ENVIRONMENT, stdout=log, stderr=subprocess.PIPE, text=True)
        deadline = time.monotonic() + 60
        while len(list((self.folder / "out/checkpoints").glob("step_*"))) < 2:
            self.assertIsNone(child.poll(), "it ended by itself")
            self.assertLess(time.monotonic(), deadline, "no checkpoint came")
            time.sleep(0.05)
        return child

    def ranks_of(self, child):
        """Processes of the program that mpirun has started."""
        name = pathlib.Path(self.program).name
        found = subprocess.run(["ps", "-eo", "pid=,ppid=,comm="], capture_output=True, text=True).stdout
        rows = [line.split(None, 2) for line in found.splitlines()]
        below, grown = {child.pid}, True
        while grown:
            more = {int(pid) for pid, parent, _ in rows if int(parent) in below} - below
            grown = bool(more)
            below |= more
        return sorted(int(pid) for pid, _, comm in rows if int(pid) in below and comm.startswith(name[:15]))

    def test_a_rank_that_dies_ends_all_and_the_run_goes_on(self):
        child = self.started(3)
        ranks = self.ranks_of(child)
        self.assertEqual(len(ranks), 3)
        os.kill(ranks[-1], signal.SIGKILL)
        child.communicate(timeout=60)
        self.assertNotEqual(child.returncode, 0)
        self.assertEqual(self.ranks_of(child), [])
        step = max(int(path.name[5:]) for path in (self.folder / "out/checkpoints").glob("step_*"))
        end = (step + 60) * 2 * 0.02 / 18  # the shear rate is 2 U0/L
        self.run_well("run", "--resume", "out", "--shear-time", end, ranks=2)
        self.run_well("run", "case.toml", "--output", "whole", "--shear-time", end, "--set", "run.checkpoint_every=0.01")
        self.assert_same("whole", "out")


if __name__ == "__main__":
    main()
