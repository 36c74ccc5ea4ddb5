"""How fast a stretched red cell comes back: the fit of Hochmuth, Worthy and Evans (Biophys. J. 26, 101, 1979) to its length over its width.

A membrane of shear modulus G_s and shear viscosity mu_s that is let go from L/W = q_0 and ends at w has, at the time t,

    L/W = w (Q + exp(-t/t_c))/(Q - exp(-t/t_c)),   Q = (q_0 + w)/(q_0 - w),   t_c = mu_s/G_s,

which is (L/W - w)/(L/W + w) = exp(-t/t_c)/Q. t_c, q_0 and w are those of least squares of L/W, every point with the same weight. Their
errors are standard deviations: what errors of the points that know nothing of each other, as large as the residuals, make of them.
A series of a simulation has other errors than that: what it says of the form is `rms`.
"""

import dataclasses

import numpy
import scipy.optimize

from .observables import InputError


@dataclasses.dataclass(frozen=True)
class Relaxation:
    """A fit, in the unit of time of its series. `..._error`: standard deviations; 0 for what was given."""

    time: float  # t_c
    start: float  # q_0, at t = 0
    end: float  # w
    time_error: float
    start_error: float
    end_error: float
    rms: float  # of the residuals of L/W
    points: int

    def at(self, t):
        """L/W at the times t."""
        return length_over_width(t, self.time, self.start, self.end)


def length_over_width(t, time, start, end):
    """L/W at the times t since the release."""
    # Q times its denominator q_0 - w, so that q_0 = w is L/W = w at all times.
    decay = (start - end) * numpy.exp(-numpy.asarray(t, dtype=float) / time)
    return end * (start + end + decay) / (start + end - decay)


def fit_relaxation(t, ratio, end=None):
    """The fit to L/W = ratio at the times t since the release. `end`: w, where it is known.

    InputError: fewer points than four (three with an end); times that do not grow or begin before 0; L/W that is not positive or not
    above its end at first; a series too short or too rough to tell its time from its end."""
    t, ratio = numpy.array(t, dtype=float), numpy.array(ratio, dtype=float)
    _check_series(t, ratio, end)
    last = ratio[-1] if end is None else end
    if not ratio[0] > last:
        raise InputError(f"L/W = {ratio[0]:g} at first and {last:g} in the end: it must fall")
    # In logarithms, so that none of them is ever negative.
    guess = [_time_to_halve(t, ratio, last) / numpy.log(2), ratio[0], last][: 3 if end is None else 2]
    known = [] if end is None else [end]

    def residuals(logarithms):
        return length_over_width(t, *numpy.exp(logarithms), *known) - ratio

    found = scipy.optimize.least_squares(residuals, numpy.log(guess), xtol=1e-14, ftol=1e-14, gtol=1e-14)
    values = numpy.exp(found.x)
    free = len(t) - len(values)
    square = float(numpy.sum(found.fun**2))
    information = found.jac.T @ found.jac
    if not found.success or numpy.linalg.cond(information) > 1e12:
        raise InputError(f"L/W over {len(t)} points does not tell how fast it falls and where it ends: give the end, or a longer series")
    errors = values * numpy.sqrt(numpy.diag(numpy.linalg.inv(information)) * square / free)
    time, start, w = [*values, *known]
    time_error, start_error, end_error = [*errors, *([] if end is None else [0.0])]
    return Relaxation(
        float(time), float(start), float(w), float(time_error), float(start_error), float(end_error), float(numpy.sqrt(square / len(t))), len(t)
    )


def _check_series(t, ratio, end):
    """InputError unless they are a series that a fit can be made to."""
    least = 4 if end is None else 3
    if t.ndim != 1 or t.shape != ratio.shape or len(t) < least:
        raise InputError(f"{t.size} times and {ratio.size} values of L/W: there must be as many of both, and at least {least}")
    if not (numpy.isfinite(t).all() and numpy.isfinite(ratio).all()) or t[0] < 0 or (numpy.diff(t) <= 0).any():
        raise InputError("times since the release must be numbers from 0 on that grow, and L/W must be numbers")
    if (ratio <= 0).any() or (end is not None and not 0 < end < numpy.inf):
        raise InputError("L/W and its end must be > 0")


def _time_to_halve(t, ratio, last):
    """When L/W is first halfway between its first value and its last."""
    halfway = numpy.nonzero(ratio <= (ratio[0] + last) / 2)[0]
    return t[halfway[0]] if len(halfway) and t[halfway[0]] > 0 else t[-1] / 2
