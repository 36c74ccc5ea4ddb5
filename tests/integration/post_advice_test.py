"""The advice that messages of post/ give, followed. Usage: post_advice_test.py TANKTREAD [unittest arguments]."""

import pathlib
import re
import subprocess
import sys
import unittest

import numpy
from post_fixture import ROOT, InFolder, octahedron
from surface_shapes import obj_text, soup

from tanktread_post import convert_surface, measured, run_folder
from tanktread_post.observables import InputError, Observables

SMALL = ["flow.box=[24,24,24]", "capsule.0.radius=5", "capsule.0.position=[12,12,12]", "capsule.0.mesh.level=1", "run.threads=1"]


class Advice(InFolder):
    def said(self, call, *arguments, **options):
        """The message of a refusal."""
        with self.assertRaises(InputError) as caught:
            call(*arguments, **options)
        return str(caught.exception)

    def shell(self, command):
        """A command as a user would copy it from a message."""
        ended = subprocess.run(["bash", "-c", f"tanktread() {{ {PROGRAM!r} \"$@\"; }}; {command}"], capture_output=True, text=True, cwd=self.folder)
        self.assertEqual(ended.returncode, 0, f"{command}: {ended.stderr}")

    def test_a_run_that_is_too_short_goes_on(self):
        output = self.folder / "a run's folder"
        settings = [f"--set={value}" for value in SMALL]
        case = ROOT / "cases/shear-capsule/case.toml"
        subprocess.run([PROGRAM, "run", case, "--output", output, "--shear-time", "0.02", *settings], check=True, capture_output=True)
        for wanted, form in ((0.03, "--resume"), (0.04, "--force")):
            message = self.said(Observables(output).at, "deformation", wanted)
            command = message[message.index("tanktread run") :]
            self.assertIn(form, command)
            self.shell(command)
            self.assertGreater(Observables(output).at("deformation", wanted), 0)
            for checkpoint in output.glob("checkpoints/step_*"):  # as cases/run does with a finished run
                checkpoint.rename(self.folder / checkpoint.name)
        echo = output / "echo.toml"
        echo.write_text(re.sub(r"(?m)^shear_time = .*", "shear_time = 0.05", echo.read_text()))  # as of a run that was interrupted
        self.assertFalse(run_folder.is_finished(output))
        message = self.said(measured.add, self.folder, output, "a", [0.01], "a command")
        self.shell(message[message.index("tanktread run") :])
        self.assertTrue(run_folder.is_finished(output))

    def convert(self, points, faces, **options):
        (self.folder / "in.obj").write_text(obj_text(points, faces))
        return convert_surface.convert(self.folder / "in.obj", self.folder / "out.vtu", **options)

    def test_seams_that_do_not_meet(self):
        points, faces = octahedron(0.0, 1.0)
        apart = soup(points, faces)[0] * 1.0
        apart[::2] += 1e-4
        triangles = numpy.arange(24).reshape(8, 3)
        self.assertIn("raise --merge-tolerance (1e-06)", self.said(self.convert, apart, triangles))
        self.assertIn("out.vtu: 6 nodes, 8 triangles", self.convert(apart, triangles, merge_tolerance=1e-3)[-1])

    def test_a_tolerance_that_leaves_nothing(self):
        points, faces = octahedron(0.0, 1.0)
        small = numpy.concatenate([points * 1e-3, [[1.0, 0.0, 0.0], [1.001, 0.0, 0.0], [1.0, 0.001, 0.0]]])
        everything = numpy.concatenate([faces, [[6, 7, 8]]])
        self.assertIn("lower --merge-tolerance", self.said(self.convert, small, everything, merge_tolerance=0.01))
        self.convert(small, everything, merge_tolerance=1e-6, body=0)
        self.assertIn("two corners at one place: it is no surface", self.said(self.convert, points * 0, faces, force=True))

    def test_a_sheet_that_hangs_on(self):
        points, faces = octahedron(0.0, 1.0)
        fin = numpy.concatenate([faces, [[0, 2, 6]]])
        self.assertIn("closed by itself: --body 0", self.said(self.convert, numpy.concatenate([points, [[2.0, 2.0, 0.0]]]), fin))
        self.convert(numpy.concatenate([points, [[2.0, 2.0, 0.0]]]), fin, body=0)
        # A wall between two halves: neither is closed without it, so no part is named.
        wall = numpy.concatenate([faces, [[0, 2, 3], [1, 3, 2]]])
        self.assertNotIn("--body", self.said(self.convert, points, wall))

    def test_several_bodies_and_a_file_that_is_there(self):
        points, faces = octahedron(0.0, 1.0)
        two = numpy.concatenate([points, points + 5]), numpy.concatenate([faces, faces + 6])
        self.assertIn("take it with --body K", self.said(self.convert, *two))
        for body in (0, 1):
            self.convert(*two, body=body, force=True)
        self.assertIn("--force to replace it", self.said(self.convert, points, faces))
        self.convert(points, faces, force=True)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
