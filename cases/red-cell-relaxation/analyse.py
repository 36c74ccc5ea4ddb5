"""The time t_c in which the cell comes back, by the fit of relaxation.py to L/W, against mu_s/G_s; and L/W over time.

The results are output/RUN/drag.csv of the membrane alone, output/RUN/measures.csv of a run in a fluid, RUN a row of releases.csv. L and W are the
axial and the transverse diameter, time is shear time over si.shear_rate_per_s from the release on: the start of drag.csv, load.until of a run.
"""

import dataclasses
import math
import pathlib

import numpy

from tanktread_post.observables import InputError, Observables
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import number_in, read_comparison, read_table
from tanktread_post.relaxation import Relaxation, fit_relaxation
from tanktread_post.run_folder import is_finished, read_echo
from tanktread_post.table import Table
from tanktread_post.toml_tables import read_toml

SETTINGS = (("reference", "later_than", "line_band", "slope_low", "slope_high"), ())
LINES = {"membrane": "the membrane alone", "fluid": "in plasma"}  # groups of releases.csv


@dataclasses.dataclass(frozen=True)
class Release:
    """A cell that comes back."""

    run: str
    group: str  # of LINES; "" on no line
    viscosity: float  # mu_s, N s/m
    membrane_time: float  # mu_s/G_s, s
    drag: float  # NaN in a fluid
    seconds: numpy.ndarray
    ratio: numpy.ndarray  # L/W
    fit: Relaxation  # to all of it
    later: Relaxation  # without the first part, in which what has no viscosity comes back


def _in_a_fluid(folder):
    """(seconds since the release, L/W) of a finished run that lets its load go; None of another."""
    if not (folder / "echo.toml").is_file() or not is_finished(folder):
        return None
    echo, measures = read_echo(folder), Observables(folder, table="measures.csv")
    seconds = (measures["shear_time"] - echo["capsule"][0]["load"]["until"]) / echo["si"]["shear_rate_per_s"]
    return (part[seconds >= 0] for part in (seconds, measures["axial_diameter"] / measures["transverse_diameter"]))


def _alone(folder, shear_rate):
    """The same of a membrane alone."""
    table = folder / "drag.csv"
    if not table.is_file():
        return None
    rows = read_table(table)
    seconds = numpy.array([number_in(table, "shear_time", one) for one in rows]) / shear_rate
    return seconds, numpy.array([number_in(table, "axial_diameter", one) / number_in(table, "transverse_diameter", one) for one in rows])


def releases(output, case):
    """The releases that are there, in the order of releases.csv."""
    si, file = read_toml(pathlib.Path(case) / "case.toml")["si"], pathlib.Path(case) / "releases.csv"
    later_than = read_comparison(case)["analyse"]["later_than"]
    found = []
    for row in read_table(file):
        folder, drag = pathlib.Path(output) / row["run"], number_in(file, "drag", row) if row["drag"] else math.nan
        series = _in_a_fluid(folder) if math.isnan(drag) else _alone(folder, si["shear_rate_per_s"])
        if series is None:
            continue
        seconds, ratio = series
        viscosity = number_in(file, "si.membrane_shear_viscosity_N_s_per_m", row)
        try:
            fit, later = (fit_relaxation(seconds[chosen], ratio[chosen]) for chosen in (seconds >= 0, seconds >= later_than))
        except InputError as error:
            raise InputError(f"{folder}: {error}") from None
        found.append(Release(row["run"], row["groups"], viscosity, viscosity / si["shear_modulus_N_per_m"], drag, seconds, ratio, fit, later))
    if not found:
        raise InputError(f"{output}: there are no results of a run of {file}")
    return found


def measured_times(case, settings):
    """t_c of the cells of the reference, s."""
    file = pathlib.Path(case) / settings["reference"]
    return [number_in(file, "tc_s", row) for row in read_table(file)]


def line_of(found, group):
    """(slope, t_c at 0 in s) of the straight line of t_c over mu_s/G_s through the releases of a group; None with fewer than three."""
    chosen = [one for one in found if one.group == group]
    return None if len(chosen) < 3 else tuple(numpy.polyfit([one.membrane_time for one in chosen], [one.fit.time for one in chosen], 1))


def _over_membrane_time(time, one):
    return f"{time / one.membrane_time:.3f}" if one.membrane_time else ""


def _times_table(found, times, lines, settings):
    rows, verdicts = [], []
    for one in found:
        line = lines.get(one.group)
        off = one.fit.time / numpy.polyval(line, one.membrane_time) - 1 if line else None
        inside = None if off is None else abs(off) <= settings["line_band"]
        word = {None: "shown only", True: "inside", False: "OUTSIDE"}[inside]
        in_range = min(times) <= one.fit.time <= max(times)
        rows.append(
            (
                one.run, f"{one.membrane_time:.4f}", "a fluid" if math.isnan(one.drag) else f"{one.drag:g}", f"{one.fit.time:.4f}",
                _over_membrane_time(one.fit.time, one), _over_membrane_time(one.later.time, one),
                f"{one.fit.start:.2f}", f"{one.fit.end:.3f}", f"{one.fit.rms:.3f}", "" if off is None else f"{100 * off:+.1f} %",
                "within the measured" if in_range else "", word,
            )
        )  # fmt: skip
        verdicts.append(inside)
    header = ("run", "mu_s/G_s", "drag", "t_c", "t_c G_s/mu_s", f"after {settings['later_than']:g} s", "L/W first", "end", "rms", "off the line", f"cells: {min(times):g} to {max(times):g} s", "")
    return Table(f"Times in s; band {100 * settings['line_band']:g} % off the line", header, rows, verdicts=tuple(verdicts))


def _line_table(lines, settings):
    rows, verdicts = [], []
    for group, (slope, start) in lines.items():
        verdicts.append(settings["slope_low"] <= slope <= settings["slope_high"])
        rows.append((LINES[group], f"{slope:.3f}", f"{settings['slope_low']:g} to {settings['slope_high']:g}", f"{start:.4f}", "inside" if verdicts[-1] else "OUTSIDE"))
    return Table("The line t_c = slope mu_s/G_s + t_0", ("", "slope", "band", "t_0 (s)", ""), rows, verdicts=tuple(verdicts))


def tables(output, case):
    """The times, and their lines."""
    settings, found = read_comparison(case)["analyse"], releases(output, case)
    lines = {group: line for group in LINES if (line := line_of(found, group))}
    return [_times_table(found, measured_times(case, settings), lines, settings), *([_line_table(lines, settings)] if lines else [])]


def measured(output, case):
    """relaxation.csv: a row a run."""
    text = "run,mu_s_N_s_per_m,mu_s_over_G_s_s,drag,tc_s,later_tc_s,start_L_over_W,end_L_over_W,rms\n"
    for one in releases(output, case):
        drag = "" if math.isnan(one.drag) else f"{one.drag:g}"
        text += f"{one.run},{one.viscosity:g},{one.membrane_time:g},{drag},{one.fit.time:.6g},{one.later.time:.6g},{one.fit.start:.5g},{one.fit.end:.5g},{one.fit.rms:.3g}\n"
    return {"relaxation.csv": text}


def _ratio_picture(found, file):
    """L/W over time since the release, ours and the fit."""
    figure, axes = new_axes("time since the release  (s)", "$L/W$")
    for number, one in enumerate(found):
        colour = COLOURS[number % len(COLOURS)]
        axes.plot(one.seconds, one.ratio, color=colour, label=f"{one.run}: $t_c$ = {one.fit.time:.3f} s")
        axes.plot(one.seconds, one.fit.at(one.seconds), color=colour, linestyle="dotted")
    axes.set_xlim(left=0)
    axes.legend(frameon=False, fontsize="small", title="lines: the cell, dots: the fit")
    return save(figure, file)


def _times_picture(found, times, file):
    """t_c over mu_s/G_s, with the range of the cells."""
    figure, axes = new_axes(r"$\mu_s/G_s$  (s)", "$t_c$  (s)")
    axes.axhspan(min(times), max(times), color="#000000", alpha=0.08, label="cells (Hochmuth et al. 1979)")
    for colour, (group, name) in zip(COLOURS, LINES.items()):
        own = [one for one in found if math.isnan(one.drag) == (group == "fluid") and (one.group == group or one.viscosity == 0)]
        if not own:
            continue
        axes.plot([one.membrane_time for one in own], [one.fit.time for one in own], "o", color=colour, label=name)
        if line := line_of(found, group):
            ends = numpy.array([0, max(one.membrane_time for one in own)])
            axes.plot(ends, numpy.polyval(line, ends), color=colour, linewidth=1)
    axes.set_xlim(left=-0.003)
    axes.set_ylim(bottom=0)
    axes.legend(frameon=False, fontsize="small")
    return save(figure, file)


def pictures(output, case):
    """relaxation.png: L/W over time since the release, ours and the fit; times.png: t_c over mu_s/G_s."""
    found, folder = releases(output, case), pathlib.Path(output)
    times = measured_times(case, read_comparison(case)["analyse"])
    return [_ratio_picture(found, folder / "relaxation.png"), _times_picture(found, times, folder / "times.png")]
