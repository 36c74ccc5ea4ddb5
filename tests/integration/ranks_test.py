"""Runs on several ranks are the run on one, bit for bit. Usage: ranks_test.py TANKTREAD MPIRUN [unittest arguments]."""

import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

from post_fixture import ROOT, InFolder
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPImageDataReader

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

PERIODIC = CASE.replace('"shear"', '"periodic"').replace("wall_speed = 0.02", "shear_rate = 2e-3")

# What is in a run, and the ranks that share it: cuts along z, y, x and all; with a part of few nodes.
RUNS = {
    "a capsule over a cut, walls": ([], CASE, [2, 3]),
    "over an edge and a corner of the cuts": (["flow.wall_axis=y", "flow.flow_axis=z"], CASE, ["1,2,2", "2,2,2"]),
    "on a face, off the middle": (["capsule.0.position=[6.1,10.7,9.2]", "flow.inertia=false"], CASE, ["3,1,1", "1,1,4"]),
    "a viscosity contrast": (["flow.viscosity_ratio=5"], CASE, [3, "2,1,2"]),
    "an implicit viscosity": (
        ["membrane.viscous.boussinesq_shear=5", "membrane.viscous.scheme=implicit", "coupler.keep_volume=true"], CASE, [2, "2,2,1"]),
    "several, round a periodic box": (
        ["flow.body_force=[1e-6,0,0]"], PERIODIC + SECOND, [4]),
    "across the cuts, with other owners on the way": (
        ["flow.wall_speed=0.05", "flow.start=developed", "flow.viscosity_ratio=2", "capsule.0.position=[7,10,11]", "run.shear_time=3",
         "run.checkpoint_every=0.5", "output.membrane_every=1", "output.fluid_every=3", "output.energy_every=1"],
        CASE, ["3,1,1"]),
    "of two viscosities, implicit, several": (
        ["membrane.viscous.boussinesq_shear=5", "membrane.viscous.scheme=implicit", "flow.viscosity_ratio=3", "run.shear_time=0.02"],
        PERIODIC + SECOND, [3]),
    "away from a rank, which is then without any, and back": (
        ["flow.box=[40,12,12]", "capsule.0.radius=3", "capsule.0.position=[4,6,6]", "flow.body_force=[1e-3,0,0]", "flow.shear_rate=1e-2",
         "run.shear_time=2.5", "run.checkpoint_every=5", "output.membrane_every=1", "output.fluid_every=2", "output.energy_every=1"],
        PERIODIC, ["4,1,1"]),
    "another kernel with its correction": (
        ["coupler.kernel=peskin4", "coupler.tangential_correction=true", "flow.viscosity_ratio=3"], CASE + SECOND, [3, "2,1,2"]),
    "in single precision": (["flow.storage=single", "flow.viscosity_ratio=0.5"], CASE + SECOND, [2, "1,3,1"]),
    "a slice of the fluid, to the first nodes of a part": (["output.fluid_box=[[0,12],[3,3],[5,12]]"], CASE, ["1,1,9", "2,2,1"]),
    "what one capsule alone has, and shapes from files": (
        ["capsule.1.load.force=0.5", "capsule.1.load.direction=[1,0,0]", "capsule.0.membrane.bending_modulus=0.02", "capsule.1.stress_free.shape=spheroid", "capsule.1.stress_free.aspect_ratio=0.9"],
        CASE.replace('shape = "sphere", level = 1', 'file = "sphere.vtu"') + SECOND, [3]),
    "a red cell": (
        ["capsule.0.mesh.shape=biconcave", "membrane.bending_modulus=0.02", "membrane.global_area_modulus=1",
         "membrane.volume_modulus=1"], CASE, [2]),
}

# Of these the runs on several ranks write in pieces, the run on one in one file: of the membranes, a capsule a piece.
IN_PIECES = {
    "what one capsule alone has, and shapes from files",
    "over an edge and a corner of the cuts", "a viscosity contrast", "several, round a periodic box",
    "across the cuts, with other owners on the way", "in single precision", "a slice of the fluid, to the first nodes of a part",
}
PIECES = ["--set", "output.whole_file_nodes=100", "--set", "output.whole_file_triangles=80"]


def grid(reader, file):
    """Extent, and arrays [z, y, x, component] by name."""
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    extent, points = data.GetExtent(), data.GetPointData()
    shape = [extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in (2, 1, 0)]
    return extent, {
        points.GetArrayName(k): vtk_to_numpy(points.GetArray(k)).reshape(*shape, -1) for k in range(points.GetNumberOfArrays())}


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


class Equal(OnRanks):
    def test_runs_of_every_kind(self):
        self.run_well("mesh", "sphere", "--level", "1", "--radius", "4", "sphere.vtu")
        for name, (changes, case, shares) in RUNS.items():
            (self.folder / "case.toml").write_text(case)
            settings = [word for change in changes for word in ("--set", change)]
            self.run_well("run", "case.toml", "--force", "--output", "one", *settings)
            for ranks in shares:
                with self.subTest(name, ranks=ranks):
                    pieces = PIECES if name in IN_PIECES else []
                    said = self.run_well("run", "case.toml", "--force", "--output", "many", *settings, *pieces, ranks=ranks)
                    self.assertIn("ranks (", said)
                    for kind in ("fluid", "membrane"):
                        for place in (kind, "checkpoints/step_*"):
                            self.assert_in_pieces(f"many/{place}", bool(pieces) and (kind == "fluid" or SECOND in case), kind)
                    self.assert_same("one", "many")

    def test_a_checkpoint_of_some_ranks_goes_on_with_others(self):
        settings = ["--set", "flow.viscosity_ratio=3"]
        self.run_well("run", "case.toml", "--output", "whole", *settings)
        self.run_well("run", "case.toml", "--output", "parts", *settings, "--shear-time", "0.02", ranks=3)
        self.run_well("run", "--resume", "parts", "--shear-time", "0.04", ranks=2)
        self.run_well("run", "--resume", "parts", "--shear-time", "0.06")
        self.assert_same("whole", "parts")

    def test_a_checkpoint_of_one_goes_on_with_several(self):
        self.run_well("run", "case.toml", "--output", "whole")
        self.run_well("run", "case.toml", "--output", "parts", "--shear-time", "0.03")
        self.run_well("run", "--resume", "parts", "--shear-time", "0.06", ranks=4)
        self.assert_same("whole", "parts")

    def test_in_pieces_a_run_goes_on_with_other_ranks(self):
        """Of some ranks with others, and from one file to pieces and back."""
        (self.folder / "case.toml").write_text(CASE + SECOND)
        settings = ["--set", "flow.viscosity_ratio=3"]
        self.run_well("run", "case.toml", "--output", "whole", *settings)
        self.run_well("run", "case.toml", "--output", "parts", *settings, *PIECES, "--shear-time", "0.02", ranks=3)
        self.run_well("run", "--resume", "parts", "--shear-time", "0.03", ranks=2)
        self.assert_in_pieces("parts/checkpoints/step_*", True)
        self.run_well("run", "--resume", "parts", "--shear-time", "0.04")
        self.assert_in_pieces("parts/checkpoints/step_*", True)
        self.run_well("run", "--resume", "parts", "--shear-time", "0.06", ranks=4)
        self.assert_same("whole", "parts")
        for run, pieces in (("parts", True), ("whole", False)):
            self.run_well("run", "case.toml", "--force", "--output", run, *settings, *(PIECES if pieces else []), "--shear-time", "0.02", ranks=3)
            echo = self.folder / run / "echo.toml"
            echo.write_text(re.sub(r"(?m)^(whole_file_nodes|whole_file_triangles) = .*$", r"\1 = " + ("4194304" if pieces else "100"), echo.read_text()))
            self.run_well("run", "--resume", run, "--shear-time", "0.06", ranks=2)
            for kind in ("fluid", "membrane"):
                self.assert_in_pieces(f"{run}/checkpoints/step_*27", not pieces, kind)
        self.assert_same("whole", "parts")

    def test_each_piece_has_the_numbers_of_the_whole(self):
        """In the layers too that it shares with its neighbours, which putting the pieces together does not look at."""
        settings = ["--set", "flow.viscosity_ratio=3", "--set", "capsule.0.position=[12,10,9.3]"]
        self.run_well("run", "case.toml", "--output", "whole", *settings)
        self.run_well("run", "case.toml", "--output", "parts", *settings, *PIECES, ranks="2,2,2")
        for index in ("fluid/fluid_0000000000", "fluid/fluid_0000000027", "checkpoints/step_0000000027/fluid"):
            _, whole = grid(vtkXMLImageDataReader(), self.folder / f"whole/{index}.vti")
            _, together = grid(vtkXMLPImageDataReader(), self.folder / f"parts/{index}.pvti")
            self.assertEqual(set(whole), set(together))
            for name in whole:
                self.assertEqual(whole[name].tobytes(), together[name].tobytes(), name)
            pieces = sorted((self.folder / "parts" / index).iterdir())
            self.assertEqual(len(pieces), 8)
            for piece in pieces:
                (x0, x1, y0, y1, z0, z1), arrays = grid(vtkXMLImageDataReader(), piece)
                for name, values in arrays.items():
                    self.assertEqual(values.tobytes(), whole[name][z0 : z1 + 1, y0 : y1 + 1, x0 : x1 + 1].tobytes(), (piece, name))

    def test_pieces_of_membranes_do_not_depend_on_ranks(self):
        """Five capsules, two a piece: the same files to the last byte, whoever writes them, and of a state too."""
        more = SECOND + "".join(SECOND.replace("[5, 15, 6.4]", at) for at in ("[18, 4, 6.5]", "[18, 15, 11.5]", "[5, 5, 11.5]"))
        (self.folder / "case.toml").write_text(CASE + more)
        settings = ["--shear-time", "0.02", "--set", "output.whole_file_triangles=160"]
        for name, ranks in (("one", 1), ("two", 2), ("six", 6)):
            self.run_well("run", "case.toml", "--output", name, *settings, ranks=ranks)
        for place, n_steps in (("membrane/membrane_*", 2), ("checkpoints/step_*/membrane", 2)):
            found = {name: {path.relative_to(self.folder / name): path.read_bytes() for path in (self.folder / name).glob(place + "/*.vtu")}
                     for name in ("one", "two", "six")}
            self.assertEqual(len(found["one"]), 3 * n_steps)
            self.assertEqual(found["two"], found["one"])
            self.assertEqual(found["six"], found["one"])
        self.run_well("run", "--resume", "one", "--shear-time", "0.04", ranks=4)
        self.run_well("run", "--resume", "six", "--shear-time", "0.04")
        self.assert_same("one", "six")

    def test_pieces_of_later_files_go(self):
        """A run that goes on from an earlier checkpoint leaves no piece of what comes after it, and none that lacks its index."""
        self.run_well("run", "case.toml", "--output", "whole")
        self.run_well("run", "case.toml", "--output", "parts", *PIECES, ranks=3)
        (self.folder / "parts/fluid/fluid_0000000010").mkdir()
        (self.folder / "parts/fluid/fluid_0000000027.pvti").rename(self.folder / "parts/fluid/.fluid_0000000027.pvti.1-0.tmp")
        self.run_well("run", "--resume", "parts", "--from-step", "18", "--shear-time", "0.046", ranks=2)
        steps = ("fluid_0000000000", "fluid_0000000014", "fluid_0000000021")
        self.assertEqual(
            sorted(path.name for path in (self.folder / "parts/fluid").iterdir()), sorted([*steps, *(f"{step}.pvti" for step in steps)]))
        self.assertEqual(len(list((self.folder / "parts/fluid/fluid_0000000021").iterdir())), 2)
        self.run_well("run", "--resume", "parts", "--shear-time", "0.06", ranks=3)
        self.assert_same("whole", "parts")

    def test_checkpoints_by_the_clock_change_nothing(self):
        """The last two are kept: with next to no time between them, of the last two steps."""
        self.run_well("run", "case.toml", "--output", "one")
        self.run_well("run", "case.toml", "--output", "two", "--set", "run.checkpoint_every=1000", "--set", "run.checkpoint_minutes=1e-9", ranks=2)
        steps = sorted(int(path.name[5:]) for path in (self.folder / "two/checkpoints").glob("step_*"))
        self.assertEqual(steps, [26, 27])
        self.assertEqual((self.folder / "one/energy.csv").read_bytes(), (self.folder / "two/energy.csv").read_bytes())
        self.assertEqual((self.folder / "one/observables.csv").read_bytes(), (self.folder / "two/observables.csv").read_bytes())


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
    OnRanks.program, OnRanks.mpirun = str(pathlib.Path(sys.argv[1]).resolve()), sys.argv[2]
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]])
