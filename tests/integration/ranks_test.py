"""Runs on several ranks are the run on one, bit for bit. Usage: ranks_test.py TANKTREAD MPIRUN [unittest arguments]."""

import re

from ranks_fixture import CASE, PIECES, SECOND, OnRanks, main
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPImageDataReader

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


def grid(reader, file):
    """Extent, and arrays [z, y, x, component] by name."""
    reader.SetFileName(str(file))
    reader.Update()
    data = reader.GetOutput()
    extent, points = data.GetExtent(), data.GetPointData()
    shape = [extent[2 * axis + 1] - extent[2 * axis] + 1 for axis in (2, 1, 0)]
    return extent, {
        points.GetArrayName(k): vtk_to_numpy(points.GetArray(k)).reshape(*shape, -1) for k in range(points.GetNumberOfArrays())}


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


if __name__ == "__main__":
    main()
