"""The error of D and of the inclination by the theory of a kernel's mobility (kernel_theory.py), and against the runs of other cases."""

import dataclasses
import pathlib

import numpy

from tanktread_post.kernel_theory import mobility, read_kernel
from tanktread_post.observables import InputError
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import matching_rows, read_comparison, read_table
from tanktread_post.study import read_study
from tanktread_post.table import Table, verdict
from tanktread_post.viscous_capsule import steady_state

SETTINGS = (
    ("capillary_number", "boussinesq", "radii", "measured", "shear_time", "box_in_radii", "box_error", "band", "not_judged"),
    (),
)


@dataclasses.dataclass(frozen=True)
class Measured:
    """A run of another case: what it was, and its D over that of the sharp theory less one, the box taken off."""

    run: str
    kernel: str
    corrected: bool
    radius: float
    error: float


def kernels_of(output, case):
    """{name: Kernel} of the tables that are there, in the order of study.toml."""
    files = [pathlib.Path(output) / table["file"] for table in read_study(case)["table"]]
    kernels = [read_kernel(file) for file in files if file.is_file()]
    if not kernels:
        raise InputError(f"{output}: no table of a kernel is there")
    return {kernel.name: kernel for kernel in kernels}


def error(kernel, radius, corrected, capillary_number, boussinesq=0.0):
    """(D over that of the sharp theory less one, inclination less that of the sharp theory in degrees)."""
    sharp = steady_state(capillary_number, boussinesq)
    ours = steady_state(capillary_number, boussinesq, mobility=mobility(kernel, radius, corrected))
    return ours[0] / sharp[0] - 1, ours[1] - sharp[1]


def measured_runs(case, settings):
    """The elastic runs of the other cases that the theory is of, in the box whose error is known, without repeats."""
    wanted = {
        "elastic_law": "skalak", "capillary_modulus": "G_s", "capillary_number": settings["capillary_number"],
        "shear_time": settings["shear_time"],
    }  # fmt: skip
    sharp, _ = steady_state(settings["capillary_number"])
    found = {}
    for file in settings["measured"]:
        for row in matching_rows(read_table(pathlib.Path(case) / file), wanted):
            radius, width = float(row["radius"]), float(row["box"].split(" x ")[2])
            if float(row.get("boussinesq_shear") or 0) or float(row.get("boussinesq_dilatational") or 0):
                continue
            if abs(width / radius - settings["box_in_radii"]) > 0.1:
                continue
            corrected = row.get("tangential_correction") == "true"
            ratio = float(row["deformation"]) / (1 + settings["box_error"]) / sharp
            found[row["kernel"], corrected, radius] = Measured(row["run"], row["kernel"], corrected, radius, ratio - 1)
    return [found[key] for key in sorted(found)]


def _name(kernel, corrected):
    return f"{kernel}, corrected" if corrected else kernel


def _theory_table(kernels, settings, boussinesq):
    """Errors of D and of the inclination against the radius, a row a kernel with and without the correction."""
    rows = []
    for name, kernel in kernels.items():
        for corrected in (False, True):
            errors = [error(kernel, radius, corrected, settings["capillary_number"], boussinesq) for radius in settings["radii"]]
            rows.append((_name(name, corrected), *(f"{100 * d:+.2f} % {angle:+.2f}" for d, angle in errors), ""))
    header = ("kernel", *(f"a = {radius:g}" for radius in settings["radii"]), "")
    return Table(f"By theory, Bq_s = {boussinesq:g}: error of D, and of the inclination in degrees", header, rows)


def _measured_table(kernels, case, settings):
    """Measured errors of D beside those of the theory, and whether the difference lies in the band."""
    rows, verdicts = [], []
    for run in measured_runs(case, settings):
        if run.kernel not in kernels:
            continue
        theory, _ = error(kernels[run.kernel], run.radius, run.corrected, settings["capillary_number"])
        band = None if run.kernel in settings["not_judged"] else settings["band"]
        inside = verdict(run.error - theory, band)
        word = {True: "inside", False: "OUTSIDE", None: "shown only"}[inside]
        texts = (f"{100 * value:+.2f} %" for value in (run.error, theory, run.error - theory))
        rows.append((_name(run.kernel, run.corrected), f"{run.radius:g}", *texts, word))
        verdicts.append(inside)
    return Table("Measured, the box taken off, and theory: error of D", ("kernel", "a", "measured", "theory", "difference", ""), rows, verdicts)


def measured(output, case):
    """errors.csv: measured and by theory, a row a run."""
    settings, kernels = read_comparison(case)["analyse"], kernels_of(output, case)
    text = "kernel,tangential_correction,radius,measured_error,theory_error,run\n"
    for run in measured_runs(case, settings):
        if run.kernel in kernels:
            theory, _ = error(kernels[run.kernel], run.radius, run.corrected, settings["capillary_number"])
            text += f"{run.kernel},{'true' if run.corrected else ''},{run.radius:g},{run.error:.6f},{theory:.6f},{run.run}\n"
    return {"errors.csv": text}


def tables(output, case):
    """The tables of the theory for each Bq_s, and that of the measured runs."""
    settings, kernels = read_comparison(case)["analyse"], kernels_of(output, case)
    theory = [_theory_table(kernels, settings, boussinesq) for boussinesq in settings["boussinesq"]]
    return [*theory, _measured_table(kernels, case, settings)]


def pictures(output, case):
    """The error of D against the radius: lines of the theory, points of the runs."""
    settings, kernels = read_comparison(case)["analyse"], kernels_of(output, case)
    runs = measured_runs(case, settings)
    radii = numpy.geomspace(min(settings["radii"]), max(settings["radii"]), 24)
    figure, axes = new_axes("radius  $a$  (grid steps)", "error of $D$  (%)")
    for colour, (name, kernel) in zip(COLOURS, kernels.items()):
        for corrected, style, face in ((False, "solid", colour), (True, "dashed", "white")):
            errors = [100 * error(kernel, radius, corrected, settings["capillary_number"])[0] for radius in radii]
            axes.plot(radii, errors, color=colour, linestyle=style, label=_name(name, corrected))
            points = [(run.radius, 100 * run.error) for run in runs if (run.kernel, run.corrected) == (name, corrected)]
            if points:
                axes.plot(*zip(*points), "o", color=colour, markerfacecolor=face, markersize=5, zorder=3)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xscale("log")
    axes.set_xticks(settings["radii"], [f"{radius:g}" for radius in settings["radii"]])
    axes.minorticks_off()
    axes.legend(frameon=False, fontsize="small", ncols=2)
    return [save(figure, pathlib.Path(output) / "errors.png")]
