"""The runs of the group `fine`: at the resolution of the thesis, and at that of the matrix with a start as theirs, beside the matrix over the same shear times."""

import ast
import math
import pathlib

from tanktread_post.case_analysis import module_of
from tanktread_post.table import Table, difference, shown
from tanktread_post.turning import turning_frequency

NAMES = module_of(pathlib.Path(__file__).with_name("verdicts.py")).NAMES
QUANTITIES = (  # name, digits, whether a difference is a share
    ("deformation", 4, True), ("inclination_deg", 2, False), ("circumference", 4, True), ("membrane_speed", 4, True), ("nu_travel", 5, True), ("nu_marker", 5, True),
)  # fmt: skip
TURNING_OVER = 10.0  # shear times before the end in which half a turn of the marker is looked for: it takes some 9
HEADER = ("quantity", "shear times", "fine", "coarse", "difference", "the matrix", "its end", "its end, and the difference", "thesis", "")


def read(history, start, end):
    """{name of QUANTITIES: number} of a History from one shear time to another: means; nu_marker of the last half turn before the end. NaN without a History."""
    if history is None:
        return dict.fromkeys((name for name, *_ in QUANTITIES), math.nan)
    means = {name: history.mean(name, start, end) for name in ("deformation", "inclination_deg", "circumference", "membrane_speed")}
    times = history["shear_time"]
    until = history.from_to(0, end)
    path = (history[name][until] for name in ("marker_along_flow", "marker_along_gradient"))
    return means | {
        "nu_travel": means["membrane_speed"] / means["circumference"],
        "nu_marker": turning_frequency(times[until], *path, min(TURNING_OVER, end)),
    }


def _box_of(row):
    """The number of nodes along the box of a row; 0: that of the matrix."""
    return ast.literal_eval(row["flow.box"])[0] if row.get("flow.box") else 0


def _text(value, digits):
    return "" if math.isnan(value) else f"{value:.{digits}f}"


def tables(rows, place_of, known, printed, over):
    """The table of the fine runs that are known, if there is one. `rows` of runs.csv in their group, `place_of(row)`: (lambda, Bq_s, Bq_d); `known`:
    gathered.Gathered; `printed`: {quantity: [(lambda, Bq_s, value)]}; means over the last `over` shear times of each."""
    histories, by_place = known.histories, {r.place: r for r in known.readings}
    coarse = {place_of(row): histories.get(row["run"]) for row in rows if not _box_of(row)}
    lines = []
    for row in rows:
        place, history = place_of(row), histories.get(row["run"])
        if not _box_of(row) or history is None or place not in by_place:
            continue
        matrix = by_place[place]
        end = float(row["run.shear_time"])
        ours, like, before = (read(one, end - over, end) for one in (history, coarse.get(place), histories.get(matrix.run)))
        said = {name: value for name, values in printed.items() for ratio, shear, value in values if (ratio, shear) == place[:2]}
        for name, digits, relative in QUANTITIES:
            fine, like_it, late = ours[name], like[name], getattr(matrix, name)
            change = "" if math.isnan(like_it) else shown(difference(fine, like_it, relative), relative)
            moved = late * fine / like_it if relative else late + fine - like_it
            cells = (_text(value, digits) for value in (before[name], late, moved, said.get(name, math.nan)))
            label = f"{row['run']}: {NAMES[name]}"
            lines.append((label, f"{end - over:g} to {end:g}", _text(fine, digits), _text(like_it, digits), change, *cells, "shown only"))
    title = "the thesis's box (fine), and that of the matrix with a start as in it (coarse), beside the matrix over the same shear times"
    return [Table(title, HEADER, lines)] if lines else []
