"""Where a quantity goes as a parameter of the runs goes to 0: the straight line (least squares) through what was measured."""

import math

import numpy


def line(x, y):
    """(value at x = 0, gradient) of the line through the points; NaN with fewer than two different x."""
    if len(set(x)) < 2:
        return math.nan, math.nan
    gradient, at_zero = numpy.polyfit(x, y, 1)
    return float(at_zero), float(gradient)


def intercept(x, y):
    """Where the line through the points meets x = 0; NaN with fewer than two different x."""
    return line(x, y)[0]
