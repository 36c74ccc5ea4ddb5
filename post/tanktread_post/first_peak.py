"""The first peak of the deformation against the stiffness of the artificial spring, and which runs break down.

The thesis fits the peak by D1 = A kappa^-b + c (Eq. 3.42), and maps stable and unstable runs over the interval N and
kappa. A run that breaks down is a result here: it is known by its log.
"""

import csv
import dataclasses
import math
import pathlib

import numpy

from .compare import print_rows, table_row
from .observables import InputError, Observables
from .reference import look_up, read_comparison, read_table
from .run_folder import breakdown, is_finished, is_run, read_echo, read_parameters


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run: its parameters, whether it broke down, and the first peak of D (NaN: none yet, or broken down)."""

    run: str
    commit: str  # of the program that made it
    scheme: str
    boussinesq_shear: float
    corrected: bool  # with coupler.tangential_correction
    stiffness: float  # kappa
    interval: int  # N
    interval_times_spring: float  # N k_s', lattice units
    broke_down: bool
    peak: float

    @property
    def outcome(self):
        """As the thesis's table has it."""
        return "breaks down" if self.broke_down else "stable"

    @property
    def series(self):
        """The curve of D1 against kappa to which it belongs."""
        return self.boussinesq_shear, self.corrected


def name_of(series):
    """How a curve is called in tables and pictures."""
    number, corrected = series
    return f"Bq_s = {number:g}" + (", corrected" if corrected else "")


def first_peak(deformation):
    """The first local maximum of a curve at equal distances, by the parabola through it and its neighbours; NaN without one."""
    for before, top, after in zip(deformation, deformation[1:], deformation[2:]):
        if before < top >= after:
            curvature = before - 2 * top + after
            return float(top - (after - before) ** 2 / (8 * curvature))
    return math.nan


def read_run(directory, log):
    """The reading of one run that is finished or broken down; None of another."""
    broken = breakdown(log) is not None
    if not broken and not is_finished(directory):
        return None
    echo = read_echo(directory)
    viscous = echo["capsule"][0]["membrane"]["viscous"]
    if "spring_stiffness" not in viscous:
        raise InputError(f"{directory}: membrane.viscous.spring_stiffness is not given, but the peak is read against it")
    parameters = read_parameters(directory)
    return Reading(
        run=pathlib.Path(directory).name,
        commit=parameters["commit"],
        scheme=viscous["scheme"],
        boussinesq_shear=viscous["boussinesq_shear"],
        corrected=bool(echo["coupler"].get("tangential_correction")),
        stiffness=viscous["spring_stiffness"],
        interval=viscous["interval"],
        interval_times_spring=parameters["capsule"][0]["viscous"]["interval_times_shear_spring"],
        broke_down=broken,
        peak=math.nan if broken else first_peak(Observables(directory)["deformation"]),
    )


def read_runs(output):
    """The readings of all runs below a folder."""
    directories = sorted(path for path in pathlib.Path(output).iterdir() if is_run(path)) if pathlib.Path(output).is_dir() else []
    readings = (read_run(path, path.with_name(path.name + ".log")) for path in directories)
    return sorted((r for r in readings if r is not None), key=lambda r: (*r.series, r.interval, r.stiffness, r.scheme))


def fit(stiffness, peak):
    """A, b, c of peak = A stiffness^-b + c by least squares; NaN with fewer than four points.

    For a given b it is a straight line; the best b between 0.2 and 2 is found on a grid, twice refined.
    """
    if len(set(stiffness)) < 4:
        return math.nan, math.nan, math.nan

    def line(b):
        matrix = numpy.stack([numpy.power(stiffness, -b), numpy.ones(len(stiffness))], axis=1)
        (a, c), *_ = numpy.linalg.lstsq(matrix, numpy.asarray(peak), rcond=None)
        return float(numpy.sum((matrix @ (a, c) - peak) ** 2)), float(a), float(c)

    low, high = 0.2, 2.0
    for _ in range(3):
        grid = numpy.linspace(low, high, 181)
        best = float(min(grid, key=lambda b: line(b)[0]))
        low, high = max(0.2, best - grid[1] + grid[0]), min(2.0, best + grid[1] - grid[0])
    _, a, c = line(best)
    return a, best, c


def curves(readings):
    """{series: readings} of the stable runs with a peak, of the scheme `fd` and N = 1 alone: with others a kappa would count twice."""
    return {
        series: [r for r in readings if r.series == series and (r.scheme, r.interval) == ("fd", 1) and not math.isnan(r.peak)]
        for series in sorted({r.series for r in readings})
    }


def fits(readings, smallest=0.0):
    """{series: (A, b, c)} of the curves, of their part from a smallest stiffness on."""
    chosen = {series: [r for r in curve if r.stiffness >= smallest] for series, curve in curves(readings).items()}
    return {series: fit([r.stiffness for r in curve], [r.peak for r in curve]) for series, curve in chosen.items()}


def fit_rows(readings, case, settings):
    """Rows of the table of fits, and whether each lies in its band: all springs, judged; then those from `also_from` on, if given."""
    rows, verdicts = [], []
    for smallest, bands in ((0.0, (None, None, settings["band"])), (settings.get("also_from"), (None, None, None))):
        if smallest is None:
            continue
        for series, values in fits(readings, smallest).items():
            for name, value, band in zip("Abc", values, bands):
                if math.isnan(value):
                    continue
                published = look_up(case, {"file": settings["fit"], "where": {"bq_s": series[0]}, "column": name})
                part = f", kappa from {smallest:g}" if smallest else ""
                row, inside = table_row(f"{name_of(series)}{part}: {name}", "", value, published, True, band)
                rows.append(row)
                verdicts.append(inside)
    return rows, verdicts


def published_stability(case, settings):
    """The thesis's points: (Bq_s, N, kappa, N k_s' in lattice units, outcome)."""
    rows = read_table(pathlib.Path(case) / settings["stability"])
    points = [(float(row["bq_s"]), int(row["N"]), float(row["kappa"]), row["outcome"]) for row in rows]
    return [(bq, n, kappa, settings["stability_spring"] * n * kappa * bq, outcome) for bq, n, kappa, outcome in points]


def write_readings(readings, file):
    """A CSV of the readings: a row a run, those that broke down among them."""
    with open(file, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(("run", "scheme", "boussinesq_shear", "tangential_correction", "interval", "spring_stiffness", "interval_times_spring", "outcome", "first_peak", "commit"))
        for r in readings:
            peak = "" if math.isnan(r.peak) else f"{r.peak:.8g}"
            numbers = (f"{r.boussinesq_shear:g}", "true" if r.corrected else "", r.interval, f"{r.stiffness:g}", f"{r.interval_times_spring:.6g}")
            writer.writerow((r.run, r.scheme, *numbers, r.outcome, peak, r.commit))


def compare(output, case):
    """Prints peaks, fits and the map of stability; 1 if a limit c lies outside its band, else 0."""
    settings, readings = read_comparison(case)["first_peak"], read_runs(output)
    if not readings:
        raise InputError(f"{output}: no run that is finished or broken down is there")
    print_rows(
        "First peak of D, and stability",
        ("run", "Bq_s", "N", "kappa", "N k_s'", "D1", "outcome"),
        [
            (r.run, f"{r.boussinesq_shear:g}", f"{r.interval}", f"{r.stiffness:g}", f"{r.interval_times_spring:.3g}",
             "" if math.isnan(r.peak) else f"{r.peak:.5f}", r.outcome)
            for r in readings
        ] + [
            ("thesis", f"{bq:g}", f"{n}", f"{kappa:g}", f"{product:.3g}", "", outcome)
            for bq, n, kappa, product, outcome in published_stability(case, settings)
        ],
    )  # fmt: skip
    rows, verdicts = fit_rows(readings, case, settings)
    if rows:
        print_rows("D1 = A kappa^-b + c", ("quantity", "", "ours", "thesis", "difference", "band", ""), rows)
    return 1 if False in verdicts else 0
