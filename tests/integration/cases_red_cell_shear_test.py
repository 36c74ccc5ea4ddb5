"""Tests of the case red-cell-shear: what is read of motions that are known, and what is said of them."""

import csv
import math
import shutil
import unittest

import numpy
from post_fixture import ROOT, InFolder, said, write_echo, write_observables

from tanktread_post import case_analysis, case_results

CASE = ROOT / "cases/red-cell-shear"
analyse = case_analysis.module_of(CASE / "analyse.py")
readings = analyse.readings
END, EVERY = 40.0, 0.05
TIMES = numpy.arange(round(END / EVERY) + 1) * EVERY
HERTZ = 1 / (2 * math.pi)


class Motion(unittest.TestCase):
    def motion(self, shape, marker):
        return readings.motion(TIMES, shape, marker, 25.0, 5.0)

    def test_of_known_angles(self):
        swing = numpy.radians(12) * numpy.sin(TIMES)
        for state, shape, marker in (
            ("tumbling", -0.2 * TIMES + swing, -0.2 * TIMES),
            ("tank-treading", 0.2 + 0.3 * swing, -0.3 * TIMES),
            ("swinging", 0.2 + swing, -0.3 * TIMES + swing),
            ("slow", 0.2 + swing, -0.1 * TIMES),
        ):
            with self.subTest(state=state):
                found, tumbling, treading = self.motion(shape, marker)
                self.assertEqual(found, state)
                self.assertEqual((math.isnan(tumbling), math.isnan(treading)), (state != "tumbling", state not in ("swinging", "tank-treading")))

    def test_frequencies_are_of_whole_half_turns(self):
        # 25 shear times are 1.6 half turns of the first, 2.4 of the second; the swing has the period of half a turn, so that its mean is exact but for the
        # cubic between four samples: 0.05^4 3/128 times a fourth derivative of the time over the angle, some 10^3, over a time of 15: 1e-5.
        for rate, state in ((0.2, "tumbling"), (0.3, "tank-treading")):
            wave = numpy.radians(20) * numpy.sin(2 * rate * TIMES)
            turning, steady = -rate * TIMES + wave, 0.1 + 0 * TIMES
            found = self.motion(*((turning, turning) if state == "tumbling" else (steady, turning)))
            self.assertEqual(found[0], state)
            self.assertAlmostEqual(numpy.nansum(found[1:]), rate, delta=1e-5)


class RedCellShear(InFolder):
    def setUp(self):
        super().setUp()
        self.case = self.folder / "case"
        shutil.copytree(CASE, self.case, ignore=shutil.ignore_patterns("measured", "__pycache__"))

    def run_of(self, name, rate, viscosity=28.9e-3, membrane=0.0, shape=-0.0, marker=-0.3, inclination=15.0, volume=1.0, area=1.0):
        """A cell whose shape and marker turn evenly, by radians a shear time."""
        folder = self.folder / "out" / name
        write_echo(folder, shear_time=END, viscosity_ratio=8e-3 / viscosity)
        with open(folder / "echo.toml", "a") as stream:
            stream.write(f"[si]\nshear_rate_per_s = {rate}\nviscosity_Pa_s = {viscosity}\ninner_viscosity_Pa_s = 8e-3\n")
            stream.write(f"membrane_shear_viscosity_N_s_per_m = {membrane}\n" if membrane else "")
        volumes, areas = numpy.linspace(1, volume, len(TIMES)), numpy.linspace(1, area, len(TIMES))
        write_observables(folder, [{"shear_time": repr(t), "volume_ratio": repr(v), "area_ratio": repr(a)} for t, v, a in zip(TIMES.tolist(), volumes.tolist(), areas.tolist())])
        angle, phase = math.radians(inclination) + shape * TIMES, marker * TIMES
        short = (numpy.degrees(angle) - 90 + 90) % 180 - 90  # in [-90, 90)
        with open(folder / "measures.csv", "w", newline="") as stream:
            writer = csv.writer(stream, lineterminator="\n")
            writer.writerow(["step", "shear_time", "capsule", "marker_x", "marker_y", "marker_z", "short_inclination_deg"])
            columns = (TIMES, 0 * TIMES, numpy.cos(phase), 0 * TIMES, numpy.sin(phase), short)
            writer.writerows([k, *(repr(float(value)) for value in row[:1]), 0, *(repr(float(value)) for value in row[2:])] for k, row in enumerate(zip(*columns)))

    def read(self):
        settings = analyse.read_comparison(self.case)["analyse"]
        return {r.run: r for r in readings.read_runs(self.folder / "out", settings, self.case / "measured/readings.csv")}

    def judge(self):
        analyse.known.cache_clear()
        return said(case_results.judge, self.folder / "out", self.case)

    def test_reads_what_was_put_in(self):
        self.run_of("dextran-viscous-100", 100, membrane=0.42e-6, volume=0.999, area=1.01)
        self.run_of("plasma-elastic-30", 30, viscosity=1.2e-3, shape=-0.25, marker=-0.25)
        found = self.read()
        r = found["dextran-viscous-100"]
        self.assertEqual((r.state, r.fluid), ("tank-treading", ("dextran", "viscous")))
        # Even turns are found to rounding: some 800 steps of angles up to 12.
        self.assertAlmostEqual(r.treading_frequency, 30 * HERTZ, delta=1e-9)
        self.assertAlmostEqual(r.inclination, 15, delta=1e-9)
        self.assertAlmostEqual(r.swing, 0, delta=1e-9)
        self.assertAlmostEqual(r.viscosity_ratio, 8 / 28.9, delta=1e-12)
        self.assertEqual((r.least_volume, r.greatest_volume, r.least_area, r.greatest_area), (0.999, 1, 1, 1.01))
        r = found["plasma-elastic-30"]
        self.assertEqual((r.state, r.fluid), ("tumbling", ("plasma", "elastic")))
        self.assertAlmostEqual(r.tumbling_frequency, 7.5 * HERTZ, delta=1e-9)
        self.assertTrue(math.isnan(r.inclination))

    def test_what_was_said_before_is_judged(self):
        self.run_of("dextran-elastic-30", 30, marker=-0.31)
        self.run_of("dextran-elastic-100", 100)
        self.run_of("dextran-viscous-100", 100, membrane=0.42e-6, marker=-0.29)
        code, text = self.judge()
        self.assertEqual(code, 0, text)
        for statement in ("dextran-elastic-100 does not tumble", "dextran-elastic-100 treads faster", "dextran-viscous-100 treads slower"):
            self.assertIn(statement, text)
        self.assertIn("not finished: dextran-elastic-1,", text)

    def test_each_statement_can_fail(self):
        for name, keys in (
            ("dextran-elastic-100", {"rate": 100, "shape": -0.3}),
            ("plasma-viscous-30", {"rate": 30, "viscosity": 1.2e-3, "membrane": 0.42e-6}),
            ("dextran-elastic-30", {"rate": 30, "volume": 1.0021}),
            ("dextran-elastic-30", {"rate": 30, "volume": 0.9979}),
            ("dextran-elastic-30", {"rate": 30, "area": 1.021}),
            ("dextran-elastic-30", {"rate": 30, "area": 0.979}),
        ):
            with self.subTest(name=name, **keys):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.run_of(name, **keys)
                code, text = self.judge()
                self.assertEqual((code, text.count("OUTSIDE")), (1, 1), text)

    def test_a_viscous_membrane_that_treads_faster_is_outside(self):
        self.run_of("dextran-elastic-100", 100)
        self.run_of("dextran-viscous-100", 100, membrane=0.42e-6, marker=-0.31)
        self.assertEqual(self.judge()[0], 1)

    def test_what_is_kept_is_read_again(self):
        self.run_of("dextran-elastic-100", 100)
        self.run_of("plasma-elastic-30", 30, viscosity=1.2e-3, shape=-0.25, marker=-0.25)
        analyse.known.cache_clear()
        case_results.keep(self.folder / "out", self.case, "a command")
        for name in ("states.png", "frequency.png", "inclination.png"):
            self.assertTrue((self.case / "measured" / name).is_file(), name)
        shutil.rmtree(self.folder / "out")
        found = self.read()
        self.assertEqual({run: r.state for run, r in found.items()}, {"dextran-elastic-100": "tank-treading", "plasma-elastic-30": "tumbling"})
        self.assertAlmostEqual(found["dextran-elastic-100"].treading_frequency, 30 * HERTZ, delta=1e-5)

    def test_a_kept_table_that_is_damaged_is_refused(self):
        kept = self.case / "measured/readings.csv"
        kept.parent.mkdir()
        for text in ("run,commit\na,b\n", (CASE / "measured/readings.csv").read_text().replace("tumbling,1,", "tumbling,one,", 1)):
            kept.write_text(text)
            self.assert_refused([str(kept), "run --measure of the run again"], self.read)

    def test_without_runs(self):
        self.assert_refused(["no finished run"], case_results.judge, self.folder / "out", self.case)


if __name__ == "__main__":
    unittest.main()
