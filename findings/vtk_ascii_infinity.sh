#!/usr/bin/env bash
# VTK does not read the infinity that it writes as ASCII: the whole grid is lost, and the error code is 0.
#
# Packages: python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1, python3-numpy 1:1.24.2-1+deb12u1
#
# In ASCII mode VTK's XML writer puts an infinite value down as "Infinity" and a NaN as "NaN". Its reader takes the NaN and stops
# at "Infinity": the output has no points and no cells, and GetErrorCode() says 0. The only sign is a line on the standard error.
# The sign of -0.0 is lost too; all other values keep every bit.
#
# Seen:
# | ascii    1.0 0.3333333333333333 5e-324: written as 1 0.3333333333333333 5e-324; error code 0, 3 points, the bits are kept
# | ascii    1.0 nan 2.0: written as 1 NaN 2; error code 0, 3 points, the bits are kept
# | ascii    1.0 -0.0 2.0: written as 1 0 2; error code 0, 3 points, the bits are not kept
# | ascii    1.0 inf 2.0: written as 1 Infinity 2; error code 0, 0 points
# | appended 1.0 -0.0 inf: error code 0, 3 points, the bits are kept
#
# What we do: exchange/vtk_calls.cpp writes appended raw numbers, and when it reads, listens to what VTK says besides the error
# code; exchange/file_head.hpp refuses ASCII where every bit counts.
source "$(dirname "$0")/packages.bash"
need python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1 python3-numpy=1:1.24.2-1+deb12u1

cat >check.py <<'END'
import re

import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def grid_of(values):
    points = vtk.vtkPoints()
    for k in range(3):
        points.InsertNextPoint(k, k * k, 0)
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    grid.InsertNextCell(vtk.VTK_TRIANGLE, 3, [0, 1, 2])
    array = numpy_to_vtk(values, deep=True)
    array.SetName("value")
    grid.GetPointData().AddArray(array)
    return grid


def show(mode, *values):
    values = numpy.array(values)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName("a.vtu")
    writer.SetInputData(grid_of(values))
    {"ascii": writer.SetDataModeToAscii, "appended": writer.SetDataModeToAppended}[mode]()
    writer.Write()
    line = f"{mode:8} {' '.join(map(str, values))}:"
    if mode == "ascii":
        with open("a.vtu") as file:
            line += " written as " + " ".join(re.search('Name="value"[^>]*>([^<]*)<', file.read())[1].split()) + ";"
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName("a.vtu")
    reader.Update()
    n_points = reader.GetOutput().GetNumberOfPoints()
    line += f" error code {reader.GetErrorCode()}, {n_points} points"
    if n_points > 0:
        found = vtk_to_numpy(reader.GetOutput().GetPointData().GetArray("value"))
        line += f", the bits are {'kept' if found.tobytes() == values.tobytes() else 'not kept'}"
    print(line)


show("ascii", 1.0, 1 / 3, 5e-324)
show("ascii", 1.0, float("nan"), 2.0)
show("ascii", 1.0, -0.0, 2.0)
show("ascii", 1.0, float("inf"), 2.0)
show("appended", 1.0, -0.0, float("inf"))
END
as_seen "$python" check.py
