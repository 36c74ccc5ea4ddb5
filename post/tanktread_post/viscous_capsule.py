"""The shape of a capsule or a drop with a viscous membrane in shear flow, for small deformation: steady, and of the capsule from rest.

To first order the membrane of a sphere moves in shear flow as a rigid one turns, at g/2, and strains by a second spherical
harmonic. With Y = n.E.n/g, E the rate of strain of the flow, its displacement is a (w Y e_r + v grad_s Y) (grad_s of the unit
sphere). In units of a, of the viscosity mu_o (lambda = 1) and of 1/g:

- Membrane: T = K tr(e) P + 2 G (e - tr(e) P/2) gives the fluid the force f = div_s T,
      f_r = -4 K w + 12 K v along Y e_r,   f_t = 2 K w - (6 K + 4 G) v along grad_s Y.
- Fluid: grad_s Y - 3 Y e_r and grad_s Y + 2 Y e_r are eigenfunctions of the single layer of a sphere (Stokes flow inside and
  out), with the values 2/35 and 1/5.
- The flow without a membrane has (1, 1/2) for (w, v).

Seen from an element, which turns at -1/2, the steady shape turns the other way: harmonics of the shear plane go as exp(i t), so
the membrane answers with the moduli G = G_s + i mu_s, K = K_s + i mu_d, and

    i (w, v) = q_E (1, 1/2) + M(G, K) (w, v),   q_E = i/2 (the complex amplitude (E_xx - E_yy)/2 + i E_xy),

with M the product of the two steps above. D is |w|, and the inclination half its argument. Without viscosity and for Ca to 0, D is
(5/8) Ca_G (3 + G_s/K_s), that of Barthes-Biesel and Rallison (1981), at 45 degrees. The shape is taken to first order in D: Ca_G is
small, while Ca_G Bq need not be.

From rest, with the viscous stress behind a spring (a Maxwell element: it is that of a strain rate r which follows the strain's with the
relaxation time theta), and as seen from the element, where the flow turns as exp(i t),

    d(w, v)/dt = q_E exp(i t) (1, 1/2) + M(G_s, K_s) (w, v) + M(mu_s, mu_d) r,    theta dr/dt = d(w, v)/dt - r.

A drop has a tension gamma in place of the elasticity. On the deformed sphere it makes the force f_r = -4 gamma w and nothing along the
surface, with gamma = 1/Ca; the viscosities work as before on the surface velocity, i (w, v), in which v is not a displacement any more, for
the surface of a drop strains for ever. To second order in Ca at a given Bq that is all there is in the shear plane: the surface velocity also
carries the shape along, and the viscous forces are those of a deformed surface, but both are of second degree in E, whose square
makes the axes of the shear plane longer or shorter alike. So D/Ca and (pi/4 - inclination)/Ca are exact for Ca to 0. Without viscosity both are
35/32: Taylor (1932) and Chaffey and Brenner (1967) for lambda = 1.

An immersed boundary spreads the force over a few grid steps and takes the velocity from as many. There the tangential velocity has a
kink of f_t, and the mean over it is short by loss f_t, loss = C dx/a with the C of docs/kernels.md: so much less is the tangential
mobility. The radial velocity has no kink. That is the first order; kernel_theory.py has the whole mobility of a kernel, which the
functions below take in place of the sharp one.
"""

import cmath
import math

import numpy


def _force(shear, area):
    """The force (f_r, f_t) of a membrane displaced by (w, v)."""
    return numpy.array([[-4 * area, 12 * area], [2 * area, -(6 * area + 4 * shear)]])


def sharp_mobility(loss=0.0):
    """The velocity (w, v) that the fluid takes from a force (f_r, f_t), 2 x 2, less the loss of tangential mobility."""
    to_eigenfunctions = numpy.array([[-1, 2], [1, 3]]) / 5  # of (f_r, f_t)
    velocity = numpy.array([[-3, 2], [1, 1]]) @ numpy.diag([2 / 35, 1 / 5])  # (radial, tangential) of these
    mobility = velocity @ to_eigenfunctions
    mobility[1, 1] -= loss
    return mobility


def _response(force, loss, mobility):
    """M: the velocity (w, v) that the fluid takes from a force that is a matrix times the displacement (w, v)."""
    return (sharp_mobility(loss) if mobility is None else mobility) @ force


FLOW = 0.5j * numpy.array([1, 0.5])  # of the undisturbed flow, in (w, v)


def _shape(w):
    """(D, inclination in degrees)."""
    return abs(w), math.degrees(cmath.phase(w)) / 2


def _steady(force, loss, mobility):
    """(D, inclination in degrees) of what answers a displacement (w, v) exp(i t) with a force that is a matrix times it."""
    w, _ = numpy.linalg.solve(1j * numpy.eye(2) - _response(force, loss, mobility), FLOW)
    return _shape(w)


def steady_state(capillary_number, boussinesq_shear=0.0, boussinesq_dilatational=0.0, area_modulus=3.0, loss=0.0, mobility=None):
    """(D, inclination in degrees). Capillary number by G_s; area_modulus = K_s/G_s (3: Skalak with C = 1, neo-Hookean); loss of
    tangential mobility to an immersed boundary, or the whole mobility (kernel_theory.mobility) in its place."""
    shear = 1 / capillary_number + 1j * boussinesq_shear
    area = area_modulus / capillary_number + 1j * boussinesq_dilatational
    return _steady(_force(shear, area), loss, mobility)


def drop_steady_state(capillary_number, boussinesq_shear=0.0, boussinesq_dilatational=0.0, loss=0.0, mobility=None):
    """(D, inclination in degrees) of a drop. Capillary number by the interfacial tension; at a given Bq both errors are of third order in it.
    loss and mobility as of steady_state."""
    tension = numpy.array([[-4 / capillary_number, 0], [0, 0]])
    return _steady(tension + _force(1j * boussinesq_shear, 1j * boussinesq_dilatational), loss, mobility)


def start_up(shear_time, capillary_number, boussinesq_shear, spring_relaxation_time, area_modulus=3.0, loss=0.0, mobility=None):
    """(D, inclination in degrees) at a shear time, from a sphere at rest in the developed flow. spring_relaxation_time is
    tau_s g = mu_s g/k_s', positive, of which theta is the double; the membrane has no dilatational viscosity. loss and mobility as of steady_state."""
    one = numpy.eye(2)
    elastic = _response(_force(1 / capillary_number, area_modulus / capillary_number), loss, mobility)
    viscous = _response(_force(boussinesq_shear, 0), loss, mobility)
    rate = 1 / (2 * spring_relaxation_time)
    # Of (w, v) and r, turned with the flow, whose forcing is constant then.
    growth = numpy.block([[elastic, viscous], [rate * elastic, rate * (viscous - one)]]) - 1j * numpy.eye(4)
    forcing = numpy.concatenate([FLOW, rate * FLOW])
    values, modes = numpy.linalg.eig(growth)
    amplitudes = numpy.linalg.solve(modes, forcing)
    w = (modes @ (numpy.expm1(values * shear_time) / values * amplitudes))[0]
    return _shape(w)
