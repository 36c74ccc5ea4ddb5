"""Whether VTK's own writer makes the same file of what it reads in one, byte for byte. Usage: exchange_grid_bytes.py FILE.vti."""
import pathlib
import sys
import tempfile

from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter

reader = vtkXMLImageDataReader()
reader.SetFileName(sys.argv[1])
reader.Update()
with tempfile.TemporaryDirectory() as folder:
    again = pathlib.Path(folder) / "again.vti"
    writer = vtkXMLImageDataWriter()
    writer.SetInputData(reader.GetOutput())
    writer.SetFileName(str(again))
    writer.SetDataModeToAppended()
    writer.EncodeAppendedDataOff()
    writer.SetCompressorTypeToNone()
    writer.SetHeaderTypeToUInt64()
    writer.Write()
    ours, vtk = pathlib.Path(sys.argv[1]).read_bytes(), again.read_bytes()
if ours != vtk:
    place = next((k for k, (a, b) in enumerate(zip(ours, vtk)) if a != b), min(len(ours), len(vtk)))
    sys.exit(f"VTK writes other bytes from {place} on: {vtk[max(place - 60, 0) : place + 60]!r} in the place of {ours[max(place - 60, 0) : place + 60]!r}")
