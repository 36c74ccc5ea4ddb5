"""How fast something turns: the mean angular velocity over whole periods of an angle that is known at times."""

import math

import numpy


def _crossing(times, phase, value):
    """When a phase that grows in the mean was last at a value: by the cubic through the four samples around, whose error is of fourth order."""
    before = int(numpy.flatnonzero(phase <= value)[-1])
    first = min(max(before - 1, 0), len(times) - 4)
    around = slice(first, first + 4)
    return times[before] + numpy.polynomial.polynomial.polyfit(phase[around] - value, times[around] - times[before], 3)[0]


def mean_turning(times, angle, period, longest):
    """The mean size of the velocity of a continuous angle (radians), over as many whole periods as there are, up to the end, in the last `longest` of the
    times; NaN without one. Within a period the velocity may be any."""
    start = angle[times >= times[-1] - longest][0]
    phase = numpy.sign(angle[-1] - start) * (angle - angle[-1])  # grows to 0
    n_periods = math.floor(abs(angle[-1] - start) / period)
    if n_periods < 1 or len(times) < 4:
        return math.nan
    return float(n_periods * period / (times[-1] - _crossing(times, phase, -n_periods * period)))


def turning_frequency(times, along_flow, along_gradient, longest):
    """nu* = 2 pi/(g T) of a marker that goes round a centre, times in shear times: mean_turning of its angle over half turns, for a steady shape looks
    the same from its other end."""
    return mean_turning(times, numpy.unwrap(numpy.arctan2(along_gradient, along_flow)), math.pi, longest)
