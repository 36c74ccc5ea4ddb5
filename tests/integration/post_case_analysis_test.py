"""A case with code of its own, analyse.py: that it is found and used, and what is refused."""

import re
import unittest

from post_fixture import ROOT, InFolder, said, write_run

from tanktread_post import case_analysis, case_results

# The smallest one: a number of its own settings, judged by the sign of another.
ANALYSE = '''
import pathlib

from tanktread_post.observables import Observables
from tanktread_post.reference import read_comparison
from tanktread_post.table import Table

SETTINGS = (("limit",), ("least",))


def tables(output, case):
    limit, largest = read_comparison(case)["analyse"]["limit"], max(Observables(output)["deformation"])
    return [Table("the largest D", ("quantity", ""), [("D", f"{largest:g}")], [largest < limit], ["above"], ["below"])]


def pictures(output, case):
    file = pathlib.Path(output) / "own.png"
    file.write_text("drawn")
    return [file]
'''
VALUE = '[[value]]\nname = "deformation"\nshear_time = 1.0\nreference = 0.4\nband = 0.01\n'
PICTURE = '[[picture]]\nfile = "shared.png"\nname = "deformation"\nruns = ["out"]\n'


class CaseAnalysis(InFolder):
    def setUp(self):
        super().setUp()
        self.case, self.output = self.folder / "mine", self.folder / "out"
        self.case.mkdir()
        write_run(self.output, deformation=0.4)
        self.write()

    def write(self, analyse=ANALYSE, compare="[analyse]\nlimit = 0.5\n"):
        (self.case / "analyse.py").write_text(analyse)
        (self.case / "compare.toml").write_text('title = "made for a test"\n' + compare)

    def judged(self):
        return said(case_results.judge, self.output, self.case)

    def refused(self, *words):
        """Refused, with the name of a file of the case, wherever it is used."""
        for call, *arguments in ((case_analysis.load,), (case_results.judge, self.output), (case_results.draw, self.output)):
            self.assert_refused([str(self.case), *words], call, *arguments, self.case)

    def test_its_tables_are_printed_and_judged(self):
        self.assertEqual(self.judged(), (0, "above\n\nthe largest D\nquantity\nD         0.4\nbelow\n"))
        self.write(compare="[analyse]\nlimit = 0.3\n")
        self.assertEqual(self.judged()[0], 1)

    def test_tables_and_pictures_of_compare_toml_come_after_its_own(self):
        self.write(compare="[analyse]\nlimit = 0.5\n" + VALUE)
        code, text = self.judged()
        self.assertEqual(code, 0)
        self.assertLess(text.index("the largest D"), text.index("deformation"))
        for limit, reference in ((0.3, 0.4), (0.5, 0.5)):  # outside in the one, then in the other
            self.write(compare=f"[analyse]\nlimit = {limit}\n" + VALUE.replace("reference = 0.4", f"reference = {reference}"))
            self.assertEqual(self.judged()[0], 1)
        self.assertEqual([file.name for file in case_results.draw(self.output, self.case)], ["own.png"])
        write_run(self.folder / "runs/out")
        self.write(compare="[analyse]\nlimit = 0.5\n" + PICTURE)
        self.assertEqual([file.name for file in case_results.draw(self.folder / "runs", self.case)], ["own.png", "shared.png"])

    def test_what_it_may_leave_out(self):
        analysis = case_analysis.load(self.case)
        self.assertEqual((analysis.measured(self.output, self.case), analysis.breakdown_is_a_result), ({}, False))
        self.write(ANALYSE + "\nBREAKDOWN_IS_A_RESULT = True\n\ndef measured(output, case):\n    return {'a.csv': 'b'}\n")
        analysis = case_analysis.load(self.case)
        self.assertEqual((analysis.measured(self.output, self.case), analysis.breakdown_is_a_result), ({"a.csv": "b"}, True))
        (self.case / "analyse.py").unlink()
        (self.case / "compare.toml").write_text('title = ""\n')
        self.assertIsNone(case_analysis.load(self.case))

    def test_one_without_the_interface_is_refused(self):
        self.write(ANALYSE.replace("def pictures", "def drawings"))
        self.refused("analyse.py: it must have the function pictures(output, case)")
        self.write("tables = 3\n")
        self.refused("analyse.py: it must have the functions tables(output, case) and pictures(output, case)")

    def test_one_that_gives_something_else_is_refused(self):
        self.write(ANALYSE.replace("return [Table", "return [('a')] or [Table"))
        self.assert_refused(["analyse.py: tables(output, case) gives", "must be a list of Table"], case_results.judge, self.output, self.case)
        self.write(ANALYSE.replace("return [file]", "return [file.with_name('none.png')]"))
        self.assert_refused(["analyse.py: pictures(output, case) gives", "a list of files that are there"], case_results.draw, self.output, self.case)

    def test_one_that_cannot_be_loaded_is_refused(self):
        self.write("def tables(\n")
        self.refused("analyse.py: it cannot be loaded: SyntaxError", "line 1")
        self.write("import no_such_library\n")
        self.refused("analyse.py: it cannot be loaded: ModuleNotFoundError", "no_such_library")

    def test_settings(self):
        for text, words in (
            ("[analyse]\nleast = 1\n", "compare.toml: [analyse]: the key 'limit' is missing"),
            ("", "compare.toml: [analyse]: the key 'limit' is missing"),
            ("[analyse]\nlimit = 1\nlimits = 2\n", "compare.toml: [analyse]: there is no key 'limits'; there are: limit, least"),
            ("analyse = 3\n", "compare.toml: [analyse]: it must be a table"),
        ):
            self.write(compare=text)
            self.refused(words)
        self.write(ANALYSE.replace("SETTINGS", "OTHERS"))
        self.refused("compare.toml: [analyse]: there is no key 'limit'")

    def test_the_example_of_the_manual(self):
        (example,) = re.findall(r"```python\n(.*?SETTINGS.*?)```", (ROOT / "post/README.md").read_text().split("analysis of a case of its own")[-1], re.DOTALL)
        self.write(example)
        self.assertEqual(self.judged(), (0, "\nthe largest D\nquantity    ours\nD         0.4000\n"))
        self.assertEqual(case_results.draw(self.output, self.case), [])

    def test_those_of_the_cases_have_the_interface(self):
        found = {file.parent.name: case_analysis.load(file.parent) for file in (ROOT / "cases").glob("*/analyse.py")}
        self.assertLessEqual({"small-deformation", "spring-and-interval"}, set(found))


if __name__ == "__main__":
    unittest.main()
