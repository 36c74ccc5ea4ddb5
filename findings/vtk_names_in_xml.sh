#!/usr/bin/env bash
# VTK and meshio write .vtu files that no reader opens, if the name of an array has one of XML's own characters.
#
# Packages: python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1, python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# Both put the name of an array into the XML as it is; "&" and "<" are not well-formed there. Both writers report success, and
# neither of them reads the file again. ">" is well-formed, and meshio reads it; but VTK's reader looks for the numbers after the
# first ">", so where they follow at once (VTK's binary and ASCII modes, all that meshio writes) it does not find them. In each case
# VTK's reader says so on the standard error only: its error code is 0, and its output has no points.
#
# Seen:
# | name p & q, by VTK, appended (Write() = 1): VTK reads 0 points, error code 0; meshio ParseError
# | name p & q, by VTK, binary (Write() = 1): VTK reads 0 points, error code 0; meshio ReadError
# | name p & q, by meshio: VTK reads 0 points, error code 0; meshio ReadError
# | name p < q, by VTK, appended (Write() = 1): VTK reads 0 points, error code 0; meshio ParseError
# | name p < q, by VTK, binary (Write() = 1): VTK reads 0 points, error code 0; meshio ReadError
# | name p < q, by meshio: VTK reads 0 points, error code 0; meshio ReadError
# | name p > q, by VTK, appended (Write() = 1): VTK reads 3 points, error code 0; meshio 3 points
# | name p > q, by VTK, binary (Write() = 1): VTK reads 0 points, error code 0; meshio 3 points
# | name p > q, by meshio: VTK reads 0 points, error code 0; meshio 3 points
#
# What we do: exchange/vtk_arrays.cpp refuses such names before anything is written.
source "$(dirname "$0")/packages.bash"
need python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk


def by_vtk(name, mode):
    points = vtk.vtkPoints()
    for k in range(3):
        points.InsertNextPoint(k, k * k, 0)
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(vtk.VTK_TRIANGLE, 3, [0, 1, 2])
    array = numpy_to_vtk(numpy.ones(3), deep=True)
    array.SetName(name)
    grid.GetPointData().AddArray(array)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName("a.vtu")
    writer.SetInputData(grid)
    {"appended": writer.SetDataModeToAppended, "binary": writer.SetDataModeToBinary}[mode]()
    return f"VTK, {mode} (Write() = {writer.Write()})"


def by_meshio(name):
    triangle = [("triangle", numpy.array([[0, 1, 2]]))]
    meshio.write("a.vtu", meshio.Mesh(numpy.eye(3), triangle, point_data={name: numpy.ones(3)}))
    return "meshio"


def read():
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName("a.vtu")
    reader.Update()
    try:
        found = f"{len(meshio.vtu.read('a.vtu').points)} points"
    except Exception as error:
        found = type(error).__name__
    return f"VTK reads {reader.GetOutput().GetNumberOfPoints()} points, error code {reader.GetErrorCode()}; meshio {found}"


for name in ("p & q", "p < q", "p > q"):
    print(f"name {name}, by {by_vtk(name, 'appended')}: {read()}")
    print(f"name {name}, by {by_vtk(name, 'binary')}: {read()}")
    print(f"name {name}, by {by_meshio(name)}: {read()}")
END
as_seen "$python" check.py
