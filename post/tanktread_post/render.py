"""A picture of the capsule in the flow, drawn without a window: the membrane coloured by a field, in the shear plane."""

import os
import pathlib

import numpy
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkIOXML import (
    vtkXMLImageDataReader,
    vtkXMLPImageDataReader,
    vtkXMLPUnstructuredGridReader,
    vtkXMLUnstructuredGridReader,
)
from vtkmodules.vtkRenderingCore import (
    vtkLightKit,
    vtkRenderer,
    vtkRenderWindow,
    vtkTextActor,
    vtkWindowToImageFilter,
)

from . import scene, series, vtk_pieces, whole_file
from .observables import InputError
from .run_folder import read_echo
from .vtk_reading import read_by, require_end

WIDTH, HEIGHT = 1200, 900
READERS = {".vtu": vtkXMLUnstructuredGridReader, ".pvtu": vtkXMLPUnstructuredGridReader, ".vti": vtkXMLImageDataReader, ".pvti": vtkXMLPImageDataReader}


def _require_display():
    """VTK needs a display to draw on, a virtual one too, and ends the process without one."""
    if not os.environ.get("DISPLAY"):
        raise InputError("drawing needs a display, and there is none; put `xvfb-run -a` before the command")


def read(file):
    """What VTK finds in a file of a series, whole or in pieces."""
    if not file.is_file():
        raise InputError(f"{file}: the series names this file, and it is not there")
    if file.suffix not in READERS:
        raise InputError(f"{file}: the series names this file, and it is none of {', '.join(READERS)}")
    for piece in vtk_pieces.pieces_of(file) if vtk_pieces.is_index(file) else ():
        require_end(piece)
    data = read_by(READERS[file.suffix](), file)
    if data.GetNumberOfPoints() == 0:
        raise InputError(f"{file}: it holds no points")
    return data


def look_along_vorticity(renderer, axes, bounds):
    """Turns the camera to the shear plane: flow to the right, gradient up, a little from the side and from above."""
    flow_axis, wall_axis = axes
    right, up = numpy.eye(3)[flow_axis], numpy.eye(3)[wall_axis]
    centre = numpy.array([0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)])
    camera = renderer.GetActiveCamera()
    camera.SetFocalPoint(*centre)
    camera.SetPosition(*(centre + 10 * numpy.cross(right, up)))
    camera.SetViewUp(*up)
    camera.SetViewAngle(22)
    camera.Azimuth(-24)
    camera.Elevation(14)
    renderer.ResetCamera(bounds)
    camera.Zoom(1.2)
    renderer.ResetCameraClippingRange()


def _caption(text):
    actor = vtkTextActor()
    actor.SetInput(text)
    actor.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    actor.SetPosition(0.82, 0.04)
    actor.GetTextProperty().SetFontSize(24)
    actor.GetTextProperty().SetColor(*scene.INK)
    return actor


def picture_place(file):
    """The file that a picture is to be written to, if it can be, and drawn at all."""
    file = pathlib.Path(file)
    if file.suffix.lower() != ".png":
        raise InputError(f"{file}: a picture is a PNG; its name must end with .png")
    whole_file.require_place(file, force=True)
    _require_display()
    return file


def write_picture(renderers, file, size):
    """Draws renderers in a window of that size (pixels) that nobody sees, as a PNG."""
    window = vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetMultiSamples(8)
    window.SetSize(*size)
    for renderer in renderers:
        window.AddRenderer(renderer)
    window.Render()
    picture = vtkWindowToImageFilter()
    picture.SetInput(window)
    picture.ReadFrontBufferOff()
    writer = vtkPNGWriter()
    writer.SetInputConnection(picture.GetOutputPort())
    with whole_file.writing(file) as temporary:
        writer.SetFileName(str(temporary))
        writer.Write()
        if writer.GetErrorCode() or not temporary.is_file():
            raise InputError(f"{file}: the picture cannot be written there")


def render(output, field="area_ratio", shear_time=None, file=None):
    """Writes capsule.png into the output directory (or `file`). Returns the file.

    `shear_time`: the nearest membrane file is drawn, the last by default, in the last flow up to its time; in none if the run wrote none.
    """
    output = pathlib.Path(output)
    if not output.is_dir():
        raise InputError(f"{output}: there is no such folder; give the output directory of a run")
    file = picture_place(file or output / "capsule.png")
    case = read_echo(output)
    axes = [scene.AXES.index(case["flow"][key]) for key in ("flow_axis", "wall_axis")]
    entry = series.at(output / "membrane.pvd", shear_time)
    if entry is None:
        raise InputError(f"{output}/membrane.pvd: there is nothing to draw (output.membrane_every is 0?)")
    surface = read(entry[1])
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    actors, table = scene.membrane(surface, field)
    renderer.AddActor2D(scene.legend(table, field.replace("_", " "), left=False))
    bounds = surface.GetBounds()

    flow_entry = series.shown_at(output / "fluid.pvd", entry[0])
    if flow_entry is not None:
        grid = read(flow_entry[1])
        vorticity_axis = 3 - sum(axes)
        low, high = grid.GetBounds()[2 * vorticity_axis : 2 * vorticity_axis + 2]
        middle = min(max(sum(bounds[2 * vorticity_axis : 2 * vorticity_axis + 2]) / 2, low), high)
        flow_actors, flow_table = scene.flow(grid, axes, middle)
        actors += flow_actors
        renderer.AddActor2D(scene.legend(flow_table, f"velocity {scene.AXES[axes[0]]}", left=True))
        bounds = list(grid.GetBounds())
        bounds[2 * vorticity_axis : 2 * vorticity_axis + 2] = [middle, middle]
    for actor in actors:
        renderer.AddActor(actor)
    renderer.AddActor2D(_caption(f"shear time {entry[0]:.2f}"))
    lights = vtkLightKit()
    lights.AddLightsToRenderer(renderer)
    look_along_vorticity(renderer, axes, bounds)
    write_picture([renderer], file, (WIDTH, HEIGHT))
    return file
