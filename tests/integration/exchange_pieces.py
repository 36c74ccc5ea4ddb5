"""Whether VTK's reader of grids in pieces gives what its reader of one file does. Usage: exchange_pieces.py INDEX.pvti WHOLE.vti"""
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPImageDataReader


def read(reader, file):
    reader.SetFileName(file)
    reader.Update()
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


def require_same(first, second, names):
    for name in names:
        if first[name].shape != second[name].shape or first[name].tobytes() != second[name].tobytes():
            sys.exit(f"VTK finds another {name}")


pieces, whole = read(vtkXMLPImageDataReader(), sys.argv[1]), read(vtkXMLImageDataReader(), sys.argv[2])
for frame in ("GetExtent", "GetOrigin", "GetSpacing"):
    if getattr(pieces, frame)() != getattr(whole, frame)():
        sys.exit(f"VTK finds another frame: {frame}")
first, second = arrays(pieces.GetPointData()), arrays(whole.GetPointData())
if set(first) != set(second) or not numpy.array_equal(first["place"], numpy.arange(len(first["place"]))):
    sys.exit("VTK finds other arrays")
require_same(first, second, second)
require_same(arrays(pieces.GetFieldData()), arrays(whole.GetFieldData()), ("step", "shear_time"))
