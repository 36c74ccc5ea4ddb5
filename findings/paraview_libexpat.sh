#!/usr/bin/env bash
# Debian's ParaView reads no VTK file with appended data any more, not even its own, since a security update of libexpat.
#
# Packages: paraview and python3-paraview 5.11.0+dfsg-1+b1, libexpat1 2.5.0-1+deb12u2; for comparison
# python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1. Downloads some 80 MB.
#
# ParaView writes a sphere, and reads it again. In its default mode, with the numbers appended after the XML, it stops where they
# begin, whether they are raw ("not well-formed (invalid token)") or base64 ("junk after document element"); its source is empty then, and
# pvpython goes on. With the numbers inside the XML it reads the file. The VTK of the same Debian release reads all of them, with the same
# libexpat. With libexpat1 2.5.0-1+deb12u1 ParaView did too, and with +deb12u5 it does not.
#
# Seen:
# | ParaView, raw: not well-formed (invalid token), 0 points
# | ParaView, base64: junk after document element, 0 points
# | ParaView, binary: 50 points
# | VTK 9.1.0, raw: 50 points
# | VTK 9.1.0, base64: 50 points
# | VTK 9.1.0, binary: 50 points
#
# What we do: README.md (From a clone to a picture in ParaView) and post/paraview/output_scene.py name the cause.
source "$(dirname "$0")/packages.bash"

cat >in_paraview.py <<'END'
import sys

from paraview import simple

name, mode, encoded = sys.argv[1:]
simple.SaveData(f"{name}.vtp", proxy=simple.Sphere(), DataMode=mode, EncodeAppendedData=int(encoded))
reader = simple.XMLPolyDataReader(FileName=[f"{name}.vtp"])
reader.UpdatePipeline()
print(f"{simple.servermanager.Fetch(reader).GetNumberOfPoints()} points")
END
cat >in_vtk.py <<'END'
import vtk

for name in ("raw", "base64", "binary"):
    reader = vtk.vtkXMLPolyDataReader()
    reader.SetFileName(f"{name}.vtp")
    reader.Update()
    print(f"VTK {vtk.vtkVersion.GetVTKVersion()}, {name}: {reader.GetOutput().GetNumberOfPoints()} points")
END

# Each in a root of its own, since ParaView brings a VTK of its own. Of ParaView: what it says of the XML, and what it has read.
paraview() (
  root=$folder/paraview
  need paraview=5.11.0+dfsg-1+b1 python3-paraview=5.11.0+dfsg-1+b1
  unpack libexpat1=2.5.0-1+deb12u2
  while read -r name mode encoded; do
    pvpython --no-mpi in_paraview.py "$name" "$mode" "$encoded" >log 2>&1 </dev/null
    echo "ParaView, $name: $(grep -oE 'not well-formed.*token\)|junk after document element' log | sed 's/$/, /')$(grep -E '^[0-9]+ points' log)"
  done <<<$'raw Appended 0\nbase64 Appended 1\nbinary Binary 0'
)
vtk() (
  root=$folder/vtk
  need python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1
  unpack libexpat1=2.5.0-1+deb12u2
  "$python" in_vtk.py
)
check() {
  paraview && vtk
}
as_seen check
