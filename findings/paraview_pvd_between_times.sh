#!/usr/bin/env bash
# At a time between two files ParaView shows the next file of a .pvd series, but the last one of every other kind of series.
#
# Packages: paraview and python3-paraview 5.11.0+dfsg-1+b1. Downloads some 80 MB.
#
# Three files for the times 0, 1 and 2, whose data say which they are, as a .pvd, as a .vtu.series, as a list of files and as XDMF. When
# ParaView is asked for time 0.1 the .pvd gives the file of time 1, the others that of time 0. So a scene of two .pvd series of which
# one has fewer files shows that one ahead of the other; and the same data behave in another way when they are opened by the other list.
#
# Seen:
# | time asked for:  -1 0 0.1 0.9 1 1.1 2 3
# | .pvd:            0 0 1 1 1 2 2 2
# | .vtu.series:     0 0 0 0 1 1 2 2
# | list of files:   0 0 0 0 1 1 2 2
# | XDMF:            0 0 0 0 1 1 2 2
#
# What we do: driver/run/output_series.hpp: both series of a run have an entry at each time at which either has a file.
source "$(dirname "$0")/packages.bash"
need paraview=5.11.0+dfsg-1+b1 python3-paraview=5.11.0+dfsg-1+b1

cat >check.py <<'END'
import json

from paraview import simple

TIMES = (-1, 0, 0.1, 0.9, 1, 1.1, 2, 3)
VTU = """<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="time" format="ascii">{0} {0} {0}</DataArray></PointData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
"""
GRID = """<Grid Name="triangle" GridType="Uniform"><Time Value="{0}"/>
<Topology TopologyType="Triangle" NumberOfElements="1"><DataItem DataType="Int" Dimensions="1 3" Format="XML">0 1 2</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem Dimensions="3 3" Format="XML">0 0 0 1 0 0 0 1 0</DataItem></Geometry>
<Attribute Name="time" Center="Node"><DataItem Dimensions="3" Format="XML">{0} {0} {0}</DataItem></Attribute></Grid>
"""


def write(name, text):
    with open(name, "w") as file:
        file.write(text)


for k in range(3):
    write(f"t_{k}.vtu", VTU.format(k))
sets = "".join(f'<DataSet timestep="{k}" file="t_{k}.vtu"/>' for k in range(3))
write("t.pvd", f'<VTKFile type="Collection" version="0.1"><Collection>{sets}</Collection></VTKFile>')
files = [{"name": f"t_{k}.vtu", "time": k} for k in range(3)]
write("t.vtu.series", json.dumps({"file-series-version": "1.0", "files": files}))
grids = "".join(GRID.format(k) for k in range(3))
collection = f'<Grid GridType="Collection" CollectionType="Temporal">{grids}</Grid>'
write("t.xdmf", f'<?xml version="1.0"?><Xdmf Version="3.0"><Domain>{collection}</Domain></Xdmf>')


def shown(source):
    found = []
    for time in TIMES:
        source.UpdatePipeline(time)
        data = simple.servermanager.Fetch(source)
        while data.IsA("vtkMultiBlockDataSet"):
            data = data.GetBlock(0)
        found.append(f"{data.GetPointData().GetArray('time').GetValue(0):g}")
    return " ".join(found)


print(f"time asked for:  {' '.join(f'{time:g}' for time in TIMES)}")
print(f".pvd:            {shown(simple.OpenDataFile('t.pvd'))}")
print(f".vtu.series:     {shown(simple.OpenDataFile('t.vtu.series'))}")
print(f"list of files:   {shown(simple.XMLUnstructuredGridReader(FileName=[f't_{k}.vtu' for k in range(3)]))}")
print(f"XDMF:            {shown(simple.OpenDataFile('t.xdmf'))}")
END
as_seen pvpython --no-mpi check.py
