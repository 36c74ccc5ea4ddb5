"""The numbers that the thesis prints of the matrix, held against the runs that are there: a row each, (label, of what, ours, thesis, difference, band, word),
and its verdict. What it says of series of runs is in statements.py, what is only shown in remarks.py.
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
        if len(values) > 1:
            printed = number_in(file, "variation", row)
            ours = (max(values) - min(values)) / (max(values) + min(values))
            rows.append(table_row(f"{NAMES[name]}, half of the span over its middle", "Sect. 4.3.3", ours, printed, False, None))
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
