"""What the speed of the membrane has to do with shape and inclination: the thesis says of three sketched capsules (Fig. 4.7) that it rises with the
inclination and falls with D."""

import math

import numpy

ALIKE = {"deformation": 0.015, "inclination_deg": 1.0}  # two capsules whose values are no farther apart have the same
TIMES = {"deformation": 0.1, "inclination_deg": 10.0}  # what counts as much, of a difference


def three_alike(readings):
    """(a, b, c) of the runs without a dilatational viscosity: b with the inclination of a and a smaller D, c with the D of a and a larger inclination; of
    all such the three whose differences multiply to the most. Nothing where there are none."""
    matrix = [r for r in readings if r.boussinesq_dilatational == 0 and not math.isnan(r.membrane_speed)]

    def distance(one, other, name):
        return getattr(one, name) - getattr(other, name)

    def farthest(a, name, sign, same):  # a itself where there is none
        return max((r for r in matrix if abs(distance(r, a, same)) <= ALIKE[same]), key=lambda r: sign * distance(r, a, name))

    best, trio = 0.0, ()
    for a in matrix:
        b, c = farthest(a, "deformation", -1, "inclination_deg"), farthest(a, "inclination_deg", 1, "deformation")
        worth = -distance(b, a, "deformation") * distance(c, a, "inclination_deg")
        if worth > best:
            best, trio = worth, (a, b, c)
    return trio


def slopes(readings):
    """(change of V* with 0.1 of D, with 10 degrees) of the plane through the runs without a dilatational viscosity, by least squares; NaN with fewer
    than five of them."""
    matrix = [r for r in readings if r.boussinesq_dilatational == 0 and not math.isnan(r.membrane_speed)]
    if len(matrix) < 5:
        return math.nan, math.nan
    plane = numpy.array([[1, *(getattr(r, name) / unit for name, unit in TIMES.items())] for r in matrix])
    return tuple(numpy.linalg.lstsq(plane, numpy.array([r.membrane_speed for r in matrix]), rcond=None)[0][1:].tolist())
