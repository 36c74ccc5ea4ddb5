"""The parts of the picture of a capsule in the flow, as VTK actors; render.py puts them together."""

import matplotlib
import numpy
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (draws text: loaded for its effect)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (draws all else: loaded for its effect)
from vtkmodules.vtkCommonCore import vtkLookupTable
from vtkmodules.vtkFiltersCore import (
    vtkArrayCalculator,
    vtkCellDataToPointData,
    vtkGlyph3D,
    vtkPolyDataNormals,
    vtkProbeFilter,
)
from vtkmodules.vtkFiltersExtraction import vtkExtractEdges
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkArrowSource, vtkPlaneSource
from vtkmodules.vtkRenderingAnnotation import vtkScalarBarActor
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper

from .observables import InputError

INK = (0.15, 0.15, 0.18)
AXES = "xyz"


def lookup_table(name, low, high, strength=1.0):
    """One of matplotlib's colour maps over a range, mixed with white where `strength` is below 1."""
    table = vtkLookupTable()
    table.SetNumberOfTableValues(256)
    for k, colour in enumerate(matplotlib.colormaps[name](numpy.linspace(0.0, 1.0, 256))):
        table.SetTableValue(k, *(1.0 - strength + strength * colour[:3]), 1.0)
    table.SetRange(low, high)
    table.Build()
    return table


def _actor(source, table=None, array=None):
    """An actor of a filter's output, coloured by a point array or plain."""
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    if table is None:
        mapper.ScalarVisibilityOff()
    else:
        mapper.SetScalarModeToUsePointFieldData()
        mapper.SelectColorArray(array)
        mapper.SetLookupTable(table)
        mapper.UseLookupTableScalarRangeOn()
        mapper.InterpolateScalarsBeforeMappingOn()
    actor = vtkActor()
    actor.SetMapper(mapper)
    return actor


def membrane(surface, field):
    """The membrane coloured by a cell field (its magnitude, if it has components), and its mesh. Actors, table."""
    cells = surface.GetCellData()
    if cells.GetArray(field) is None:
        names = [cells.GetArrayName(k) for k in range(cells.GetNumberOfArrays())]
        raise InputError(f"the membrane has no cell field '{field}', only {', '.join(names)}")
    triangles = vtkGeometryFilter()
    triangles.SetInputData(surface)
    at_points = vtkCellDataToPointData()
    at_points.SetInputConnection(triangles.GetOutputPort())
    smooth = vtkPolyDataNormals()
    smooth.SetInputConnection(at_points.GetOutputPort())
    smooth.SplittingOff()
    smooth.Update()
    low, high = smooth.GetOutput().GetPointData().GetArray(field).GetRange(-1)
    table = lookup_table("viridis", low, high)
    table.SetVectorModeToMagnitude()
    body = _actor(smooth, table, field)
    body.GetProperty().SetSpecular(0.25)
    body.GetProperty().SetSpecularPower(25)
    body.GetProperty().SetAmbient(0.15)
    edges = vtkExtractEdges()
    edges.SetInputConnection(smooth.GetOutputPort())
    mesh = _actor(edges)
    mesh.GetProperty().SetColor(0, 0, 0)
    mesh.GetProperty().SetOpacity(0.25)
    mesh.GetProperty().SetLineWidth(1.0)
    mesh.GetProperty().LightingOff()
    mesh.GetMapper().SetResolveCoincidentTopologyToPolygonOffset()
    mesh.GetMapper().SetRelativeCoincidentTopologyLineOffsetParameters(0, -4)
    return [body, mesh], table


def _plane(bounds, axes, position, resolution):
    """A grid of points over the bounds in the plane of two axes, at a position along the third."""
    first, second = axes
    third = 3 - first - second
    corners = numpy.empty((3, 3))
    corners[:, third] = position
    for corner, (along_first, along_second) in enumerate(((0, 0), (1, 0), (0, 1))):
        corners[corner, first] = bounds[2 * first + along_first]
        corners[corner, second] = bounds[2 * second + along_second]
    plane = vtkPlaneSource()
    plane.SetOrigin(*corners[0])
    plane.SetPoint1(*corners[1])
    plane.SetPoint2(*corners[2])
    plane.SetResolution(*resolution)
    return plane


def _connect_probe(consumer, grid, plane):
    """Feeds a filter with the grid's fields at the points of a plane."""
    # An output port does not keep its filter alive, a connection does: so it is made before the probe goes.
    probe = vtkProbeFilter()
    probe.SetInputConnection(plane.GetOutputPort())
    probe.SetSourceData(grid)
    consumer.SetInputConnection(probe.GetOutputPort())


def flow(grid, axes, position):
    """The velocity in the shear plane: a plane coloured by its part along the flow axis, with arrows.

    Returns actors, table. `axes`: flow axis, wall axis; `position`: of the plane along the third.
    """
    if grid.GetPointData().GetArray("velocity") is None:
        raise InputError("the fluid has no point field 'velocity'")
    bounds, nodes = grid.GetBounds(), grid.GetDimensions()
    resolution = [max(1, nodes[axis] - 1) for axis in axes]
    along = vtkArrayCalculator()
    _connect_probe(along, grid, _plane(bounds, axes, position, resolution))
    along.AddScalarVariable("u", "velocity", axes[0])
    along.SetFunction("u")
    along.SetResultArrayName("along")
    along.Update()
    low, high = along.GetOutput().GetPointData().GetArray("along").GetRange()
    greatest = max(abs(low), abs(high)) or 1.0
    both_ways = low < -0.1 * greatest
    table = lookup_table("RdBu_r" if both_ways else "Blues", -greatest if both_ways else 0.0, greatest, strength=0.6)
    sheet = _actor(along, table, "along")
    sheet.GetProperty().LightingOff()

    extents = [bounds[2 * axis + 1] - bounds[2 * axis] for axis in axes]
    spacing = max(extents) / 16
    coarse = _plane(bounds, axes, position, [max(1, round(extent / spacing)) for extent in extents])
    glyph = vtkGlyph3D()
    _connect_probe(glyph, grid, coarse)
    shape = vtkArrowSource()
    shape.SetTipResolution(24)
    shape.SetShaftResolution(16)
    glyph.SetSourceConnection(shape.GetOutputPort())
    glyph.SetInputArrayToProcess(1, 0, 0, 0, "velocity")
    glyph.SetVectorModeToUseVector()
    glyph.SetScaleModeToScaleByVector()
    glyph.SetScaleFactor(spacing / greatest)
    arrows = _actor(glyph)
    arrows.GetProperty().SetColor(*INK)
    return [sheet, arrows], table


def legend(table, title, left):
    """The scale of a colour table, at the left or the right edge of the picture."""
    bar = vtkScalarBarActor()
    bar.SetLookupTable(table)
    bar.SetTitle(title + "\n ")
    bar.SetNumberOfLabels(5)
    bar.SetLabelFormat("%-#.3g")
    bar.UnconstrainedFontSizeOn()
    bar.SetBarRatio(0.25)
    bar.SetWidth(0.08)
    bar.SetHeight(0.42)
    bar.SetPosition(0.025 if left else 0.895, 0.3)
    for text, size in ((bar.GetTitleTextProperty(), 21), (bar.GetLabelTextProperty(), 19)):
        text.SetFontSize(size)
        text.SetColor(*INK)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return bar
