"""What the thesis says of the matrix, held against the runs that are there: a row each, (label, of what, ours, thesis, difference, band, word), and its verdict.

A statement about a series of runs is judged once all of its runs in runs.csv are finished; `wanted` below are the places (lambda, Bq_s, Bq_d) of these.
"""

import math

from tanktread_post.reference import number_in
from tanktread_post.table import difference, shown, table_row, verdict

HEADER = ("quantity", "of", "ours", "thesis", "difference", "band", "")
WORDS = {True: "inside", False: "OUTSIDE", None: "not judged yet"}
NAMES = {
    "deformation": "D",
    "inclination_deg": "inclination",
    "area_ratio": "area",
    "circumference": "C*",
    "membrane_speed": "V*",
    "vorticity_extent": "extent along the vorticity",
    "nu_marker": "nu* (marker)",
    "nu_travel": "nu* (V*/C*)",
}
ABSOLUTE = ("inclination_deg", "area_ratio")  # quantities whose bands are in their own unit


def place_name(place):
    """A place of the matrix as text."""
    ratio, shear, dilatational = place
    return f"({ratio:g}, {shear:g})" if dilatational == 0 else f"({ratio:g}, {shear:g}), Bq_d = {dilatational:g}"


def printed_rows(readings, table, file, bands):
    """The printed numbers of which the run is there. `bands`: {quantity: band}; a quantity without one is shown."""
    by_place, rows = {r.place: r for r in readings}, []
    for row in table:
        place = (number_in(file, "viscosity_ratio", row), number_in(file, "bq_s", row), 0.0)
        name = row["quantity"]
        ours = getattr(by_place[place], name) if place in by_place else math.nan
        if not math.isnan(ours):
            label = f"{place_name(place)}: {NAMES[name]}"
            rows.append(table_row(label, row["place"].partition(" (")[0], ours, number_in(file, "value", row), name not in ABSOLUTE, bands.get(name)))
    return rows


def _of_series(label, of, places, readings, judge):
    """A statement about a series: (ours, holds) of its readings by `judge`, in the order of the places."""
    by_place = {r.place: r for r in readings}
    missing = [place_name(place) for place in places if place not in by_place]
    if missing or not places:
        return (label, of, "", "", "", "", f"not judged yet: {len(places) - len(missing)} of {len(places)} runs"), None
    ours, holds = judge([by_place[place] for place in places])
    if holds is None:
        return (label, of, ours, "", "", "", "not judged yet"), None
    return (label, of, ours, "", "", "", WORDS[holds]), holds


def falls(quantity, digits=4):
    """A judge: whether a quantity falls from each run to the next."""

    def judge(series):
        values = [getattr(r, quantity) for r in series]
        return " ".join(f"{value:.{digits}f}" for value in values), None if any(map(math.isnan, values)) else all(b < a for a, b in zip(values, values[1:]))

    return judge


def falls_then_rises(quantity):
    """A judge: whether a quantity has one least value, inside the series, and falls to it and rises from it."""

    def judge(series):
        values = [getattr(r, quantity) for r in series]
        if any(map(math.isnan, values)):
            return "", None
        least = values.index(min(values))
        down, up = values[: least + 1], values[least:]
        holds = 0 < least < len(values) - 1 and all(b < a for a, b in zip(down, down[1:])) and all(b > a for a, b in zip(up, up[1:]))
        return " ".join(f"{value:.4f}" for value in values), holds

    return judge


def least_inclination_between(low, high):
    """A judge: whether the inclination is least at a Bq_s between two."""

    def judge(series):
        least = min(series, key=lambda r: r.inclination_deg)
        return f"{least.inclination_deg:.2f} degrees at {least.boussinesq_shear:g}", low <= least.boussinesq_shear <= high

    return judge


def series_rows(readings, wanted, settings):
    """The statements about series of the matrix."""
    matrix = sorted(place for place in wanted if place[2] == 0)
    ratios, shears = sorted({p[0] for p in matrix}), sorted({p[1] for p in matrix})
    of_shear = {shear: [p for p in matrix if p[1] == shear] for shear in shears}
    of_ratio = {ratio: [p for p in matrix if p[0] == ratio] for ratio in ratios}
    rows = []
    for quantity, digits in (("deformation", 4), ("inclination_deg", 2)):
        for shear, places in of_shear.items():
            rows.append(_of_series(f"{NAMES[quantity]} falls with lambda", f"Bq_s = {shear:g}", places, readings, falls(quantity, digits)))
    for ratio, places in of_ratio.items():
        rows.append(_of_series("D falls with Bq_s", f"lambda = {ratio:g}", places, readings, falls("deformation")))
    low, high = settings["least_inclination_between"]
    rows.append(_of_series("inclination is least near Bq_s = 10", "lambda = 1", of_ratio.get(1.0, []), readings, least_inclination_between(low, high)))
    spoon = falls_then_rises("membrane_speed")
    rows.append(_of_series("V* is spoon-shaped in Bq_s", "lambda = 0.2", of_ratio.get(0.2, []), readings, spoon))
    rows.append(_of_series("V* is spoon-shaped in lambda", "Bq_s = 0", of_shear.get(0.0, []), readings, spoon))
    return rows


def span_rows(readings, wanted, table, file, bands):
    """The least and the greatest value over the matrix; judged when the whole of it is there, shown before."""
    matrix = [r for r in readings if r.boussinesq_dilatational == 0]
    whole = {place for place in wanted if place[2] == 0} <= {r.place for r in matrix}
    rows = []
    for row in table:
        name = row["quantity"]
        values = [getattr(r, name) for r in matrix if not math.isnan(getattr(r, name))]
        for word, find in (("least", min), ("most", max)):
            if values:
                label = f"{NAMES[name]}, {word} of {len(values)} runs"
                rows.append(table_row(label, row.get("place", "Sect. 4.3.3"), find(values), number_in(file, word, row), True, bands.get(name) if whole else None))
    return rows


def volume_row(readings, band):
    """The farthest that a volume came from that at rest."""
    worst = max(readings, key=lambda r: max(r.greatest_volume - 1, 1 - r.least_volume))
    amount = max(worst.greatest_volume - 1, worst.least_volume - 1, key=abs)
    inside = verdict(amount, band)
    return ("volume, farthest of all runs", worst.run, f"{1 + amount:.5f}", "1", shown(amount, True), shown(band, True, ""), WORDS[inside]), inside


def dilatational_rows(readings, band):
    """What Bq_d alone does to the steady state, of which the thesis says nothing: D and the inclination as shares of those without it."""
    alone = {r.boussinesq_dilatational: r for r in readings if (r.viscosity_ratio, r.boussinesq_shear) == (1, 0)}
    without = alone.pop(0.0, None)
    rows = []
    for number, r in alone.items() if without is not None else ():
        for quantity in ("deformation", "inclination_deg"):
            ours, wanted = getattr(r, quantity), getattr(without, quantity)
            amount = difference(ours, wanted, True)
            inside = verdict(amount, band)
            cells = (f"{ours:.4f}", f"{wanted:.4f} (ours)", shown(amount, True), shown(band, True, ""), WORDS[inside])
            rows.append(((f"Bq_d = {number:g} alone: {NAMES[quantity]}", "Sect. 4.3.5", *cells), inside))
    return rows
