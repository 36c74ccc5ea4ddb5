#!/usr/bin/env bash
# meshio reads the field data of a .vtu file and leaves them out when it writes one.
#
# Package: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# Field data are arrays of the whole file: a time, a step, parameters. A mesh that is read and written again by meshio has lost
# them, without a word; data of points and cells are kept.
#
# Seen:
# | in the file: field data step = 1000, data of points speed, data of cells area
# | read by meshio: field data ['step'], data of points ['speed'], data of cells ['area']
# | written and read by meshio: field data [], data of points ['speed'], data of cells ['area']
#
# What we do: docs/outside-programs.md says where a program that writes by meshio keeps its state.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio

with open("a.vtu", "w") as file:
    file.write(
        """<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<FieldData><DataArray type="Float64" Name="step" NumberOfTuples="1" format="ascii">1000</DataArray></FieldData>
<Piece NumberOfPoints="3" NumberOfCells="1">
<PointData><DataArray type="Float64" Name="speed" format="ascii">1 2 3</DataArray></PointData>
<CellData><DataArray type="Float64" Name="area" format="ascii">0.5</DataArray></CellData>
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
"""
    )


def show(what, mesh):
    arrays = [list(group) for group in (mesh.field_data, mesh.point_data, mesh.cell_data)]
    print("{}: field data {}, data of points {}, data of cells {}".format(what, *arrays))


print("in the file: field data step = 1000, data of points speed, data of cells area")
mesh = meshio.read("a.vtu")
show("read by meshio", mesh)
meshio.write("b.vtu", mesh)
show("written and read by meshio", meshio.read("b.vtu"))
END
as_seen "$python" check.py
