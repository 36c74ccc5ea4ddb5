"""Opens the output of a run in ParaView: the membrane coloured by its area ratio, the velocity in the shear plane.

    TANKTREAD_OUTPUT=output/shear-capsule paraview --script=post/paraview/open_output.py     in the window
    pvbatch post/paraview/open_output.py output/shear-capsule picture.png                    a picture, no window

The last moment is shown; the time slider goes through all of them, in shear times.
"""

import os
import sys

from paraview import simple

MEMBRANE_FIELD = ("CELLS", "area_ratio")
N_ARROWS = 16  # across the box


def open_series(folder, name):
    """A .pvd series as a source; None if the run wrote no such files."""
    file = os.path.join(folder, name + ".pvd")
    if not os.path.isfile(file):
        sys.exit(f"{file}: there is no such file; is {folder} the output of a run?")
    with open(file) as stream:
        if "<DataSet" not in stream.read():
            return None
    source = simple.PVDReader(registrationName=name, FileName=file)
    source.UpdatePipeline()
    return source


def show_membrane(membrane, view):
    """The membrane with its mesh."""
    display = simple.Show(membrane, view)
    display.SetRepresentationType("Surface With Edges")
    simple.ColorBy(display, MEMBRANE_FIELD)
    display.RescaleTransferFunctionToDataRange(False, True)
    display.SetScalarBarVisibility(view, True)


def show_flow(fluid, view):
    """Outline of the box; velocity along the flow, and arrows, in the plane through its middle across y."""
    outline = simple.Show(fluid, view)
    outline.SetRepresentationType("Outline")
    bounds = fluid.GetDataInformation().GetBounds()
    plane = simple.Slice(registrationName="shear plane", Input=fluid, SliceType="Plane")
    plane.SliceType.Origin = [0.5 * (bounds[2 * k] + bounds[2 * k + 1]) for k in range(3)]
    plane.SliceType.Normal = [0.0, 1.0, 0.0]
    display = simple.Show(plane, view)
    simple.ColorBy(display, ("POINTS", "velocity", "X"))
    display.Opacity = 0.6
    display.SetScalarBarVisibility(view, True)

    plane.UpdatePipeline()
    velocity = plane.PointData["velocity"]
    fastest = max(abs(velocity.GetRange(0)[0]), abs(velocity.GetRange(0)[1])) or 1.0
    spacing = (bounds[1] - bounds[0]) / N_ARROWS
    arrows = simple.Glyph(registrationName="velocity arrows", Input=plane, GlyphType="Arrow")
    arrows.OrientationArray = ["POINTS", "velocity"]
    arrows.ScaleArray = ["POINTS", "velocity"]
    arrows.ScaleFactor = spacing / fastest
    arrows.GlyphMode = "Uniform Spatial Distribution (Bounds Based)"
    arrows.MaximumNumberOfSamplePoints = N_ARROWS * N_ARROWS
    shown = simple.Show(arrows, view)
    simple.ColorBy(shown, None)
    shown.AmbientColor = shown.DiffuseColor = [0.15, 0.15, 0.18]


def look_along_vorticity(view):
    """The flow to the right, the gradient up, a little from the side and from above."""
    view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, -1, 0], [0, 0, 0], [0, 0, 1]
    simple.ResetCamera(view)
    camera = simple.GetActiveCamera()
    camera.Azimuth(-24)
    camera.Elevation(14)


def main(folder, picture=None):
    """Builds the scene; with `picture`, saves it there."""
    view = simple.GetActiveViewOrCreate("RenderView")
    membrane, fluid = open_series(folder, "membrane"), open_series(folder, "fluid")
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.GoToLast()
    if fluid is not None:
        show_flow(fluid, view)
    if membrane is not None:
        show_membrane(membrane, view)
    look_along_vorticity(view)
    simple.Render(view)
    if picture:
        simple.SaveScreenshot(picture, view, ImageResolution=[1200, 900])


arguments = sys.argv[1:] or [os.environ.get("TANKTREAD_OUTPUT", "")]
if not arguments[0]:
    sys.exit(__doc__)
main(*arguments[:2])
