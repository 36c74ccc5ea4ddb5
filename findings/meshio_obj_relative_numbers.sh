#!/usr/bin/env bash
# meshio counts the relative node numbers of an .obj file from the wrong place.
#
# Package: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# In a Wavefront .obj file a face may name its corners from the latest vertex back: -1 is the last one that stands above it.
# meshio subtracts 1 from every number, negative ones too, and keeps them negative. To numpy -1 is the last of all points, so
# that a face gets other corners than it has. Both triangles here come out as the same one, and neither is right.
#
# Seen:
# | in the file: triangles 0 1 2 and 3 4 5
# | as meshio reads: [[-4, -3, -2], [-4, -3, -2]]
# | which are to numpy the points [[2, 3, 4], [2, 3, 4]]
#
# What we do: post/tanktread_post/text_surfaces.py reads .obj, and counts from the latest vertex back.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio
import numpy

with open("a.obj", "w") as file:
    for z in (0, 1):
        file.write(f"v 0 0 {z}\nv 1 0 {z}\nv 0 1 {z}\nf -3 -2 -1\n")
triangles = meshio.read("a.obj").cells[0].data
print("in the file: triangles 0 1 2 and 3 4 5")
print(f"as meshio reads: {triangles.tolist()}")
print(f"which are to numpy the points {numpy.arange(6)[triangles].tolist()}")
END
as_seen "$python" check.py
