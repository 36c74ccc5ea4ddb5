"""A viscosity contrast at large deformation, against boundary integrals: D and inclination in the unbounded fluid, from two boxes.

Walls and periodic images at a distance L change the shear rate that a capsule sees by a share of (a/L)^3, so the values of the unbounded
fluid, which the reference has, come from a line in (a/L)^3 through the runs of one viscosity ratio, radius and mesh.
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
Series = collections.namedtuple("Series", "viscosity_ratio radius triangles")  # what the runs of two boxes have in common


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run: its box, D and inclination (degrees) at its end, and the farthest that its volume came from that at rest, a share."""

    width: int  # grid steps, of the cubic box
    deformation: float
    inclination_deg: float
    volume: float


@dataclasses.dataclass(frozen=True)
class Comparison:
    """The runs of a series, from the narrowest box to the widest, and the reference; None where it has no such capsule."""

    series: Series
    readings: list
    reference: dict

    def limit(self, quantity):
        """The quantity in the unbounded fluid; NaN with one box alone."""
        return intercept([(self.series.radius / r.width) ** 3 for r in self.readings], [getattr(r, quantity) for r in self.readings])


def read_run(directory, read_over):
    """(law, Ca_G, Series, Reading) of one finished run: means over its last `read_over` shear times."""
    echo, observables = read_echo(directory), Observables(directory)
    capsule = echo["capsule"][0]
    # A run to T ends with the step nearest to T.
    end = min(end_of(directory), float(observables["shear_time"][-1]))
    means = {name: observables.mean(name, end - read_over, end) for name in QUANTITIES}
    volume = observables["volume_ratio"] - 1
    ratio = capsule.get("viscosity_ratio", echo["flow"]["viscosity_ratio"])
    series = Series(ratio, capsule["radius"], 20 * 4 ** capsule["mesh"]["level"])
    membrane = capsule["membrane"]
    reading = Reading(echo["flow"]["box"][2], **means, volume=float(volume[abs(volume).argmax()]))
    return membrane["elastic_law"], capillary_number_by_shear_modulus(membrane), series, reading


def compare(output, case):
    """(settings, [Comparison]) of all finished runs, in rising viscosity ratio, radius and number of triangles."""
    settings = read_comparison(case)["analyse"]
    file = pathlib.Path(case) / settings["reference"]
    table, readings, rows = read_table(file), collections.defaultdict(list), {}
    for directory in finished_runs(output):
        law, number, series, reading = read_run(directory, settings["read_over"])
        readings[series].append(reading)
        rows[series] = matching_rows(table, {"law": law, "capillary_number": number, "viscosity_ratio": series.viscosity_ratio})
    if not readings:
        raise InputError(f"{output}: no finished run is there")
    comparisons = []
    for series in sorted(readings):
        reference = {quantity: number_in(file, quantity, row) for row in rows[series][:1] for quantity in QUANTITIES}
        comparisons.append(Comparison(series, sorted(readings[series], key=lambda r: r.width), reference or None))
    return settings, comparisons


def _text(value, digits):
    return "" if math.isnan(value) else f"{value:.{digits}f}"


def _row(one, quantity, boxes, settings, relative, band, digits):
    """A row of the table of a quantity, and its verdict; None where it is not judged, or not known yet."""
    by_box = {f"{r.width / one.series.radius:.0f}": getattr(r, quantity) for r in one.readings}
    limit = one.limit(quantity)
    numbers = [f"{one.series.viscosity_ratio:g}", f"{one.series.radius:g}", f"{one.series.triangles}"]
    found = [*(_text(by_box.get(box, math.nan), digits) for box in boxes), _text(limit, digits)]
    if one.reference is None:
        return (*numbers, *found, "", "", "shown only"), None
    wanted = f"{one.reference[quantity]:.{digits}f}"
    if math.isnan(limit):
        return (*numbers, *found, wanted, "", "not judged yet"), None
    amount = difference(limit, one.reference[quantity], relative)
    judged = (one.series.viscosity_ratio, one.series.radius) == (settings["viscosity_ratio"], settings["radius"])
    inside = verdict(amount, band) if judged else None
    word = {True: "inside", False: "OUTSIDE", None: "shown only"}[inside]
    return (*numbers, *found, wanted, shown(amount, relative), word), inside


def _table(settings, comparisons, quantity, relative, band, digits, **more):
    boxes = sorted({f"{r.width / one.series.radius:.0f}" for one in comparisons for r in one.readings}, key=float)
    rows, verdicts = zip(*(_row(one, quantity, boxes, settings, relative, band, digits) for one in comparisons))
    header = ("lambda", "a", "triangles", *(f"L = {box} a" for box in boxes), "unbounded", "reference", "difference", "")
    return Table(f"{QUANTITIES[quantity]}; band {shown(band, relative, '')}", header, list(rows), verdicts, **more)


def fine_grid(comparisons, quantity):
    """{(viscosity ratio, triangles): (where the unbounded value goes with a wide radius, by the line in 1/a^2, reference or None)}."""
    by_mesh = collections.defaultdict(list)
    for one in comparisons:
        if not math.isnan(one.limit(quantity)):
            by_mesh[one.series.viscosity_ratio, one.series.triangles].append(one)
    limits = {}
    for mesh, those in by_mesh.items():
        if len(those) > 1:
            limit = intercept([one.series.radius**-2 for one in those], [one.limit(quantity) for one in those])
            limits[mesh] = limit, those[0].reference and those[0].reference[quantity]
    return limits


def _fine_table(comparisons):
    rows = []
    for quantity, relative, digits in (("deformation", True, 5), ("inclination_deg", False, 3)):
        for (ratio, triangles), (limit, wanted) in fine_grid(comparisons, quantity).items():
            held = ("", "") if wanted is None else (_text(wanted, digits), shown(difference(limit, wanted, relative), relative))
            rows.append((QUANTITIES[quantity], f"{ratio:g}", f"{triangles}", _text(limit, digits), *held, "shown only"))
    return Table("where the unbounded values go with the radius, by 1/a^2", ("", "lambda", "triangles", "fine grid", "reference", "difference", ""), rows)


def tables(output, case):
    """D and inclination in the unbounded fluid against the reference, of which one viscosity ratio and radius is judged; and in the limit of a fine grid."""
    settings, comparisons = compare(output, case)
    said = [f"means over the last {settings['read_over']:g} shear times of each run"]
    farthest = max((r.volume for one in comparisons for r in one.readings), key=abs)
    volume = [f"the volume is within {100 * abs(farthest):.3f} % of that at rest in all runs"]
    deformation = _table(settings, comparisons, "deformation", True, settings["band"], 5, before=said)
    inclination = _table(settings, comparisons, "inclination_deg", False, settings["inclination_band"], 3, after=volume)
    return [deformation, inclination, *([_fine_table(comparisons)] if fine_grid(comparisons, "deformation") else [])]


def measured(output, case):
    """unbounded.csv: a row a series of which two boxes are known."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([*Series._fields, *QUANTITIES, "reference_deformation", "reference_inclination_deg"])
    for one in compare(output, case)[1]:
        limits = [one.limit(quantity) for quantity in QUANTITIES]
        if not math.isnan(limits[0]):
            reference = one.reference or dict.fromkeys(QUANTITIES, "")
            writer.writerow([*(f"{number:g}" for number in one.series), *(f"{limit:.6g}" for limit in limits), *reference.values()])
    return {"unbounded.csv": stream.getvalue()}


def _draw(output, comparisons, quantity, label):
    """A picture of a quantity against the viscosity ratio. None where nothing is known yet."""
    known = [one for one in comparisons if not math.isnan(one.limit(quantity))]
    if not known:
        return None
    figure, axes = new_axes(r"viscosity ratio  $\lambda$", label)
    references = sorted({(one.series.viscosity_ratio, one.reference[quantity]) for one in known if one.reference is not None})
    if references:
        axes.plot(*zip(*references), "o", color="black", markerfacecolor="white", markersize=9, label="boundary integrals")
    kinds = sorted({one.series[1:] for one in known})
    for colour, kind in zip(COLOURS, kinds):
        points = [(one.series.viscosity_ratio, one.limit(quantity)) for one in known if one.series[1:] == kind]
        axes.plot(*zip(*points), "x", color=colour, markersize=6, label=f"unbounded, $a$ = {kind[0]:g}, {kind[1]} triangles")
    axes.set_xlim(left=0)
    axes.legend(frameon=False)
    return save(figure, pathlib.Path(output) / f"{quantity.removesuffix('_deg')}.png")


def pictures(output, case):
    """deformation.png, inclination.png: against the viscosity ratio, with the points of the reference. With no two boxes of a series there are none."""
    comparisons = compare(output, case)[1]
    labels = {"deformation": "Taylor deformation  $D$", "inclination_deg": "inclination  (degrees)"}
    drawn = [_draw(output, comparisons, quantity, label) for quantity, label in labels.items()]
    return [file for file in drawn if file is not None]
