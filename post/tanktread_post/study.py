"""The tables of a case without a run: study.toml, which lists them, and the values a comparison reads from them.

A study.toml has any of

    [[table]]            a CSV that `tanktread study` writes into the output folder
    file = "errors.csv"
    arguments = ["maxwell", "--scheme", "fd"]

    [[plot]]             a picture of one of them, both axes logarithmic
    file = "errors.png"
    table = "errors.csv"
    where = {}           which rows (default: all): the value of a column, or a list of values
    x = "dt"             a column; y = another
    lines = ["scheme"]   a line for each combination of values of these columns (default: one line)
    x_label, y_label     (default: the columns)
    reference = { file, where, x, y, factor }   points from a CSV of the case; x a column or one number
"""

import pathlib

import numpy

from .observables import InputError
from .reference import look_up, matching_rows, number_in, read_table
from .toml_tables import check_keys, checked_entries, read_toml, require_name_of

# The keys of study.toml: those an entry must have, those it may have.
ENTRIES = {
    "table": (("file", "arguments"), ()),
    "plot": (("file", "table", "x", "y"), ("where", "lines", "x_label", "y_label", "reference")),
}
REFERENCE = (("file", "x", "y"), ("where", "factor"))


def read_study(case):
    """study.toml of a case folder, with every default filled in."""
    file = pathlib.Path(case) / "study.toml"
    wanted = read_toml(file)
    check_keys(file, wanted, ((), tuple(ENTRIES)))
    for name, entries in checked_entries(file, wanted, ENTRIES).items():
        for number, entry in enumerate(entries, 1):
            require_name_of(f"{file}: [[{name}]] number {number}", entry["file"], {"table": ".csv", "plot": ".png"}[name])
    for number, plot in enumerate(wanted.setdefault("plot", []), 1):
        if "reference" in plot:
            check_keys(f"{file}: [[plot]] number {number}: reference", plot["reference"], REFERENCE)
        plot.setdefault("where", {})
        plot.setdefault("lines", [])
        plot.setdefault("x_label", plot["x"])
        plot.setdefault("y_label", plot["y"])
    wanted.setdefault("table", [])
    return wanted


def choose_tables(study, names):
    """The tables whose file or stem is among the names; all without names."""
    known = {pathlib.Path(table["file"]).stem for table in study["table"]}
    wanted = {pathlib.Path(name).stem for name in names}
    if wanted - known:
        raise InputError(f"no table is called '{min(wanted - known)}'; there are: {', '.join(sorted(known))}")
    return [table for table in study["table"] if not wanted or pathlib.Path(table["file"]).stem in wanted]


def column(rows, name, file):
    """A column of a table as numbers."""
    if not rows:
        raise InputError(f"{file}: there is no row to take the column '{name}' of")
    return numpy.array([number_in(file, name, row) for row in rows])


def lines_of(output, plot):
    """{label: (x, y)} of a [[plot]], sorted by x."""
    file = pathlib.Path(output) / plot["table"]
    rows = matching_rows(read_table(file), plot["where"])
    lines = {}
    for row in rows:
        missing = [name for name in plot["lines"] if name not in row]
        if missing:
            raise InputError(f"{file}: there is no column '{missing[0]}', only {', '.join(row)}")
        lines.setdefault(", ".join(row[name] for name in plot["lines"]), []).append(row)
    return {label: _sorted(column(group, plot["x"], file), column(group, plot["y"], file)) for label, group in lines.items()}


def reference_points(case, plot):
    """(x, y) of the reference of a [[plot]]; None without one."""
    wanted = plot.get("reference")
    if wanted is None:
        return None
    file = pathlib.Path(case) / wanted["file"]
    rows = matching_rows(read_table(file), wanted.get("where", {}))
    y = wanted.get("factor", 1.0) * column(rows, wanted["y"], file)
    x = column(rows, wanted["x"], file) if isinstance(wanted["x"], str) else numpy.full(len(y), float(wanted["x"]))
    return _sorted(x, y)


def _sorted(x, y):
    order = numpy.argsort(x, kind="stable")
    return x[order], y[order]


def value(output, entry):
    """Ours and the reference of a [[value]] entry of compare.toml that names a table."""
    ours = look_up(output, {**entry, "file": entry["table"]})
    reference = entry["reference"]
    return ours, look_up(output, {**reference, "file": reference["table"]}) if isinstance(reference, dict) else reference


def slope(output, entry):
    """The slope of a [[slope]] entry: of the line through log y against log x (least squares)."""
    file = pathlib.Path(output) / entry["table"]
    rows = matching_rows(read_table(file), entry["where"])
    if len(rows) < 2:
        raise InputError(f"{file}: {len(rows)} rows have {entry['where']}; a slope needs two or more")
    x, y = numpy.log(column(rows, entry["x"], file)), numpy.log(column(rows, entry["y"], file))
    return float(numpy.polyfit(x, y, 1)[0])
