"""The flow solver of tanktread as a program in the place of itself: `tanktread fluid` for each step.

Usage: outside_fluid.py TANKTREAD CASE [WHAT STEP]. It remembers nothing: the populations are in its packets. From that step
on it does what is said, one of CHANGES or `die`.
"""

import pathlib
import subprocess
import sys

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkIOXML import vtkXMLImageDataReader, vtkXMLImageDataWriter


def read(file):
    reader = vtkXMLImageDataReader()
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def write(grid, file):
    writer = vtkXMLImageDataWriter()
    writer.SetFileName(str(file))
    writer.SetInputData(grid)
    writer.Write()


def put(grid, name, values):
    """Adds an array to the points, or replaces it."""
    array = numpy_to_vtk(values, deep=True)
    array.SetName(name)
    grid.GetPointData().AddArray(array)


def values_of(grid, name):
    return vtk_to_numpy(grid.GetPointData().GetArray(name))


def state_of(packet):
    """The state that `tanktread fluid` goes on from; its force is that of the step before, which a step does not look at."""
    state = vtkImageData()
    state.CopyStructure(packet)
    for name in ("populations", "force"):
        state.GetPointData().AddArray(packet.GetPointData().GetArray(name))
    state.GetFieldData().AddArray(packet.GetFieldData().GetArray("step"))
    return state


def next_fields(tanktread, case, packet):
    """Density, velocity and populations after the step that a packet asks for."""
    folder = packet.parent
    command = [tanktread, "fluid", "--case", case, "--set", "flow.command=[]", "--force", packet, "--steps", "1"]
    given = read(packet)
    if given.GetPointData().HasArray("populations"):
        write(state_of(given), folder / "state.vti")
        command += ["--state", folder / "state.vti"]
    subprocess.run([*command, "--out", folder / "next.vti", "--fields", folder / "fields.vti"], check=True)
    fields = read(folder / "fields.vti")
    put(fields, "populations", values_of(read(folder / "next.vti"), "populations"))
    return fields


def with_nan(fields):
    velocity = values_of(fields, "velocity").copy()
    velocity[24 * 24 * 3 + 24 * 2 + 1, 0] = numpy.nan
    put(fields, "velocity", velocity)


CHANGES = {
    "good": lambda fields: None,
    "nan": with_nan,
    "fast": lambda fields: put(fields, "velocity", values_of(fields, "velocity") + numpy.array([0, 0.4, 0])),
    "no-density": lambda fields: fields.GetPointData().RemoveArray("density"),
    "plane": lambda fields: put(fields, "velocity", values_of(fields, "velocity")[:, :2].copy()),
    "float32": lambda fields: put(fields, "velocity", values_of(fields, "velocity").astype(numpy.float32)),
    "moved": lambda fields: fields.SetOrigin(0, 0, 0),
    "late": lambda fields: fields.GetFieldData().GetArray("step").SetValue(0, 99),
}


def main():
    tanktread, case, *rest = sys.argv[1:]
    what, first = (rest[0], int(rest[1])) if rest else ("good", 0)
    for line in sys.stdin:
        packet = pathlib.Path(line.rstrip("\n"))
        fields = next_fields(tanktread, case, packet)
        step = fields.GetFieldData().GetArray("step").GetValue(0)
        if step >= first:
            if what == "die":
                sys.exit(7)
            CHANGES[what](fields)
        write(fields, packet.with_name("reply.vti"))
        print(packet.with_name("reply.vti"), flush=True)


if __name__ == "__main__":
    main()
