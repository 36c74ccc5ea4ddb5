#!/usr/bin/env bash
# A surface in two physical groups of Gmsh stands twice in a .msh of version 2.2.
#
# Packages: gmsh 4.8.4+ds2-3, python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# In version 2.2 a triangle has one group, and Gmsh writes the triangles once for each group that they are in: twice as many
# triangles, twice the area, every edge in four triangles instead of two. In version 4.1, its default, they stand once. There
# meshio's array gmsh:physical has the first group only; both groups are complete in the cell sets.
#
# Seen:
# | version 2.2: 8 triangles, area 2, groups in gmsh:physical [7, 8], cell sets: none
# | version 4.1: 4 triangles, area 1, groups in gmsh:physical [7], cell sets: one 4, two 4
#
# What we do: post/tanktread_post/surface_repair.py drops triangles with the corners of another one, and says how many.
source "$(dirname "$0")/packages.bash"
need gmsh=4.8.4+ds2-3 python3-meshio=7.0.0-3

cat >square.geo <<'END'
Point(1) = {0, 0, 0, 1}; Point(2) = {1, 0, 0, 1}; Point(3) = {1, 1, 0, 1}; Point(4) = {0, 1, 0, 1};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Line Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("one", 7) = {1}; Physical Surface("two", 8) = {1};
END
cat >check.py <<'END'
import subprocess

import meshio
import numpy

for version, name in (("msh22", "2.2"), ("msh41", "4.1")):
    subprocess.run(["gmsh", "-2", "square.geo", "-format", version, "-o", "a.msh", "-v", "1"], check=True)
    mesh = meshio.gmsh.read("a.msh")
    triangles = numpy.concatenate([block.data for block in mesh.cells])
    a, b, c = mesh.points[triangles].transpose(1, 0, 2)
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
    groups = numpy.unique(numpy.concatenate(mesh.cell_data["gmsh:physical"])).tolist()
    sets = [f"{group} {sum(map(len, mesh.cell_sets[group]))}" for group in ("one", "two") if group in mesh.cell_sets]
    print(
        f"version {name}: {len(triangles)} triangles, area {area:g}, groups in gmsh:physical {groups}, "
        f"cell sets: {', '.join(sets) or 'none'}"
    )
END
as_seen "$python" check.py
