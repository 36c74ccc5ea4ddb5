#!/usr/bin/env bash
# meshio reads the points of all pieces of a .vtu file, and the cells of the last piece only.
#
# Package: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# A .vtu file may hold its grid in several pieces. The file here has two, of one triangle each. There is no error and no warning:
# the points of both are there, the other triangle is not.
#
# Seen:
# | in the file: 6 points, triangles [0, 1, 2] and [3, 4, 5]
# | as meshio reads: 6 points, triangles [[3, 4, 5]]
#
# What we do: exchange/surface_file.cpp writes one piece; post/tanktread_post/vtk_surfaces.py reads .vtu files by VTK.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio

PIECE = """<Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">{x} 0 0 {x} 1 0 {x} 0 1</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece>
"""
with open("two.vtu", "w") as file:
    file.write('<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>\n')
    file.write(PIECE.format(x=0) + PIECE.format(x=1))
    file.write("</UnstructuredGrid></VTKFile>\n")
mesh = meshio.read("two.vtu")
print("in the file: 6 points, triangles [0, 1, 2] and [3, 4, 5]")
print(f"as meshio reads: {len(mesh.points)} points, triangles {mesh.cells[0].data.tolist()}")
assert len(mesh.cells) == 1
END
as_seen "$python" check.py
