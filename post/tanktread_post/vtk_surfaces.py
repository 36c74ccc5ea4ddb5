"""VTK's XML files of cells, .vtu, .pvtu and .vtp, read by VTK: all pieces of them, or nothing.

meshio 5.0.0 keeps only the last piece of a file of several, and refuses file version 2, LZ4, .pvtu and .vtp.
"""

import meshio
import numpy
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkCellTypes, vtkGenericCell
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLUnstructuredGridReader

from . import vtk_head, vtk_pieces
from .observables import InputError
from .vtk_reading import apart, read_by

READERS = {"UnstructuredGrid": vtkXMLUnstructuredGridReader, "PolyData": vtkXMLPolyDataReader}
VERTEX, POLY_VERTEX, LINE, POLY_LINE, TRIANGLE, TRIANGLE_STRIP, POLYGON, PIXEL, QUAD = range(1, 10)
# VTK's numbers of cells as meshio calls them; others go by the name of VTK's class.
KINDS = {
    VERTEX: "vertex", LINE: "line", TRIANGLE: "triangle", POLYGON: "polygon", QUAD: "quad", 10: "tetra", 12: "hexahedron", 13: "wedge", 14: "pyramid",
    21: "line3", 22: "triangle6", 23: "quad8", 24: "tetra10", 28: "quad9", 34: "triangle7", 42: "polyhedron",
}  # fmt: skip


def read(file):
    """A meshio.Mesh with all arrays of a .vtu or .vtp, or of the pieces of a .pvtu."""
    if vtk_pieces.is_index(file):
        pieces = vtk_pieces.pieces_of(file)
        return vtk_pieces.joined([read(piece) for piece in pieces], pieces, file)
    kind, n_points, n_cells = vtk_head.read(file)
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
        kind, data = kinds[first], nodes[offsets[first] : offsets[last]].reshape(last - first, lengths[first])
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
    kinds = (  # each as VTK's numbers, by the number of corners
        (surface.GetVerts(), lambda n: VERTEX if n == 1 else POLY_VERTEX),
        (surface.GetLines(), lambda n: LINE if n == 2 else POLY_LINE),
        (surface.GetPolys(), lambda n: {3: TRIANGLE, 4: QUAD}.get(n, POLYGON)),
        (surface.GetStrips(), lambda n: TRIANGLE_STRIP),
    )
    blocks, places, first = [], [], 0
    for cells, kind in kinds:
        nodes, offsets = _cells(cells)
        lengths = numpy.diff(offsets)
        ends = numpy.flatnonzero(numpy.diff(lengths)) + 1
        for a, b in zip([0, *ends], [*ends, len(lengths)]) if len(lengths) else ():
            name, data, owners = _as_faces(kind(lengths[a]), nodes[offsets[a] : offsets[b]].reshape(b - a, lengths[a]))
            blocks.append((name, data))
            places.append(first + numpy.arange(a, b)[owners])
        first += len(lengths)
    return blocks, places
