"""Tests of the tables of a study: reading study.toml, comparing, plotting, keeping what was measured."""

import unittest

from post_fixture import InFolder, said

from tanktread_post import compare, measured, plot_study, reference, study

STUDY = """[[table]]
file = "errors.csv"
arguments = ["maxwell"]
[[table]]
file = "noise.csv"
arguments = ["strain-rate-noise"]
[[plot]]
file = "errors.png"
table = "errors.csv"
where = { scheme = "fd" }
x = "dt"
y = "error"
lines = ["k"]
reference = { file = "published.csv", x = "dt", y = "digits", factor = 1e-2 }
[[plot]]
file = "noise.png"
table = "noise.csv"
x = "N"
y = "l2_error"
"""
TABLE = """scheme,k,dt,error
fd,1,0.4,0.16
fd,1,0.2,0.04
fd,1,0.1,0.01
fd,2,0.1,0.02
int1,1,0.1,0.05
"""
PUBLISHED = "# Source\ndt,digits\n0.4,16.1\n0.1,0.99\n"


class Tables(InFolder):
    def setUp(self):
        super().setUp()
        self.case, self.output = self.folder / "case", self.folder / "out"
        for folder in (self.case, self.output):
            folder.mkdir()
        (self.case / "study.toml").write_text(STUDY)
        (self.case / "published.csv").write_text(PUBLISHED)
        (self.output / "errors.csv").write_text(TABLE)

    def compare(self, *entries):
        """Exit code and printed text of a comparison by these entries of compare.toml."""
        (self.case / "compare.toml").write_text('title = "made for a test"\nsource = "paper"\n' + "\n".join(entries))
        return said(compare.compare, self.output, self.case)

    @staticmethod
    def value(reference, band, where='scheme = "fd", k = 1, dt = 0.1', column="error"):
        return f'[[value]]\ntable = "errors.csv"\nwhere = {{ {where} }}\ncolumn = "{column}"\nreference = {reference}\nband = {band}\n'


class Comparing(Tables):
    def test_a_cell_against_a_cell_of_the_reference(self):
        # 0.01 is 1.01 % above 0.99e-2.
        published = '{ file = "published.csv", where = { dt = 0.1 }, column = "digits", factor = 1e-2 }'
        code, text = self.compare(self.value(published, 0.011))
        self.assertEqual(code, 0, text)
        for word in ("errors.csv", "error fd, 1, 0.1", "0.010000", "0.0099", "+1.01 %", "inside"):
            self.assertIn(word, text)
        self.assertEqual(self.compare(self.value(published, 0.010))[0], 1)

    def test_a_cell_against_another(self):
        other = '{ table = "errors.csv", where = { k = 2 }, column = "error" }'
        for band, code in (('"below"', 0), ('"above"', 1), (0.51, 0), (0.49, 1)):
            with self.subTest(band=band):
                self.assertEqual(self.compare(self.value(other, band))[0], code)
        same = '{ table = "errors.csv", where = { scheme = "fd", k = 1, dt = 0.1 }, column = "error" }'
        for band in ('"below"', '"above"'):
            self.assertEqual(self.compare(self.value(same, band))[0], 1)

    def test_not_a_number_is_on_no_side(self):
        (self.output / "errors.csv").write_text(TABLE.replace("0.05", "nan"))
        for band in ('"below"', '"above"', 9):
            self.assertEqual(self.compare(self.value(1.0, band, where='scheme = "int1"'))[0], 1)

    def test_a_slope(self):
        slope = '[[slope]]\ntable = "errors.csv"\nwhere = {{ {} }}\nx = "dt"\ny = "error"\nreference = {}\nband = 0.01\n'
        where = 'scheme = "fd", k = 1'
        code, text = self.compare(slope.format(where, 2.0))
        self.assertEqual(code, 0, text)
        self.assertIn("slope of error against dt", text)
        # A negative reference: the band is a share of its amount.
        self.assertEqual(self.compare(slope.format(where, -2.0))[0], 1)
        # A list takes the rows of any of its values: from 0.4 to 0.2 alone.
        self.assertEqual(self.compare(slope.format(where + ", dt = [0.4, 0.2]", 2.0))[0], 0)
        (self.output / "errors.csv").write_text(TABLE.replace("0.1,0.01", "0.1,0.02"))
        self.assertEqual(self.compare(slope.format(where, 2.0))[0], 1)
        self.assert_refused("a slope needs two", self.compare, slope.format('scheme = "int1"', 2.0))

    def test_a_table_that_is_not_there_is_named(self):
        absent = '[[value]]\nname = "noise"\ntable = "noise.csv"\nwhere = {}\ncolumn = "l2_error"\nreference = 1\n'
        code, text = self.compare(self.value(0.01, 0.01), absent)
        self.assertEqual(code, 0)
        self.assertIn("not run yet: noise", text)
        self.assertIn("nothing was judged", self.compare(absent)[1])

    def test_refuses_what_names_no_cell(self):
        self.assert_refused("3 rows", self.compare, self.value(1, 1, where='scheme = "fd", k = 1'))
        self.assert_refused(["no column 'eror'", "error"], self.compare, self.value(1, 1, column="eror"))


class Studies(Tables):
    def test_tables_are_chosen_by_name(self):
        wanted = study.read_study(self.case)
        self.assertEqual([t["file"] for t in study.choose_tables(wanted, [])], ["errors.csv", "noise.csv"])
        for name in ("noise", "noise.csv"):
            self.assertEqual([t["file"] for t in study.choose_tables(wanted, [name])], ["noise.csv"])
        self.assert_refused(["'nose'", "errors, noise"], study.choose_tables, wanted, ["noise", "nose"])
        self.assert_refused("no such file", study.read_study, self.output)
        text = (self.case / "study.toml").read_text()
        for bad, words in (("[[tabel]]\n", "no key 'tabel'"), ('[[table]]\nfile = "a.csv"\n', ["[[table]] number", "'arguments' is missing"]), ("[[table]]\nfile = 1\narguments = []\ncolour = 1\n", "no key 'colour'"), ("[[table]]\nfile = 1\narguments = []\n", "file = 1, must be a text"), ('[[table]]\nfile = "study.toml"\narguments = []\n', "ends with .csv")):
            (self.case / "study.toml").write_text(text + bad)
            self.assert_refused(words, study.read_study, self.case)
        (self.case / "study.toml").write_text(text)

    def test_plots_of_the_tables_that_are_there(self):
        (self.case / "compare.toml").write_text('title = ""\n')
        self.assertEqual(plot_study.plot_tables(self.output, self.case), [self.output / "errors.png"])
        self.assertGreater((self.output / "errors.png").stat().st_size, 10000)
        wanted = study.read_study(self.case)["plot"][0]
        lines = study.lines_of(self.output, wanted)
        self.assertEqual({label: list(x) for label, (x, _) in lines.items()}, {"1": [0.1, 0.2, 0.4], "2": [0.1]})
        self.assertEqual(list(lines["1"][1]), [0.01, 0.04, 0.16])
        x, y = study.reference_points(self.case, wanted)
        self.assertEqual((list(x), [round(v, 12) for v in y]), ([0.1, 0.4], [0.0099, 0.161]))
        wanted["reference"]["x"] = 5
        self.assertEqual(list(study.reference_points(self.case, wanted)[0]), [5, 5])
        self.assertIsNone(study.reference_points(self.case, study.read_study(self.case)["plot"][1]))

    def test_a_measured_table_says_how_it_was_made(self):
        for commit in ("one", "two"):
            file = measured.add_table(self.case, self.output / "errors.csv", "tanktread study maxwell", commit)
        self.assertEqual(file, self.case / "measured/errors.csv")
        lines = file.read_text().splitlines()
        self.assertRegex(lines[0], r"^# \d{4}-\d\d-\d\d, commit two: tanktread study maxwell$")
        self.assertEqual("\n".join(lines[1:]) + "\n", TABLE)
        self.assertEqual(len(reference.read_table(file)), 5)


if __name__ == "__main__":
    unittest.main()
