"""Whether VTK's reader of grids or surfaces in pieces gives what its reader of one file does. Usage: exchange_pieces.py INDEX WHOLE, of
the suffixes .pvti and .vti, or .pvtu and .vtu."""
import pathlib
import sys

import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLPImageDataReader, vtkXMLPUnstructuredGridReader, vtkXMLUnstructuredGridReader

READERS = {".pvti": vtkXMLPImageDataReader, ".vti": vtkXMLImageDataReader, ".pvtu": vtkXMLPUnstructuredGridReader, ".vtu": vtkXMLUnstructuredGridReader}


def read(file):
    reader = READERS[pathlib.Path(file).suffix]()
    reader.SetFileName(file)
    reader.Update()
    if reader.GetErrorCode():
        sys.exit(f"VTK does not read {file}")
    return reader.GetOutput()


def arrays(data):
    return {data.GetArrayName(k): vtk_to_numpy(data.GetArray(k)) for k in range(data.GetNumberOfArrays())}


def require_same(first, second, names):
    for name in names:
        if first[name].dtype != second[name].dtype or first[name].shape != second[name].shape or first[name].tobytes() != second[name].tobytes():
            sys.exit(f"VTK finds another {name}")


def geometry(data):
    if data.IsA("vtkImageData"):
        return {name: numpy.array(getattr(data, f"Get{name}")()) for name in ("Extent", "Origin", "Spacing")}
    cells = data.GetCells()
    parts = {"points": data.GetPoints().GetData(), "corners": cells.GetConnectivityArray(), "offsets": cells.GetOffsetsArray()}
    return {name: vtk_to_numpy(array) for name, array in parts.items()}


pieces, whole = (read(file) for file in sys.argv[1:])
require_same(geometry(pieces), geometry(whole), geometry(whole))
for data in ("GetPointData", "GetCellData"):
    first, second = (arrays(getattr(grid, data)()) for grid in (pieces, whole))
    if set(first) != set(second):
        sys.exit(f"VTK finds other arrays by {data}")
    require_same(first, second, second)
place = arrays(pieces.GetPointData())["place"]
if pieces.IsA("vtkImageData") and not numpy.array_equal(place, numpy.arange(len(place))):
    sys.exit("VTK finds other places")
require_same(arrays(pieces.GetFieldData()), arrays(whole.GetFieldData()), ("step", "shear_time"))
