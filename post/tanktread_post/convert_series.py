"""The membranes of a run, membrane.pvd, as one XDMF time series and as tables."""

import contextlib
import pathlib

import meshio
import numpy

from . import series, whole_file
from .observables import InputError
from .surface_files import read_mesh

COMPONENTS = {3: "xyz", 9: ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz")}
LABELS = ("node", "triangle", "node_1", "node_2", "node_3")  # columns of whole numbers
LARGEST_IN_PARAVIEW = 400_000  # numbers of an array: libxml2, which ParaView reads XDMF with, stops at 10^7 characters; 25 each


def convert(output, target, tables=None, force=False):
    """Writes `target` (.xdmf) and, into the new folder `tables`, two tables a time; the lines to print.

    One time is in memory at once as numbers, all of them as text: meshio writes the file at its end.
    @throws InputError; nothing is written then
    """
    entries = _entries(output)
    _require_places(target, tables, force)
    with contextlib.ExitStack() as stack:
        temporary = stack.enter_context(whole_file.writing(target))
        folder = None if tables is None else stack.enter_context(whole_file.writing(tables))
        largest = _write(entries, temporary, folder)
    lines = [f"{target}: {len(entries)} times, shear time {entries[0][0]:g} to {entries[-1][0]:g}"]
    if tables is not None:
        lines.append(f"{tables}: times.csv, and points and cells of each time")
    if largest > LARGEST_IN_PARAVIEW:
        lines.append(f"an array has {largest} numbers: ParaView reads at most 10 MB of text an array from XDMF; open membrane.pvd there")
    return lines


def _entries(output):
    file = pathlib.Path(output) / "membrane.pvd"
    if not file.is_file():
        raise InputError(f"{file}: there is no such file; is {output} the output of a run?")
    entries = series.read_files(file)  # a file that is named again is the same membrane
    if not entries:
        raise InputError(f"{file}: it lists no files; the run has not written a membrane yet")
    return entries


def _require_places(target, tables, force):
    if pathlib.Path(target).suffix.lower() not in (".xdmf", ".xmf"):
        raise InputError(f"{target}: its name must end with .xdmf or .xmf")
    whole_file.require_place(target, force)
    if tables is not None:
        whole_file.require_empty(tables)


def _write(entries, target, folder):
    """Every time into the series, and its tables into the folder; how many numbers the largest array has."""
    if folder is not None:
        folder.mkdir()
    triangles, times, largest = None, [], 0
    # As text ("XML") it is one file. meshio's "Binary" writes into the present folder, "HDF" needs h5py.
    with meshio.xdmf.TimeSeriesWriter(target, data_format="XML") as writer:
        for time, file in entries:
            mesh = _read(file, triangles)
            triangles = mesh.cells[0].data
            _add(writer, time, mesh)
            largest = max([largest, mesh.points.size, *(blocks[0].size for blocks in mesh.cell_data.values())])
            if folder is not None:
                name = file.stem.removeprefix("membrane_")
                _write_tables(folder, name, mesh)
                times.append((mesh.field_data.get("step", [numpy.nan])[0], time, f"points_{name}.csv", f"cells_{name}.csv"))
    if folder is not None:
        _write_times(folder / "times.csv", times)
    return largest


def _read(file, triangles):
    """A membrane_STEP.vtu or .pvtu, of the same triangles as the one before."""
    mesh = read_mesh(file)
    if [block.type for block in mesh.cells] != ["triangle"]:
        raise InputError(f"{file}: it is not a surface of triangles only")
    if triangles is not None and not numpy.array_equal(triangles, mesh.cells[0].data):
        raise InputError(f"{file}: its triangles differ from those of the time before; a series has the same ones at all times")
    return mesh


def _add(writer, time, mesh):
    """One time. meshio's writer refers all times to one geometry, its reader reads the first one only; a membrane moves, so each
    time gets a geometry of its own, for ParaView, and the array `position`, for meshio."""
    writer.has_mesh = True
    writer.write_data(time, {"position": mesh.points, **mesh.point_data}, mesh.cell_data)
    grid = writer.collection[-1]
    grid.remove(grid[0])  # the reference to the one geometry
    grid.set("Name", "membrane")
    grid.set("GridType", "Uniform")
    writer.points(grid, mesh.points)
    writer.cells(mesh.cells, grid)


def _columns(name, values):
    """{name of a column: its numbers} of an array with one or more components."""
    values = numpy.asarray(values).reshape(len(values), -1)
    n = values.shape[1]
    labels = [name] if n == 1 else [f"{name}_{label}" for label in COMPONENTS.get(n, range(1, n + 1))]
    return dict(zip(labels, values.T))


def _write_tables(folder, name, mesh):
    """points_NAME.csv and cells_NAME.csv."""
    points = {"node": numpy.arange(len(mesh.points)), **dict(zip("xyz", mesh.points.T))}
    for array, values in mesh.point_data.items():
        points |= _columns(array, values)
    corners = mesh.cells[0].data
    cells = {"triangle": numpy.arange(len(corners)), **dict(zip(LABELS[2:], corners.T))}
    for array, blocks in mesh.cell_data.items():
        cells |= _columns(array, blocks[0])
    _write_table(folder / f"points_{name}.csv", points)
    _write_table(folder / f"cells_{name}.csv", cells)


def _write_table(file, columns):
    """17 significant digits, which name one double only."""
    forms = ["%d" if name in LABELS else "%.17g" for name in columns]
    rows = numpy.column_stack(list(columns.values()))
    numpy.savetxt(file, rows, fmt=forms, delimiter=",", header=",".join(columns), comments="")


def _write_times(file, times):
    """When each table is: step, shear_time and the names of the two files."""
    rows = [f"{step:.17g},{time!r},{points},{cells}" for step, time, points, cells in times]
    file.write_text("\n".join(["step,shear_time,points,cells", *rows]) + "\n")
