"""The scene of a run in ParaView: membrane, slices of the flow, arrows, colour bars, the time, the camera."""

import output_camera as camera
import output_fields as fields
from paraview import simple
from tanktread_post.observables import InputError

INK = [0.15, 0.15, 0.18]
PALE, BLUE, RED = [0.95, 0.95, 0.95], [0.45, 0.6, 0.85], [0.85, 0.45, 0.5]
# Names of ParaView's maps or colours from low to high, for values of one sign and for values about 0. The flow is pale, so that
# the membrane stands out.
MEMBRANE_COLOURS = ("Viridis (matplotlib)", "PRGn")
FLOW_COLOURS = ([PALE, BLUE], [BLUE, PALE, RED])


def open_series(file, name):
    """A .pvd series as a source, at its first time. Throws InputError if ParaView reads nothing."""
    source = simple.PVDReader(registrationName=name, FileName=file)
    source.UpdatePipeline(source.TimestepValues[0])
    if source.GetDataInformation().GetNumberOfPoints() == 0:
        raise InputError(f"{file}: ParaView reads no points from its files; 'not well-formed' above means Debian's libexpat1, see README.md")
    return source


def arrays_of(source):
    """The arrays of a source, in alphabetical order."""
    found = []
    for association, data in (("POINTS", source.PointData), ("CELLS", source.CellData)):
        found += [fields.Array(association, array.GetName(), array.GetNumberOfComponents()) for array in data]
    return sorted(found, key=lambda array: array.name)


def over_time(sources, times, array, components):
    """[(low, high) for each component] of an array in these sources over all times."""
    ranges = []
    for time in times:
        for source in sources:
            source.UpdatePipeline(time)
            data = source.PointData if array.association == "POINTS" else source.CellData
            ranges.append([data.GetArray(array.name).GetRange(component) for component in components])
    return [(min(low for low, _ in column), max(high for _, high in column)) for column in zip(*ranges)]


def bounds_over_time(source, times):
    """The box that holds a source at all times: x from, x to, y from ..."""
    boxes = []
    for time in times:
        source.UpdatePipeline(time)
        boxes.append(source.GetDataInformation().GetBounds())
    return camera.union(boxes)


def show_membrane(membrane, view, field, limits, edges):
    """The membrane in the colours of a field, with the edges of its triangles."""
    display = simple.Show(membrane, view)
    display.SetRepresentationType("Surface")
    display.Ambient, display.Diffuse = 0.4, 0.65
    colour_by(display, view, field, limits, MEMBRANE_COLOURS, left=False)
    if edges:
        # Not "Surface With Edges", whose lines ParaView draws opaque before 5.12: they would hide the colours of fine meshes.
        lines = simple.Show(simple.ExtractSurface(registrationName="edges", Input=membrane), view)
        lines.SetRepresentationType("Wireframe")
        plain(lines)
        lines.Opacity = 0.25


def plain(display):
    """One dark colour without shading."""
    display.ColorArrayName = [None, ""]
    display.AmbientColor = display.DiffuseColor = INK
    display.Ambient, display.Diffuse = 1.0, 0.0


def slice_of(fluid, axis, position):
    """The flow in a plane across an axis; fluid files of one sheet are that plane already."""
    bounds = fluid.GetDataInformation().GetBounds()
    if bounds[2 * axis] == bounds[2 * axis + 1]:
        return fluid
    plane = simple.Slice(registrationName=f"slice {fields.AXES[axis]}", Input=fluid, SliceType="Plane")
    # A plane through the outermost nodes may cut nothing.
    margin = 1e-6 * (bounds[2 * axis + 1] - bounds[2 * axis])
    position = min(max(position, bounds[2 * axis] + margin), bounds[2 * axis + 1] - margin)
    plane.SliceType.Origin = camera.middle(camera.flat_box(bounds, axis, position))
    plane.SliceType.Normal = [float(k == axis) for k in range(3)]
    simple.Hide3DWidgets(proxy=plane.SliceType)
    return plane


def show_slice(plane, view, field, limits, opacity):
    """A slice in the colours of the velocity, without shading."""
    display = simple.Show(plane, view)
    display.SetRepresentationType("Surface")
    display.Ambient, display.Diffuse = 1.0, 0.0
    display.Opacity = opacity
    colour_by(display, view, field, limits, FLOW_COLOURS, left=True)


def show_arrows(fluid, view, axis, position, n_arrows, fastest):
    """Arrows on a square lattice in the plane across an axis; the longest, of the speed `fastest`, reaches to the next."""
    corners, numbers, spacing = camera.lattice(fluid.GetDataInformation().GetBounds(), axis, position, n_arrows)
    lattice = simple.Plane(registrationName=f"lattice {fields.AXES[axis]}", XResolution=numbers[0] - 1, YResolution=numbers[1] - 1)
    lattice.Origin, lattice.Point1, lattice.Point2 = corners
    sampled = simple.ResampleWithDataset(registrationName=f"velocity {fields.AXES[axis]}", SourceDataArrays=fluid, DestinationMesh=lattice)
    arrows = simple.Glyph(registrationName=f"arrows {fields.AXES[axis]}", Input=sampled, GlyphType="Arrow")
    arrows.OrientationArray = arrows.ScaleArray = ["POINTS", "velocity"]
    arrows.ScaleFactor = spacing / fastest
    arrows.GlyphMode = "All Points"
    plain(simple.Show(arrows, view))


def colour_by(display, view, field, limits, colours, left):
    """Colours by a field over fixed limits, and a bar that says so at the left or the right edge."""
    array = field.array
    component = "Magnitude" if field.component == fields.MAGNITUDE else str(field.component)
    value = (array.association, array.name)
    # A map of the membrane's own: its velocity must not take the colours of the flow's. All slices share one.
    simple.ColorBy(display, value if array.n_components == 1 else (*value, component), separate=not left)
    table = simple.GetColorTransferFunction(array.name, display, separate=not left)
    set_colours(table, colours[fields.goes_both_ways(limits)], limits)
    add_bar(view, table, fields.title(field), limits, left)
    display.SetScalarBarVisibility(view, True)


def set_colours(table, colours, limits):
    """Fills a map with one of ParaView's or with colours at equal distances, over fixed limits."""
    if isinstance(colours, str):
        table.ApplyPreset(colours, True)
    else:
        table.ColorSpace = "Lab"
        table.RGBPoints = [x for value, colour in zip(fields.labels(limits, len(colours)), colours) for x in (value, *colour)]
    table.AutomaticRescaleRangeMode = "Never"
    table.RescaleTransferFunction(*limits)


def font_size(view, size):
    """A size that suits a picture 1200 wide, for the view; not too small to be read."""
    return round(size * max(0.7, view.ViewSize[0] / 1200))


def add_bar(view, table, title, limits, left):
    """Sets a colour bar: upright, its title above, five numbers."""
    bar = simple.GetScalarBar(table, view)
    bar.AutoOrient, bar.Orientation = 0, "Vertical"
    bar.WindowLocation, bar.Position = "Any Location", [0.03 if left else 0.845, 0.32]
    bar.ScalarBarLength, bar.ScalarBarThickness = 0.36, 20
    bar.HorizontalTitle, bar.TitleJustification = 1, "Left"
    bar.Title, bar.ComponentTitle = title, ""
    bar.AutomaticLabelFormat, bar.LabelFormat = 0, "%-.3g"
    bar.AddRangeLabels, bar.UseCustomLabels, bar.CustomLabels = 0, 1, fields.labels(limits)
    for part, size in (("Title", 19), ("Label", 18)):
        setattr(bar, part + "Color", INK)
        setattr(bar, part + "FontSize", font_size(view, size))


def show_time(view):
    """The time of what is shown, in the lower right corner."""
    time = simple.AnnotateTime(registrationName="shear time")
    # ParaView writes numbers in Python's way from 5.10 on.
    time.Format = "shear time %.2f" if "%" in time.Format else "shear time {time:.2f}"
    display = simple.Show(time, view)
    display.WindowLocation, display.Position = "Any Location", [0.8, 0.04]
    display.FontSize, display.Color = font_size(view, 20), INK


def prepare(view, size):
    """A size (None: as it is), white behind everything, small axes in the corner; the camera stays where `look` puts it."""
    simple._DisableFirstRenderCameraReset()
    if size:
        view.ViewSize = size
    view.UseColorPaletteForBackground = 0
    view.BackgroundColorMode = "Single Color"
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesLabelColor = INK
    view.CenterAxesVisibility = 0


def look(view, boxes, right, up, n_slices, zoom):
    """Turns the camera to the boxes: axis `right` to the right, axis `up` upwards."""
    width, height = view.ViewSize
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = camera.place(boxes, right, up, width / height, n_slices > 1, zoom)
    view.CenterOfRotation = view.CameraFocalPoint
    view.CameraViewAngle = camera.VIEW_ANGLE
