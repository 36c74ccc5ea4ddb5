"""A neo-Hookean membrane as a program of its own: start from here for a membrane of yours.

tanktread starts it once (membrane.command in case.toml). Each time step it writes the name of a file to our standard
input, with the nodes at their new places, and waits for the name of a file with the forces on them. The protocol and all
arrays: docs/outside-programs.md. What goes wrong here, and what is printed to sys.stderr, is seen on the terminal.
"""

import pathlib
import sys

import meshio
import numpy


def reference_elements(points, triangles):
    """Of each undeformed triangle its area and the gradients of its linear shape functions.

    The gradients (T x 3 corners x 2) are in the plane of the triangle, its first axis along the edge from corner 0 to 1.
    """
    first, second = points[triangles[:, 1]] - points[triangles[:, 0]], points[triangles[:, 2]] - points[triangles[:, 0]]
    length = numpy.linalg.norm(first, axis=1)
    x = (first * second).sum(axis=1) / length
    y = numpy.linalg.norm(numpy.cross(first, second), axis=1) / length
    gradient = numpy.zeros((len(triangles), 3, 2))
    gradient[:, 1] = numpy.stack([1 / length, -x / (y * length)], axis=1)
    gradient[:, 2, 1] = 1 / y
    gradient[:, 0] = -gradient[:, 1] - gradient[:, 2]
    return 0.5 * length * y, gradient


def stress(c, shear_modulus):
    """Second Piola-Kirchhoff stress (T x 2 x 2) of the energy W = G_s/2 (I1 - 1 + 1/(I2 + 1)): the line to change.

    c is the right Cauchy-Green tensor of each triangle, I1 = tr c - 2, I2 = det c - 1; S = 2 dW/dI1 1 + 2 dW/dI2 adj c.
    """
    det = c[:, 0, 0] * c[:, 1, 1] - c[:, 0, 1] * c[:, 1, 0]
    adjugate = numpy.trace(c, axis1=1, axis2=2)[:, None, None] * numpy.eye(2) - c
    return shear_modulus * (numpy.eye(2) - adjugate / det[:, None, None] ** 2)


def nodal_forces(points, triangles, area, gradient, shear_modulus):
    """The force on each node (N x 3), minus the derivative of the energy by its place; sums to zero."""
    deformation = numpy.einsum("tcx,tca->txa", points[triangles], gradient)  # F = dx/dX, 3 x 2
    c = numpy.einsum("txa,txb->tab", deformation, deformation)  # F^T F
    piola = deformation @ stress(c, shear_modulus)
    corners = -area[:, None, None] * numpy.einsum("txa,tca->tcx", piola, gradient)
    sums = [numpy.bincount(triangles.ravel(), corners[:, :, axis].ravel(), len(points)) for axis in range(3)]
    return numpy.stack(sums, axis=1)


def main():
    elements = None
    for line in sys.stdin:  # ends when the run ends
        packet = pathlib.Path(line.rstrip("\n"))
        mesh = meshio.read(packet)
        triangles = mesh.cells_dict["triangle"]
        if elements is None:
            elements = reference_elements(mesh.point_data["reference_position"], triangles)
        force = nodal_forces(mesh.points, triangles, *elements, mesh.field_data["shear_modulus"][0])
        # Further arrays put into point_data or cell_data would come back in the next packet, and after a restart.
        reply = meshio.Mesh(mesh.points, mesh.cells, point_data={"total_force": force})
        reply.write(packet.with_name("output.vtu"), compression=None)
        print(packet.with_name("output.vtu"), flush=True)


if __name__ == "__main__":
    main()
