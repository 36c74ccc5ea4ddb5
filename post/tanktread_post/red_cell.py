"""The red cell at rest as Evans and Fung measured it (Microvasc. Res. 4, 335, 1972): its numbers, and those of a cell of given moduli.

At the distance r from the axis its thickness is h = sqrt(1 - x^2) (0.81 + 7.83 x^2 - 4.39 x^4) micrometres, x = r over 3.91 micrometres, and
its surfaces lie at z = +h/2 and -h/2. With x = sin t the profile r(t), z(t) is smooth from the pole (t = 0) to the equator (pi/2), where
the thickness ends with an upright tangent; so Gauss and Legendre's rule in t has all digits of

    V = 2 int pi r^2 (-dz/dt) dt,   A = 2 int 2 pi r w dt,   E/(8 pi kappa_b) = (1/4) int (c_1 + c_2)^2 r w dt,

w = sqrt((dr/dt)^2 + (dz/dt)^2), c_1 = (dz/dt d2r/dt2 - dr/dt d2z/dt2)/w^3 along the profile and c_2 = -dz/dt/(r w) round the axis, positive for
a sphere. The energy is that of Helfrich without spontaneous curvature, kappa_b/2 int (c_1 + c_2)^2 dA.
"""

import dataclasses
import functools
import math

import numpy

from .observables import InputError

MICROMETRE = 1e-6


@dataclasses.dataclass(frozen=True)
class RedCell:
    """A biconcave cell, symmetric about an axis and a plane. Lengths in metres unless told otherwise."""

    radius: float = 3.91 * MICROMETRE  # of its outline
    thickness: tuple = (0.81 * MICROMETRE, 7.83 * MICROMETRE, -4.39 * MICROMETRE)  # coefficients of 1, x^2, x^4

    def scaled(self, factor):
        """The same shape, `factor` times as large."""
        return RedCell(factor * self.radius, tuple(factor * c for c in self.thickness))

    @property
    def diameter(self):
        """Of its outline."""
        return 2 * self.radius

    def thickness_at(self, r):
        """The thickness h at a distance from the axis; 0 beyond the outline."""
        square = numpy.square(numpy.asarray(r) / self.radius)
        return numpy.sqrt(numpy.maximum(1 - square, 0)) * numpy.polynomial.polynomial.polyval(square, self.thickness)

    @property
    def least_thickness(self):
        """In the dimple, on the axis."""
        return self.thickness[0]

    @property
    def largest_thickness(self):
        """Of the rim, where dh/d(x^2) = 0: (1 - y) p' = p/2 with the polynomial p of y = x^2."""
        c_0, c_1, c_2 = self.thickness
        roots = numpy.roots([-2.5 * c_2, 2 * c_2 - 1.5 * c_1, c_1 - c_0 / 2])
        inside = [root.real for root in roots if abs(root.imag) < 1e-12 and 0 < root.real < 1]
        return max(float(self.thickness_at(self.radius * math.sqrt(y))) for y in (0, *inside))

    def profile(self, points=201):
        """(r, z) from the upper pole over the equator to the lower one, at equal steps of t; an odd number of points has the equator."""
        t = numpy.linspace(0, math.pi, points)
        r = self.radius * numpy.sin(t)
        return r, numpy.where(t < math.pi / 2, 1, -1) * self.thickness_at(r) / 2

    @property
    def volume(self):
        """V, m^3."""
        return self._integrals[0]

    @property
    def area(self):
        """A, m^2."""
        return self._integrals[1]

    @property
    def bending_energy(self):
        """E over 8 pi kappa_b, 1 for a sphere; without spontaneous curvature."""
        return self._integrals[2]

    @property
    def radius_of_equal_volume(self):
        """Of the sphere of its volume: the radius that capillary and Boussinesq numbers are counted with."""
        return (3 * self.volume / (4 * math.pi)) ** (1 / 3)

    @property
    def radius_of_equal_area(self):
        """Of the sphere of its area: the unit of vesicle_shapes.py."""
        return math.sqrt(self.area / (4 * math.pi))

    @property
    def reduced_volume(self):
        """v, its volume over that of the sphere of its area."""
        return (self.radius_of_equal_volume / self.radius_of_equal_area) ** 3

    @functools.cached_property
    def _integrals(self):
        """(V, A, E/(8 pi kappa_b))."""
        node, weight = numpy.polynomial.legendre.leggauss(64)
        t, weight = math.pi / 4 * (node + 1), math.pi / 4 * weight
        sine, cosine = numpy.sin(t), numpy.cos(t)
        # z = cos t p(y)/2 with y = sin^2 t, whose derivatives in t are 2 sin t cos t and 2 cos(2 t).
        p = numpy.polynomial.Polynomial(self.thickness)
        y, dy, ddy = sine**2, 2 * sine * cosine, 2 * (cosine**2 - sine**2)
        dp, ddp = p.deriv()(y) * dy, p.deriv(2)(y) * dy**2 + p.deriv()(y) * ddy
        dz = (cosine * dp - sine * p(y)) / 2
        ddz = (cosine * ddp - 2 * sine * dp - cosine * p(y)) / 2
        r, dr, ddr = self.radius * sine, self.radius * cosine, -self.radius * sine
        w = numpy.hypot(dr, dz)
        curvature_sum = (dz * ddr - dr * ddz) / w**3 - dz / (r * w)
        volume = 2 * math.pi * float(weight @ (-(r**2) * dz))
        area = 4 * math.pi * float(weight @ (r * w))
        return volume, area, float(weight @ (curvature_sum**2 * r * w)) / 4


def dimensionless_numbers(
    radius, shear_modulus, shear_rate, viscosity, inner_viscosity, area_modulus=None, bending_modulus=None, membrane_shear_viscosity=0.0
):
    """{name: number} of a cell in SI units: m (radius of equal volume), N/m, 1/s, Pa s, Pa s, N/m, J, N s/m.

    capillary_number mu_o g a/G_s, viscosity_ratio mu_i/mu_o, boussinesq_shear mu_s/(mu_o a), retardation_time mu_s/G_s (in seconds);
    with a bending modulus bending_number kappa_b/(G_s a^2), and foeppl_von_karman_number Y a^2/kappa_b with Young's modulus of the membrane
    Y = 4 K_s G_s/(K_s + G_s), which wants the area modulus K_s (G_s (1 + 2 C) by Skalak's law). InputError unless all are positive (the
    viscosity of the membrane may be 0)."""
    positive = {
        "radius": radius, "shear_modulus": shear_modulus, "shear_rate": shear_rate, "viscosity": viscosity,
        "inner_viscosity": inner_viscosity, "area_modulus": area_modulus, "bending_modulus": bending_modulus,
    }  # fmt: skip
    for name, value in positive.items():
        if value is not None and not 0 < value < math.inf:
            raise InputError(f"{name} = {value}: it must be a number > 0, in SI units")
    if not 0 <= membrane_shear_viscosity < math.inf:
        raise InputError(f"membrane_shear_viscosity = {membrane_shear_viscosity}: it must be a number >= 0, in SI units")
    numbers = {
        "capillary_number": viscosity * shear_rate * radius / shear_modulus,
        "viscosity_ratio": inner_viscosity / viscosity,
        "boussinesq_shear": membrane_shear_viscosity / (viscosity * radius),
        "retardation_time": membrane_shear_viscosity / shear_modulus,
    }
    if bending_modulus is not None:
        numbers["bending_number"] = bending_modulus / (shear_modulus * radius**2)
        if area_modulus is not None:
            young = 4 * area_modulus * shear_modulus / (area_modulus + shear_modulus)
            numbers["foeppl_von_karman_number"] = young * radius**2 / bending_modulus
    return numbers
