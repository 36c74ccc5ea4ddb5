#!/usr/bin/env bash
# meshio exchanges two arrays of a .vtu file, without a word.
#
# Packages: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0), python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1
#
# VTK writes five arrays on five points as appended raw data, 64-bit lengths, uncompressed. meshio turns these data into base64 array by
# array, gives each array its new offset in the XML at once, and finds the next one by the text of its old offset. Here the old
# offset of the fifth array (192) is the new offset of the fourth, so the fourth is taken for it. Whether this happens depends on
# the lengths of the arrays only: with five arrays it does at 5, 8, 11, 14, ... points. Other lengths end in an error about a shape.
#
# Seen:
# |  4 points, first values of a b c d e as VTK reads: 0 100 200 300 400, as meshio reads: 0 100 200 300 400
# |  5 points, first values of a b c d e as VTK reads: 0 100 200 300 400, as meshio reads: 0 100 200 400 300
# |  6 points, first values of a b c d e as VTK reads: 0 100 200 300 400, as meshio reads: 0 100 200 300 400
# | 11 points, first values of a b c d e as VTK reads: 0 100 200 300 400, as meshio reads: 0 100 200 400 300
#
# What we do: exchange/meshio_padding.hpp: one more array of the right length before all others, where it is needed.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3 python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1

cat >check.py <<'END'
import meshio
import numpy
import vtk
from vtk.util.numpy_support import numpy_to_vtk

NAMES = "abcde"


def write(n_points):
    points = vtk.vtkPoints()
    points.SetDataTypeToDouble()
    for k in range(n_points):
        points.InsertNextPoint(k, k * k, 0)
    grid = vtk.vtkUnstructuredGrid()
    grid.SetPoints(points)
    for k in range(n_points - 2):
        grid.InsertNextCell(vtk.VTK_TRIANGLE, 3, [k, k + 1, k + 2])
    for k, name in enumerate(NAMES):
        array = numpy_to_vtk(100.0 * k + numpy.arange(n_points), deep=True)
        array.SetName(name)
        grid.GetPointData().AddArray(array)
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetFileName("a.vtu")
    writer.SetInputData(grid)
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64()
    writer.Write()


for n_points in (4, 5, 6, 11):
    write(n_points)
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName("a.vtu")
    reader.Update()
    data = reader.GetOutput().GetPointData()
    by_vtk = [f"{data.GetArray(name).GetValue(0):g}" for name in NAMES]
    mesh = meshio.read("a.vtu")
    by_meshio = [f"{mesh.point_data[name][0]:g}" for name in NAMES]
    print(f"{n_points:2} points, first values of {' '.join(NAMES)} as VTK reads: {' '.join(by_vtk)}, as meshio reads: {' '.join(by_meshio)}")
END
as_seen "$python" check.py
