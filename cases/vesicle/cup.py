#!/usr/bin/python3
"""The start of a stomatocyte: rings of nodes on the meridian of theory, with about the triangles that a level has.
cup.py CUP.vtu LEVEL REDUCED_VOLUME

Edges are h = h_0/sqrt(1 + (c/CURVATURE)^2) long, c the curvature of the meridian, rings sqrt(3)/2 h apart: so the triangles are nearly equilateral, and small
at the mouth, where an icosphere's are forty a ring and long.
"""

import math
import sys

import meshio
import numpy
from tanktread_post.vesicle_shapes import shape

CURVATURE = 4.0  # over that of the sphere of equal area: from there on edges are shorter


def stitched(lower, upper):
    """Triangles between two rings, each a list of nodes at equal azimuths from 0 on: always on to the node of less azimuth."""
    triangles, i, j = [], 0, 0
    while i < len(lower) or j < len(upper):
        a, b = lower[i % len(lower)], upper[j % len(upper)]
        if j == len(upper) or (i < len(lower) and (i + 1) * len(upper) <= (j + 1) * len(lower)):
            triangles.append([a, lower[(i + 1) % len(lower)], b])
            i += 1
        else:
            triangles.append([a, upper[(j + 1) % len(upper)], b])
            j += 1
    return triangles


def ringed(profile, n_triangles):
    """(points, triangles) on a profile, wound outwards if it goes from above to below round the axis."""
    s, r = profile.arc_length, profile.r
    finer = numpy.sqrt(1 + (numpy.gradient(profile.tangent_angle, s) / CURVATURE) ** 2)
    of_area = numpy.trapezoid if hasattr(numpy, "trapezoid") else numpy.trapz
    h = math.sqrt(of_area(2 * math.pi * r * finer**2, s) / (math.sqrt(3) / 4 * n_triangles))
    steps = numpy.concatenate([[0], numpy.cumsum((finer[1:] + finer[:-1]) / 2 * numpy.diff(s))]) / (math.sqrt(3) / 2 * h)
    n_rings = round(steps[-1])
    at = numpy.interp(numpy.arange(1, n_rings) * steps[-1] / n_rings, steps, s)
    points, rings = [[0, 0, profile.z[0]]], []
    for place in at:
        radius, z, finer_here = (float(numpy.interp(place, s, values)) for values in (r, profile.z, finer))
        n = max(4, round(2 * math.pi * radius * finer_here / h))
        rings.append(list(range(len(points), len(points) + n)))
        points += [[radius * math.cos(2 * math.pi * k / n), radius * math.sin(2 * math.pi * k / n), z] for k in range(n)]
    points.append([0, 0, profile.z[-1]])
    triangles = [[0, rings[0][k - 1], rings[0][k]] for k in range(len(rings[0]))]
    for upper, lower in zip(rings, rings[1:]):
        triangles += stitched(lower, upper)
    triangles += [[len(points) - 1, rings[-1][k], rings[-1][k - 1]] for k in range(len(rings[-1]))]
    points, triangles = numpy.array(points, dtype=float), numpy.array(triangles)
    a, b, c = (points[triangles[:, k]] for k in range(3))
    inside_out = numpy.einsum("ij,ij->", a, numpy.cross(b, c)) < 0
    return points, triangles[:, ::-1] if inside_out else triangles


if __name__ == "__main__":
    target, level, reduced_volume = sys.argv[1:]
    points, triangles = ringed(shape("stomatocyte", float(reduced_volume), points=2001), 20 * 4 ** int(level))
    meshio.write(target, meshio.Mesh(points, [("triangle", triangles)]))
