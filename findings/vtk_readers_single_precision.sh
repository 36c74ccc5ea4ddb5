#!/usr/bin/env bash
# VTK's readers of PLY, OBJ and STL round coordinates to single precision, whatever the file holds.
#
# Packages: python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1, python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# meshio writes one triangle in double precision, and each file is read back by both. A PLY file states its type ("property
# double"), the other two are text with all digits. VTK's readers give points of type float without a word; meshio keeps every
# bit. VTK's reader of its own legacy format keeps them too.
#
# Seen:
# | .ply (binary, double): VTK float, off by 9.93e-09; meshio off by 0
# | .obj (text): VTK float, off by 9.93e-09; meshio off by 0
# | .stl (text): VTK float, off by 9.93e-09; meshio off by 0
# | .vtk (binary, double): VTK double, off by 0; meshio off by 0
#
# What we do: post/tanktread_post/text_surfaces.py and ply_surfaces.py read these formats in double precision.
source "$(dirname "$0")/packages.bash"
need python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio
import numpy
import vtk
from vtk.util.numpy_support import vtk_to_numpy

points = numpy.array([[1 / 3, 0, 0], [1, 0, 0], [0, 1, 0]])
mesh = meshio.Mesh(points, [("triangle", numpy.array([[0, 1, 2]], dtype=numpy.int32))])
for suffix, form, write, read, reader in (
    (".ply", "binary, double", meshio.ply.write, meshio.ply.read, vtk.vtkPLYReader()),
    (".obj", "text", meshio.obj.write, meshio.obj.read, vtk.vtkOBJReader()),
    (".stl", "text", meshio.stl.write, meshio.stl.read, vtk.vtkSTLReader()),
    (".vtk", "binary, double", meshio.vtk.write, meshio.vtk.read, vtk.vtkUnstructuredGridReader()),
):
    file = "a" + suffix
    write(file, mesh)
    reader.SetFileName(file)
    reader.Update()
    array = reader.GetOutput().GetPoints().GetData()
    by_vtk, by_meshio = vtk_to_numpy(array), read(file).points
    print(
        f"{suffix} ({form}): VTK {array.GetDataTypeAsString()}, off by {abs(by_vtk - points).max():.3g}; "
        f"meshio off by {abs(by_meshio - points).max():.3g}"
    )
END
as_seen "$python" check.py
