"""PNG plots of the tables of a study, both axes logarithmic, with the reference drawn in."""

import pathlib

from matplotlib.ticker import LogFormatter

from .plot import COLOURS, new_axes, save
from .reference import read_comparison
from .study import lines_of, read_study, reference_points

DASHES = ("-", "--", ":", "-.")


def plot_tables(output, case):
    """Writes a PNG for each [[plot]] of study.toml whose table is there. Returns the files."""
    plots = [plot for plot in read_study(case)["plot"] if (pathlib.Path(output) / plot["table"]).is_file()]
    source = read_comparison(case)["source"]
    return [_plot_table(output, case, plot, source) for plot in plots]


def _plot_table(output, case, plot, source):
    figure, axes = new_axes(plot["x_label"], plot["y_label"])
    axes.set_xscale("log")
    axes.set_yscale("log")
    _spell_out_ticks(axes)
    for k, (label, (x, y)) in enumerate(lines_of(output, plot).items()):
        dash, colour = DASHES[k // len(COLOURS) % len(DASHES)], COLOURS[k % len(COLOURS)]
        axes.plot(x, y, "o" + dash, color=colour, markersize=3, label=label or "tanktread")
    points = reference_points(case, plot)
    if points:
        axes.plot(*points, "o", color="black", markerfacecolor="white", markersize=7, label=source, zorder=3)
    axes.legend(frameon=False, fontsize="small")
    return save(figure, pathlib.Path(output) / plot["file"])


def _spell_out_ticks(axes):
    """Numbers between the powers of ten too, where an axis spans few of them."""
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_formatter(LogFormatter())
        axis.set_minor_formatter(LogFormatter(minor_thresholds=(1.5, 0.5)))
