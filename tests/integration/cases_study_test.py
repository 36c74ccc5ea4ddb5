"""Every case of tables makes its tables, and finds in them what it compares. Usage: cases_study_test.py TANKTREAD [unittest arguments].

The short cases have to lie inside their bands. The twisting sphere, which takes long, is made with a short period: that all
its cells are there is what is tested.
"""

import subprocess
import sys
import unittest

from post_fixture import ROOT, InFolder, said

from tanktread_post import case_analysis, compare, study

SHORTER = {"twisting-sphere": ["--period", "8"]}


class CasesStudy(InFolder):
    def make_tables(self, case, folder):
        for table in study.read_study(case)["table"]:
            command = [PROGRAM, "study", *table["arguments"], *SHORTER.get(case.name, []), "--out", folder / table["file"]]
            ended = subprocess.run(command, capture_output=True, text=True)
            self.assertEqual(ended.returncode, 0, f"{case.name} {table['file']}: {ended.stderr}")

    def test_tables_and_comparison(self):
        cases = sorted(path.parent for path in (ROOT / "cases").glob("*/study.toml"))
        self.assertGreaterEqual(len(cases), 3)
        for case in cases:
            with self.subTest(case=case.name):
                folder = self.folder / case.name
                folder.mkdir()
                self.make_tables(case, folder)
                code, text = said(compare.compare, folder, case)
                self.assertNotIn("not run yet", text)
                if case.name not in SHORTER:
                    self.assertEqual(code, 0, text)

    def test_measured_tables_are_those_of_the_study(self):
        for case in sorted(path.parent for path in (ROOT / "cases").glob("*/study.toml")):
            with self.subTest(case=case.name):
                files = {table["file"] for table in study.read_study(case)["table"]}
                analysis = case_analysis.load(case)
                files |= set(analysis.measured(case / "measured", case) if analysis else ())
                self.assertEqual({file.name for file in (case / "measured").glob("*.csv")}, files)
                code, text = said(compare.compare, case / "measured", case)
                self.assertEqual(code, 0, text)
                for plot in study.read_study(case)["plot"]:
                    self.assertTrue(study.lines_of(case / "measured", plot))


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
