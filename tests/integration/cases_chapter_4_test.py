"""Tests of the matrix of Chapter 4: what is read of runs made of functions that are known, and what is said of it."""

import json
import math
import unittest

import numpy

from chapter_4_fixture import CASE, EVERY, OfChapter4, chapter_4, ellipse, readings, write_run

from tanktread_post import case_results, reference, turning


class TurningFrequency(unittest.TestCase):
    # The time as a function of the angle is a cubic through four samples, 0.017 of the ellipse's parameter apart: 3/128 0.017^4 times a fourth derivative, with axes
    # 2.5 : 1 some 2.5^4, over the frequency, in a time of half a turn, pi over it: 2e-8 of the frequency at 0.3, and eight times that at 0.5.
    def test_of_a_marker_on_an_ellipse_is_known(self):
        times = numpy.arange(901) * EVERY
        for frequency in (0.2, 0.3349, 0.5, -0.36682):
            for longest in (20.0, 44.0):
                with self.subTest(frequency=frequency, longest=longest):
                    found = turning.turning_frequency(times, *ellipse(times, frequency), longest)
                    self.assertAlmostEqual(found, abs(frequency), delta=1e-7)

    def test_is_that_of_the_last_turns(self):
        # Twice as fast before shear time 20: the phase is continuous.
        times = numpy.arange(901) * EVERY
        phase = numpy.where(times < 20, 0.6 * times, 12 + 0.3 * (times - 20))
        self.assertAlmostEqual(turning.turning_frequency(times, numpy.cos(phase), -numpy.sin(phase), 22.0), 0.3, delta=1e-6)
        self.assertGreater(turning.turning_frequency(times, numpy.cos(phase), -numpy.sin(phase), 44.0), 0.35)

    def test_what_turned_the_other_way_before_does_not_count(self):
        times = numpy.arange(901) * EVERY
        phase = numpy.where(times < 20, 0.6 * times, 12 - 0.3 * (times - 20))
        self.assertAlmostEqual(turning.turning_frequency(times, numpy.cos(phase), numpy.sin(phase), 22.0), 0.3, delta=1e-6)

    def test_of_less_than_half_a_turn_is_not_known(self):
        times = numpy.arange(901) * EVERY
        self.assertTrue(math.isnan(turning.turning_frequency(times, *ellipse(times, 0.1), 20.0)))
        self.assertTrue(math.isnan(turning.turning_frequency(times, numpy.ones(901), numpy.zeros(901), 20.0)))


class Chapter4(OfChapter4):
    def test_reads_what_was_put_in(self):
        self.run_at(5, 10, swing=0.25, frequency=0.31, volume=0.9985, membrane=0.8, inner=1.6, extent=1.03)
        (r,) = self.read().values()
        # Sums of some 200 products rounded to 1e-16, the text is exact.
        exact = {
            "deformation": 0.4, "inclination_deg": 20.0, "deformation_amplitude": 0.1, "inclination_deg_amplitude": 5.0, "area_ratio": 1.1,
            "circumference": 1.1, "membrane_speed": 0.36, "vorticity_extent": 1.03, "least_volume": 0.9985, "greatest_volume": 1.0,
            "membrane_dissipation": 0.8, "inner_dissipation": 1.6, "dissipation_ratio": 0.5, "nu_travel": 0.36 / 1.1,
        }  # fmt: skip
        for name, value in exact.items():
            self.assertAlmostEqual(getattr(r, name) / value, 1, delta=1e-12, msg=name)
        self.assertAlmostEqual(r.nu_marker, 0.31, delta=1e-6)

    def test_runs_that_are_not_there_are_named_and_no_error(self):
        self.run_at(1, 0)
        self.run_at(10, 0, end=12.0)  # unfinished
        code, text = self.judged()
        missing = self.line("not run yet:")
        self.assertEqual(len(missing.split(",")), len(chapter_4.gathered.rows_of(CASE)) - 1)
        self.assertIn(" l10-bqs0,", missing)
        self.assertNotIn(" l1-bqs0,", missing)
        self.assertIn("1 of 5 runs", self.line("D falls with lambda", "Bq_s = 0 "))

    def test_runs_of_one_viscosity_whose_inside_is_not_marked_are_read(self):
        self.run_at(1, 10, membrane=0.8, inner=None)
        self.assertEqual(self.judged()[0], 0)
        (r,) = self.read().values()
        self.assertAlmostEqual(r.membrane_dissipation, 0.8, delta=1e-12)
        self.assertTrue(math.isnan(r.inner_dissipation) and math.isnan(r.dissipation_ratio))

    def test_old_runs_without_measures_and_energy_are_read(self):
        self.run_at(1, 0, deformation=0.433, measures=False, energy=False)
        self.assertEqual(self.judged()[0], 0)
        self.assertTrue(math.isnan(self.read()[1, 0, 0].nu_marker))
        self.assertGreater(len(case_results.draw(self.output, self.case)), 2)

    def test_judges_the_printed_numbers(self):
        exact = {"frequency": 0.3349, "circumference": 1.1015, "speed": 0.33243 * 1.1015, "deformation": 0.433}
        for change, word in (
            ({}, "inside"), ({"frequency": 0.3349 * 1.019}, "inside"), ({"frequency": 0.3349 * 1.021}, "nu* (marker)"),
            ({"speed": 0.33243 * 1.1015 * 0.979}, "nu* (V*/C*)"), ({"circumference": 1.1015 * 1.011}, "C*"), ({"deformation": 0.433 * 1.051}, " D "),
        ):  # fmt: skip
            with self.subTest(change=change):
                self.run_at(1, 0, **(exact | change))
                code, text = self.judged()
                self.assertEqual(code, 0 if word == "inside" else 1)
                outside = [line for line in text.splitlines() if "OUTSIDE" in line]
                self.assertEqual(len(outside), code)
                if outside:
                    self.assertIn(word, outside[0])

    def test_judges_whether_the_shape_falls_with_the_viscosity_ratio(self):
        for ratio in (0.2, 1, 3, 5, 10):
            self.run_at(ratio, 20, deformation=0.4 - 0.02 * ratio, inclination=20 - ratio)
        self.assertIn("inside", self.line("D falls with lambda", "Bq_s = 20"))
        self.assertIn("inside", self.line("inclination falls with lambda", "Bq_s = 20"))
        self.run_at(3, 20, deformation=0.39, inclination=16)
        self.assertIn("OUTSIDE", self.line("D falls with lambda", "Bq_s = 20"))
        self.assertIn("inside", self.line("inclination falls with lambda", "Bq_s = 20"))

    def series_of_shear(self, ratio, speed=lambda shear: 0.3, inclination=lambda shear: 20.0):
        for shear in (0, 2, 5, 10, 20, 30, 40):
            self.run_at(ratio, shear, deformation=0.4 - 0.005 * shear, speed=speed(shear), inclination=inclination(shear))

    def test_judges_where_the_inclination_is_least(self):
        for least, word in ((10, "inside"), (40, "OUTSIDE"), (2, "OUTSIDE")):
            self.series_of_shear(1, inclination=lambda shear: 13 + abs(shear - least) / 10)
            line = self.line("inclination is least")
            self.assertIn(word, line)
            self.assertIn(f"13.00 degrees at {least}", line)

    def test_judges_the_spoon(self):
        for speed, word in ((lambda s: 0.3 + abs(s - 6) / 100, "inside"), (lambda s: 0.5 - s / 100, "OUTSIDE"), (lambda s: 0.3 + 0.01 * (s in (2, 20)), "OUTSIDE")):
            self.series_of_shear(0.2, speed=speed)
            self.assertIn(word, self.line("V* is spoon-shaped in Bq_s"))
        for ratio in (0.2, 1, 3, 5, 10):
            self.run_at(ratio, 0, speed=0.36 + abs(ratio - 3) / 100)
        self.assertIn("inside", self.line("V* is spoon-shaped in lambda"))

    def test_spans_are_judged_once_the_matrix_is_whole(self):
        rows = [row for row in chapter_4.gathered.rows_of(CASE) if row["membrane.viscous.boussinesq_dilatational"] == "0"]
        for number, row in enumerate(rows):
            share = number / (len(rows) - 1)
            place = float(row["flow.viscosity_ratio"]), float(row["membrane.viscous.boussinesq_shear"])
            if number == len(rows) - 1:
                self.assertIn("shown only", self.line("V*, least"))
            self.run_at(*place, speed=0.273 + share * (0.456 * 1.04 - 0.273), circumference=0.9935 + share * (1.1196 * 0.98 - 0.9935))
        for words, word in (("V*, least", "inside"), ("V*, most", "inside"), ("C*, least", "inside"), ("C*, most", "OUTSIDE")):
            self.assertIn(word, self.line(f"{words} of {len(rows)} runs"))
        self.assertEqual(len(case_results.draw(self.output, self.case)), 6)

    def test_judges_volume_and_dilatational_viscosity(self):
        self.run_at(1, 0, deformation=0.4)
        self.run_at(1, 0, 40, deformation=0.4 * 1.019, inclination=20 * 0.979, volume=1.0021)
        self.assertIn("OUTSIDE", self.line("volume, farthest", "l1-bqs0-bqd40", "+0.21 %"))
        self.assertIn("inside", self.line("Bq_d = 40 alone: D"))
        self.assertIn("OUTSIDE", self.line("Bq_d = 40 alone: inclination"))
        self.run_at(1, 40, 40)
        self.assertIn("fig-4.10.png", {file.name for file in case_results.draw(self.output, self.case)})

    def test_says_which_viscosity_ratio_a_membrane_viscosity_amounts_to(self):
        for ratio in (0.2, 1, 3, 5, 10):
            self.run_at(ratio, 0, deformation=0.45 - 0.02 * ratio, inclination=25 - 2 * ratio)
        self.run_at(1, 20, deformation=0.45 - 0.02 * 4.25, inclination=25 - 2 * 9.5, membrane=3.0, inner=2.0)
        self.run_at(1, 40, deformation=0.1, inclination=25 - 2 * 2.0)
        cells = [line.split() for line in self.judged()[1].splitlines()]
        self.assertIn(["20", "4.25", "9.50", "2.50"], cells)
        self.assertIn(["40", "2.00", "1.00"], cells)  # D is below that of all runs without membrane viscosity

    def test_says_over_what_range_the_inclination_goes_at_one_deformation(self):
        # D = 0.24 on the line between the first two at 15 degrees, and between the first and the third at 10.
        self.run_at(1, 0, deformation=0.28, inclination=20)
        self.run_at(1, 10, deformation=0.20, inclination=10)
        self.run_at(10, 0, deformation=0.20, inclination=0)
        self.assertIn("10 to 15", self.line("inclination where D is 0.24"))

    def test_keeps_what_was_read(self):
        self.run_at(1, 10, membrane=0.8, inner=1.6)
        header, row = chapter_4.measured(self.output, self.case)["readings.csv"].splitlines()
        cells = dict(zip(header.split(","), row.split(",")))
        self.assertEqual([cells[name] for name in ("run", "boussinesq_shear", "deformation", "dissipation_ratio")], ["l1-bqs10", "10", "0.4", "0.5"])

    def test_holds_a_finer_grid_against_the_matrix_without_judging_it(self):
        self.run_at(1, 0, deformation=0.433, frequency=0.335, circumference=1.1015, speed=0.33243 * 1.1015)
        before = self.judged()
        write_run(self.output / "l1-bqs0-60", deformation=0.44, inclination=21.0, frequency=0.36, end=15.0, planned=15.0)
        write_run(self.output / "l1-bqs0-120", deformation=0.462, inclination=20.0, frequency=0.37, end=15.0, planned=15.0)
        code, text = self.judged()
        self.assertEqual((code, text[: len(before[1])]), before)
        cells = self.line("l1-bqs0-120: D").split()
        self.assertEqual(cells[2:], ["10", "to", "15", "0.4620", "0.4400", "+5.00", "%", "0.4330", "0.4330", "0.4546", "0.4330", "shown", "only"])
        self.assertEqual(self.line("l1-bqs0-120: inclination").split()[5:], ["20.00", "21.00", "-1.0000", "20.00", "20.00", "19.00", "23.30", "shown", "only"])
        # Samples a quarter of a shear time apart: 625 times as far as those of a run, whose error is below 1e-7.
        self.assertAlmostEqual(float(self.line("l1-bqs0-120: nu* (marker)").split()[6]), 0.37, delta=6e-5)
        self.assertEqual([r.run for r in chapter_4.gathered.gather(self.output, self.case).readings], ["l1-bqs0"])
        self.assertIn("l1-bqs0-120,15,", chapter_4.measured(self.output, self.case)["histories.csv"])

    def test_a_mean_has_the_steps_next_to_its_ends(self):
        """Kept are whole steps, some of them a little later than the time that they stand for; the last of a run among them."""
        times = numpy.array([9.749, 9.998, 10.251, 10.502])
        history = chapter_4.gathered.histories.History("made", {"shear_time": times, "deformation": numpy.array([1.0, 2.0, 4.0, 9.0])})
        self.assertEqual(history.mean("deformation", 10, 10.5), 5)
        self.assertEqual(history.mean("deformation", 10, 10.25), 3)
        self.assertTrue(numpy.isnan(history.mean("deformation", 20, 21)))

    def test_says_that_nothing_is_there(self):
        self.assert_refused("no finished run", case_results.judge, self.output, self.case)


class Case(unittest.TestCase):
    def test_rows_are_the_matrix_in_the_order_of_their_worth(self):
        rows = chapter_4.gathered.rows_of(CASE)
        places = list(chapter_4._wanted(CASE))
        self.assertEqual(len(places), len(rows))
        self.assertEqual([place[0] for place in places[:5]], [1, 10, 5, 0.2, 3])
        matrix = {(ratio, shear, 0.0) for ratio in (0.2, 1, 3, 5, 10) for shear in (0, 2, 5, 10, 20, 30, 40)}
        self.assertEqual({place for place in places if place[2] == 0}, matrix)
        for row in rows:
            viscous = row["membrane.viscous.boussinesq_shear"] != "0" or row["membrane.viscous.boussinesq_dilatational"] != "0"
            self.assertEqual(row["membrane.viscous.scheme"], "implicit" if viscous else "")

    def test_fine_runs_are_of_places_in_the_matrix_and_start_alike(self):
        rows, places = chapter_4.gathered.rows_of(CASE, fine=True), chapter_4._wanted(CASE)
        found = {}
        for row in rows:
            place = chapter_4._place_of(CASE, row)
            self.assertIn(place, places)
            box = json.loads(row["flow.box"] or "[60]")[0]
            radius = float(row["capsule.0.radius"] or 60 / (2 * math.pi))
            self.assertAlmostEqual(radius, box / (2 * math.pi), delta=1e-13)
            # Re = g a^2/nu goes as U0 L, where the radius goes as L.
            found.setdefault(place, []).append((box, float(row["flow.wall_speed"]) * box))
        for sizes in found.values():
            (fine, first), (coarse, second) = sorted(sizes, reverse=True)
            self.assertEqual((fine, coarse), (120, 60))
            self.assertAlmostEqual(first / second, 1, delta=1e-15)

    def test_printed_numbers_are_of_runs_that_are_there(self):
        places = chapter_4._wanted(CASE)
        for row in reference.read_table(CASE / "reference/printed.csv"):
            self.assertIn((float(row["viscosity_ratio"]), float(row["bq_s"]), 0.0), places)
            self.assertIn(row["quantity"], chapter_4.verdicts.NAMES)


if __name__ == "__main__":
    unittest.main()
