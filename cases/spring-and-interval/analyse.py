"""The first peak of the deformation against the stiffness of the artificial spring, and which runs break down.

The thesis fits the peak by D1 = A kappa^-b + c (Eq. 3.42), and maps stable and unstable runs over the interval N and
kappa. A run that breaks down is a result here: it is known by its log.
"""

import csv
import dataclasses
import io
import math
import pathlib

import numpy

from tanktread_post.observables import InputError, Observables
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import look_up, read_comparison, read_table
from tanktread_post.run_folder import breakdown, is_finished, is_run, read_echo, read_parameters
from tanktread_post.table import Table, table_row

# also_from: the least stiffness of a second fit, which is shown and not judged.
SETTINGS = (("fit", "stability", "stability_spring", "band"), ("also_from",))
BREAKDOWN_IS_A_RESULT = True


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


def written(readings):
    """The readings as the text of a CSV: a row a run, those that broke down among them."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(("run", "scheme", "boussinesq_shear", "tangential_correction", "interval", "spring_stiffness", "interval_times_spring", "outcome", "first_peak", "commit"))
    for r in readings:
        peak = "" if math.isnan(r.peak) else f"{r.peak:.8g}"
        numbers = (f"{r.boussinesq_shear:g}", "true" if r.corrected else "", r.interval, f"{r.stiffness:g}", f"{r.interval_times_spring:.6g}")
        writer.writerow((r.run, r.scheme, *numbers, r.outcome, peak, r.commit))
    return stream.getvalue()


def measured(output, case):
    """first_peak.csv, for --measure."""
    return {"first_peak.csv": written(read_runs(output))}


def tables(output, case):
    """Peaks and the map of stability, and the fits, of which the limit c is judged."""
    settings, readings = read_comparison(case)["analyse"], read_runs(output)
    if not readings:
        raise InputError(f"{output}: no run that is finished or broken down is there")
    peaks = Table(
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
    fitted = Table("D1 = A kappa^-b + c", ("quantity", "", "ours", "thesis", "difference", "band", ""), rows, verdicts)
    return [peaks, fitted] if rows else [peaks]


def plot_peaks(output, case, readings):
    """first_peak.png: D1 against kappa, with our fit and the published one."""
    settings = read_comparison(case)["analyse"]
    published = {float(row["bq_s"]): row for row in read_table(pathlib.Path(case) / settings["fit"])}
    figure, axes = new_axes(r"stiffness of the spring  $\kappa$", "first peak  $D_1$")
    axes.set_xscale("log")
    fitted = fits(readings)
    for colour, (series, chosen) in zip(COLOURS, curves(readings).items()):
        if not chosen:
            continue
        number, corrected = series
        axes.plot([r.stiffness for r in chosen], [r.peak for r in chosen], "o", color=colour, label=name_of(series))
        a, b, c = fitted[series]
        x = numpy.geomspace(1, max(r.stiffness for r in chosen), 100)
        if not math.isnan(a):
            axes.plot(x, a * x**-b + c, color=colour, linewidth=1)
        if number in published and not (corrected and (number, False) in fitted):
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
    points = published_stability(case, read_comparison(case)["analyse"])
    for outcome, marker in (("stable", "s"), ("breaks down", "x")):
        chosen = [(n, product) for _, n, _, product, said in points if said == outcome]
        if chosen:
            axes.plot(*zip(*chosen), marker, color="black", markerfacecolor="white", label=f"thesis, {outcome}")
    axes.legend(frameon=False)
    return save(figure, pathlib.Path(output) / "stability.png")


def pictures(output, case):
    """Both pictures."""
    readings = read_runs(output)
    return [plot_peaks(output, case, readings), plot_stability(output, case, readings)] if readings else []
