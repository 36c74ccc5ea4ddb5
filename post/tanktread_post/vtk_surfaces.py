"""VTK's XML files of cells, .vtu and .vtp, read by VTK: all pieces of them, or nothing.

meshio 5.0.0 keeps only the last piece of a file of several, and refuses file version 2, LZ4, and .vtp.
"""

import xml.parsers.expat

import meshio
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellTypes, vtkGenericCell
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

from .observables import InputError
from .vtk_reading import apart, read_by

READERS = {"UnstructuredGrid": vtkXMLUnstructuredGridReader, "PolyData": vtkXMLPolyDataReader}
CELLS = ("NumberOfCells", "NumberOfVerts", "NumberOfLines", "NumberOfStrips", "NumberOfPolys")
# VTK ends its process when there is no memory for the numbers that a head announces. No file holds so many points in a byte.
MOST_IN_A_BYTE = 100
TRIANGLE_STRIP, PIXEL = 6, 8
# VTK's numbers of cells as meshio calls them; others go by the name of VTK's class.
KINDS = {
    1: "vertex", 3: "line", 5: "triangle", 7: "polygon", 9: "quad", 10: "tetra", 12: "hexahedron", 13: "wedge", 14: "pyramid",
    21: "line3", 22: "triangle6", 23: "quad8", 24: "tetra10", 28: "quad9", 34: "triangle7", 42: "polyhedron",
}  # fmt: skip


def read(file):
    """A meshio.Mesh with all arrays of a .vtu or .vtp."""
    kind, n_points, n_cells = _head(file)
    return apart(lambda: _read(file, kind, n_points, n_cells), file)


def _read(file, kind, n_points, n_cells):
    data = read_by(READERS[kind](), file)
    found = data.GetNumberOfPoints(), data.GetNumberOfCells()
    if found != (n_points, n_cells):
        raise InputError(f"{file}: its head says {n_points} points and {n_cells} cells, VTK reads {found[0]} and {found[1]}; it is damaged")
    blocks, places = _blocks(data) if kind == "UnstructuredGrid" else _blocks_of_surface(data)
    points = vtk_to_numpy(data.GetPoints().GetData()) if n_points else numpy.empty((0, 3))
    cell_data = {name: [values[place] for place in places] for name, values in _arrays(data.GetCellData()).items()}
    return meshio.Mesh(points, blocks, point_data=_arrays(data.GetPointData()), cell_data=cell_data, field_data=_arrays(data.GetFieldData()))


class _HeadIsRead(Exception):
    """The rest of a file is numbers, which need not be XML."""


def _head(file):
    """(kind of data, points, cells) as the head says: over all pieces."""
    kind, pieces = [], []

    def starts(name, attributes):
        if name == "VTKFile":
            kind.append(attributes.get("type"))
        elif name == "Piece":
            pieces.append((int(attributes["NumberOfPoints"]), sum(int(attributes.get(key, 0)) for key in CELLS)))
        elif name == "AppendedData":
            raise _HeadIsRead

    parser = xml.parsers.expat.ParserCreate()
    parser.StartElementHandler = starts
    try:
        with open(file, "rb") as stream:
            parser.ParseFile(stream)
    except _HeadIsRead:
        pass
    except xml.parsers.expat.ExpatError as error:
        raise InputError(f"{file}: it is not VTK's XML ({error}); it is damaged, cut off, or of another format") from None
    except (KeyError, ValueError):
        raise InputError(f"{file}: a piece does not say how many points and cells it has; it is damaged") from None
    wanted = "PolyData" if file.suffix.lower() == ".vtp" else "UnstructuredGrid"
    if kind != [wanted]:
        said = " ".join(map(str, kind)) or "nothing"
        other = "; its name must end with .vtp" if kind == ["PolyData"] else "; its name must end with .vtu" if kind == ["UnstructuredGrid"] else ""
        raise InputError(f"{file}: it holds {said}, where its name says {wanted}{other}")
    n_points, n_cells = (sum(piece[k] for piece in pieces) for k in (0, 1))
    if min((min(piece) for piece in pieces), default=0) < 0 or max(n_points, n_cells) > MOST_IN_A_BYTE * file.stat().st_size:
        raise InputError(f"{file}: its head says {n_points} points and {n_cells} cells, which a file of {file.stat().st_size} bytes cannot hold; it is damaged")
    return wanted, n_points, n_cells


def _arrays(data):
    """{name: numbers} of the arrays that have a name and hold numbers."""
    arrays = (data.GetArray(k) for k in range(data.GetNumberOfArrays()))
    return {array.GetName(): vtk_to_numpy(array) for array in arrays if array is not None and array.GetName()}


def _name(kind):
    """How a kind of cell is called; that of a curved face begins with triangle or quad."""
    if kind in KINDS:
        return KINDS[kind]
    name, cell = vtkCellTypes.GetClassNameFromTypeId(kind).removeprefix("vtk"), vtkGenericCell()
    cell.SetCellType(kind)
    if cell.GetCellDimension() != 2 or kind in (PIXEL, TRIANGLE_STRIP):
        return name
    return f"{'triangle' if 'Triangle' in name else 'quad'} ({name})"


def _cells(array):
    """(node numbers, where each cell begins among them, and their end)."""
    return vtk_to_numpy(array.GetConnectivityArray()), vtk_to_numpy(array.GetOffsetsArray())


def _blocks(grid):
    """([(kind, C x n nodes)], [the cells of each block]): a block ends where the kind or the number of corners changes."""
    if grid.GetNumberOfCells() == 0:
        return [], []
    nodes, offsets = _cells(grid.GetCells())
    kinds, lengths = vtk_to_numpy(grid.GetCellTypesArray()), numpy.diff(offsets)
    ends = numpy.flatnonzero((numpy.diff(kinds) != 0) | (numpy.diff(lengths) != 0)) + 1
    blocks, places = [], []
    for first, last in zip([0, *ends], [*ends, len(kinds)]):
        kind, data = kinds[first], nodes[offsets[first] : offsets[last]].reshape(last - first, -1)
        name, data, owners = _as_faces(kind, data)
        blocks.append((name, data))
        places.append(numpy.arange(first, last)[owners])
    return blocks, places


def _as_faces(kind, data):
    """(kind, nodes, the cell of each row) with pixels as quadrilaterals and strips as triangles."""
    owners = numpy.arange(len(data))
    if kind == PIXEL:
        return "quad", data[:, [0, 1, 3, 2]], owners
    if kind == TRIANGLE_STRIP:  # every second triangle is wound the other way
        n = data.shape[1] - 2
        corners = [[k, k + 1 + k % 2, k + 2 - k % 2] for k in range(n)]
        return "triangle", data[:, corners].reshape(-1, 3), numpy.repeat(owners, n)
    return _name(kind), data, owners


def _blocks_of_surface(surface):
    """The same of poly data: points, lines, faces and strips, in VTK's order of cells."""
    blocks, places, first = [], [], 0
    for cells, kinds in ((surface.GetVerts(), {1: 1}), (surface.GetLines(), {2: 3}), (surface.GetPolys(), {3: 5, 4: 9}), (surface.GetStrips(), {})):
        other = {1: 2, 2: 4}.get(min(kinds, default=0), 7 if kinds else TRIANGLE_STRIP)
        nodes, offsets = _cells(cells)
        lengths = numpy.diff(offsets)
        ends = numpy.flatnonzero(numpy.diff(lengths)) + 1
        for a, b in zip([0, *ends], [*ends, len(lengths)]) if len(lengths) else ():
            name, data, owners = _as_faces(kinds.get(lengths[a], other), nodes[offsets[a] : offsets[b]].reshape(b - a, -1))
            blocks.append((name, data))
            places.append(first + numpy.arange(a, b)[owners])
        first += len(lengths)
    return blocks, places
