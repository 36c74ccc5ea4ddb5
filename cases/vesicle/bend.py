#!/usr/bin/python3
"""The start of a stomatocyte: a surface of `tanktread mesh spheroid` bent to a cup, z to z + BEND r^2, r the distance from its axis. That keeps
its volume.   bend.py SPHEROID.vtu CUP.vtu BEND"""

import sys

import meshio

if __name__ == "__main__":
    source, target, bend = sys.argv[1:]
    mesh = meshio.read(source)
    mesh.points[:, 2] += float(bend) * (mesh.points[:, 0] ** 2 + mesh.points[:, 1] ** 2)
    meshio.write(target, meshio.Mesh(mesh.points, [("triangle", mesh.cells_dict["triangle"])]))
