"""Pictures of the first peak of the deformation against kappa, and of stable and unstable runs over N and kappa."""

import math
import pathlib

import numpy

from . import first_peak
from .plot import COLOURS, new_axes, save
from .reference import read_comparison, read_table


def plot_peaks(output, case, readings):
    """first_peak.png: D1 against kappa, with our fit and the published one."""
    settings = read_comparison(case)["first_peak"]
    published = {float(row["bq_s"]): row for row in read_table(pathlib.Path(case) / settings["fit"])}
    figure, axes = new_axes(r"stiffness of the spring  $\kappa$", "first peak  $D_1$")
    axes.set_xscale("log")
    fits = first_peak.fits(readings)
    for colour, (series, chosen) in zip(COLOURS, first_peak.curves(readings).items()):
        if not chosen:
            continue
        number, corrected = series
        axes.plot([r.stiffness for r in chosen], [r.peak for r in chosen], "o", color=colour, label=first_peak.name_of(series))
        a, b, c = fits[series]
        x = numpy.geomspace(1, max(r.stiffness for r in chosen), 100)
        if not math.isnan(a):
            axes.plot(x, a * x**-b + c, color=colour, linewidth=1)
        if number in published and not (corrected and (number, False) in fits):
            a, b, c = (float(published[number][name]) for name in "Abc")
            axes.plot(x, a * x**-b + c, "--", color="black", linewidth=1, label=f"thesis, $Bq_s$ = {number:g}")
    if axes.has_data():
        axes.legend(frameon=False)
    return save(figure, pathlib.Path(output) / "first_peak.png")


def plot_stability(output, case, readings):
    """stability.png: N k_s' of each run against N, stable or not, the thesis's points beside ours."""
    figure, axes = new_axes("steps between updates  $N$", r"$N k_s'$  (lattice units)")
    axes.set_xscale("log")
    axes.set_yscale("log")
    for place, (colour, number) in enumerate(zip(COLOURS, sorted({r.boussinesq_shear for r in readings}))):
        for broken, marker in ((False, "s"), (True, "x")):
            chosen = [r for r in readings if r.boussinesq_shear == number and r.broke_down == broken]
            if chosen:
                label = f"$Bq_s$ = {number:g}, {'breaks down' if broken else 'stable'}"
                beside = [r.interval * 1.05**place for r in chosen]  # so that points of one N and N k_s' do not hide each other
                axes.plot(beside, [r.interval_times_spring for r in chosen], marker, color=colour, label=label)
    points = first_peak.published_stability(case, read_comparison(case)["first_peak"])
    for outcome, marker in (("stable", "s"), ("breaks down", "x")):
        chosen = [(n, product) for _, n, _, product, said in points if said == outcome]
        if chosen:
            axes.plot(*zip(*chosen), marker, color="black", markerfacecolor="white", label=f"thesis, {outcome}")
    axes.legend(frameon=False)
    return save(figure, pathlib.Path(output) / "stability.png")


def plot_first_peak(output, case):
    """Both pictures; their files."""
    readings = first_peak.read_runs(output)
    return [plot_peaks(output, case, readings), plot_stability(output, case, readings)] if readings else []
