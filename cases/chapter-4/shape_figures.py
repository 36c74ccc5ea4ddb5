"""Pictures in the form of the thesis's Figures 4.4, 4.7 and 4.11: outlines in the shear plane with the marker, and how it moves."""

import math
import pathlib

import numpy
from matplotlib import pyplot
from tanktread_post.plot import COLOURS, new_panels, save

TIME = r"shear time  $\dot\gamma t$"
LONGEST = 1.75  # half a side of a panel with an outline, over a
PAPER = {"facecolor": "white", "edgecolor": "none", "pad": 1}  # behind a number that stands on a curve
MARKER = {"marker": "o", "color": "black", "markersize": 6, "linestyle": "none", "zorder": 4}


def _draw_outline(axes, outline, inclination_deg, title):
    """An outline with its marker, the undeformed circle, and a line along the inclination."""
    angles = numpy.linspace(0, 2 * math.pi, 181)
    axes.plot(numpy.cos(angles), numpy.sin(angles), linestyle="dashed", color=COLOURS[0], linewidth=1)
    for curve in outline.curves:
        axes.plot(*numpy.vstack([curve, curve[:1]]).T, color=COLOURS[1], linewidth=1.5)
    tilt = LONGEST * numpy.array([math.cos(math.radians(inclination_deg)), math.sin(math.radians(inclination_deg))])
    axes.plot([-tilt[0], tilt[0]], [-tilt[1], tilt[1]], linestyle="dashed", color="grey", linewidth=1)
    axes.plot(*outline.marker, **MARKER)
    axes.set(xlim=(-LONGEST, LONGEST), ylim=(-LONGEST, LONGEST), aspect="equal", xlabel="$x/a$", ylabel="$z/a$")
    axes.set_title(title, fontsize="medium")


def _with_mean(axes, history, name, label, stretch):
    """A quantity against time, and a dashed line at its mean over a stretch of time, with the number."""
    axes.plot(history["shear_time"], history[name], color=COLOURS[0])
    mean = history.mean(name, *stretch)
    if not math.isnan(mean):
        axes.plot(stretch, [mean, mean], linestyle="dashed", color="black")
        axes.annotate(f"{mean:.4f}", (stretch[1], mean), xytext=(0, 6), textcoords="offset points", ha="right", fontsize="small", bbox=PAPER)
    axes.set(xlabel=TIME, ylabel=label, xlim=(0, history["shear_time"][-1]))


def markers(file, columns, stretch):
    """Fig. 4.4: a column for each (title, Reading, History, Outline): the outline, the marker's places and speed, and C* against time, with means over a
    stretch of time. Returns the file, None where there is no run."""
    if not columns:
        return None
    figure, panels = new_panels([TIME] * len(columns), ["", "marker,  $x/a$ and $z/a$", r"marker speed  $V/\dot\gamma a$", "circumference  $C^*$"])
    for (title, _, history, outline), column in zip(columns, panels.T):
        _draw_outline(column[0], outline, history.at("inclination_deg", outline.shear_time), rf"{title}, $\dot\gamma t$ = {outline.shear_time:g}")
        for name, label, colour in (("marker_along_flow", "$x/a$", COLOURS[0]), ("marker_along_gradient", "$z/a$", COLOURS[1])):
            column[1].plot(history["shear_time"], history[name], color=colour, label=label)
        column[1].set_xlim(0, history["shear_time"][-1])
        column[1].legend(frameon=False, fontsize="small", loc="upper right")
        _with_mean(column[2], history, "marker_speed", r"marker speed  $V/\dot\gamma a$", stretch)
        _with_mean(column[3], history, "circumference", "circumference  $C^*$", stretch)
    return save(figure, file)


def paths(file, columns):
    """Of each of (title, Reading, History, Outline): the path of the marker in its last turn with its places at equal times, a quarter of a shear time
    apart, on the outline (above); its speed against its angle from the flow axis (below)."""
    if not columns:
        return None
    figure, panels = new_panels([""] * len(columns), ["", r"marker speed  $V/\dot\gamma a$"])
    for (title, reading, history, outline), column in zip(columns, panels.T):
        turn = 2 * math.pi / reading.nu_marker if not math.isnan(reading.nu_marker) else math.inf
        last = history["shear_time"] > history["shear_time"][-1] - turn
        x, z, speed = (history[name][last] for name in ("marker_along_flow", "marker_along_gradient", "marker_speed"))
        for curve in outline.curves:
            column[0].plot(*numpy.vstack([curve, curve[:1]]).T, color="grey", linewidth=1, label=rf"outline at {outline.shear_time:g}")
        column[0].plot(x, z, "o", color=COLOURS[1], markersize=3, label="marker, every 0.25")
        column[0].set(xlim=(-LONGEST, LONGEST), ylim=(-LONGEST, LONGEST), aspect="equal", xlabel="$x/a$", ylabel="$z/a$")
        column[0].set_title(title, fontsize="medium")
        column[0].legend(frameon=False, fontsize="small", loc="lower right")
        column[1].plot(numpy.degrees(numpy.arctan2(z, x)), speed, "o", color=COLOURS[1], markersize=3)
        column[1].set(xlabel="angle of the marker  (degrees)", xlim=(-180, 180), ylim=(0, None))
        column[1].set_xticks(range(-180, 181, 90))
    return save(figure, file)


def _in_a_row(file, panels_of, n_columns):
    """A picture of outlines only: (outline, inclination, title) of each panel."""
    n_rows = math.ceil(len(panels_of) / n_columns)
    figure, panels = pyplot.subplots(n_rows, n_columns, figsize=(3.4 * n_columns, 3.6 * n_rows), layout="constrained", squeeze=False)
    for axes, one in zip(panels.flat, panels_of):
        _draw_outline(axes, *one)
        axes.tick_params(length=3)
    for axes in panels.flat[len(panels_of) :]:
        axes.remove()
    return save(figure, file)


def three_shapes(file, trio):
    """Fig. 4.7 of runs that were computed: a reference, one with the same inclination and a smaller D, one with the same D and a larger inclination;
    (name, Reading, Outline) each, none where the runs are not there."""
    if not trio:
        return None
    drawn = []
    for letter, (name, r, outline) in zip("abc", trio):
        drawn.append((outline, r.inclination_deg, f"({letter}) {name}\n$D$ = {r.deformation:.3f}, {r.inclination_deg:.1f} degrees, $V^*$ = {r.membrane_speed:.3f}"))
    return _in_a_row(file, drawn, 3)


def deforming(file, history, outlines):
    """Fig. 4.11: the outlines of one run at some times; none where the run is not there."""
    if history is None or not outlines:
        return None
    drawn = []
    for one in outlines:
        D, inclination = (history.at(name, one.shear_time) for name in ("deformation", "inclination_deg"))
        drawn.append((one, inclination, rf"$\dot\gamma t$ = {one.shear_time:g},  $D$ = {D:.3f},  {inclination:.1f} degrees"))
    return _in_a_row(file, drawn, 4)


def all_pictures(output, columns, trio, history, outlines, stretch):
    """Draws what can be drawn. Returns the files."""
    output = pathlib.Path(output)
    drawn = [
        markers(output / "fig-4.4.png", columns, stretch),
        paths(output / "marker.png", columns),
        three_shapes(output / "fig-4.7.png", trio),
        deforming(output / "fig-4.11.png", history, outlines),
    ]
    return [file for file in drawn if file is not None]
