"""Every case of cases/ is one that the program accepts and tries; of cases of many runs every value of every key, without a trial. Usage: cases_plan_test.py TANKTREAD [unittest arguments]."""

import subprocess
import sys
import unittest

from post_fixture import ROOT

from tanktread_post import reference


def new_values(rows):
    """Rows that together have every value of every key, those with the most values that none before has first."""
    values = [{(key, value) for key, value in row.items() if key not in ("run", "groups") and value} for row in rows]
    missing, chosen = set().union(*values), []
    while missing:
        best = max(range(len(rows)), key=lambda k: len(values[k] & missing))
        missing -= values[best]
        chosen.append(rows[best])
    return chosen


class CasesPlan(unittest.TestCase):
    def plan(self, file, row, *options):
        keys = [f"--set={key}={value}" for key, value in row.items() if key not in ("run", "groups") and value]
        ended = subprocess.run([PROGRAM, "plan", file, *options, *keys], capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, f"{file} {row}: {ended.stderr}")

    def test_case_files(self):
        files = sorted((ROOT / "cases").glob("*/case*.toml"))  # some cases have a second one
        self.assertGreaterEqual(len(files), 3)
        for file in files:
            with self.subTest(case=file.parent.name, file=file.name):
                keys = ["--set=run.shear_time=1e-3"]  # a short run, a short trial of its first steps
                if "fluid_box" not in file.read_text():
                    keys.append("--set=output.fluid_box=[[0,3],[0,3],[0,3]]")  # and of writing, which else takes the longest
                self.plan(file, {}, *keys)

    def test_runs(self):
        for file in sorted((ROOT / "cases").glob("*/runs.csv")):
            rows = reference.read_table(file)
            self.assertEqual(list(rows[0])[:2], ["run", "groups"])
            self.assertEqual(len({row["run"] for row in rows}), len(rows), f"{file}: two runs of one name")
            for row in new_values(rows):
                with self.subTest(case=file.parent.name, run=row["run"]):
                    self.plan(file.with_name("case.toml"), row, "--no-trial")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
