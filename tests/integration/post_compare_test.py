"""Tests of reading observables and of comparing them with references."""

import unittest

import post_fixture
from post_fixture import InFolder, said, write_observables, write_run

from tanktread_post import compare, reference, run_folder
from tanktread_post.observables import Observables

COMPARE = """title = "made for a test"
source = "paper"
[[value]]
name = "deformation"
shear_time = 1.5
reference = {reference}
band = 0.01
[[value]]
name = "inclination_deg"
shear_time = 1.5
reference = 44.5
band = {band}
relative = false
"""


class Reading(InFolder):
    def test_reads_between_rows_by_a_straight_line(self):
        write_observables(self.folder, [{"shear_time": 0, "deformation": 0.1}, {"shear_time": 2, "deformation": 0.5}])
        self.assertAlmostEqual(Observables(self.folder).at("deformation", 0.5), 0.2, delta=1e-15)

    def test_a_row_without_an_end_is_no_row_yet(self):
        # 2.5 that is cut to 2 has all its cells, and another value.
        write_observables(self.folder, [{"shear_time": str(t), "deformation": "0.25"} for t in range(3)])
        file = self.folder / "observables.csv"
        whole = file.read_text()
        for cut in range(1, len(whole.splitlines()[-1]) + 1):
            file.write_text(whole[:-cut])
            self.assertEqual(Observables(self.folder)["shear_time"].tolist(), [0.0, 1.0])
        lines = whole.splitlines(keepends=True)
        file.write_text("".join([*lines[:2], lines[2].rpartition(",")[0] + "\n", *lines[3:]]))
        self.assert_refused(["observables.csv: line 3 has not", "damaged"], Observables, self.folder)

    def test_never_reads_beyond_the_end(self):
        write_observables(self.folder, [{"shear_time": 0, "deformation": 0}, {"shear_time": 2, "deformation": 1, "step": 1000}])
        self.assert_refused(["shear time 2.1 is outside 0 to 2", "tanktread run"], Observables(self.folder).at, "deformation", 2.1)
        # The last step lies within half a step of the end: it is the reading at the end.
        self.assertEqual(Observables(self.folder).at("deformation", 2.0009), 1.0)
        self.assertFalse(Observables(self.folder).reaches(2.0011))

    def test_a_mean_is_that_of_the_lines_between_rows(self):
        rows = [{"shear_time": t, "deformation": d} for t, d in ((0, 0.0), (1, 0.2), (3, 0.6), (4, 0.0))]
        write_observables(self.folder, rows)
        # 0.2 t up to 3, then a fall to 0: from 0.5 to 3.5 the area is 0.1 (9 - 0.25) + 0.5 (0.6 + 0.3)/2.
        self.assertAlmostEqual(Observables(self.folder).mean("deformation", 0.5, 3.5), (0.875 + 0.225) / 3, delta=1e-15)
        self.assert_refused("outside 0 to 4", Observables(self.folder).mean, "deformation", 3, 5)

    def test_takes_one_capsule(self):
        rows = [{"shear_time": t, "deformation": 10 * c + t, "capsule": c} for t in (0, 1) for c in (0, 1)]
        write_observables(self.folder, rows)
        self.assertEqual(list(Observables(self.folder, capsule=1)["deformation"]), [10, 11])
        self.assert_refused("no rows of capsule 2", Observables, self.folder, capsule=2)

    def test_leaves_out_a_row_that_was_cut_off(self):
        write_observables(self.folder, [{"shear_time": 0}, {"shear_time": 1}])
        with open(self.folder / "observables.csv", "a") as stream:
            stream.write("2,2.0,0.3")
        self.assertEqual(list(Observables(self.folder)["shear_time"]), [0, 1])

    def test_says_what_is_missing(self):
        self.assert_refused("there is no such file", Observables, self.folder)
        write_observables(self.folder, [{"shear_time": 0}])
        self.assert_refused(["'deformatoin'", "deformation"], Observables(self.folder).__getitem__, "deformatoin")
        (self.folder / "observables.csv").write_text("a,b\n1,2\n")
        self.assert_refused("does not name the columns", Observables, self.folder)

    def test_finished_and_not(self):
        write_run(self.folder / "done", shear_time=3.0, end=2.9999)
        write_run(self.folder / "begun", shear_time=3.0, end=2.5)
        self.assertTrue(run_folder.is_finished(self.folder / "done"))
        self.assertFalse(run_folder.is_finished(self.folder / "begun"))
        self.assertFalse(run_folder.is_finished(self.folder / "nowhere"))


class References(InFolder):
    TABLE = "# Source, Table 1\nmesh,bq_s,deformation\n2,0,0.44\n3,0,0.43\n3,10,0.36\n"

    def look_up(self, **where):
        (self.folder / "table.csv").write_text(self.TABLE)
        return reference.look_up(self.folder, {"file": "table.csv", "where": where, "column": "deformation"})

    def test_finds_the_one_row(self):
        self.assertEqual(self.look_up(mesh=3, bq_s=0), 0.43)
        self.assertEqual(self.look_up(mesh="3", bq_s=10.0), 0.36)
        self.assertEqual(reference.look_up(self.folder, 0.5), 0.5)

    def test_a_row_of_another_length_is_refused(self):
        for row in ("1,2", "1,2,3,4"):
            (self.folder / "a.csv").write_text(f"# of a test\na,b,c\n1,2,3\n{row}\n")
            self.assert_refused(["a.csv: a row has not as many cells", row.replace(",", ", ")[:4]], reference.read_table, self.folder / "a.csv")

    def test_refuses_none_and_two(self):
        self.assert_refused("2 rows", self.look_up, mesh=3)
        self.assert_refused("0 rows", self.look_up, mesh=4)

    def test_every_case_has_its_references(self):
        cases = sorted(path.parent for path in (post_fixture.ROOT / "cases").glob("*/compare.toml"))
        self.assertGreaterEqual(len(cases), 3)
        for case in cases:
            with self.subTest(case=case.name):
                reference.read_comparison(case)
                self.assertTrue((case / "README.md").read_text().startswith("# "))


class Comparing(InFolder):
    def compare(self, text):
        """Exit code and printed text of a comparison by this compare.toml."""
        case = self.folder / "case"
        case.mkdir(exist_ok=True)
        (case / "compare.toml").write_text(text)
        return said(compare.compare, self.folder / "run", case)

    def test_inside_and_outside(self):
        write_run(self.folder / "run", deformation=0.404, inclination=44.0)
        # 0.404 is 1 % (0.9999...) above 0.4 and 1.003 % above 0.39999; 44.0 is 0.5 below 44.5.
        for value, band, code in ((0.4001, 0.6, 0), (0.3999, 0.6, 1), (0.4001, 0.4, 1)):
            with self.subTest(reference=value, band=band):
                self.assertEqual(self.compare(COMPARE.format(reference=value, band=band))[0], code)
        text = self.compare(COMPARE.format(reference=0.3999, band=0.6))[1]
        for word in ("paper", "0.404000", "+1.03 %", "1.00 %", "OUTSIDE", "-0.5000", "inside"):
            self.assertIn(word, text)

    def test_a_value_that_is_not_a_number_is_outside(self):
        write_run(self.folder / "run", deformation=float("nan"))
        self.assertEqual(self.compare(COMPARE.format(reference=0.4, band=9))[0], 1)

    def test_without_a_band_nothing_is_judged(self):
        write_run(self.folder / "run", deformation=9.0)
        code, text = self.compare('title = ""\n[[value]]\nname = "deformation"\nshear_time = 1\nreference = 0.4\n')
        self.assertEqual(code, 0)
        self.assertIn("shown only", text)
        self.assertIn("nothing was judged", text)

    def test_runs_side_by_side(self):
        change = '[[change]]\nname = "deformation"\nshear_time = 1\nfrom = "a"\nto = "{to}"\nband = 0.003\n'
        value = '[[value]]\nrun = "c"\nname = "deformation"\nshear_time = 1\nreference = 1.0\n'
        write_run(self.folder / "run/a", deformation=0.4)
        write_run(self.folder / "run/b", deformation=0.4011)
        write_run(self.folder / "run/d", deformation=0.4013)
        code, text = self.compare('title = ""\n' + change.format(to="b") + value)
        self.assertEqual(code, 0)
        self.assertIn("not run yet: c: deformation", text)
        self.assertEqual(self.compare('title = ""\n' + change.format(to="d"))[0], 1)
        expected = change.replace("band", "reference = {reference}\nband")
        for reference, code in ((0.4013 / 0.4 - 1, 0), (0.4013 / 0.4 - 0.996, 1)):
            self.assertEqual(self.compare('title = ""\n' + expected.format(to="d", reference=reference))[0], code)
        code, text = self.compare('title = ""\n' + value)
        self.assertEqual(code, 0)
        self.assertIn("nothing was judged", text)

    def test_a_mean_over_time(self):
        write_run(self.folder / "run/a", deformation=0.4)
        value = '[[value]]\nrun = "a"\nname = "deformation"\nmean_over = [1, {end}]\nreference = 0.4\nband = 0.001\n'
        code, text = self.compare('title = ""\n' + value.format(end=3))
        self.assertEqual(code, 0)
        self.assertIn("mean 1 to 3", text)
        self.assertIn("not run yet: a", self.compare('title = ""\n' + value.format(end=3.5))[1])

    def test_says_that_nothing_is_there(self):
        self.assert_refused("none of the runs", self.compare, 'title = ""\n')

    def test_refuses_keys_that_compare_toml_does_not_have(self):
        write_run(self.folder / "run/a")
        for text, words in (
            ("", ["compare.toml", "'title' is missing"]),
            ('title = ""\nvalues = 1\n', ["no key 'values'", "value"]),
            ('title = ""\n[[value]]\nname = "deformation"\nshear_time = 1\n', ["[[value]] number 1", "'reference' is missing"]),
            ('title = ""\n[[value]]\nname = "deformation"\nreference = 1\n', ["[[value]] number 1", "one of `shear_time` and `mean_over`"]),
            ('title = ""\n[[value]]\ntable = "a.csv"\nreference = 1\n', ["[[value]] number 1", "`where` and `column`"]),
            ('title = ""\n[[change]]\nname = "deformation"\nshear_time = 1\nfrom = "a"\n', ["[[change]] number 1", "'to' is missing"]),
            ('title = ""\n[analyse]\nfit = ""\n', ["[analyse] is for", "case/analyse.py, and there is no such file"]),
            ('title = "\n', ["compare.toml", "line 1"]),
        ):
            with self.subTest(text=text):
                self.assert_refused(words, self.compare, text)


if __name__ == "__main__":
    unittest.main()
