"""How commands end on files that are damaged, missing or of another kind: by a message and code 2, never by a traceback."""

import contextlib
import io
import shutil
import subprocess
import sys
import unittest

from post_fixture import ROOT, InFolder, write_pictures, write_run

from tanktread_post import __main__, exit_codes
from tanktread_post.observables import InputError

VALUE = 'title = "made for a test"\nread_at = [1.0]\n[[value]]\nname = "deformation"\nshear_time = 1.0\nreference = 0.4\n'
PVD = '<VTKFile type="Collection"><Collection>{}</Collection></VTKFile>'
# Files of a run and its case, and what may be wrong with them.
DAMAGES = {
    "out/observables.csv": ["", "\0", "a,b\n1,2\n", "step,shear_time,deformation,capsule\n", "step,shear_time,deformation,capsule\n1,x,3,0\n", "step,shear_time,deformation,capsule\n1,2,3,one\n"],
    "out/echo.toml": ["", "[flow", "flow = 1\n", "[flow]\nbox = [1]\n", "[run]\nshear_time = 'long'\n", "[[capsule]]\nradius = 1\n", "capsule = []\n"],
    "out/parameters.toml": ["", "commit"],
    "out/membrane.pvd": ["", "<a", PVD.format("<DataSet/>"), PVD.format('<DataSet timestep="late" file="a"/>'), PVD.format('<DataSet timestep="3" file="gone.vtu"/>')],
    "out/membrane/membrane_1.vtu": ["", "<VTKFile", "<VTKFile></VTKFile>"],
    "case/compare.toml": [
        "", "title", "title = 3\n", VALUE + 'band = "wide"\n', VALUE + "band = -1\n", VALUE.replace("reference = 0.4", 'reference = "a"'), VALUE.replace("reference = 0.4", "reference = true"),
        VALUE.replace("reference = 0.4", 'reference = { file = "gone.csv", where = {}, column = "a" }'), VALUE.replace("reference = 0.4", "reference = { }"),
        VALUE.replace("reference = 0.4", 'reference = { file = "words.csv", where = { a = 1 }, column = "b" }'),
        VALUE.replace("reference = 0.4", 'reference = { file = "words.csv", where = { a = 1 }, column = "c" }'),
        VALUE.replace("shear_time = 1.0", 'shear_time = "1"'), VALUE.replace("shear_time = 1.0", "mean_over = [2]"), VALUE.replace('"deformation"', "1"), VALUE.replace('"deformation"', '"none"'),
        VALUE.replace("[1.0]", '["1"]'), VALUE.replace("[[value]]", "[value]"), "value = 3\n" + VALUE.split("[[")[0], VALUE + '[[picture]]\nfile = "a"\nname = "deformation"\nruns = "a"\n',
        VALUE + '[[snapshot]]\nrun = 1\nshear_time = 1\nlabel = ""\n',
    ],
    "case/study.toml": ["", "table = 1\n", "[[table]]\n", '[[plot]]\nfile = "a.png"\ntable = "words.csv"\nx = "a"\ny = "b"\n', '[[plot]]\nfile = "a.png"\ntable = "words.csv"\nx = "a"\ny = "a"\nlines = ["z"]\n'],
    "case/analyse.py": ["", "1 +", "import nothing_of_this_name\n", "def tables(output, case):\n    return 1\ndef pictures(output, case):\n    return open('/none/of/this/name')\n"],
}  # fmt: skip


class Ending(InFolder):
    def ended(self, call):
        """(code, what stands on the error stream)"""
        stream = io.StringIO()
        with contextlib.redirect_stderr(stream), contextlib.redirect_stdout(io.StringIO()):
            code = exit_codes.ended("the program", call)
        return code, stream.getvalue()

    def thrown(self, error):
        def throw():
            raise error

        return self.ended(throw)

    def test_codes(self):
        self.assertEqual(self.ended(lambda: 1), (1, ""))
        self.assertEqual(self.thrown(InputError("a.csv: it is bad")), (2, "the program: error: a.csv: it is bad\n"))
        self.assertEqual(self.thrown(OSError(28, "No space left on device", "a.png")), (2, "the program: error: a.png: No space left on device\n"))
        code, said = self.thrown(KeyError("a"))
        self.assertEqual(code, 3)
        self.assertIn("KeyError: 'a'", said)
        self.assertIn("the program: error: this is a fault of tanktread_post", said)

    def test_a_reader_that_went_away(self):
        call = "from tanktread_post import exit_codes; import sys; sys.exit(exit_codes.ended('a', lambda: [print('b' * 99) for _ in range(9999)] and 0))"
        child = subprocess.Popen([sys.executable, "-c", call], stdout=subprocess.PIPE, stderr=subprocess.PIPE, env={"PYTHONPATH": str(ROOT / "post")})
        child.stdout.close()
        self.assertEqual((child.wait(timeout=60), child.stderr.read()), (141, b""))
        child.stderr.close()

    def write(self):
        out, case = self.folder / "out", self.folder / "case"
        for folder in (out, case):
            shutil.rmtree(folder, ignore_errors=True)
        write_run(out, deformation=0.4)
        write_pictures(out)
        case.mkdir()
        (case / "compare.toml").write_text(VALUE)
        (out / "words.csv").write_text("a,b\n1,many\n")
        (case / "words.csv").write_text("a,b\n1,many\n")

    def test_damaged_files(self):
        out, case = (str(self.folder / name) for name in ("out", "case"))
        commands = (
            ["plot", out, "--case", case], ["compare", out, "--case", case], ["finished", out], ["render", out], ["snapshots", out, "--case", case],
            ["measure", out, "--case", case, "--at", "1", "--made-by", "a test"], ["convert-series", out, str(self.folder / "series.xdmf"), "--force"],
        )  # fmt: skip
        for name, contents in DAMAGES.items():
            for content in contents:
                refused = 0
                for command in commands if name.startswith(("case", "out/observables")) else commands[1:]:  # the first one is slow
                    with self.subTest(name, content=content, command=command[0]):
                        self.write()
                        (self.folder / name).write_text(content)
                        arguments = __main__.build_parser().parse_args(command)
                        code, said = self.ended(lambda: arguments.call(arguments))
                        self.assertIn(code, (0, 1, 2) if command[0] == "finished" else (0, 2), said)
                        self.assertEqual("tanktread_post" in said or "Traceback" in said, False, said)
                        refused += code == 2
                self.assertGreater(refused, 0, f"{name} with {content!r} is refused by no command")

    def test_missing_files(self):
        self.write()
        for command in (["plot"], ["compare", "--case", "none"], ["finished"], ["render"], ["snapshots", "--case", "none"], ["keep", "--case", "none", "--made-by", ""], ["measure", "--case", "none", "--at", "1", "--made-by", ""], ["convert-series"]):
            arguments = __main__.build_parser().parse_args([command[0], "none", *command[1:], *(["a.xdmf"] if command == ["convert-series"] else [])])
            code, said = self.ended(lambda: arguments.call(arguments))
            self.assertEqual((code, "none" in said or command == ["finished"]), (1 if command == ["finished"] else 2, True), said)
            # Nothing that a user could go on with, or make, is there.
            self.assertNotIn("go on with", said)
            self.assertNotIn("make it first", said)

    def test_words_that_are_no_numbers(self):
        for command in (["measure", "out", "--case", "a", "--made-by", "b", "--at"], ["render", "out", "--shear-time"], ["convert-surface", "a.stl", "a.vtu", "--scale"]):
            for word in ("nan", "inf", "1_0", "1,5", "half"):
                said = io.StringIO()
                with contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as ended:
                    __main__.build_parser().parse_args([*command, word])
                self.assertEqual(ended.exception.code, 2)
                self.assertIn(f"'{word}' is no number; write one as 0.5", said.getvalue())


if __name__ == "__main__":
    unittest.main()
