#!/usr/bin/env bash
# meshio writes a wrong .vtu file from triangles whose node numbers are of a small integer type.
#
# Package: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# Node numbers up to 32767 fit into 16 bits, and numpy keeps what it is given. meshio gives the array "offsets", the end of each
# triangle in the list of corners, the type of the node numbers: of int16 it overflows from 10923 triangles on (3 x 10923 = 32769).
# There is no error and no warning, and what is read back are other triangles. With int64, numpy's own choice, all is well.
#
# Seen:
# | 10922 triangles on 5463 points, int16: the same triangles come back
# | 10924 triangles on 5464 points, int16: others come back
# | 10924 triangles on 5464 points, int64: the same triangles come back
#
# What we do: post/tanktread_post/surface_files.py makes node numbers int64 (int32 for .ply) before it writes.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio
import numpy


def closed_strip(n_triangles):
    """A closed surface: a double cone over a polygon of n/2 corners."""
    n = n_triangles // 2
    corner = numpy.arange(n)
    following = (corner + 1) % n
    angle = 2 * numpy.pi * corner / n
    ring = numpy.stack([numpy.cos(angle), numpy.sin(angle), 0 * angle], axis=1)
    points = numpy.concatenate([ring, [[0, 0, 1], [0, 0, -1]]])
    upper = numpy.stack([corner, following, numpy.full(n, n)], axis=1)
    lower = numpy.stack([following, corner, numpy.full(n, n + 1)], axis=1)
    return points, numpy.concatenate([upper, lower])


for n_triangles, kind in ((10922, numpy.int16), (10924, numpy.int16), (10924, numpy.int64)):
    points, triangles = closed_strip(n_triangles)
    meshio.write("a.vtu", meshio.Mesh(points, [("triangle", triangles.astype(kind))]))
    cells = meshio.read("a.vtu").cells
    same = len(cells) == 1 and numpy.array_equal(cells[0].data, triangles)
    print(
        f"{n_triangles} triangles on {len(points)} points, {numpy.dtype(kind)}: "
        + ("the same triangles come back" if same else "others come back")
    )
END
as_seen "$python" check.py
