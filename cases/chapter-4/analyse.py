"""The matrix of viscosity ratio and membrane viscosity of the thesis's Chapter 4: what each run comes to, and what the thesis says of it.

readings.py reads a run, verdicts.py holds the runs against the thesis, figures.py draws. Runs that are not finished are named as missing.
"""

import csv
import dataclasses
import functools
import io
import math
import pathlib

from tanktread_post.case_analysis import module_of
from tanktread_post.observables import InputError
from tanktread_post.reference import number_in, read_comparison, read_table
from tanktread_post.table import Table

HERE = pathlib.Path(__file__).parent
readings, verdicts, figures = (module_of(HERE / f"{name}.py") for name in ("readings", "verdicts", "figures"))

SETTINGS = (
    (
        "means_over", "turning_over", "printed", "spans", "crossings", "bands", "span_bands", "volume_band", "dilatational_band",
        "least_inclination_between",
    ),
    (),
)  # fmt: skip
COLUMNS = (  # of the table of runs: heading, digits, member of Reading
    ("D", 4, "deformation"), ("+-", 4, "deformation_amplitude"), ("inclination", 2, "inclination_deg"), ("+-", 2, "inclination_deg_amplitude"),
    ("C*", 4, "circumference"), ("V*", 4, "membrane_speed"), ("nu* marker", 5, "nu_marker"), ("nu* V*/C*", 5, "nu_travel"),
    ("extent", 4, "vorticity_extent"), ("area", 4, "area_ratio"), ("volume from", 5, "least_volume"), ("to", 5, "greatest_volume"),
    ("Phi_mem", 3, "membrane_dissipation"), ("Phi_int", 3, "inner_dissipation"), ("d", 3, "dissipation_ratio"),
)  # fmt: skip


def _wanted(case):
    """{(lambda, Bq_s, Bq_d): run} of all runs of the case."""
    file = pathlib.Path(case) / "runs.csv"
    columns = ("flow.viscosity_ratio", "membrane.viscous.boussinesq_shear", "membrane.viscous.boussinesq_dilatational")
    return {tuple(number_in(file, column, row) for column in columns): row["run"] for row in read_table(file)}


def _read(output, case):
    """(settings, [Reading] of all finished runs)."""
    settings = read_comparison(case)["analyse"]
    found = readings.read_runs(output, settings)
    if not found:
        raise InputError(f"{output}: no finished run is there")
    return settings, found


def _text(value, digits):
    return "" if math.isnan(value) else f"{value:.{digits}f}"


def _runs_table(found, case, settings):
    rows = [(r.run, *(f"{number:g}" for number in r.place), *(_text(getattr(r, name), digits) for _, digits, name in COLUMNS)) for r in found]
    there = {r.run for r in found}
    missing = [run for run in _wanted(case).values() if run not in there]
    before = [
        f"means over the last {settings['means_over']:g} shear times, +- half of the way between the extremes in them; volumes over the whole run;",
        f"nu* by half turns of the marker within the last {settings['turning_over']:g}; Phi in mu_o g^2 a^3",
    ]
    header = ("run", "lambda", "Bq_s", "Bq_d", *(heading for heading, *_ in COLUMNS))
    return Table("the runs", header, rows, before=before, after=[f"not run yet: {', '.join(missing)}"] if missing else ())


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


def _crossing_table(found, case, settings):
    file = pathlib.Path(case) / settings["crossings"]
    rows = []
    for row in read_table(file):
        value, ends = number_in(file, "value", row), [number_in(file, end, row) for end in ("least", "most")]
        ours = readings.crossings(found, row["at"], value, row["quantity"])
        if not math.isnan(ours[0]):
            label = f"{verdicts.NAMES[row['quantity']]} where {verdicts.NAMES[row['at']]} is {value:g}"
            rows.append((label, "{:.4g} to {:.4g}".format(*ours), "{:g} to {:g}".format(*ends), "shown only"))
    return Table("how far the inclination is from being one with D", ("quantity", "ours", "thesis", ""), rows)


def tables(output, case):
    """The runs, and what the thesis prints and says of them."""
    settings, found = _read(output, case)
    wanted, case = _wanted(case), pathlib.Path(case)
    printed, spans = case / settings["printed"], case / settings["spans"]
    bands, span_bands = dict(settings["bands"]), dict(settings["span_bands"])
    judged = [
        ("printed numbers", verdicts.printed_rows(found, read_table(printed), printed, bands)),
        ("the matrix", [
            *verdicts.series_rows(found, wanted, settings),
            *verdicts.span_rows(found, wanted, read_table(spans), spans, span_bands),
            verdicts.volume_row(found, settings["volume_band"]),
            *verdicts.dilatational_rows(found, settings["dilatational_band"]),
        ]),
    ]  # fmt: skip
    held = [Table(title, verdicts.HEADER, [row for row, _ in rows], [inside for _, inside in rows]) for title, rows in judged if rows]
    further = [table for table in (_equivalent_table(found), _crossing_table(found, case, settings)) if table.rows]
    return [_runs_table(found, case, settings), *held, *further]


def measured(output, case):
    """readings.csv: all that is read of each run, a row a run."""
    stream = io.StringIO()
    names = [field.name for field in dataclasses.fields(readings.Reading) if field.name != "directory"]
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow([*names, "nu_travel", "dissipation_ratio"])
    for r in _read(output, case)[1]:
        values = [getattr(r, name) for name in (*names[1:], "nu_travel", "dissipation_ratio")]
        writer.writerow([r.run, *("" if math.isnan(value) else f"{value:.8g}" for value in values)])
    return {"readings.csv": stream.getvalue()}


def pictures(output, case):
    """The thesis's figures, of the runs that are there."""
    settings, found = _read(output, case)
    file, printed = pathlib.Path(case) / settings["printed"], {}
    for row in read_table(file):
        printed.setdefault(row["quantity"], []).append(tuple(number_in(file, name, row) for name in ("viscosity_ratio", "bq_s", "value")))
    return figures.all_pictures(output, found, functools.partial(readings.curves, found), printed, _equivalents(found))
