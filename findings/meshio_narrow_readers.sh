#!/usr/bin/env bash
# meshio refuses usual variants of STL, PLY and OFF, with words that do not say why; VTK reads those of STL and PLY.
#
# Packages: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0), python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1
#
# One triangle. A text STL must be in small letters and must not end with an empty line. The corners of a PLY must be called vertex_indices,
# not vertex_index, the other name in use. The counts of an OFF must stand on the second line, not behind the word OFF.
#
# Seen:
# | STL: meshio reads 1 triangle, VTK 1
# | STL in capitals: meshio ValueError, could not convert string to float: 'OUTER'; VTK 1
# | STL, an empty line at its end: meshio ValueError, cannot reshape array of size 12 into shape (0); VTK 1
# | PLY, vertex_indices: meshio reads 1 triangle, VTK 1
# | PLY, vertex_index: meshio KeyError, ('uchar', 'int'); VTK 1
# | OFF: meshio reads 1 triangle
# | OFF, counts on its first line: meshio ReadError, Expected the first line to be `OFF`.
#
# What we do: post/tanktread_post/text_surfaces.py and ply_surfaces.py read these formats.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3 python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1

cat >check.py <<'END'
import meshio
import vtk

STL = """solid a
facet normal 0 0 1
outer loop
vertex 0 0 0
vertex 1 0 0
vertex 0 1 0
endloop
endfacet
endsolid a
"""
PLY = """ply
format ascii 1.0
element vertex 3
property double x
property double y
property double z
element face 1
property list uchar int NAME
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""
OFF = "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"
READERS = {
    "STL": (meshio.stl.read, vtk.vtkSTLReader),
    "PLY": (meshio.ply.read, vtk.vtkPLYReader),
    "OFF": (meshio.off.read, None),
}
for name, text in (
    ("STL", STL),
    ("STL in capitals", STL.upper()),
    ("STL, an empty line at its end", STL + "\n"),
    ("PLY, vertex_indices", PLY.replace("NAME", "vertex_indices")),
    ("PLY, vertex_index", PLY.replace("NAME", "vertex_index")),
    ("OFF", OFF),
    ("OFF, counts on its first line", OFF.replace("OFF\n", "OFF ")),
):
    by_meshio, by_vtk = READERS[name[:3]]
    with open("a", "w") as file:
        file.write(text)
    try:
        line = f"{name}: meshio reads {len(by_meshio('a').cells[0].data)} triangle,"
    except Exception as error:
        line = f"{name}: meshio {type(error).__name__}, {error};"
    if by_vtk is not None:
        reader = by_vtk()
        reader.SetFileName("a")
        reader.Update()
        line += f" VTK {reader.GetOutput().GetNumberOfCells()}"
    print(line.rstrip(",;"))
END
as_seen "$python" check.py
