"""The matrix of viscosity ratio and membrane viscosity of the thesis's Chapter 4: what each run comes to, and what the thesis says of it.

gathered.py brings together what is known of the runs: readings.py (one run in numbers), histories.py (in time), tanktread_post.outlines (in the shear plane). verdicts.py,
statements.py and remarks.py hold it against the thesis, fine.py holds a finer grid against the matrix, figures.py and shape_figures.py draw. A run without output is taken from measured/; one that is in neither is
named as missing. So `plot` and `compare` of an empty folder draw and print what is kept.
"""

import functools
import math
import pathlib

from tanktread_post.case_analysis import module_of
from tanktread_post.reference import number_in, read_table
from tanktread_post.table import Table

HERE = pathlib.Path(__file__).parent
gathered, verdicts, statements, remarks, membrane_speed, fine, figures, shape_figures = (
    module_of(HERE / f"{name}.py") for name in ("gathered", "verdicts", "statements", "remarks", "membrane_speed", "fine", "figures", "shape_figures")
)
readings, histories, outlines = gathered.readings, gathered.histories, gathered.outlines

SETTINGS = (
    (
        "means_over", "turning_over", "printed", "spans", "crossings", "bands", "span_bands", "volume_band", "dilatational_band",
        "least_inclination_between", "outline_at", "deforming", "deforming_at", "marker_means_over",
        "fine_over",
    ),
    (),
)  # fmt: skip
COLUMNS = (  # of the table of runs: heading, digits, member of Reading
    ("D", 4, "deformation"), ("+-", 4, "deformation_amplitude"), ("inclination", 2, "inclination_deg"), ("+-", 2, "inclination_deg_amplitude"),
    ("C*", 4, "circumference"), ("V*", 4, "membrane_speed"), ("nu* marker", 5, "nu_marker"), ("nu* V*/C*", 5, "nu_travel"),
    ("extent", 4, "vorticity_extent"), ("area", 4, "area_ratio"), ("volume from", 5, "least_volume"), ("to", 5, "greatest_volume"),
    ("Phi_mem", 3, "membrane_dissipation"), ("Phi_int", 3, "inner_dissipation"), ("d", 3, "dissipation_ratio"),
    ("settled", 1, "settling_time"),
)  # fmt: skip


def _place_of(case, row):
    """(lambda, Bq_s, Bq_d) of a row of runs.csv."""
    columns = ("flow.viscosity_ratio", "membrane.viscous.boussinesq_shear", "membrane.viscous.boussinesq_dilatational")
    return tuple(number_in(pathlib.Path(case) / "runs.csv", column, row) for column in columns)


def _wanted(case):
    """{(lambda, Bq_s, Bq_d): run} of all runs of the matrix, and of those with Bq_d."""
    return {_place_of(case, row): row["run"] for row in gathered.rows_of(case)}


def _printed(case, settings):
    """{quantity: [(lambda, Bq_s, value)]} of the numbers that the thesis prints."""
    file, printed = pathlib.Path(case) / settings["printed"], {}
    for row in read_table(file):
        printed.setdefault(row["quantity"], []).append(tuple(number_in(file, name, row) for name in ("viscosity_ratio", "bq_s", "value")))
    return printed


def _text(value, digits):
    return "" if math.isnan(value) else f"{value:.{digits}f}"


def _runs_table(known, case):
    settings, found = known.settings, known.readings
    rows = [(r.run, *(f"{number:g}" for number in r.place), *(_text(getattr(r, name), digits) for _, digits, name in COLUMNS)) for r in found]
    there = {r.run for r in found}
    missing = [run for run in _wanted(case).values() if run not in there]
    before = [
        f"means over the last {settings['means_over']:g} shear times, +- half of the way between the extremes in them; volumes over the whole run;",
        f"nu* by half turns of the marker within the last {settings['turning_over']:g}; Phi in mu_o g^2 a^3; settled: D is within {readings.SETTLED:.0%} of its mean",
    ]
    header = ("run", "lambda", "Bq_s", "Bq_d", *(heading for heading, *_ in COLUMNS))
    lines = [f"{words}: {', '.join(runs)}" for words, runs in (("not run yet", missing), ("as kept in measured/, without output", known.kept)) if runs]
    return Table("the runs", header, rows, before=before, after=lines)


def _equivalents(found):
    """[(Bq_s, viscosity ratio by D, by the inclination, 1 + d)] of the runs with viscosity ratio 1."""
    elastic = readings.curves(found, "viscosity_ratio", "boussinesq_shear").get(0.0, [])
    rows = []
    for r in readings.curves(found, "boussinesq_shear", "viscosity_ratio").get(1.0, []):
        by = [readings.equivalent_viscosity_ratio(elastic, name, getattr(r, name)) for name in ("deformation", "inclination_deg")]
        rows.append((r.boussinesq_shear, *by, 1 + r.dissipation_ratio))
    return rows


def _equivalent_table(found):
    known = [row for row in _equivalents(found) if not all(map(math.isnan, row[1:]))]
    rows = [(f"{row[0]:g}", *(_text(value, 2) for value in row[1:]), "") for row in known]
    title = "the viscosity ratio of an elastic capsule that is alike, lambda = 1 (the thesis: 7.72 by D at Bq_s = 40); empty: beyond the runs"
    return Table(title, ("Bq_s", "by D", "by the inclination", "lambda + d", ""), rows)


def _remark_table(known, case):
    found, file = known.readings, pathlib.Path(case) / known.settings["crossings"]
    rows = [
        *remarks.frequency_rows(found),
        *remarks.linear_row(found),
        *remarks.round_row(found),
        *remarks.speed_rows(found),
        *remarks.crossing_rows(found, read_table(file), file, readings.crossings),
        *remarks.curve_rows(found),
        *remarks.dissipation_row(found),
        *remarks.with_dilatational_rows(found),
        *remarks.outline_rows(_deforming(known), known.histories.get(known.settings["deforming"])),
    ]
    return Table("what the thesis says of them besides", ("quantity", "ours", "thesis", ""), rows)


def _deforming(known):
    """The outlines of Fig. 4.11, as far as they are known."""
    found = (known.outline(known.settings["deforming"], time) for time in known.settings["deforming_at"])
    return [one for one in found if one is not None]


def tables(output, case):
    """The runs, and what the thesis prints and says of them."""
    known, wanted, case = gathered.gather(output, case), _wanted(case), pathlib.Path(case)
    found, settings = known.readings, known.settings
    printed, spans = case / settings["printed"], case / settings["spans"]
    bands, span_bands = dict(settings["bands"]), dict(settings["span_bands"])
    judged = [
        ("printed numbers", verdicts.printed_rows(found, read_table(printed), printed, bands)),
        ("the matrix", [
            *statements.rows_of(found, wanted, settings),
            *verdicts.span_rows(found, wanted, read_table(spans), spans, span_bands),
            verdicts.volume_row(found, settings["volume_band"]),
            *verdicts.dilatational_rows(found, settings["dilatational_band"]),
        ]),
    ]  # fmt: skip
    held = [Table(title, verdicts.HEADER, [row for row, _ in rows], [inside for _, inside in rows]) for title, rows in judged if rows]
    further = [table for table in (_equivalent_table(found), _remark_table(known, case)) if table.rows]
    return [_runs_table(known, case), *held, *further, *_fine_tables(known, case)]


def _fine_tables(known, case):
    rows, numbers = gathered.rows_of(case, fine=True), _printed(case, known.settings)
    return fine.tables(rows, functools.partial(_place_of, case), known, numbers, known.settings["fine_over"])


def measured(output, case):
    """What is known of each run, those among it that were kept before: numbers, in time, in the shear plane."""
    known = gathered.gather(output, case)
    texts = {"readings.csv": readings.table_of(known.readings)}
    if known.histories:
        order = [*(r.run for r in known.readings), *(row["run"] for row in gathered.rows_of(case, fine=True))]
        texts["histories.csv"] = histories.table_of(known.histories[run] for run in order if run in known.histories)
    if known.outlines:
        texts["outlines.csv"] = outlines.table_of(known.outlines[place] for place in sorted(known.outlines))
    return texts


def _title(place):
    return rf"$(\lambda, Bq_s)$ = ({place[0]:g}, {place[1]:g})"


def pictures(output, case):
    """The thesis's figures, of the runs that are known."""
    known, case = gathered.gather(output, case), pathlib.Path(case)
    found, settings = known.readings, known.settings
    printed = _printed(case, settings)
    shape = {r.run: known.outline(r.run, settings["outline_at"]) for r in found}
    three = [row["run"] for row in read_table(case / "runs.csv") if "fig-4.4" in row["groups"].split()]
    columns = [(_title(r.place), r, known.histories[r.run], shape[r.run]) for r in found if r.run in three and shape[r.run] and r.run in known.histories]
    trio = [(_title(r.place), r, shape[r.run]) for r in membrane_speed.three_alike([r for r in found if shape[r.run]])]
    deforming = known.histories.get(settings["deforming"]), _deforming(known)
    return [
        *figures.all_pictures(output, found, functools.partial(readings.curves, found), printed, _equivalents(found), known.histories),
        *shape_figures.all_pictures(output, sorted(columns, key=lambda one: three.index(one[1].run)), trio, *deforming, settings["marker_means_over"]),
    ]
