#!/usr/bin/env bash
# meshio.read ends the whole program where it cannot read a file.
#
# Package: python3-meshio 7.0.0-3 (it calls itself meshio 5.0.0)
#
# A .vtu file with a text in its field data, as VTK writes a vtkStringArray, is valid; meshio does not read it. Its function read()
# catches its own ReadError, prints it and calls sys.exit: what follows is a SystemExit, which "except Exception" does not catch.
# A script that reads many files ends at the first one that it cannot read, whatever it does about errors. The reader of the
# format itself (meshio.vtu.read) throws ReadError.
#
# Seen:
# | meshio.vtu.read: ReadError, Illegal data type 'String'.
# | meshio.read:
# | Illegal data type 'String'.
# | not an Exception, but SystemExit(1)
#
# What we do: post/tanktread_post/surface_files.py and gmsh_surfaces.py call the readers of the formats; exchange/content_hash.hpp
# keeps a hash as numbers, since text would be refused.
source "$(dirname "$0")/packages.bash"
need python3-meshio=7.0.0-3

cat >check.py <<'END'
import meshio

with open("a.vtu", "w") as file:
    file.write(
        """<VTKFile type="UnstructuredGrid" version="0.1" byte_order="LittleEndian"><UnstructuredGrid>
<FieldData><DataArray type="String" Name="title" NumberOfTuples="1" format="ascii">97 98 0</DataArray></FieldData>
<Piece NumberOfPoints="3" NumberOfCells="1">
<Points><DataArray type="Float64" NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0</DataArray></Points>
<Cells><DataArray type="Int64" Name="connectivity" format="ascii">0 1 2</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">3</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">5</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>
"""
    )
try:
    meshio.vtu.read("a.vtu")
except Exception as error:
    print(f"meshio.vtu.read: {type(error).__name__}, {error}")
print("meshio.read:")
try:
    meshio.read("a.vtu")
except Exception as error:
    print(f"{type(error).__name__}, {error}")
except BaseException as error:
    print(f"not an Exception, but {error!r}")
END
as_seen "$python" check.py
