"""Tests of measured results: what is added, replaced, refused."""

import unittest

from post_fixture import InFolder, write_observables, write_run

from tanktread_post import measured, reference, run_folder

LOG = """time   3.000 of 3.000  D 0.0400  inclination  44.00 deg  50.0 MLUPS  0 s left
time of              seconds        %
  fluid               80.000     76.2
  forced nodes        11.500     11.0
  stencils             3.000      2.9
  interpolation        2.000      1.9
  spreading            1.500      1.4
  correction           0.500      0.5
  membranes            1.500      1.4
  files                4.000      3.8
  else                 1.000      1.0
ended at step 14400 with 48.5 MLUPS; results are in out
"""


class Measured(InFolder):
    def add(self, run, deformation, times=(1.5, 3.0), log=None, **options):
        write_run(self.folder / run, deformation=deformation, **options)
        (self.folder / "case").mkdir(exist_ok=True)
        return measured.add(self.folder / "case", self.folder / run, run, times, f"cases/run case {run}", log)

    def test_rows_have_command_commit_and_date(self):
        (self.folder / "log").write_text(LOG)
        file = self.add("a", 0.04, log=self.folder / "log")
        lines = file.read_text().splitlines()
        self.assertRegex(lines[1], r"^# \d{4}-\d\d-\d\d, commit abc: cases/run case a$")
        rows = reference.read_table(file)
        self.assertEqual([row["shear_time"] for row in rows], ["1.5", "3"])
        self.assertEqual(rows[0]["deformation"], "0.04")
        self.assertEqual(rows[0]["box"], "72 x 72 x 72")
        self.assertEqual(rows[0]["shear_rate_by"], "reynolds_number 0.1")
        self.assertEqual([rows[0][name] for name in measured.COST], ["48.5", "91.5", "7", "1.5"])

    def test_a_capsule_has_the_shared_membrane_and_its_own_keys(self):
        write_run(self.folder / "run", viscous={"scheme": "fd", "interval": 25})
        echo = self.folder / "run/echo.toml"
        own = "membrane = { capillary_number = 0.7, viscous = { interval = 3 } }\n"
        echo.write_text(echo.read_text().replace("[membrane]", own + "[[capsule]]\nradius = 1.0\n[membrane]"))
        first, second = (capsule["membrane"] for capsule in run_folder.read_echo(self.folder / "run")["capsule"])
        self.assertEqual((first["capillary_number"], first["viscous"]), (0.7, {"scheme": "fd", "interval": 3}))
        self.assertEqual((second["capillary_number"], second["viscous"]), (0.02, {"scheme": "fd", "interval": 25}))

    def test_membrane_viscosity_has_columns_of_its_own(self):
        file = self.add("elastic", 0.04)
        viscous = {"scheme": "fd", "boussinesq_shear": 10.0, "spring_stiffness": 100.0, "interval": 25}
        file = self.add("viscous", 0.03, viscous=viscous)
        rows = {row["run"]: row for row in reference.read_table(file)}
        self.assertEqual([rows["elastic"][name] for name in measured.VISCOUS], [""] * 6)
        self.assertEqual(
            [rows["viscous"][name] for name in measured.VISCOUS], ["fd", "10.0", "", "spring_stiffness 100.0", "25", ""]
        )

    def test_a_corrected_coupler_shows(self):
        self.add("plain", 0.04)
        write_run(self.folder / "corrected", deformation=0.05, corrected=True, inertia=False, viscosity_ratio=5.0)
        file = measured.add(self.folder / "case", self.folder / "corrected", "corrected", (3.0,), "cases/run case corrected")
        rows = {row["run"]: row for row in reference.read_table(file)}
        self.assertEqual([rows[run]["tangential_correction"] for run in ("plain", "corrected")], ["", "true"])
        self.assertEqual([rows[run]["inertia"] for run in ("plain", "corrected")], ["", "false"])
        self.assertEqual({rows[run]["keep_volume"] for run in ("plain", "corrected")}, {""})
        self.assertEqual([rows[run]["viscosity_ratio"] for run in ("plain", "corrected")], ["", "5"])

    def test_a_file_with_fewer_columns_is_filled_up(self):
        file = self.add("old", 0.04)
        n = len(measured.VISCOUS) + len(measured.SWITCHES)
        file.write_text("\n".join(l if l.startswith("#") else l.rsplit(",", n)[0] for l in file.read_text().splitlines()))
        self.add("new", 0.05)
        rows = {row["run"]: row for row in reference.read_table(file)}
        self.assertEqual(rows["old"]["deformation"], "0.04")
        self.assertEqual(rows["old"]["interval"], "")

    def test_measuring_again_replaces_that_run_only(self):
        self.add("a", 0.04, commit="one")
        self.add("b", 0.05, commit="two")
        file = self.add("a", 0.06, commit="three")
        text = file.read_text()
        self.assertNotIn("commit one", text)
        self.assertEqual({row["run"]: row["deformation"] for row in reference.read_table(file)}, {"a": "0.06", "b": "0.05"})
        self.assertEqual(text.count("# "), 2)

    def test_means_are_those_of_a_stretch_beside_the_highest_deformation_of_all(self):
        write_run(self.folder / "run")
        (self.folder / "case").mkdir()
        rows = [{"shear_time": str(t), "deformation": str(d), "volume_ratio": "0.99"} for t, d in enumerate((0, 0.5, 0.2, 0.3, 0.25))]
        write_observables(self.folder / "run", rows)
        for number in (1, 2):  # the second replaces the first
            file = measured.add_means(self.folder / "case", self.folder / "run", "run", (2, 4), f"command {number}")
        (row,) = reference.read_table(file)
        self.assertIn("command 2", file.read_text())
        self.assertNotIn("command 1", file.read_text())
        self.assertEqual((row["from"], row["to"], row["deformation"], row["volume_ratio"]), ("2", "4", "0.2625", "0.99"))
        self.assertEqual((row["highest_deformation"], row["highest_at"]), ("0.5", "1"))

    def test_a_stretch_that_is_none_is_refused(self):
        for stretch in ("[30, 15]", "[15]", '["a", "b"]', "15"):
            (self.folder / "compare.toml").write_text(f'title = ""\nmeans_over = {stretch}\n')
            self.assert_refused(["means_over", "as [15, 30]"], reference.read_comparison, self.folder)

    def test_a_table_of_a_case_has_a_name_of_its_own(self):
        for name, words in (("results.csv", "which holds the runs"), ("../compare.toml", "a name without a folder"), ("a.toml", "ends with .csv")):
            self.assert_refused(["analyse.py: measured(output, case)", words], measured.add_own, self.folder, name, "a,b\n", "a command")
        self.assertEqual(measured.add_own(self.folder, "own.csv", "a,b\n", "a command").read_text().splitlines()[1], "a,b")

    def test_refuses_a_run_of_which_nothing_is_read(self):
        with self.assertRaisesRegex(measured.InputError, "before the first shear time of read_at"):
            self.add("a", 0.04, times=())
        self.assertFalse((self.folder / "case/measured/results.csv").exists())

    def test_refuses_a_run_that_is_not_finished(self):
        self.assert_refused(["not finished", "tanktread run"], self.add, "a", 0.04, end=1.0)


if __name__ == "__main__":
    unittest.main()
