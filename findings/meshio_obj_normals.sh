#!/usr/bin/env bash
# meshio refuses an .obj file with fewer normals than points.
#
# Package: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# Faces of a Wavefront .obj file name a point and a normal each (1//1), and a flat face needs one normal for all its corners:
# drawing programs write a cube with eight points and six normals. meshio takes the normals (and texture coordinates) for data
# of the points, in the order of the file, and throws if there are not as many. If there happen to be as many, they are given to
# the points by their order, whatever the faces say.
#
# Seen:
# | 4 points, 1 normal: ValueError, len(points) = 4, but len(point_data["obj:vn"]) = 1
# | 3 points, 3 normals, the face says 1//3 2//2 3//1: the normal of the first point is [0.0, 0.0, 1.0], in the file [1.0, 0.0, 0.0]
#
# What we do: post/tanktread_post/text_surfaces.py reads .obj, and leaves normals out.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio

with open("square.obj", "w") as file:
    file.write("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvn 0 0 1\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n")
try:
    meshio.read("square.obj")
except Exception as error:
    print(f"4 points, 1 normal: {type(error).__name__}, {error}")
with open("triangle.obj", "w") as file:
    file.write("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 1\nvn 0 1 0\nvn 1 0 0\nf 1//3 2//2 3//1\n")
first = meshio.read("triangle.obj").point_data["obj:vn"][0].tolist()
print(f"3 points, 3 normals, the face says 1//3 2//2 3//1: the normal of the first point is {first}, in the file [1.0, 0.0, 0.0]")
END
as_seen "$python" check.py
