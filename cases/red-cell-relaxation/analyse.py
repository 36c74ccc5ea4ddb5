"""The time t_c in which the cell comes back, by the fit of relaxation.py to L/W, against mu_s/G_s; and L/W over time.

The results are output/RUN/drag.csv, RUN a row of releases.csv. L and W are the axial and the transverse diameter, time is shear time over
si.shear_rate_per_s from the release on.
"""

import dataclasses
import pathlib

import numpy

from tanktread_post.observables import InputError
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import number_in, read_comparison, read_table
from tanktread_post.relaxation import Relaxation, fit_relaxation
from tanktread_post.table import Table
from tanktread_post.toml_tables import read_toml

SETTINGS = (("reference", "later_than", "line_band", "slope_low", "slope_high"), ())


@dataclasses.dataclass(frozen=True)
class Release:
    """A cell that comes back."""

    run: str
    on_line: bool
    viscosity: float  # mu_s, N s/m
    membrane_time: float  # mu_s/G_s, s
    drag: float
    seconds: numpy.ndarray
    ratio: numpy.ndarray  # L/W
    fit: Relaxation  # to all of it
    later: Relaxation  # without the first part, in which what has no viscosity comes back


def releases(output, case):
    """The releases that are there, in the order of releases.csv."""
    si, file = read_toml(pathlib.Path(case) / "case.toml")["si"], pathlib.Path(case) / "releases.csv"
    later_than = read_comparison(case)["analyse"]["later_than"]
    found = []
    for row in read_table(file):
        table = pathlib.Path(output) / row["run"] / "drag.csv"
        if not table.is_file():
            continue
        viscosity = number_in(file, "si.membrane_shear_viscosity_N_s_per_m", row)
        rows = read_table(table)
        seconds = numpy.array([number_in(table, "shear_time", one) for one in rows]) / si["shear_rate_per_s"]
        ratio = numpy.array([number_in(table, "axial_diameter", one) / number_in(table, "transverse_diameter", one) for one in rows])
        try:
            fit, later = (fit_relaxation(seconds[chosen], ratio[chosen]) for chosen in (seconds >= 0, seconds >= later_than))
        except InputError as error:
            raise InputError(f"{table}: {error}") from None
        found.append(
            Release(
                row["run"], "line" in row["groups"].split(), viscosity, viscosity / si["shear_modulus_N_per_m"], number_in(file, "drag", row),
                seconds, ratio, fit, later,
            )
        )  # fmt: skip
    if not found:
        raise InputError(f"{output}: there are no results of a run of {file}")
    return found


def measured_times(case, settings):
    """t_c of the cells of the reference, s."""
    file = pathlib.Path(case) / settings["reference"]
    return [number_in(file, "tc_s", row) for row in read_table(file)]


def line_of(found):
    """(slope, t_c at 0 in s) of the straight line of t_c over mu_s/G_s through the runs on it; None with fewer than three."""
    chosen = [one for one in found if one.on_line]
    return None if len(chosen) < 3 else tuple(numpy.polyfit([one.membrane_time for one in chosen], [one.fit.time for one in chosen], 1))


def _times_table(found, times, line, settings):
    rows, verdicts = [], []
    for one in found:
        off = one.fit.time / numpy.polyval(line, one.membrane_time) - 1 if line and one.on_line else None
        inside = None if off is None else abs(off) <= settings["line_band"]
        word = {None: "shown only", True: "inside", False: "OUTSIDE"}[inside]
        in_range = min(times) <= one.fit.time <= max(times)
        rows.append(
            (
                one.run, f"{one.membrane_time:.4f}", f"{one.drag:g}", f"{one.fit.time:.4f}", f"{one.fit.time / one.membrane_time:.3f}",
                f"{one.later.time / one.membrane_time:.3f}",
                f"{one.fit.start:.2f}", f"{one.fit.end:.3f}", f"{one.fit.rms:.3f}", "" if off is None else f"{100 * off:+.1f} %",
                "within the measured" if in_range else "", word,
            )
        )  # fmt: skip
        verdicts.append(inside)
    header = ("run", "mu_s/G_s", "drag", "t_c", "t_c G_s/mu_s", f"after {settings['later_than']:g} s", "L/W first", "end", "rms", "off the line", f"cells: {min(times):g} to {max(times):g} s", "")
    return Table(f"Times in s; band {100 * settings['line_band']:g} % off the line", header, rows, verdicts=tuple(verdicts))


def _line_table(line, settings):
    inside = settings["slope_low"] <= line[0] <= settings["slope_high"]
    row = (f"{line[0]:.3f}", f"{settings['slope_low']:g} to {settings['slope_high']:g}", f"{line[1]:.4f}", "inside" if inside else "OUTSIDE")
    return Table("The line t_c = slope mu_s/G_s + t_0", ("slope", "band", "t_0 (s)", ""), [row], verdicts=(inside,))


def tables(output, case):
    """The times, and their line."""
    settings, found = read_comparison(case)["analyse"], releases(output, case)
    line = line_of(found)
    return [_times_table(found, measured_times(case, settings), line, settings), *([_line_table(line, settings)] if line else [])]


def measured(output, case):
    """relaxation.csv: a row a run."""
    text = "run,mu_s_N_s_per_m,mu_s_over_G_s_s,drag,tc_s,later_tc_s,start_L_over_W,end_L_over_W,rms\n"
    for one in releases(output, case):
        text += f"{one.run},{one.viscosity:g},{one.membrane_time:g},{one.drag:g},{one.fit.time:.6g},{one.later.time:.6g},{one.fit.start:.5g},{one.fit.end:.5g},{one.fit.rms:.3g}\n"
    return {"relaxation.csv": text}


def pictures(output, case):
    """relaxation.png: L/W over time since the release, ours and the fit."""
    figure, axes = new_axes("time since the release  (s)", "$L/W$")
    for colour, one in zip(COLOURS, releases(output, case)):
        axes.plot(one.seconds, one.ratio, color=colour, label=f"{one.run}: $t_c$ = {one.fit.time:.3f} s")
        axes.plot(one.seconds, one.fit.at(one.seconds), color=colour, linestyle="dotted")
    axes.set_xlim(left=0)
    axes.legend(frameon=False, fontsize="small", title="lines: the membrane, dots: the fit")
    return [save(figure, pathlib.Path(output) / "relaxation.png")]
