"""Large deformation against boundary integrals: D and inclination in the unbounded fluid, from boxes of several sizes.

A capsule is a stresslet, whose velocity falls like 1/r^2: walls and periodic images at a distance L change the shear rate that
it sees by a share of (a/L)^3. So D and inclination of the unbounded fluid come from a line in (a/L)^3.
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
from tanktread_post.run_folder import capillary_number_by_shear_modulus, end_of, finished_runs, read_echo
from tanktread_post.table import Table, difference, shown, verdict

SETTINGS = (("reference", "viscosity_ratio", "radius", "read_over", "band", "inclination_band"), ())
QUANTITIES = {"deformation": "D", "inclination_deg": "inclination"}  # columns of observables.csv and of the reference
Case = collections.namedtuple("Case", "law area_ratio capillary_number")  # what a row of the reference is of; by G_s


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run: its parameters, D and inclination (degrees) at its end."""

    case: Case
    radius: float  # grid steps
    width: int  # grid steps, of the cubic box
    deformation: float
    inclination_deg: float

    @property
    def box(self):
        """The box in radii, as text."""
        return f"{self.width / self.radius:.0f}"


def read_run(directory, read_over):
    """The reading of one finished run: means over its last `read_over` shear times."""
    echo, observables = read_echo(directory), Observables(directory)
    capsule = echo["capsule"][0]
    membrane = capsule["membrane"]
    # A run to T ends with the step nearest to T.
    end = min(end_of(directory), float(observables["shear_time"][-1]))
    means = {name: observables.mean(name, end - read_over, end) for name in QUANTITIES}
    area_ratio = membrane["area_ratio"] if membrane["elastic_law"] == "skalak" else None
    case = Case(membrane["elastic_law"], area_ratio, capillary_number_by_shear_modulus(membrane))
    return Reading(case, capsule["radius"], echo["flow"]["box"][2], **means)


def series_of(readings):
    """{(case, radius): its readings, from the narrowest box to the widest}."""
    series = collections.defaultdict(list)
    for reading in sorted(readings, key=lambda r: r.width):
        series[reading.case, reading.radius].append(reading)
    return series


def unbounded(readings, quantity):
    """A quantity in the unbounded fluid, by the line in (a/L)^3 through runs of one case; NaN with one box alone."""
    return intercept([(r.radius / r.width) ** 3 for r in readings], [getattr(r, quantity) for r in readings])


@dataclasses.dataclass(frozen=True)
class Comparison:
    """A row of the reference and what was found for it."""

    case: Case
    reference: dict  # {quantity: number}
    readings: list

    def limit(self, quantity):
        """The quantity in the unbounded fluid."""
        return unbounded(self.readings, quantity)


def read_reference(case, settings):
    """[(Case, {quantity: number})] of the viscosity ratio wanted."""
    file = pathlib.Path(case) / settings["reference"]
    rows = matching_rows(read_table(file), {"viscosity_ratio": settings["viscosity_ratio"]})
    if not rows:
        raise InputError(f"{file}: no row has viscosity_ratio = {settings['viscosity_ratio']}")

    def number(row, column):
        return number_in(file, column, row)

    found = []
    for row in rows:
        area_ratio = number(row, "area_ratio") if row["area_ratio"] else None
        reference = {quantity: number(row, quantity) for quantity in QUANTITIES}
        found.append((Case(row["law"], area_ratio, number(row, "capillary_number")), reference))
    return found


def compare(output, case):
    """(settings, series of all runs, [Comparison] of the radius that is judged)."""
    settings = read_comparison(case)["analyse"]
    series = series_of(read_run(directory, settings["read_over"]) for directory in finished_runs(output))
    rows = read_reference(case, settings)
    return settings, series, [Comparison(*row, series.get((row[0], settings["radius"]), [])) for row in rows]


def _text(value, digits):
    return "" if math.isnan(value) else f"{value:.{digits}f}"


def _row(comparison, quantity, boxes, relative, band, digits):
    """A row of the table of a quantity, and its verdict; None where it is not known yet."""
    by_box = {r.box: getattr(r, quantity) for r in comparison.readings}
    limit, reference = comparison.limit(quantity), comparison.reference[quantity]
    amount = difference(limit, reference, relative)
    inside = None if math.isnan(limit) else verdict(amount, band)
    word = {True: "inside", False: "OUTSIDE", None: "not judged yet"}[inside]
    found = [_text(by_box.get(box, math.nan), digits) for box in boxes] + [_text(limit, digits)]
    names = (comparison.case.law, f"{comparison.case.capillary_number:g}")
    return (*names, *found, f"{reference:.{digits}f}", "" if inside is None else shown(amount, relative), word), inside


def _table(comparisons, quantity, relative, band, digits, **more):
    boxes = sorted({r.box for one in comparisons for r in one.readings}, key=float)
    rows, verdicts = zip(*(_row(one, quantity, boxes, relative, band, digits) for one in comparisons))
    header = ("law", "Ca_G", *(f"L = {box} a" for box in boxes), "unbounded", "reference", "difference", "")
    return Table(f"{QUANTITIES[quantity]}; band {shown(band, relative, '')}", header, list(rows), verdicts, **more)


def _box_tables(series):
    """How straight the line in (a/L)^3 is, where there are more boxes than a line needs."""
    tables = []
    for (case, radius), readings in series.items():
        if len(readings) < 3:
            continue
        rows = []
        for k, reading in enumerate(readings):
            limits = [unbounded(readings[k - 1 : k + 1], quantity) if k else math.nan for quantity in QUANTITIES]
            rows.append(
                (reading.box, f"{reading.deformation:.5f}", _text(limits[0], 5), f"{reading.inclination_deg:.3f}", _text(limits[1], 3), "")
            )
        title = f"box: {case.law}, Ca_G = {case.capillary_number:g}, a = {radius:g}; unbounded by this box and the one before"
        tables.append(Table(title, ("L/a", "D", "unbounded", "inclination", "unbounded", ""), rows))
    return tables


def tables(output, case):
    """D and inclination against the reference, judged in the unbounded fluid; and the boxes of series of three and more."""
    settings, series, comparisons = compare(output, case)
    if not series:
        raise InputError(f"{output}: no finished run is there")
    said = [f"a = {settings['radius']:g} grid steps; means over the last {settings['read_over']:g} shear times of each run"]
    deformation = _table(comparisons, "deformation", True, settings["band"], 5, before=said)
    return [deformation, _table(comparisons, "inclination_deg", False, settings["inclination_band"], 3), *_box_tables(series)]


def measured(output, case):
    """unbounded.csv: what is judged, a row a row of the reference that is known."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(["law", "area_ratio", "capillary_number", "radius", *QUANTITIES, "reference_deformation", "reference_inclination_deg"])
    settings, _, comparisons = compare(output, case)
    for one in comparisons:
        limits = [one.limit(quantity) for quantity in QUANTITIES]
        if not math.isnan(limits[0]):
            area_ratio = "" if one.case.area_ratio is None else one.case.area_ratio
            parameters = [one.case.law, area_ratio, one.case.capillary_number, settings["radius"]]
            writer.writerow([*parameters, *(f"{limit:.6g}" for limit in limits), *one.reference.values()])
    return {"unbounded.csv": stream.getvalue()}


def _draw(output, comparisons, quantity, label):
    """A picture of a quantity against Ca_G. None where nothing is known yet."""
    known = [one for one in comparisons if not math.isnan(one.limit(quantity))]
    if not known:
        return None
    figure, axes = new_axes("capillary number  $Ca_G$", label)
    for colour, law in zip(COLOURS, dict.fromkeys(one.case.law for one in comparisons)):
        points = [(one.case.capillary_number, one.reference[quantity]) for one in comparisons if one.case.law == law]
        axes.plot(*zip(*points), "o", color=colour, markerfacecolor="white", markersize=9, label=f"{law}: boundary integrals")
        points = [(one.case.capillary_number, one.limit(quantity)) for one in known if one.case.law == law]
        if points:
            axes.plot(*zip(*points), "x", color=colour, markersize=6, label=f"{law}: tanktread, unbounded")
    axes.set_xlim(left=0)
    axes.legend(frameon=False)
    return save(figure, pathlib.Path(output) / f"{quantity.removesuffix('_deg')}.png")


def pictures(output, case):
    """deformation.png, inclination.png: against Ca_G, with the points of the reference. With no two boxes of a case there are none."""
    _, _, comparisons = compare(output, case)
    labels = {"deformation": "Taylor deformation  $D$", "inclination_deg": "inclination  (degrees)"}
    drawn = [_draw(output, comparisons, quantity, label) for quantity, label in labels.items()]
    return [file for file in drawn if file is not None]
