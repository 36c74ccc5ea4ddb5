#!/usr/bin/env bash
# meshio does not read the version 4.0 of the MSH format that Gmsh writes, though it has a reader of it.
#
# Packages: gmsh 4.8.4+ds2-3, python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# "gmsh -format msh40" names the version "4" in the head of the file, not "4.0". meshio takes "4" for 4.1, which has another layout,
# and stops at a part that the file does not have. With "4.0" in the head the same file is read. meshio itself writes "4.0".
#
# Seen:
# | gmsh -format msh22: the head says 2.2 0 8; meshio reads 4 triangles
# | gmsh -format msh40: the head says 4 0 8; meshio: ReadError, parametric nodes not implemented
# | gmsh -format msh41: the head says 4.1 0 8; meshio reads 4 triangles
# | the second with 4.0 0 8: meshio reads 4 triangles
#
# What we do: post/tanktread_post/gmsh_surfaces.py tells the two by the numbers before the points, and writes 4.0 into what meshio gets.
source "$(dirname "$0")/packages.bash"
need gmsh=4.8.4+ds2-3 python3-meshio=7.0.0-3

cat >square.geo <<'END'
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("square", 7) = {1};
END
cat >check.py <<'END'
import subprocess

import meshio


def meshio_on(file):
    try:
        return f"meshio reads {sum(len(block.data) for block in meshio.gmsh.read(file).cells)} triangles"
    except Exception as error:
        return f"meshio: {type(error).__name__}, {error}"


for version in ("msh22", "msh40", "msh41"):
    file = version + ".msh"
    subprocess.run(["gmsh", "-2", "square.geo", "-format", version, "-o", file, "-v", "1"], check=True)
    with open(file) as lines:
        text = lines.read()
    print(f"gmsh -format {version}: the head says {text.splitlines()[1]}; {meshio_on(file)}")
    if version == "msh40":
        with open("named.msh", "w") as named:
            named.write(text.replace("4 0 8", "4.0 0 8", 1))
print(f"the second with 4.0 0 8: {meshio_on('named.msh')}")
END
as_seen "$python" check.py
