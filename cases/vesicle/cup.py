#!/usr/bin/python3
"""The start of a stomatocyte: a surface of `tanktread mesh spheroid --aspect-ratio 1` laid on the meridian of theory, the share of its area above a node kept.
cup.py SPHERE.vtu CUP.vtu REDUCED_VOLUME"""

import sys

import meshio
import numpy
from tanktread_post.vesicle_shapes import shape


def laid_on(points, profile):
    """Nodes of a unit sphere about the origin on a meridian: polar angle to the arc length with the same area above it, azimuth kept."""
    bands = (profile.r[1:] + profile.r[:-1]) * numpy.diff(profile.arc_length)
    areas = numpy.concatenate([[0], numpy.cumsum(bands)])
    above = (1 - points[:, 2] / numpy.linalg.norm(points, axis=1)) / 2
    s = numpy.interp(above, areas / areas[-1], profile.arc_length)
    across = numpy.hypot(points[:, 0], points[:, 1])
    r = numpy.interp(s, profile.arc_length, profile.r) / numpy.where(across > 1e-9, across, 1)
    return numpy.stack([points[:, 0] * r, points[:, 1] * r, numpy.interp(s, profile.arc_length, profile.z)], axis=1)


if __name__ == "__main__":
    source, target, reduced_volume = sys.argv[1:]
    mesh = meshio.read(source)
    meshio.write(target, meshio.Mesh(laid_on(mesh.points, shape("stomatocyte", float(reduced_volume), points=2001)), [("triangle", mesh.cells_dict["triangle"])]))
