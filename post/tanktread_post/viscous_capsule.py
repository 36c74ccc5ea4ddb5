"""The shape of a capsule or a drop with a viscous membrane in shear flow, for small deformation: steady, and from a sphere at rest.

To first order the membrane of a sphere moves in shear flow as a rigid one turns, at g/2, and strains by a second spherical
harmonic. With Y = n.E.n/g, E the rate of strain of the flow, its displacement is a (w Y e_r + v grad_s Y) (grad_s of the unit
sphere). In units of a, of the viscosity mu_o (lambda = 1) and of 1/g:

- Membrane: T = K tr(e) P + 2 G (e - tr(e) P/2) gives the fluid the force f = div_s T,
      f_r = -4 K w + 12 K v along Y e_r,   f_t = 2 K w - (6 K + 4 G) v along grad_s Y.
- Fluid, of viscosity lambda inside: Stokes flow of the second degree is inside r (2, 1) without a pressure and r^3 (6, 5) with 42 r^2 Y,
  outside r^-4 (-3, 1) without and r^-2 (1, 0) with 2 r^-3 Y (Lamb's solutions, in (w, v)). So on a sphere whose surface moves with u = (w, v) the
  tractions along the outer normal are lambda T_i u inside and T_o u outside,
      T_i = [[13/2, -9], [-3/2, 5]],   T_o = [[-6, 6], [1, -5]].
- The flow without a membrane has u_0 = (1, 1/2), and the traction T_i u_0 on a sphere of its own fluid. What the flow outside differs from it dies away,
  and the force f is the jump of the traction, f = lambda T_i u - T_i u_0 - T_o (u - u_0). So
      u = M f + M (T_i - T_o) u_0,   M = 1/(lambda T_i - T_o),
  of which the second part is 5/(2 lambda + 3) u_0, and u_0 for lambda = 1. There M has the eigenfunctions grad_s Y - 3 Y e_r and grad_s Y + 2 Y e_r of the
  single layer, with the values 2/35 and 1/5.

Seen from an element, which turns at -1/2, the steady shape turns the other way: harmonics of the shear plane go as exp(i t), so
the membrane answers with the moduli G = G_s + i mu_s, K = K_s + i mu_d, and

    i (w, v) = q_E 5/(2 lambda + 3) (1, 1/2) + A(G, K) (w, v),   q_E = i/2 (the complex amplitude (E_xx - E_yy)/2 + i E_xy),

with A = M times the matrix of the membrane's force. D is |w|, and the inclination half its argument. Without viscosity and for Ca to 0, D is
(5/8) Ca_G (3 + G_s/K_s) at every lambda, that of Barthes-Biesel and Rallison (1981), at 45 degrees. For lambda to infinity it is 5/(2 (2 lambda + 3)), along
the flow. The shape is taken to first order in D: Ca_G is small, or lambda large, while Ca_G Bq and Ca_G lambda need not be small.

From rest, with the viscous stress behind a spring (a Maxwell element: it is that of a strain rate r which follows the strain's with the
relaxation time theta), and as seen from the element, where the flow turns as exp(i t),

    d(w, v)/dt = q_E exp(i t) 5/(2 lambda + 3) (1, 1/2) + A(G_s, K_s) (w, v) + A(mu_s, mu_d) r,    theta dr/dt = d(w, v)/dt - r.

A drop has a tension gamma in place of the elasticity. On the deformed sphere it makes the force f_r = -4 gamma w and nothing along the
surface, with gamma = 1/Ca; the viscosities work as before on the surface velocity, i (w, v), in which v is not a displacement any more, for
the surface of a drop strains for ever. To second order in Ca at a given Bq that is all there is in the shear plane: the surface velocity also
carries the shape along, and the viscous forces are those of a deformed surface, but both are of second degree in E, whose square
makes the axes of the shear plane longer or shorter alike. So D/Ca and (pi/4 - inclination)/Ca are exact for Ca to 0. Without viscosity they are
(19 lambda + 16)/(16 (lambda + 1)) and (19 lambda + 16)(2 lambda + 3)/(80 (lambda + 1)), those of Taylor (1932) and of Chaffey and Brenner (1967); for any Ca

    D = (5/2)/(2 lambda + 3)/sqrt(1 + r^2),   tan(2 inclination) = r = 40 (lambda + 1)/((2 lambda + 3)(19 lambda + 16) Ca),

and r is the rate at which a shape that is not the steady one decays.

An immersed boundary spreads the force over a few grid steps and takes the velocity from as many. There the tangential velocity has a
kink of f_t, and the mean over it is short by loss f_t, loss = C dx/a with the C of docs/kernels.md: so much less is the tangential
mobility. The radial velocity has no kink. That is the first order; kernel_theory.py has the whole mobility of a kernel, which the
functions below take in place of the sharp one. Both are known for lambda = 1 only: a contrast of viscosities makes a kink of its own (docs/kernels.md).
"""

import cmath
import math

import numpy

# Tractions along the outer normal, (radial, tangential), of a surface that moves with (w, v): of the fluid inside it, and outside.
INSIDE = numpy.array([[6.5, -9.0], [-1.5, 5.0]])
OUTSIDE = numpy.array([[-6.0, 6.0], [1.0, -5.0]])
FLOW = 0.5j * numpy.array([1, 0.5])  # of the undisturbed flow, in (w, v)


def _force(shear, area):
    """The force (f_r, f_t) of a membrane displaced by (w, v)."""
    return numpy.array([[-4 * area, 12 * area], [2 * area, -(6 * area + 4 * shear)]])


def sharp_mobility(viscosity_ratio=1.0, loss=0.0):
    """The velocity (w, v) that the fluids take from a force (f_r, f_t), 2 x 2, less the loss of tangential mobility."""
    mobility = numpy.linalg.inv(viscosity_ratio * INSIDE - OUTSIDE)
    mobility[1, 1] -= loss
    return mobility


def flow_on_sphere(viscosity_ratio=1.0):
    """The velocity (w, v) that the flow gives to the surface of a sphere of another viscosity, without a force."""
    return numpy.linalg.solve(viscosity_ratio * INSIDE - OUTSIDE, (INSIDE - OUTSIDE) @ FLOW)


def _response(force, viscosity_ratio, loss, mobility):
    """A: the velocity (w, v) that the fluids take from a force that is a matrix times the displacement (w, v)."""
    return (sharp_mobility(viscosity_ratio, loss) if mobility is None else mobility) @ force


def _shape(w):
    """(D, inclination in degrees)."""
    return abs(w), math.degrees(cmath.phase(w)) / 2


def _steady(force, viscosity_ratio, loss, mobility):
    """(D, inclination in degrees) of what answers a displacement (w, v) exp(i t) with a force that is a matrix times it."""
    response = _response(force, viscosity_ratio, loss, mobility)
    w, _ = numpy.linalg.solve(1j * numpy.eye(2) - response, flow_on_sphere(viscosity_ratio))
    return _shape(w)


def _from_rest(growth, forcing, shear_time):
    """(D, inclination in degrees) of dx/dt = growth x + forcing, x = 0 at first and x[0] = w, in the frame that turns with the flow."""
    values, modes = numpy.linalg.eig(growth)
    amplitudes = numpy.linalg.solve(modes, forcing)
    return _shape((modes @ (numpy.expm1(values * shear_time) / values * amplitudes))[0])


def steady_state(capillary_number, boussinesq_shear=0.0, boussinesq_dilatational=0.0, area_modulus=3.0, loss=0.0, mobility=None, viscosity_ratio=1.0):
    """(D, inclination in degrees). Capillary number by G_s; area_modulus = K_s/G_s (3: Skalak with C = 1, neo-Hookean); loss of
    tangential mobility to an immersed boundary, or the whole mobility (kernel_theory.mobility) in its place, both for viscosity_ratio 1."""
    shear = 1 / capillary_number + 1j * boussinesq_shear
    area = area_modulus / capillary_number + 1j * boussinesq_dilatational
    return _steady(_force(shear, area), viscosity_ratio, loss, mobility)


def drop_steady_state(capillary_number, boussinesq_shear=0.0, boussinesq_dilatational=0.0, loss=0.0, mobility=None, viscosity_ratio=1.0):
    """(D, inclination in degrees) of a drop. Capillary number by the interfacial tension; at a given Bq both errors are of third order in it.
    loss and mobility as of steady_state."""
    tension = numpy.array([[-4 / capillary_number, 0], [0, 0]])
    return _steady(tension + _force(1j * boussinesq_shear, 1j * boussinesq_dilatational), viscosity_ratio, loss, mobility)


def start_up(
    shear_time, capillary_number, boussinesq_shear=0.0, spring_relaxation_time=1.0, area_modulus=3.0, loss=0.0, mobility=None, viscosity_ratio=1.0
):
    """(D, inclination in degrees) at a shear time, from a sphere at rest in the developed flow. spring_relaxation_time is
    tau_s g = mu_s g/k_s', positive, of which theta is the double, and means nothing where boussinesq_shear = 0; the membrane has no dilatational
    viscosity. loss and mobility as of steady_state."""
    one, flow = numpy.eye(2), flow_on_sphere(viscosity_ratio)
    elastic = _response(_force(1 / capillary_number, area_modulus / capillary_number), viscosity_ratio, loss, mobility)
    viscous = _response(_force(boussinesq_shear, 0), viscosity_ratio, loss, mobility)
    rate = 1 / (2 * spring_relaxation_time)
    # Of (w, v) and r, turned with the flow, whose forcing is constant then.
    growth = numpy.block([[elastic, viscous], [rate * elastic, rate * (viscous - one)]]) - 1j * numpy.eye(4)
    return _from_rest(growth, numpy.concatenate([flow, rate * flow]), shear_time)


def drop_start_up(shear_time, capillary_number, viscosity_ratio=1.0):
    """(D, inclination in degrees) at a shear time of a drop without interfacial viscosity, from a sphere at rest in the developed flow."""
    decay = 4 / capillary_number * sharp_mobility(viscosity_ratio)[0, 0]
    return _from_rest(numpy.array([[-decay - 1j]]), flow_on_sphere(viscosity_ratio)[:1], shear_time)
