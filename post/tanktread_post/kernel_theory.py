"""What an immersed boundary makes of a capsule or a drop: the mobility of a sphere whose forces are spread, and whose velocity is
taken, with a kernel.

The flow u of a force density b solves mu k^2 u = (I - k k/k^2) b in Fourier space (Stokes flow, lambda = 1). A kernel phi multiplies b
by the product over the axes of its transform p(k) = int phi(r) exp(-i k r) dr when the force is spread, and u once more when
it is interpolated. On a sphere of radius a (grid steps) the forces of the second harmonic are those along the vector harmonics
Y_21 = (grad_s Y + 2 Y e_r)/sqrt(10) and Y_23 = (grad_s Y - 3 Y e_r)/sqrt(15), whose transforms over the sphere are 4 pi a^2 i^j j_j(ka)
times themselves. With the grid seen from all sides alike (the mean over directions, and over the places of the nodes between grid
nodes) the velocity along Y_2j of a force along Y_2l is, in units of a and of mu_o,

    M_jl = (2 a/pi) s_jl t_j t_l int_0^inf j_j(ka) j_l(ka) W(k) dk,    t_1 = sqrt(3/5), t_3 = sqrt(2/5), s = 1 for j = l, else -1,
    W(k) = mean over the directions n of prod over the axes of p(k n_axis)^2,

for (I - n n) takes off Y_2j what lies along the gradient of the harmonic: t_j is what is left. W = 1 gives 1/5 and 2/35 and nothing
between them, the single layer of a sphere (viscous_capsule.py).

The tangential correction adds C dx/a to the tangential mobility, C = 1/2 sum_i sum_j phi(i - s) phi(j - s) |i - j| (mean over the phases s):
what a sheet along the planes of the grid loses. A sphere, which lies in all directions and has nodes at all places, loses a little more in
first order, mean over n of 1/2 int int delta(x) delta(x') |n.(x - x')|.

For a wide box, small deformation and many triangles; the mean over the places holds where nodes are many and go round.
"""

import dataclasses
import functools
import math
import pathlib

import numpy

from .observables import InputError
from .reference import read_table
from .study import column

LARGEST_WAVENUMBER = 4 * math.pi  # a grid step; p^2 of every kernel is below 1e-4 there


@dataclasses.dataclass(frozen=True, eq=False)
class Kernel:
    """A kernel phi by its values at equal distances from 0 to its half-width, `points_per_step` of them a grid step."""

    name: str
    points_per_step: int
    values: numpy.ndarray

    @property
    def half_width(self):
        """Grid steps beyond which phi is 0."""
        return (len(self.values) - 1) / self.points_per_step

    @functools.cached_property
    def _weighted(self):
        """Distances, and phi there times the weights of an integral over both sides, by Simpson's rule: the kinks of all kernels lie
        at halves of a grid step."""
        weights = numpy.full(len(self.values), 2.0)
        weights[1::2] = 4.0
        weights[[0, -1]] = 1.0
        return numpy.arange(len(self.values)) / self.points_per_step, 2 * weights * self.values / (3 * self.points_per_step)

    def transform(self, wavenumber):
        """p(k)."""
        distance, weighted = self._weighted
        return numpy.cos(numpy.multiply.outer(wavenumber, distance)) @ weighted

    def second_moment(self):
        """int phi(r) r^2 dr."""
        distance, weighted = self._weighted
        return float(distance**2 @ weighted)

    def shortfall(self):
        """C: what a kernel takes off the velocity of nodes that push the fluid along their surface, times mu/f (docs/kernels.md)."""
        n = self.points_per_step
        reach = math.ceil(self.half_width)
        nodes = numpy.arange(-reach, reach + 2)
        # Phases in the middle between two of the distances that are known, so that none is met twice.
        phases = (numpy.arange(n) + 0.5) / n
        distance = numpy.abs(nodes[:, None] - phases)
        phi = numpy.interp(distance * n, numpy.arange(len(self.values)), self.values, right=0.0)
        pairs = 0.5 * numpy.abs(nodes[:, None] - nodes)
        return float(numpy.einsum("is,js,ij->", phi, phi, pairs)) / n


def read_kernel(file):
    """The kernel of a table of `tanktread study kernel`."""
    rows = read_table(file)
    distance, values = column(rows, "distance", file), column(rows, "phi", file)
    points = round(1 / distance[1]) if len(distance) > 1 and distance[1] > 0 else 0
    if points < 1 or points % 2 or not numpy.array_equal(distance, numpy.arange(len(distance)) / points):
        raise InputError(f"{pathlib.Path(file)}: its distances must go from 0 in equal steps, an even number of them a grid step")
    return Kernel(rows[0]["kernel"], points, values)


def _gauss(n, low, high):
    """Nodes and weights of Gauss and Legendre for the mean over an interval."""
    x, w = numpy.polynomial.legendre.leggauss(n)
    return low + (high - low) * (x + 1) / 2, w / 2


def direction_mean(kernel, wavenumber):
    """W(k): the mean over the directions of the product of p(k n_axis)^2 over the axes. One octant stands for all."""
    # Between the points of a table: of (1 - p^2)/k^2, which is even where k is small, so that a straight line keeps the first order in 1/a.
    table = numpy.linspace(0, float(numpy.max(wavenumber)), 4001)
    lost = numpy.concatenate([[kernel.second_moment()], (1 - kernel.transform(table[1:]) ** 2) / table[1:] ** 2])

    def along(cosine):
        k = wavenumber * cosine
        return 1 - k**2 * numpy.interp(k, table, lost)

    mean = numpy.zeros_like(wavenumber)
    for z, part in zip(*_gauss(24, 0, 1)):
        across = math.sqrt(1 - z * z)
        for angle, share in zip(*_gauss(24, 0, math.pi / 2)):
            mean += part * share * along(z) * along(across * math.cos(angle)) * along(across * math.sin(angle))
    return mean


def spherical_bessel(order, x):
    """j_1 or j_3, spherical Bessel functions of the first kind; near 0 by their series, whose next term is below 1e-8 of them there."""
    near = x < 0.3
    y = numpy.where(near, 1.0, x)
    sine, cosine = numpy.sin(y), numpy.cos(y)
    if order == 1:
        far, series = sine / y**2 - cosine / y, x / 3 * (1 - x**2 / 10 + x**4 / 280 - x**6 / 15120)
    else:
        far = (15 / y**4 - 6 / y**2) * sine - (15 / y**3 - 1 / y) * cosine
        series = x**3 / 105 * (1 - x**2 / 18 + x**4 / 792 - x**6 / 61776)
    return numpy.where(near, series, far)


def mobility(kernel, radius, corrected=False):
    """The velocity (w, v) of a sphere along (Y e_r, grad_s Y) of a force (f_r, f_t), 2 x 2, in units of a and mu_o; with `corrected` that
    of a run with the tangential correction. radius in grid steps."""
    result = _mobility(kernel, radius).copy()
    if corrected:
        result[1, 1] += kernel.shortfall() / radius
    return result


@functools.cache
def _mobility(kernel, radius):
    """The same without the correction."""
    n = int(LARGEST_WAVENUMBER * radius / 0.05)  # twenty points in the shortest wave of j_j j_l
    wavenumber = (numpy.arange(n) + 0.5) * LARGEST_WAVENUMBER / n
    mean = direction_mean(kernel, wavenumber)
    bessel = {order: spherical_bessel(order, wavenumber * radius) for order in (1, 3)}
    share = {1: math.sqrt(3 / 5), 3: math.sqrt(2 / 5)}

    def element(j, l):
        sign = 1 if j == l else -1
        return 2 * radius / math.pi * sign * share[j] * share[l] * float(numpy.sum(bessel[j] * bessel[l] * mean)) * LARGEST_WAVENUMBER / n

    harmonics = numpy.array([[element(j, l) for l in (1, 3)] for j in (1, 3)])
    # (radial, tangential) of a unit amount of Y_21 and Y_23, columns; and back, for the two are orthonormal where |Y|^2 = 1, |grad_s Y|^2 = 6.
    parts = numpy.array([[2, -3], [1, 1]]) / numpy.sqrt([10, 15])
    back = parts.T @ numpy.diag([1, 6])
    return parts @ harmonics @ back
