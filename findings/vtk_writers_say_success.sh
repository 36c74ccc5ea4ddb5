#!/usr/bin/env bash
# VTK's writers report success where they wrote nothing.
#
# Package: python3-vtk9 9.1.0+really9.1.0+dfsg2-5+deb12u1
#
# Write() of the XML writers returns 1 for a folder that does not exist and on a full disk (here the device /dev/full, by a link);
# only GetErrorCode() knows. The writer of PLY says in both cases that all is well, by its result and by its error code, and so
# does that of OBJ on a full disk. The writers of STL and of the legacy format return 0, as one would expect.
#
# Seen:
# | vtkXMLUnstructuredGridWriter, no such folder: Write() = 1, error: No such file or directory
# | vtkXMLUnstructuredGridWriter, full disk: Write() = 1, error: No space left on device
# | vtkXMLPolyDataWriter, no such folder: Write() = 1, error: No such file or directory
# | vtkXMLPolyDataWriter, full disk: Write() = 1, error: No space left on device
# | vtkPLYWriter, no such folder: Write() = 1, error: none
# | vtkPLYWriter, full disk: Write() = 1, error: none
# | vtkOBJWriter, no such folder: Write() = 0, error: CannotOpenFileError
# | vtkOBJWriter, full disk: Write() = 1, error: none
# | vtkSTLWriter, no such folder: Write() = 0, error: CannotOpenFileError
# | vtkSTLWriter, full disk: Write() = 0, error: OutOfDiskSpaceError
# | vtkPolyDataWriter, no such folder: Write() = 0, error: CannotOpenFileError
# | vtkPolyDataWriter, full disk: Write() = 0, error: OutOfDiskSpaceError
#
# What we do: exchange/vtk_calls.cpp looks at the error code and at what VTK says besides.
source "$(dirname "$0")/packages.bash"
need python3-vtk9=9.1.0+really9.1.0+dfsg2-5+deb12u1

cat >check.py <<'END'
import os

import vtk


def surface():
    sphere = vtk.vtkSphereSource()
    sphere.Update()
    return sphere.GetOutput()


def grid():
    append = vtk.vtkAppendFilter()
    append.SetInputData(surface())
    append.Update()
    return append.GetOutput()


def attempt(name, data, file):
    writer = getattr(vtk, name)()
    writer.SetFileName(file)
    writer.SetInputData(data)
    outcome = writer.Write()
    code = writer.GetErrorCode()
    return f"Write() = {outcome}, error: {vtk.vtkErrorCode.GetStringFromErrorCode(code) if code else 'none'}"


for name, data in (
    ("vtkXMLUnstructuredGridWriter", grid()),
    ("vtkXMLPolyDataWriter", surface()),
    ("vtkPLYWriter", surface()),
    ("vtkOBJWriter", surface()),
    ("vtkSTLWriter", surface()),
    ("vtkPolyDataWriter", surface()),
):
    print(f"{name}, no such folder: {attempt(name, data, 'absent/a')}")
    os.symlink("/dev/full", "full")
    print(f"{name}, full disk: {attempt(name, data, 'full')}")
    if os.path.lexists("full"):
        os.remove("full")
END
as_seen "$python" check.py
