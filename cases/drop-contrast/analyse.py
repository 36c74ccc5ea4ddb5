"""Another viscosity inside: D over that of the theory, what a viscosity ratio makes of it, and where it goes with the radius.

An elastic capsule of small deformation has the same D at every viscosity ratio, so what its D over the theory differs from that with
viscosity ratio 1 is an error of the contrast: of the viscosities on the grid and of the velocity along the membrane, which has a kink
(docs/kernels.md, "Two fluids"). With the shear dipole it is of second order in the grid step, and so are lines in 1/a^2 here.
A drop has an error of its mesh besides, of second order too: the tension of flat triangles that the flow has sheared. The theory is of first order, and
what D is off by then goes as Ca^2. So drops are judged where lines in 1/triangles, 1/a^2 and Ca^2 go.
"""

import collections
import csv
import dataclasses
import io
import math
import pathlib

from tanktread_post.extrapolation import intercept
from tanktread_post.observables import InputError, Observables
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import matching_rows, number_in, read_comparison, read_table
from tanktread_post.run_folder import finished_runs, read_echo
from tanktread_post.table import Table, verdict

SETTINGS = (("reference", "judged_radius", "elastic_band", "elastic_judged", "drop_band", "drop_band_deg"), ())
KINDS = {"skalak": "elastic", "interfacial-tension": "drop"}
TITLES = {"elastic": "elastic capsules", "drop": "drops"}


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run: what it is of, and D and the inclination (degrees) with those of the theory."""

    kind: str
    capillary_number: float
    viscosity_ratio: float
    radius: float  # grid steps
    level: int  # of the mesh
    deformation: float
    inclination_deg: float
    theory: float
    theory_inclination_deg: float

    @property
    def error(self):
        """D over that of the theory, less one."""
        return self.deformation / self.theory - 1

    @property
    def turned(self):
        """The inclination less that of the theory, degrees."""
        return self.inclination_deg - self.theory_inclination_deg


Series = collections.namedtuple("Series", "kind capillary_number level")  # of runs that differ in viscosity ratio and radius


def read_run(directory, file):
    """The reading of one finished run, at the shear time of its row of the reference."""
    echo = read_echo(directory)
    capsule, observables = echo["capsule"][0], Observables(directory)
    law, number = capsule["membrane"]["elastic_law"], capsule["membrane"]["capillary_number"]
    ratio = capsule.get("viscosity_ratio", echo["flow"]["viscosity_ratio"])
    if law not in KINDS:
        raise InputError(f"{directory}/echo.toml: there is no theory here of the law '{law}', only of {', '.join(KINDS)}")
    rows = matching_rows(read_table(file), {"kind": KINDS[law], "capillary_number": number, "viscosity_ratio": ratio})
    if len(rows) != 1:
        raise InputError(f"{file}: {len(rows)} rows are of {KINDS[law]}, Ca = {number:g}, viscosity ratio {ratio:g}, must be one")
    time = number_in(file, "shear_time", rows[0])
    return Reading(
        KINDS[law], number, ratio, capsule["radius"], capsule["mesh"]["level"], observables.at("deformation", time),
        observables.at("inclination_deg", time), number_in(file, "deformation", rows[0]), number_in(file, "inclination_deg", rows[0]),
    )  # fmt: skip


def read_runs(output, case, settings):
    """{Series: {viscosity ratio: {radius: Reading}}} of all finished runs, everything in rising order but for elastic capsules first."""
    file = pathlib.Path(case) / settings["reference"]
    readings = [read_run(directory, file) for directory in finished_runs(output)]
    if not readings:
        raise InputError(f"{output}: no finished run is there")
    series = {}
    for r in sorted(readings, key=lambda r: (list(KINDS.values()).index(r.kind), r.capillary_number, r.level, r.viscosity_ratio, r.radius)):
        by_ratio = series.setdefault(Series(r.kind, r.capillary_number, r.level), {})
        by_ratio.setdefault(r.viscosity_ratio, {})[r.radius] = r
    return series


def limit(errors):
    """Where {radius: error} goes for a wide radius, by the line in 1/a^2; NaN with one radius."""
    return intercept([1 / radius**2 for radius in errors], list(errors.values()))


def beside_one(by_ratio):
    """{viscosity ratio: {radius: D over theory, over that with viscosity ratio 1, less one}}, where the latter is known."""
    one = by_ratio.get(1.0, {})
    return {
        ratio: {radius: (1 + r.error) / (1 + one[radius].error) - 1 for radius, r in by_radius.items() if radius in one}
        for ratio, by_radius in by_ratio.items()
    }


def drop_limit(series, ratio, value):
    """Where a value of the readings of drops goes for fine meshes, then wide radii, then Ca to 0, by lines through what is there: its last stage and
    all before it as [(words, number)]; empty unless each radius of each Ca has two meshes, and there are two radii. `value` is of a Reading."""
    by_number = {}
    for key, by_ratio in series.items():
        if key.kind == "drop":
            for radius, r in by_ratio.get(ratio, {}).items():
                by_number.setdefault(key.capillary_number, {}).setdefault(radius, {})[key.level] = value(r)
    stages, at_number = [], {}
    for number, by_radius in sorted(by_number.items()):
        if len(by_radius) < 2 or any(len(by_level) < 2 for by_level in by_radius.values()):
            return []
        fine = {radius: intercept([4.0**-level for level in by_level], list(by_level.values())) for radius, by_level in by_radius.items()}
        at_number[number] = limit(fine)
        stages.append((f"Ca = {number:g}", at_number[number]))
    if len(at_number) > 1:
        stages.append(("Ca to 0", intercept([number**2 for number in at_number], list(at_number.values()))))
    return stages


def _percent(share):
    return "" if share is None or math.isnan(share) else f"{100 * share:+.2f} %"


def _error_table(series, by_ratio):
    radii = sorted({radius for by_radius in by_ratio.values() for radius in by_radius})
    rows = []
    for ratio, by_radius in by_ratio.items():
        errors = {radius: r.error for radius, r in by_radius.items()}
        turned = ["" if radius not in by_radius else f"{by_radius[radius].turned:+.2f}" for radius in radii]
        rows.append((f"{ratio:g}", *(_percent(errors.get(radius)) for radius in radii), _percent(limit(errors)), *turned, ""))
    header = ("lambda", *(f"D, a = {radius:g}" for radius in radii), "1/a^2 to 0", *(f"degrees, a = {radius:g}" for radius in radii), "")
    title = f"{TITLES[series.kind]}, Ca = {series.capillary_number:g}, {20 * 4**series.level} triangles: against the theory"
    return Table(title, header, rows)


def _elastic_table(by_ratio, settings):
    rows, verdicts = [], []
    for ratio, by_radius in beside_one(by_ratio).items():
        judged = ratio in settings["elastic_judged"] and settings["judged_radius"] in by_radius
        inside = verdict(by_radius[settings["judged_radius"]], settings["elastic_band"]) if judged else None
        for radius, share in by_radius.items():
            here = judged and radius == settings["judged_radius"]
            word = {True: "inside", False: "OUTSIDE"}[inside] if here else "shown only"
            rows.append((f"{ratio:g}", f"{radius:g}", _percent(share), word))
        if len(by_radius) > 1:
            rows.append((f"{ratio:g}", "infinity", _percent(limit(by_radius)), "shown only"))
        verdicts.append(inside)
    title = f"elastic capsules: D over theory, against that with lambda = 1; band {100 * settings['elastic_band']:g} % at a = {settings['judged_radius']:g}"
    return Table(title, ("lambda", "a", "more than with 1", ""), rows, verdicts)


def _drop_table(series, settings):
    rows, verdicts = [], []
    for ratio in sorted({ratio for key, by_ratio in series.items() if key.kind == "drop" for ratio in by_ratio}):
        errors = drop_limit(series, ratio, lambda r: r.error)
        turned = drop_limit(series, ratio, lambda r: r.turned)
        for (words, error), (_, angle) in zip(errors, turned):
            judged = words == errors[-1][0]
            inside = verdict(error, settings["drop_band"]) and verdict(angle, settings["drop_band_deg"])
            word = {True: "inside", False: "OUTSIDE"}[inside] if judged else "shown only"
            rows.append((f"{ratio:g}", words, _percent(error), f"{angle:+.2f}", word))
            verdicts.append(inside if judged else None)
    bands = f"{100 * settings['drop_band']:g} % and {settings['drop_band_deg']:g} degree"
    title = f"drops: against the theory, by lines in 1/triangles, 1/a^2 and Ca^2; bands {bands}"
    return Table(title, ("lambda", "", "D", "degrees", ""), rows, verdicts)


def tables(output, case):
    """The errors of D and of the inclination; what of an elastic capsule's is the contrast's, and where those of drops go, which are judged."""
    settings = read_comparison(case)["analyse"]
    series = read_runs(output, case, settings)
    judged = [_elastic_table(by_ratio, settings) for key, by_ratio in series.items() if key.kind == "elastic" and 1.0 in by_ratio]
    drops = _drop_table(series, settings)
    return [*(_error_table(key, by_ratio) for key, by_ratio in series.items()), *judged, *([drops] if drops.rows else [])]


def measured(output, case):
    """errors.csv: a row a run."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["kind", "capillary_number", "viscosity_ratio", "radius", "triangles", "deformation_error", "inclination_error_deg"])
    for key, by_ratio in read_runs(output, case, read_comparison(case)["analyse"]).items():
        for ratio, by_radius in by_ratio.items():
            for radius, r in by_radius.items():
                writer.writerow([key.kind, key.capillary_number, ratio, radius, 20 * 4**key.level, f"{r.error:.6f}", f"{r.turned:.4f}"])
    return {"errors.csv": stream.getvalue()}


def pictures(output, case):
    """errors.png: D over that of the theory, less one, against the viscosity ratio, a line a series and radius."""
    settings = read_comparison(case)["analyse"]
    figure, axes = new_axes(r"viscosity ratio  $\lambda$", "error of $D$ against the theory  (%)")
    for colour, (key, by_ratio) in zip(COLOURS, read_runs(output, case, settings).items()):
        for radius in sorted({radius for by_radius in by_ratio.values() for radius in by_radius}):
            points = [(ratio, 100 * by_radius[radius].error) for ratio, by_radius in by_ratio.items() if radius in by_radius]
            judged = radius == settings["judged_radius"]
            label = f"{key.kind}, Ca = {key.capillary_number:g}, {20 * 4**key.level} triangles, $a$ = {radius:g}"
            axes.plot(*zip(*points), "o", color=colour, linestyle="solid" if judged else "dashed", markerfacecolor=colour if judged else "white", label=label)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xscale("log")
    axes.legend(frameon=False, fontsize="small")
    return [save(figure, pathlib.Path(output) / "errors.png")]
