"""A picture of the capsule in the flow: the membrane coloured by a field, the velocity in the shear plane behind it."""

import pathlib
import xml.etree.ElementTree

import vtk
from vtk.util.numpy_support import vtk_to_numpy

from .observables import InputError

WIDTH, HEIGHT = 1200, 900


def series_file(output, name, time):
    """The file of a .pvd series at the given time, or the last one."""
    collection = pathlib.Path(output) / f"{name}.pvd"
    if not collection.is_file():
        raise InputError(f"{collection}: there is no such file")
    entries = [(float(e.get("timestep")), e.get("file")) for e in xml.etree.ElementTree.parse(collection).iter("DataSet")]
    if not entries:
        raise InputError(f"{collection}: the series is empty (output.{name}_every is 0?)")
    chosen = entries[-1] if time is None else min(entries, key=lambda entry: abs(entry[0] - time))
    return collection.parent / chosen[1]


def read(reader, file):
    """What a VTK reader makes of a file."""
    reader.SetFileName(str(file))
    reader.Update()
    return reader.GetOutput()


def colour_map(low, high):
    """Blue, white, red: the middle of the range is white."""
    function = vtk.vtkColorTransferFunction()
    function.SetColorSpaceToDiverging()
    function.AddRGBPoint(low, 0.23, 0.30, 0.75)
    function.AddRGBPoint(0.5 * (low + high), 0.865, 0.865, 0.865)
    function.AddRGBPoint(high, 0.71, 0.016, 0.15)
    return function


def membrane_actor(surface, field):
    """The membrane, smooth and coloured by a cell field, and its scale."""
    values = surface.GetCellData().GetArray(field)
    if values is None:
        names = [surface.GetCellData().GetArrayName(k) for k in range(surface.GetCellData().GetNumberOfArrays())]
        raise InputError(f"the membrane has no cell field '{field}', only {', '.join(names)}")
    low, high = vtk_to_numpy(values).min(), vtk_to_numpy(values).max()
    to_surface = vtk.vtkGeometryFilter()
    to_surface.SetInputData(surface)
    to_points = vtk.vtkCellDataToPointData()
    to_points.SetInputConnection(to_surface.GetOutputPort())
    normals = vtk.vtkPolyDataNormals()
    normals.SetInputConnection(to_points.GetOutputPort())
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(normals.GetOutputPort())
    mapper.SetScalarModeToUsePointFieldData()
    mapper.SelectColorArray(field)
    mapper.SetLookupTable(colour_map(low, high))
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetSpecular(0.2)
    return actor, mapper


def slice_actors(grid, axis=1):
    """Arrows of the velocity in the plane through the middle of the box, coloured by speed."""
    bounds, origin = grid.GetBounds(), list(grid.GetCenter())
    plane = vtk.vtkPlane()
    plane.SetOrigin(origin)
    plane.SetNormal([1.0 if k == axis else 0.0 for k in range(3)])
    cut = vtk.vtkCutter()
    cut.SetInputData(grid)
    cut.SetCutFunction(plane)
    thin = vtk.vtkMaskPoints()
    thin.SetInputConnection(cut.GetOutputPort())
    thin.SetOnRatio(max(1, (grid.GetNumberOfPoints() // max(1, grid.GetDimensions()[axis])) // 600))
    thin.RandomModeOn()
    thin.SetRandomModeType(1)
    norm = vtk.vtkArrayCalculator()
    norm.SetInputConnection(thin.GetOutputPort())
    norm.AddVectorArrayName("velocity")
    norm.SetFunction("mag(velocity)")
    norm.SetResultArrayName("speed")
    norm.Update()
    fastest = norm.GetOutput().GetPointData().GetArray("speed").GetRange()[1]
    arrow = vtk.vtkArrowSource()
    glyph = vtk.vtkGlyph3D()
    glyph.SetInputConnection(norm.GetOutputPort())
    glyph.SetSourceConnection(arrow.GetOutputPort())
    glyph.SetInputArrayToProcess(1, 0, 0, 0, "velocity")
    glyph.SetVectorModeToUseVector()
    glyph.SetScaleModeToScaleByVector()
    glyph.SetScaleFactor(0.09 * (bounds[1] - bounds[0]) / fastest if fastest > 0 else 1.0)
    mapper = vtk.vtkPolyDataMapper()
    mapper.SetInputConnection(glyph.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtk.vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(0.35, 0.40, 0.48)
    outline = vtk.vtkOutlineFilter()
    outline.SetInputData(grid)
    frame_mapper = vtk.vtkPolyDataMapper()
    frame_mapper.SetInputConnection(outline.GetOutputPort())
    frame = vtk.vtkActor()
    frame.SetMapper(frame_mapper)
    frame.GetProperty().SetColor(0.55, 0.55, 0.55)
    return [actor, frame]


def scalar_bar(mapper, title):
    """The legend of the membrane's colours."""
    bar = vtk.vtkScalarBarActor()
    bar.SetLookupTable(mapper.GetLookupTable())
    bar.SetTitle(title.replace("_", " "))
    bar.SetNumberOfLabels(4)
    bar.SetMaximumWidthInPixels(90)
    bar.SetMaximumHeightInPixels(420)
    bar.SetPosition(0.9, 0.25)
    for text in (bar.GetTitleTextProperty(), bar.GetLabelTextProperty()):
        text.SetColor(0.1, 0.1, 0.1)
        text.ItalicOff()
        text.BoldOff()
        text.ShadowOff()
    return bar


def render(output, field="area_ratio", time=None):
    """Writes capsule.png into the output directory."""
    surface = read(vtk.vtkXMLUnstructuredGridReader(), series_file(output, "membrane", time))
    grid = read(vtk.vtkXMLImageDataReader(), series_file(output, "fluid", time))
    renderer = vtk.vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    actor, mapper = membrane_actor(surface, field)
    for one in [actor, *slice_actors(grid)]:
        renderer.AddActor(one)
    renderer.AddActor2D(scalar_bar(mapper, field))
    window = vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(WIDTH, HEIGHT)
    window.AddRenderer(renderer)
    centre, bounds = grid.GetCenter(), grid.GetBounds()
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(centre)
    camera.SetPosition(centre[0] + 0.5 * bounds[1], centre[1] - 2.1 * bounds[3], centre[2] + 0.55 * bounds[5])
    camera.SetViewUp(0, 0, 1)
    renderer.ResetCameraClippingRange()
    window.Render()
    picture = vtk.vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    writer.SetFileName(str(pathlib.Path(output) / "capsule.png"))
    writer.Write()
