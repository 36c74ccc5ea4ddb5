#!/usr/bin/env bash
# A surface that a physical group of Gmsh turns round is turned in a .msh of version 2.2, and not in one of version 4.1.
#
# Packages: gmsh 4.8.4+ds2-3, python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# Physical Surface("down", 7) = {-1} asks for surface 1 with its normal the other way. Gmsh writes the triangles turned into version
# 2.2, with the group's number 7. In version 4.1, its default, they are as they were, and only a sign in the section Entities says
# so: -7. meshio does not turn them; it gives them the group -7, which has no name, and the cell set "down" is empty. So the
# direction of the normals and the members of the group depend on the version of the file.
#
# Seen:
# | version 2.2: normals along z -1, groups [7]
# | version 4.1: normals along z 1, groups [-7], cell set "down": 0 triangles
#
# What we do: post/tanktread_post/surface_repair.py winds all triangles so that the volume is positive, and uses no groups.
source "$(dirname "$0")/packages.bash"
need gmsh=4.8.4+ds2-3 python3-meshio=7.0.0-3

cat >square.geo <<'END'
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("down", 7) = {-1};
END
cat >check.py <<'END'
import subprocess

import meshio
import numpy

for version, name in (("msh22", "2.2"), ("msh41", "4.1")):
    subprocess.run(["gmsh", "-2", "square.geo", "-format", version, "-o", "a.msh", "-v", "1"], check=True)
    mesh = meshio.gmsh.read("a.msh")
    (block,) = mesh.cells
    a, b, c = mesh.points[block.data].transpose(1, 0, 2)
    signs = numpy.unique(numpy.sign(numpy.cross(b - a, c - a)[:, 2]))
    groups = numpy.unique(mesh.cell_data["gmsh:physical"][0])
    line = f"version {name}: normals along z {' '.join(f'{sign:g}' for sign in signs)}, groups {groups.tolist()}"
    if "down" in mesh.cell_sets:
        line += f', cell set "down": {sum(len(cells) for cells in mesh.cell_sets["down"])} triangles'
    print(line)
END
as_seen "$python" check.py
