"""Malformed inputs, one table: each ends with exit code 2, a message that names what is wrong, and nothing written.

Usage: malformed_inputs_test.py TANKTREAD [unittest arguments].
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

import malformed_cases
import malformed_commands
import malformed_files
import malformed_states
from malformed_rows import CASE

# What a user's message must not speak of: classes of libraries, addresses, lines of sources, C++'s own errors.
LOWER_LAYERS = re.compile(
    r"vtk[A-Z]|0x[0-9a-f]{4}|std::|CLI::|toml::|Eigen|terminate|what\(\)|bad_alloc|basic_string|vector::|stoul|stoi|filesystem error"
    r"|\.cpp\b|\.cxx\b|[Aa]ssert|Segmentation|Sanitizer|runtime error|convert = true|Traceback|TOML_|->[0-9]|[0-9]{100}"
)
LONGEST = 20  # seconds that a refusal may take before it is called a hang; it takes a fiftieth of one
LEAST_ROWS = 120


def tables():
    return {
        module.__name__: module.ROWS for module in (malformed_cases, malformed_commands, malformed_files, malformed_states)
    }  # fmt: skip


def contents(folder):
    """All that is in a folder: files with their bytes, folders with None."""
    return {str(path.relative_to(folder)): path.read_bytes() if path.is_file() else None for path in sorted(folder.rglob("*"))}


class MalformedInputs(unittest.TestCase):
    program = None

    @classmethod
    def setUpClass(cls):
        cls.place = pathlib.Path(tempfile.mkdtemp(prefix="tanktread-malformed-"))
        cls.addClassCleanup(shutil.rmtree, cls.place)
        good = cls.place / "good"
        good.mkdir()
        (good / "case.toml").write_text(CASE)
        cls.start(good, ["run", "case.toml", "--output", "out"], check=True)
        cls.start(good, ["run", "case.toml", "--output", "other", "--record", "record", "--to", "2"], check=True)
        shutil.rmtree(good / "other")
        cls.good = good

    @classmethod
    def start(cls, folder, arguments, **more):
        environment = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}
        return subprocess.run(
            [cls.program, *arguments], cwd=folder, env=environment, stdin=subprocess.DEVNULL, capture_output=True, text=True, errors="replace",
            timeout=LONGEST, **more
        )  # fmt: skip

    def prepare(self, row):
        """The folder of a row."""
        folder = pathlib.Path(tempfile.mkdtemp(dir=self.place))
        if row.run:
            shutil.copytree(self.good, folder, dirs_exist_ok=True)
        (folder / "case.toml").write_text(CASE)
        for name, content in row.files.items():
            file = folder / name
            file.parent.mkdir(parents=True, exist_ok=True)
            if callable(content):
                content = content(file.read_bytes())
            file.write_bytes(content if isinstance(content, bytes) else content.encode())
        for name in row.remove:
            path = folder / name
            shutil.rmtree(path) if path.is_dir() else path.unlink()
        return folder

    def check(self, row):
        folder = self.prepare(row)
        before = contents(folder)
        ended = self.start(folder, row.arguments())
        said = ended.stderr
        if os.environ.get("MALFORMED_SHOW"):
            print(f"\n--- {row.name}: {row.command}: exit {ended.returncode}\n{said.rstrip()}", file=sys.stderr)
        self.assertEqual(ended.returncode, 2, said + ended.stdout)
        for piece in row.message:
            self.assertIn(piece, said)
        self.assertIsNone(LOWER_LAYERS.search(said), said)
        after = contents(folder)
        self.assertEqual(sorted(before), sorted(after), said)
        self.assertEqual([name for name in before if before[name] != after[name]], [], "changed")
        shutil.rmtree(folder)

    def check_table(self, name):
        for row in tables()[name]:
            with self.subTest(row=row.name, command=row.command):
                self.check(row)

    def test_case_files(self):
        self.check_table("malformed_cases")

    def test_command_lines(self):
        self.check_table("malformed_commands")

    def test_meshes_and_packets(self):
        self.check_table("malformed_files")

    def test_states_series_and_tables(self):
        self.check_table("malformed_states")

    def test_what_is_not_spoilt_is_taken(self):
        for row in malformed_files.ACCEPTED:
            with self.subTest(row=row.name):
                ended = self.start(self.prepare(row), row.arguments())
                self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_the_tables_are_whole(self):
        rows = [row for table in tables().values() for row in table]
        self.assertGreaterEqual(len(rows), LEAST_ROWS)
        self.assertEqual(len({row.name for row in rows}), len(rows), "two rows of one name")
        for row in rows:
            self.assertTrue(row.message and all(row.message), row.name)


if __name__ == "__main__":
    MalformedInputs.program = str(pathlib.Path(sys.argv.pop(1)).resolve())
    unittest.main()
