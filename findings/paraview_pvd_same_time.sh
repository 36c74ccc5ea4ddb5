#!/usr/bin/env bash
# Of two files that a .pvd gives for one time ParaView shows the first, and never the second.
#
# Packages: paraview and python3-paraview 5.11.0+dfsg-1+b1. Downloads some 80 MB.
#
# A program that goes on from a checkpoint and appends to its .pvd has such a pair at the time where it went on, or for all the
# steps that it repeats: what is appended last is not what is seen. Times are compared as text: "1" and "1.0" are two entries in
# the list of times, and yet the second file is not shown at any time.
#
# Seen:
# | times 0 1 1 2 of files a b c d: ParaView lists 0 1 2; at 0 it shows a, at 1 b, at 1.5 d, at 2 d
# | times 0 1 1.0 2 of files a b c d: ParaView lists 0 1 1 2; at 0 it shows a, at 1 b, at 1.5 d, at 2 d
#
# What we do: exchange/series.cpp refuses to write two entries of one time.
source "$(dirname "$0")/packages.bash"
need paraview=5.11.0+dfsg-1+b1 python3-paraview=5.11.0+dfsg-1+b1

cat >check.py <<'END'
from paraview import simple

VTU = """<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Int64" Name="file" format="ascii">{0} {0} {0}</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
"""


def write(name, text):
    with open(name, "w") as file:
        file.write(text)


def shown(source, time):
    source.UpdatePipeline(time)
    data = simple.servermanager.Fetch(source)
    while data.IsA("vtkMultiBlockDataSet"):
        data = data.GetBlock(0)
    return "abcd"[data.GetPointData().GetArray("file").GetValue(0)]


for k, name in enumerate("abcd"):
    write(f"{name}.vtu", VTU.format(k))
for number, times in enumerate((("0", "1", "1", "2"), ("0", "1", "1.0", "2"))):
    sets = "".join(f'<DataSet timestep="{time}" file="{name}.vtu"/>' for time, name in zip(times, "abcd"))
    write(f"{number}.pvd", f'<VTKFile type="Collection" version="0.1"><Collection>{sets}</Collection></VTKFile>')
    source = simple.PVDReader(FileName=f"{number}.pvd")
    source.UpdatePipelineInformation()
    listed = " ".join(f"{time:g}" for time in source.TimestepValues)
    found = [f"{shown(source, time)}" for time in (0, 1, 1.5, 2)]
    print("times {} of files a b c d: ParaView lists {}; at 0 it shows {}, at 1 {}, at 1.5 {}, at 2 {}".format(" ".join(times), listed, *found))
END
as_seen pvpython --no-mpi check.py
