"""Tests of cases/run and cases/run_built with a stand-in for tanktread: what is run, skipped, resumed, passed on."""

import os
import pathlib
import shutil
import signal
import subprocess
import sys
import unittest

import cases_spring_and_interval_test
from post_fixture import ROOT, InFolder, write_run

# A tanktread that appends its arguments to `calls`, writes a finished run (if all goes well), and ends with FAKE_EXIT.
STAND_IN = f"""#!{sys.executable}
import os, pathlib, signal, sys, time
sys.path.insert(0, {str(pathlib.Path(__file__).resolve().parent)!r})
import post_fixture
with open("calls", "a") as stream:
    stream.write(" ".join(sys.argv[1:]) + "\\n")
code = int(os.environ.get("FAKE_EXIT", "0"))
if "--version" in sys.argv:
    print("tanktread 0.1.0 (commit 12ab+)")
if "--help" in sys.argv or "--version" in sys.argv:
    sys.exit(code)
if sys.argv[1] == "study":
    pathlib.Path(sys.argv[-1]).write_text("dt,error\\n1,0.4\\n2,0.8\\n")
    sys.exit(code)
place = pathlib.Path(sys.argv[sys.argv.index("--output" if "--output" in sys.argv else "--resume") + 1])
if code == 0:
    post_fixture.write_run(place, deformation=0.4, inclination=24.0, shear_time=4.2)
    post_fixture.write_pictures(place) if not (place / "membrane").exists() else None
if "FAKE_BREAKDOWN" in os.environ:
    import cases_spring_and_interval_test
    cases_spring_and_interval_test.write_peak(place, 100.0, 0.4)
    print(cases_spring_and_interval_test.BROKEN, flush=True)
    sys.exit(3)
if "FAKE_WAIT" in os.environ:
    signal.signal(signal.SIGTERM, lambda *_: sys.exit(143))
    print("waiting", flush=True)
    time.sleep(30)
sys.exit(code)
"""
STUDY = """[[table]]
file = "first.csv"
arguments = ["maxwell", "--dt", "1", "2"]
[[table]]
file = "second.csv"
arguments = ["maxwell"]
[[plot]]
file = "first.png"
table = "first.csv"
x = "dt"
y = "error"
"""
COMPARE_TABLE = """title = "made for a test"
[[value]]
table = "first.csv"
where = { dt = 2 }
column = "error"
reference = 0.8
band = 0.01
"""
COMPARE = """title = "made for a test"
read_at = [4.0]
[[value]]
run = "first"
name = "deformation"
shear_time = 4.0
reference = 0.4
band = {band}
"""


class RunBuilt(InFolder):
    """run_built in a project folder of its own, with one case of many runs and one of one run."""

    def setUp(self):
        super().setUp()
        for name in ("cases/run_built", "cases/run"):
            (self.folder / "cases").mkdir(exist_ok=True)
            shutil.copy(ROOT / name, self.folder / name)
        (self.folder / "post").symlink_to(ROOT / "post")
        for name in ("many", "one"):
            (self.folder / "cases" / name).mkdir()
            (self.folder / "cases" / name / "case.toml").write_text("")
            (self.folder / "cases" / name / "README.md").write_text(f"# The case {name}\n\n# Not this\n")
        (self.folder / "cases/many/compare.toml").write_text(COMPARE.format(band=0.01))
        (self.folder / "cases/one/compare.toml").write_text(COMPARE.format(band=0.01).replace('run = "first"\n', ""))
        (self.folder / "cases/many/runs.csv").write_text(
            '# a comment\nrun,groups,flow.box,coupler.kernel\nfirst,a b,"[8, 8, 8]",\nsecond,b,,roma3\nthird,,,\n'
        )
        (self.folder / "cases/tables").mkdir()
        (self.folder / "cases/tables/study.toml").write_text(STUDY)
        (self.folder / "cases/tables/compare.toml").write_text(COMPARE_TABLE)
        (self.folder / "cases/tables/README.md").write_text("# The case tables\n")
        (self.folder / "bin").mkdir()
        (self.folder / "bin/tanktread").write_text(STAND_IN)
        (self.folder / "bin/tanktread").chmod(0o755)
        self.environment = os.environ | {"PATH": f"{self.folder}/bin:{os.environ['PATH']}", "PYTHONDONTWRITEBYTECODE": "1"}

    def start(self, *arguments, script="cases/run_built", **environment):
        return subprocess.Popen(
            [script, *arguments], cwd=self.folder, env=self.environment | environment, text=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        )  # fmt: skip

    def run_it(self, *arguments, **more):
        """Exit code, output, and the calls of tanktread."""
        (self.folder / "calls").unlink(missing_ok=True)
        process = self.start(*arguments, **more)
        output = process.communicate(timeout=240)[0]
        calls = (self.folder / "calls").read_text().splitlines() if (self.folder / "calls").exists() else []
        return process.returncode, output, calls

    def test_runs_what_is_chosen_with_its_keys(self):
        code, output, calls = self.run_it("many", "first", "second")
        self.assertEqual(code, 0, output)
        self.assertEqual(
            calls,
            [
                "run cases/many/case.toml --output output/many/first --set flow.box=[8, 8, 8]",
                "run cases/many/case.toml --output output/many/second --set coupler.kernel=roma3",
            ],
        )
        (self.folder / "output/many/first/checkpoints/step_0000000001").mkdir(parents=True)
        calls = self.run_it("many", "a", "--again")[2]
        self.assertEqual(calls, ["run cases/many/case.toml --output output/many/first --force --set flow.box=[8, 8, 8]"])
        self.assertIn("inside", output)
        self.assertTrue((self.folder / "output/many/deformation.png").exists())

    def test_skips_what_is_finished_and_goes_on_with_the_rest(self):
        write_run(self.folder / "output/many/first", deformation=0.4, shear_time=4.2)
        write_run(self.folder / "output/many/second", shear_time=4.2, end=1.0)
        (self.folder / "output/many/second/checkpoints/step_0000000001").mkdir(parents=True)
        write_run(self.folder / "output/many/third", shear_time=4.2, end=0.5)
        code, output, calls = self.run_it("many")
        self.assertEqual(code, 0, output)
        self.assertEqual(
            calls,
            ["run --resume output/many/second", "run cases/many/case.toml --output output/many/third --force"],
        )
        self.assertFalse((self.folder / "output/many/second/checkpoints").exists())
        self.assertIn("first                        a b                      finished", self.run_it("many", "--list")[1])

    def test_exit_codes(self):
        self.assertEqual(self.run_it("many", FAKE_EXIT="3")[0], 3)
        self.assertEqual(self.run_it("one", FAKE_EXIT="2")[0], 2)
        for arguments in (("none",), ("many", "forth"), ("../cases/one",)):
            with self.subTest(arguments=arguments):
                code, output, calls = self.run_it(*arguments, script="cases/run" if arguments != ("many", "forth") else "cases/run_built")
                self.assertEqual((code, calls), (2, []), output)
        (self.folder / "cases/many/compare.toml").write_text(COMPARE.format(band=0.01).replace("0.4\n", "0.5\n"))
        self.assertEqual(self.run_it("many", "first")[0], 1)

    def test_where_a_breakdown_is_a_result_the_series_goes_on(self):
        self.assertEqual(len(self.run_it("many", FAKE_BREAKDOWN="1")[2]), 1, "elsewhere the first one ends it")
        shutil.rmtree(self.folder / "output")
        case = self.folder / "cases/many"
        cases_spring_and_interval_test.write_case(case)
        code, output, calls = self.run_it("many", FAKE_BREAKDOWN="1")
        self.assertEqual((code, len(calls)), (0, 3), output)
        code, output, calls = self.run_it("many", FAKE_BREAKDOWN="1")
        self.assertEqual((code, calls), (0, []), output)
        self.assertEqual(output.count("broke down before"), 3)
        self.assertEqual(len(self.run_it("many", "--again", "--measure", FAKE_BREAKDOWN="1")[2]), 3)
        table = (self.folder / "cases/many/measured/first_peak.csv").read_text()
        self.assertEqual(table.count("breaks down"), 3)
        self.assertTrue((self.folder / "cases/many/measured/stability.png").is_file())

    def test_a_signal_reaches_the_run(self):
        process = self.start("many", "first", FAKE_WAIT="1")
        while "waiting" not in process.stdout.readline():
            self.assertIsNone(process.poll())
        process.send_signal(signal.SIGTERM)
        process.communicate(timeout=30)
        self.assertEqual(process.returncode, 143)

    def test_measured_results(self):
        code, output, _ = self.run_it("many", "first", "--measure")
        self.assertEqual(code, 0, output)
        text = (self.folder / "cases/many/measured/results.csv").read_text()
        self.assertIn(", commit abc: cases/run many first\nfirst,skalak,0.02,", text)
        self.assertTrue((self.folder / "cases/many/measured/deformation.png").is_file())
        compare = self.folder / "cases/many/compare.toml"
        for stretch, there in (([1.0, 4.3], False), ([1.0, 4.0], True)):  # the run ends at 4.2
            compare.write_text(COMPARE.format(band=0.01).replace("read_at", f"means_over = {stretch}\nread_at"))
            self.assertEqual(self.run_it("many", "first", "--measure")[0], 0)
            self.assertEqual((self.folder / "cases/many/measured/means.csv").is_file(), there)
        compare.write_text(compare.read_text().replace("read_at = [4.0]\n", ""))
        code, output, calls = self.run_it("many", "second", "--measure")
        self.assertEqual((code, calls), (2, []), output)
        self.assertIn("'read_at' is missing", output)

    def test_one_run_is_replaced_and_compared(self):
        code, output, calls = self.run_it("one", "--threads", "2")
        self.assertEqual(code, 0, output)
        self.assertEqual(calls, ["run cases/one/case.toml --output output/one --threads 2"])
        self.assertIn("inside", output)
        for word in ("output/one/deformation.png", "output/one/capsule.png", "output/one/membrane.pvd"):
            self.assertIn(word, output)
        code, output, calls = self.run_it("one")
        self.assertEqual((code, calls), (0, ["run cases/one/case.toml --output output/one --force"]))
        self.assertIn("replacing the earlier run", output)

    def test_what_is_wrong_with_the_comparison_is_said_before_a_run(self):
        for name in ("one", "many", "tables"):
            (self.folder / "cases" / name / "analyse.py").write_text("")
            code, output, calls = self.run_it(name)
            self.assertEqual((code, calls), (2, []), output)
            self.assertIn(f"cases/{name}/analyse.py: it must have the functions tables(output, case)", output)

    def test_help_runs_and_draws_nothing(self):
        write_run(self.folder / "output/one", shear_time=4.2)
        code, output, calls = self.run_it("one", "--help")
        self.assertEqual((code, output, calls), (0, "", ["run --help"]))

    def test_tables_are_made_drawn_and_compared(self):
        first = "study maxwell --dt 1 2 --out output/tables/first.csv"
        code, output, calls = self.run_it("tables", "first", "--measure")
        self.assertEqual((code, calls), (0, [first, "--version"]), output)
        for word in ("output/tables/first.png", "inside"):
            self.assertIn(word, output)
        text = (self.folder / "cases/tables/measured/first.csv").read_text()
        self.assertIn(f", commit 12ab+: tanktread {first}\ndt,error\n", text)
        (self.folder / "cases/tables/compare.toml").write_text(COMPARE_TABLE.replace("0.8\n", "0.9\n"))
        code, output, calls = self.run_it("tables")
        self.assertEqual((code, calls), (1, [first, "study maxwell --out output/tables/second.csv"]), output)
        self.assertTrue((self.folder / "cases/tables/measured/first.png").is_file())
        self.assertFalse((self.folder / "cases/tables/measured/second.csv").exists())
        self.assertEqual(self.run_it("tables", FAKE_EXIT="3")[0], 3)

    def test_lists_the_cases(self):
        code, output, _ = self.run_it(script="cases/run")
        self.assertEqual(code, 0)
        self.assertEqual([line.split(maxsplit=1) for line in output.splitlines()[1:]], [[name, f"The case {name}"] for name in ("many", "one", "tables")])


if __name__ == "__main__":
    unittest.main()
