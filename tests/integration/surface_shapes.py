"""Surfaces with something about them, for the tests of their conversion."""

import numpy

# The unit cube: points and faces of four corners, counter-clockwise seen from outside.
CUBE_OF_QUADS = (
    numpy.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]], float),
    numpy.array([[0, 3, 2, 1], [4, 5, 6, 7], [0, 1, 5, 4], [2, 3, 7, 6], [0, 4, 7, 3], [1, 2, 6, 5]]),
)


def obj_text(points, faces):
    """A Wavefront OBJ of points and faces, with all digits."""
    rows = ["v " + " ".join(map(repr, map(float, point))) for point in points]
    return "\n".join(rows + ["f " + " ".join(str(node + 1) for node in face) for face in faces]) + "\n"


def soup(points, triangles):
    """Every triangle with corners of its own."""
    return points[triangles].reshape(-1, 3), numpy.arange(3 * len(triangles)).reshape(-1, 3)


def projective_plane():
    """Half an icosahedron with opposite points of its rim made one: closed, but with one side only."""
    angle = 2 * numpy.pi * numpy.arange(5) / 5
    points = numpy.concatenate([[[0, 0, 1]], numpy.stack([numpy.cos(angle), numpy.sin(angle), 0.1 * numpy.arange(5)], axis=1)])
    cap = [[0, k, k % 5 + 1] for k in range(1, 6)]
    return points, numpy.array(cap + [[1, 2, 4], [2, 3, 5], [3, 4, 1], [4, 5, 2], [5, 1, 3]])


def torus(n=8, m=6):
    """n times m nodes round a ring, wound outward."""
    u, v = numpy.meshgrid(2 * numpy.pi * numpy.arange(n) / n, 2 * numpy.pi * numpy.arange(m) / m, indexing="ij")
    points = numpy.stack([(3 + numpy.cos(v)) * numpy.cos(u), (3 + numpy.cos(v)) * numpy.sin(u), numpy.sin(v)], axis=2).reshape(-1, 3)
    i, j = (index.ravel() for index in numpy.indices((n, m)))
    a, b, c, d = i * m + j, (i + 1) % n * m + j, (i + 1) % n * m + (j + 1) % m, i * m + (j + 1) % m
    return points, numpy.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)
