"""Faces of any number of corners: sorted into blocks, and split into triangles."""

import itertools

import numpy
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter

from .observables import InputError

KINDS = {3: "triangle", 4: "quad"}  # by the number of corners; all others are polygons


def blocks_of(faces):
    """[(kind, F x n node numbers), ...] in the order of the faces, a list of node numbers each: a block ends where their number changes."""
    groups = (list(group) for _, group in itertools.groupby(faces, len))
    return [(KINDS.get(len(group[0]), "polygon"), numpy.array(group, dtype=numpy.int64)) for group in groups]


def triangles_of(points, blocks, file):
    """(triangles, the number of the face that each comes from) of arrays of F x n node numbers; faces are numbered in their order."""
    triangles, faces, first = [], [], 0
    for data in blocks:
        data, numbers = numpy.asarray(data, dtype=numpy.int64), first + numpy.arange(len(data))
        first += len(data)
        if data.shape[1] == 4:
            data, numbers = _split_quads(points, data), numpy.repeat(numbers, 2)
        elif data.shape[1] > 4:
            data, numbers = _split_polygons(points, data, numbers, file)
        triangles.append(data)
        faces.append(numbers)
    return numpy.concatenate(triangles), numpy.concatenate(faces)


def _split_quads(points, quads):
    """Two triangles a quadrilateral, wound as it is, along the shorter diagonal."""
    with numpy.errstate(invalid="ignore"):  # what is not finite is refused later, with its place
        diagonal = [numpy.linalg.norm(points[quads[:, k]] - points[quads[:, k + 2]], axis=1) for k in (0, 1)]
    turned = (diagonal[1] < diagonal[0])[:, None]
    a, b, c, d = numpy.where(turned, numpy.roll(quads, -1, axis=1), quads).T
    return numpy.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


def _split_polygons(points, polygons, numbers, file):
    """Triangles of F polygons of n corners, n - 2 each and wound as they are, by VTK; and the number of the face of each."""
    n = polygons.shape[1]
    if not numpy.isfinite(points[polygons]).all():  # refused later, with its place
        fan = [[0, k, k + 1] for k in range(1, n - 1)]
        return polygons[:, fan].reshape(-1, 3), numpy.repeat(numbers, n - 2)
    surface = _poly_data(points, polygons)
    triangulate = vtkTriangleFilter()
    triangulate.SetInputData(surface)
    triangulate.Update()
    triangles = vtk_to_numpy(triangulate.GetOutput().GetPolys().GetConnectivityArray()).reshape(-1, 3)
    owners = vtk_to_numpy(triangulate.GetOutput().GetCellData().GetArray("face"))
    short = numpy.flatnonzero(numpy.bincount(owners, minlength=len(polygons)) != n - 2)
    if len(short):
        raise InputError(f"{file}: face {numbers[short[0]]} of {n} corners is degenerate or cuts through itself; split it into triangles where it was made")
    return triangles.astype(numpy.int64), numbers[owners]


def _poly_data(points, polygons):
    """VTK's surface of the polygons, each with its place among them as the array `face`."""
    positions, cells, surface = vtkPoints(), vtkCellArray(), vtkPolyData()
    positions.SetDataTypeToDouble()
    positions.SetData(numpy_to_vtk(numpy.ascontiguousarray(points), deep=True))
    for polygon in polygons:
        corners = vtkIdList()
        for node in polygon:
            corners.InsertNextId(int(node))
        cells.InsertNextCell(corners)
    surface.SetPoints(positions)
    surface.SetPolys(cells)
    place = numpy_to_vtk(numpy.arange(len(polygons)), deep=True)
    place.SetName("face")
    surface.GetCellData().AddArray(place)
    return surface
