"""A strip of pictures: the membranes of a run at several times, smooth and shaded as cells are under a lamp, drawn without a window."""

import pathlib

import numpy
import vtkmodules.vtkRenderingFreeType  # noqa: F401  (draws text: loaded for its effect)
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401  (draws all else: loaded for its effect)
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkPolyDataNormals, vtkTriangleFilter
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersModeling import vtkLoopSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkLightKit, vtkPolyDataMapper, vtkRenderer, vtkTextActor

from . import outlines, render, scene, series
from .observables import InputError, Observables
from .run_folder import read_echo

PANEL = 420  # pixels, of each side
RED = (0.74, 0.13, 0.11)


def _actor(source, colour):
    mapper = vtkPolyDataMapper()
    mapper.SetInputConnection(source.GetOutputPort())
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*colour)
    return actor


def _smooth(surface):
    """A smooth surface close to the nodes of the membrane, by Loop's subdivision: for the eye, not to measure."""
    triangles = vtkGeometryFilter()
    triangles.SetInputData(surface)
    closed = vtkTriangleFilter()
    closed.SetInputConnection(triangles.GetOutputPort())
    finer = vtkLoopSubdivisionFilter()
    finer.SetNumberOfSubdivisions(2)
    finer.SetInputConnection(closed.GetOutputPort())
    normals = vtkPolyDataNormals()
    normals.SplittingOff()
    normals.SetInputConnection(finer.GetOutputPort())
    actor = _actor(normals, RED)
    actor.GetProperty().SetAmbient(0.12)
    actor.GetProperty().SetSpecular(0.35)
    actor.GetProperty().SetSpecularPower(30)
    return actor


def _marker(place, radius):
    ball = vtkSphereSource()
    ball.SetCenter(*place)
    ball.SetRadius(0.07 * radius)
    ball.SetThetaResolution(24)
    ball.SetPhiResolution(24)
    return _actor(ball, scene.INK)


def _marker_place(output, shear_time, surface, radius):
    """Of the marker of measures.csv, which is seen from the centroid; None without the table."""
    if not (output / "measures.csv").is_file():
        return None
    measures = Observables(output, table="measures.csv")
    time = min(shear_time, measures["shear_time"][-1])
    points = vtk_to_numpy(surface.GetPoints().GetData())
    triangles = vtk_to_numpy(surface.GetCells().GetConnectivityArray()).reshape(-1, 3)
    return outlines.centroid(points, triangles) + radius * numpy.array([measures.at(f"marker_{axis}", time) for axis in "xyz"])


def _panel(output, case, axes, entry, radius, share):
    """The renderer of one moment, in its share of the width."""
    surface = render.read(entry[1])
    renderer = vtkRenderer()
    renderer.SetBackground(1, 1, 1)
    renderer.SetViewport(share[0], 0, share[1], 1)
    renderer.AddActor(_smooth(surface))
    place = _marker_place(output, entry[0], surface, radius)
    if place is not None:
        renderer.AddActor(_marker(place, radius))
    caption = vtkTextActor()
    caption.SetInput(f"shear time {entry[0]:.4g}")
    caption.GetPositionCoordinate().SetCoordinateSystemToNormalizedViewport()
    caption.SetPosition(0.06, 0.04)
    caption.GetTextProperty().SetFontSize(20)
    caption.GetTextProperty().SetColor(*scene.INK)
    renderer.AddActor2D(caption)
    vtkLightKit().AddLightsToRenderer(renderer)
    # The same frame at all times, about where the membrane is.
    centre = surface.GetCenter()
    bounds = [centre[k // 2] + (1.4 if k % 2 else -1.4) * radius for k in range(6)]
    render.look_along_vorticity(renderer, axes, bounds)
    return renderer


def draw(output, shear_times, file=None):
    """Writes strip.png into the output directory of a run (or `file`): the membrane files nearest to the times, from left to right, in the
    shear plane, a little from the side and from above, with the marker of measures.csv. Of one capsule. Returns the file."""
    output = pathlib.Path(output)
    if not output.is_dir():
        raise InputError(f"{output}: there is no such folder; give the output directory of a run")
    file = render.picture_place(file or output / "strip.png")
    case = read_echo(output)
    if len(case["capsule"]) != 1:
        raise InputError(f"{output}: it has {len(case['capsule'])} capsules; a strip is of one")
    axes = [scene.AXES.index(case["flow"][key]) for key in ("flow_axis", "wall_axis")]
    entries = [series.at(output / "membrane.pvd", time) for time in shear_times]
    if None in entries:
        raise InputError(f"{output}/membrane.pvd: there is nothing to draw (output.membrane_every is 0?)")
    n = len(entries)
    renderers = [
        _panel(output, case, axes, entry, case["capsule"][0]["radius"], (k / n, (k + 1) / n)) for k, entry in enumerate(entries)
    ]
    render.write_picture(renderers, file, (PANEL * n, PANEL))
    return file
