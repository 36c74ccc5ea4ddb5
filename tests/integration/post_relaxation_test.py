"""Tests of relaxation.py on series that are made up."""

import math
import unittest

import numpy

from post_fixture import InFolder
from tanktread_post.relaxation import fit_relaxation, length_over_width

TIMES = numpy.linspace(0, 0.5, 25)
CELLS = ((0.112, 2.01, 1.11), (0.106, 2.19, 1.22), (0.146, 1.94, 1.18), (0.160, 2.01, 1.07))  # t_c in s, L/W at first and in the end


class Form(unittest.TestCase):
    def test_what_falls_is_the_difference_over_the_sum(self):
        # (L/W - w)/(L/W + w), by a factor e a t_c; and it begins and ends where it should.
        time, start, end = CELLS[0]
        ratio = length_over_width(time * numpy.arange(4), time, start, end)
        share = (ratio - end) / (ratio + end)
        numpy.testing.assert_allclose(share[:-1] / share[1:], math.e, rtol=1e-12)
        self.assertAlmostEqual(ratio[0], start, delta=1e-14)
        self.assertAlmostEqual(float(length_over_width(40 * time, time, start, end)), end, delta=1e-14)


class Fit(InFolder):
    def test_an_exact_series_gives_its_numbers_back(self):
        # Rounding of L/W, 1e-16, through the sums of 25 points: far below 1e-9.
        for time, start, end in CELLS:
            fit = fit_relaxation(TIMES, length_over_width(TIMES, time, start, end))
            numpy.testing.assert_allclose((fit.time, fit.start, fit.end), (time, start, end), rtol=1e-9)
            self.assertLess(max(fit.rms, fit.time_error), 1e-9)
            numpy.testing.assert_allclose(fit.at(TIMES), length_over_width(TIMES, time, start, end), rtol=1e-9)

    def test_any_unit_of_time_and_any_times(self):
        for unit in (1e-3, 1e4):
            t = unit * numpy.array([0.01, 0.02, 0.05, 0.06, 0.1, 0.2, 0.31, 0.5])
            fit = fit_relaxation(t, length_over_width(t, unit * 0.112, 2.01, 1.11))
            self.assertAlmostEqual(fit.time / (unit * 0.112), 1, delta=1e-9)

    def test_errors_are_those_of_many_noisy_series(self):
        # 400 series: the standard deviation of (fit - truth)/error is 1, known to 1/sqrt(800) = 0.035; with the error from 22 residuals, and the form not
        # straight at noise of 0.01, up to 1.1. Two to three of these deviations from 1: 0.8 to 1.2. Its mean is 0 to 0.05, and 0.15 where bent.
        truth, noise = numpy.array(CELLS[0]), numpy.random.default_rng(1)
        for known in (None, truth[2]):
            scores, rms = [], []
            for _ in range(400):
                fit = fit_relaxation(TIMES, length_over_width(TIMES, *truth) + 0.01 * noise.standard_normal(len(TIMES)), known)
                scores.append(((fit.time - truth[0]) / fit.time_error, (fit.start - truth[1]) / fit.start_error))
                rms.append(fit.rms)
                self.assertEqual(fit.end_error == 0, known is not None)
            for spread, middle in zip(numpy.std(scores, axis=0), numpy.mean(scores, axis=0)):
                self.assertTrue(0.8 < spread < 1.2, spread)
                self.assertLess(abs(middle), 0.2)
            # Two or three of 25 freedoms go to the fit: sqrt(22/25) = 0.94.
            self.assertAlmostEqual(float(numpy.mean(rms)), 0.01 * math.sqrt((22 if known is None else 23) / 25), delta=3e-4)

    def test_an_end_that_is_known_makes_the_time_better_known(self):
        ratio = length_over_width(TIMES, *CELLS[0]) + 0.01 * numpy.cos(37 * numpy.arange(25))
        self.assertLess(fit_relaxation(TIMES, ratio, end=1.11).time_error, fit_relaxation(TIMES, ratio).time_error)

    def test_another_form_shows_in_the_rms(self):
        # Two times, of 0.05 and 0.3: no single one fits, by more than a thousandth of L/W.
        ratio = 1.1 + 0.5 * numpy.exp(-TIMES / 0.05) + 0.4 * numpy.exp(-TIMES / 0.3)
        self.assertGreater(fit_relaxation(TIMES, ratio).rms, 1e-3)

    def test_series_that_cannot_be_fitted_are_refused(self):
        good = length_over_width(TIMES, *CELLS[0])
        self.assert_refused("at least 4", fit_relaxation, TIMES[:3], good[:3])
        self.assert_refused("as many", fit_relaxation, TIMES, good[:-1])
        self.assert_refused("grow", fit_relaxation, TIMES[::-1], good)
        self.assert_refused("from 0 on", fit_relaxation, TIMES - 1, good)
        self.assert_refused("must be numbers", fit_relaxation, TIMES, numpy.where(TIMES > 0.4, math.nan, good))
        self.assert_refused("> 0", fit_relaxation, TIMES, good - 2)
        self.assert_refused("> 0", fit_relaxation, TIMES, good, -1.0)
        self.assert_refused("must fall", fit_relaxation, TIMES, good[::-1])
        self.assert_refused("must fall", fit_relaxation, TIMES, good, 2.5)
        # A straight line says nothing of its end.
        self.assert_refused("longer series", fit_relaxation, TIMES, 2.0 - 1e-3 * TIMES)


if __name__ == "__main__":
    unittest.main()
