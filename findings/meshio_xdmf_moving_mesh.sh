#!/usr/bin/env bash
# meshio reads an XDMF series of a mesh that moves as one that stands still.
#
# Packages: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0), paraview and python3-paraview 5.11.0+dfsg-1+b1. Downloads some 80 MB.
#
# In the file each time has points of its own. ParaView moves them. meshio's TimeSeriesReader gives the points of the first time and
# the data of all times, without a word: its interface has no place for the rest. Its TimeSeriesWriter cannot write them either;
# all times refer to one geometry.
#
# Seen:
# | first point: in the file x = 0 1 2
# | by meshio: points of x = 0, data of x = 0 1 2
# | by ParaView: points of x = 0 1 2, data of x = 0 1 2
#
# What we do: post/tanktread_post/convert_series.py gives each time a geometry of its own, and its positions as data besides.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3 paraview=5.11.0+dfsg-1+b1 python3-paraview=5.11.0+dfsg-1+b1

cat >by_meshio.py <<'END'
import meshio

GRID = """<Grid Name="triangle" GridType="Uniform"><Time Value="{0}"/>
<Topology TopologyType="Triangle" NumberOfElements="1"><DataItem DataType="Int" Dimensions="1 3" Format="XML" Precision="8">0 1 2</DataItem></Topology>
<Geometry GeometryType="XYZ"><DataItem DataType="Float" Dimensions="3 3" Format="XML" Precision="8">{0} 0 0 9 0 0 0 9 0</DataItem></Geometry>
<Attribute Name="x" AttributeType="Scalar" Center="Node"><DataItem DataType="Float" Dimensions="3" Format="XML" Precision="8">{0} 9 0</DataItem></Attribute>
</Grid>
"""
with open("a.xdmf", "w") as file:
    file.write('<Xdmf Version="3.0"><Domain><Grid Name="series" GridType="Collection" CollectionType="Temporal">')
    file.write("".join(GRID.format(k) for k in range(3)) + "</Grid></Domain></Xdmf>")
print("first point: in the file x = 0 1 2")
with meshio.xdmf.TimeSeriesReader("a.xdmf") as reader:
    points, _ = reader.read_points_cells()
    data = [reader.read_data(k)[1]["x"][0] for k in range(reader.num_steps)]
print(f"by meshio: points of x = {points[0][0]:g}, data of x = {' '.join(f'{x:g}' for x in data)}")
END
cat >by_paraview.py <<'END'
from paraview import simple

source = simple.OpenDataFile("a.xdmf")
points, data = [], []
for time in range(3):
    source.UpdatePipeline(time)
    found = simple.servermanager.Fetch(source)
    points.append(f"{found.GetPoint(0)[0]:g}")
    data.append(f"{found.GetPointData().GetArray('x').GetValue(0):g}")
print(f"by ParaView: points of x = {' '.join(points)}, data of x = {' '.join(data)}")
END
check() {
  "$python" by_meshio.py
  pvpython --no-mpi by_paraview.py
}
as_seen check
