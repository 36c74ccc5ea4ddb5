"""Axisymmetric vesicles of least bending energy at a given reduced volume, by their shape equations.

The energy E = kappa_b/2 int h^2 dA of the sum of the principal curvatures h = c_1 + c_2 (Helfrich's, no spontaneous curvature; the Gaussian
part is constant) has at a given area A and volume V extrema of E + Sigma A + P V, with a tension Sigma and P the pressure outside less that inside.
Unit of length is the radius of the sphere of the same area, so that A = 4 pi and V = 4 pi/3 v; Sigma is in kappa_b, P in kappa_b too,
over the square and the cube of that radius. Energies are over 8 pi kappa_b, that of a sphere.

The profile (r, z) begins at a pole on the axis; s is the arc length along it, psi the angle of its tangent with dr/ds = cos psi, dz/ds = -sin psi.
Both principal curvatures are q = sin psi/r and dpsi/ds = h - q. With gamma, the multiplier of dr/ds = cos psi, the Euler and Lagrange equations of
2 pi int [r h^2/2 + Sigma r + P/2 r^2 sin psi + gamma (dr/ds - cos psi)] ds (Seifert, Berndl and Lipowsky, Phys. Rev. A 44, 1182, 1991) are

    dpsi/ds = h - q,   dh/ds = gamma q + P/2 r cos psi,   dgamma/ds = h (h - 2 q)/2 + Sigma + P r sin psi.

Written with h they have no pole on the axis, where q = h/2. Area, volume and energy go along as integrals: 2 pi r, pi r^2 sin psi, r h^2/8.
A free length of the profile makes r (c^2 - q^2)/2 - Sigma r - P/2 r^2 sin psi + gamma cos psi = 0, c = h - q, along all of it.
Where gamma = 0 on one pole and r = 0, psi = pi on the other, it is so by itself.

E does not know the size of a shape, so 2 Sigma A + 3 P V = 0; and P is what the energy changes by, d(E/8 pi kappa_b)/dv = -P/6.
For v to 1, where all branches but the stomatocytes begin, Sigma is -6 and P 12: E = 1 + 2 (1 - v). A long prolate is a cylinder of radius
2 v/3 with caps, up to what dies away along it: P = 27/(4 v^3), Sigma = -27/(8 v^2), E = 9/(16 v^2) + 0.49737.

| branch | equator | shapes |
| --- | --- | --- |
| oblate | a plane of symmetry | discocytes; their poles touch at v = 0.5027 |
| prolate | a plane of symmetry | to capped cylinders |
| stomatocyte | none | cups, from the inner pole on; they end at v = 0.661, where they meet shapes of a higher energy |

Of least energy are prolates above v = 0.6511, oblates down to 0.5912, stomatocytes below.
"""

import dataclasses
import functools
import math

import numpy
import scipy.integrate

from .observables import InputError

PSI, H, R, Z, GAMMA, AREA, VOLUME, ENERGY = range(8)  # what is integrated along s

TOLERANCE = 1e-8  # of the equations, as a share of their terms; energies are as exact
ON_THE_WAY = 1e-5  # the same, of the shapes between a first guess and the one wanted
LARGEST_STEP, SMALLEST_STEP = 0.02, 5e-4  # in v, from one shape to the next
LEAST_VOLUME = 0.15  # where the shapes are followed to
MESH = 101  # points that a solution hands on


@dataclasses.dataclass(frozen=True, eq=False)
class Shape:
    """A vesicle. Lengths in the radius of the sphere of equal area; energy over 8 pi kappa_b; tension and pressure (outside less
    inside) in kappa_b over that radius squared and cubed. Arrays along the profile, from pole to pole in equal steps of arc length: z = 0
    halfway between the poles. A stomatocyte begins at its inner pole and opens towards +z."""

    branch: str
    reduced_volume: float
    energy: float
    tension: float
    pressure: float
    arc_length: numpy.ndarray
    r: numpy.ndarray
    z: numpy.ndarray
    tangent_angle: numpy.ndarray  # psi
    curvature_sum: numpy.ndarray  # h = c_1 + c_2, 2 for the sphere


@dataclasses.dataclass(frozen=True, eq=False)
class _Solution:
    """A solution at v on a mesh from 0 (a pole) to 1 (the equator, or the other pole), as scipy has it. parameters: P, Sigma, length."""

    v: float
    share: float  # of the profile: 1/2 to the equator, 1 to the other pole
    mesh: numpy.ndarray
    at: object  # (x) -> the eight, 8 x len(x)
    parameters: numpy.ndarray

    @property
    def energy(self):
        return float(self.at(1.0)[ENERGY]) / self.share

    @property
    def pressure(self):
        return float(self.parameters[0])


def shape(branch, v, points=201, tolerance=TOLERANCE):
    """The shape of reduced volume v on a branch: "oblate", "prolate" or "stomatocyte"; InputError where it has none. Takes a second, some
    below v = 0.3."""
    if branch not in _BEGINNINGS:
        raise InputError(f'branch "{branch}": it must be one of {", ".join(_BEGINNINGS)}')
    if not LEAST_VOLUME <= v < 1:
        raise InputError(f"reduced volume {v}: it must be at least {LEAST_VOLUME} and below 1 (the sphere, of energy 1)")
    solution = _solution(branch, float(v), float(tolerance))
    length = float(solution.parameters[2]) / solution.share
    s = numpy.linspace(0, 1, points)
    beyond = s > solution.share
    y = solution.at(numpy.where(beyond, 1 - s, s) / solution.share)
    end = solution.at(1.0)
    z, psi = y[Z], y[PSI]
    if solution.share < 1:
        z, psi = numpy.where(beyond, end[Z] - z, z - end[Z]), numpy.where(beyond, math.pi - psi, psi)
    else:
        z = z - end[Z] / 2
    return Shape(branch, float(v), solution.energy, float(solution.parameters[1]), solution.pressure, s * length, y[R], z, psi, y[H])


@functools.lru_cache(maxsize=256)
def _solution(branch, v, tolerance):
    """Goes along the branch from where it has a first guess to v. Steps are halved where the next shape is not found."""
    at, step = _BEGINNINGS[branch](v), LARGEST_STEP
    while at.v != v:
        wanted = at.v + max(-step, min(step, v - at.v))
        found = _collocate(wanted, at.share, *_handed_on(at), ON_THE_WAY, 10 * MESH)
        if found is not None and _goes_on(at, found):
            at = found
        elif (step := step / 2) < SMALLEST_STEP:
            raise InputError(f"reduced volume {v}: there is no {branch} of it; the last one found is at {at.v:.4f}")
    exact = _collocate(v, at.share, *_handed_on(at), tolerance, 200 * MESH)
    if exact is None or not _goes_on(at, exact):
        raise InputError(f"reduced volume {v}: its {branch} was not found to the tolerance {tolerance:g}")
    if exact.at(1.0)[Z] >= 0:
        raise InputError(f"reduced volume {v}: there is no {branch} of it, the poles would have passed through each other")
    return exact


def _goes_on(before, after):
    """Whether a shape lies on the branch of another one: the energies differ by -1/6 int P dv, which lies between -P/6 (v - v') of the two ends."""
    dv = after.v - before.v
    miss = after.energy - before.energy + (before.pressure + after.pressure) / 12 * dv
    return abs(miss) <= abs((after.pressure - before.pressure) * dv) / 12 + 20 * ON_THE_WAY


def _handed_on(solution):
    """Mesh, values and parameters to begin the next one from: as fine as before where it was fine, but with MESH points."""
    mesh = numpy.interp(numpy.linspace(0, 1, MESH), numpy.linspace(0, 1, len(solution.mesh)), solution.mesh)
    return mesh, solution.at(mesh), solution.parameters


def _collocate(v, share, mesh, values, parameters, tolerance, most_points):
    """The solution near a guess, or None."""

    def along(_, y, parameters):
        pressure, tension, length = parameters
        on_axis = numpy.abs(y[R]) < 1e-9
        q = numpy.where(on_axis, y[H] / 2, numpy.sin(y[PSI]) / numpy.where(on_axis, 1, y[R]))
        sine, cosine = numpy.sin(y[PSI]), numpy.cos(y[PSI])
        return length * numpy.stack([
            y[H] - q,
            y[GAMMA] * q + pressure / 2 * y[R] * cosine,
            cosine,
            -sine,
            y[H] * (y[H] - 2 * q) / 2 + tension + pressure * y[R] * sine,
            2 * math.pi * y[R],
            math.pi * y[R] ** 2 * sine,
            y[R] * y[H] ** 2 / 8,
        ])  # fmt: skip

    def at_the_ends(pole, end, _):
        # On the equator gamma vanishes, for h is level there and sin psi/r is not 0.
        shut = [end[PSI] - math.pi / 2, end[GAMMA]] if share < 1 else [end[PSI] - math.pi, end[R]]
        whole = [end[AREA] - 4 * math.pi * share, end[VOLUME] - 4 * math.pi / 3 * v * share]
        return numpy.array([*pole[[PSI, R, Z, GAMMA, AREA, VOLUME, ENERGY]], *shut, *whole])

    with numpy.errstate(all="ignore"):  # of a guess that leads nowhere
        found = scipy.integrate.solve_bvp(along, at_the_ends, mesh, values, p=parameters, tol=tolerance, max_nodes=most_points)
    return _Solution(v, share, found.x, found.sol, found.p) if found.success else None


def _near_sphere(v, sign):
    """The oblate (sign -1) or prolate (1) of v, or of 0.95 below that, from the sphere with a second harmonic e P_2(cos psi) to first order."""
    v = max(v, 0.95)
    e = sign * math.sqrt(5 * (1 - v) / 3)
    mesh = numpy.linspace(0, 1, 41)
    t = math.pi / 2 * mesh
    legendre = (3 * numpy.cos(t) ** 2 - 1) / 2
    y = numpy.zeros((8, len(mesh)))
    y[PSI] = t + 3 * e * numpy.sin(t) * numpy.cos(t)
    y[H] = 2 + 4 * e * legendre
    y[R] = (1 + e * legendre) * numpy.sin(t)
    y[Z] = (1 + e * legendre) * numpy.cos(t) - (1 + e)
    y[AREA] = 2 * math.pi * (1 - numpy.cos(t))
    y[VOLUME] = math.pi / 3 * (2 - 3 * numpy.cos(t) + numpy.cos(t) ** 3)
    y[ENERGY] = (1 - numpy.cos(t)) / 2
    return _required(_collocate(v, 0.5, mesh, y, numpy.array([12.0, -6.0, math.pi / 2]), ON_THE_WAY, 10 * MESH))


def _cup(_):
    """The stomatocyte of v = 0.63, from the first terms of its psi = pi x + sum_k b_k sin(k pi x), in two digits, and its multipliers."""
    v, pressure, tension = 0.63, 1.3, -0.41
    sines = numpy.array([-1.49, -1.16, -0.55, -0.03, 0.22, 0.18, 0.02, -0.09])
    mesh = numpy.linspace(0, 1, MESH)
    orders = math.pi * numpy.arange(1, len(sines) + 1)
    y = numpy.zeros((8, MESH))
    y[PSI] = math.pi * mesh + numpy.sin(numpy.outer(mesh, orders)) @ sines
    r = _integral(numpy.cos(y[PSI]), mesh)
    length = math.sqrt(2 / _integral(r, mesh)[-1])
    y[R] = length * numpy.maximum(r - r[-1] * mesh, 0)  # so that it ends on the axis
    meridian = (math.pi + numpy.cos(numpy.outer(mesh, orders)) @ (orders * sines)) / length
    q = numpy.concatenate([meridian[:1], numpy.sin(y[PSI][1:-1]) / y[R][1:-1], meridian[-1:]])
    y[H] = meridian + q
    y[Z] = -length * _integral(numpy.sin(y[PSI]), mesh)
    y[GAMMA] = length * _integral(y[H] * (y[H] - 2 * q) / 2 + tension + pressure * y[R] * numpy.sin(y[PSI]), mesh)
    y[AREA] = 2 * math.pi * length * _integral(y[R], mesh)
    y[VOLUME] = math.pi * length * _integral(y[R] ** 2 * numpy.sin(y[PSI]), mesh)
    y[ENERGY] = length * _integral(y[R] * y[H] ** 2, mesh) / 8
    return _required(_collocate(v, 1.0, mesh, y, numpy.array([pressure, tension, length]), ON_THE_WAY, 10 * MESH))


def _integral(values, mesh):
    """The integral from the first point on, by the trapezoidal rule."""
    return scipy.integrate.cumulative_trapezoid(values, mesh, initial=0)


def _required(solution):
    """That of a guess of ours, which is there with any scipy we know."""
    if solution is None:
        raise ArithmeticError("the first shape of a branch was not found")
    return solution


_BEGINNINGS = {
    "oblate": functools.partial(_near_sphere, sign=-1),
    "prolate": functools.partial(_near_sphere, sign=1),
    "stomatocyte": _cup,
}
