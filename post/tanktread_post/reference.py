"""The numbers a case is held against: compare.toml and the tables of its reference/ folder.

A compare.toml has a title, a source (default "reference"), in a case of many runs `read_at` (the shear times at which
--measure reads each run) and `means_over` (a stretch of shear time, over which it takes the means of each run that is as long), and any of

    [[value]]            a value at a shear time, held against a reference
    run = "mesh-3"       which run; left out in a case of one run
    name = "deformation" a column of observables.csv
    shear_time = 4.17    or mean_over = [20, 30]: the mean over a stretch of shear time
    reference = 1.0      a number, or { file, column, where = { column = value, ... } }: one row of a CSV;
                         with `factor`, that number times it
    band = 0.015         largest difference allowed; left out: shown, not judged
    relative = true      whether the band is a share of the reference (default), or in the quantity's unit

    [[change]]           the relative change of a value from one run to another
    name, shear_time or mean_over, from, to, band (also "below" or "above": smaller or larger than in the first run),
    reference = 0.1      the relative change there should be, in the forms of a value's; default 0

    [[picture]]          a plot of some runs, in place of one of D and one of the inclination of all (which are drawn if none of its runs is there)
    file, name ("deformation" or "inclination_deg"), runs (in the order of the legend; those that are not there are left out)

    [[snapshot]]         a moment of a run, for one picture of all of them (see snapshots.py)
    run, shear_time, label, field (default "area_ratio")

    [analyse]            what the case's own analyse.py wants to know (see case_analysis.py), which checks its keys

and, in a case whose tables study.toml lists (see study.py),

    [[value]]            a cell of a table, held against a reference
    name = "order 2"     what it is (default: its column and row)
    table = "errors.csv"
    where = {scheme="fd"}  the values of columns that tell its row from all others
    column = "error"
    reference = 1.0      as above, also { table, where, column }: another cell
    band = 0.02          also "below" or "above": on that side of the reference

    [[slope]]            the slope of log y against log x (least squares)
    name, table, where, x, y (columns), reference, band, relative
"""

import csv
import pathlib

from .observables import InputError
from .toml_tables import check_keys, check_kinds, checked_entries, read_toml, require_name_of

# The keys of compare.toml: those an entry must have, those it may have.
MAIN = (("title",), ("source", "read_at", "means_over"))
ENTRIES = {
    "value": (("reference",), ("run", "name", "shear_time", "mean_over", "table", "where", "column", "band", "relative")),
    "slope": (("table", "where", "x", "y", "reference"), ("name", "band", "relative")),
    "change": (("name", "from", "to"), ("shear_time", "mean_over", "band", "reference")),
    "snapshot": (("run", "shear_time", "label"), ("field",)),
    "picture": (("file", "name", "runs"), ()),
}
REFERENCES = {"file": (("file", "where", "column"), ("factor",)), "table": (("table", "where", "column"), ())}
ANALYSE = "analyse.py"  # of a case folder: its own tables and pictures
PICTURED = ("deformation", "inclination_deg")  # the quantities that a [[picture]] may be of


def _check_pictures(file, wanted):
    """Refuses a picture of a run that the case has not."""
    runs = file.with_name("runs.csv")
    known = {row["run"] for row in read_table(runs)} if runs.is_file() else None
    for number, picture in enumerate(wanted.get("picture", []), 1):
        place = f"{file}: [[picture]] number {number}"
        require_name_of(place, picture["file"], ".png")
        for run in picture["runs"]:
            if known is not None and run not in known:
                raise InputError(f"{place}: no run is called '{run}' in {runs}")


def _check_comparison(file, wanted):
    check_keys(file, wanted, (MAIN[0], MAIN[1] + tuple(ENTRIES) + ("analyse",)))
    if "analyse" in wanted and not file.with_name(ANALYSE).is_file():
        raise InputError(f"{file}: [analyse] is for {file.with_name(ANALYSE)}, and there is no such file")
    check_kinds(file, wanted)
    for name, entries in checked_entries(file, wanted, ENTRIES).items():
        for number, entry in enumerate(entries, 1):
            place = f"{file}: [[{name}]] number {number}"
            if isinstance(entry.get("reference"), dict):
                check_keys(f"{place}: reference", entry["reference"], REFERENCES["table" if "table" in entry["reference"] else "file"])
                check_kinds(f"{place}: reference", entry["reference"])
            reads_a_run = name == "change" or (name == "value" and "table" not in entry)
            if reads_a_run and ("name" not in entry or ("shear_time" in entry) == ("mean_over" in entry)):
                raise InputError(f"{place}: it must have `name` and one of `shear_time` and `mean_over`")
            if name == "picture" and entry["name"] not in PICTURED:
                raise InputError(f"{place}: there is no picture of '{entry['name']}', only of {', '.join(PICTURED)}")
            if name == "value" and "table" in entry and not ("where" in entry and "column" in entry):
                raise InputError(f"{place}: a cell of a table must have `where` and `column`")


def read_table(file):
    """The rows of a CSV whose comment lines begin with '#', as dictionaries of text."""
    file = pathlib.Path(file)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    with open(file, newline="") as stream:
        rows = list(csv.DictReader(line for line in stream if not line.startswith("#")))
    for row in rows:
        if None in row or None in row.values():
            values = ", ".join(str(value) for value in row.values() if value is not None)
            raise InputError(f"{file}: a row has not as many cells as the first line has names: {values}; it is damaged or cut off")
    return rows


def _same(text, wanted):
    """Whether a cell says what is wanted: as a number where both are numbers, else as text."""
    try:
        return float(text) == float(wanted)
    except ValueError:
        return text == str(wanted)


def matching_rows(rows, where):
    """The rows that have the value wanted (or one of a list of values) in every column of `where`."""
    lists = {key: wanted if isinstance(wanted, list) else [wanted] for key, wanted in where.items()}
    return [row for row in rows if all(any(_same(row.get(key, ""), one) for one in wanted) for key, wanted in lists.items())]


def number_in(file, column, row):
    """A cell of a table as a number."""
    if column not in row:
        raise InputError(f"{file}: there is no column '{column}', only {', '.join(row)}")
    try:
        return float(row[column])
    except ValueError:
        raise InputError(f"{file}: column '{column}' holds '{row[column]}', which is no number, in the row {', '.join(map(str, row.values()))}") from None


def look_up(folder, reference):
    """The number of a `reference` entry of compare.toml; its file is taken from the folder."""
    if not isinstance(reference, dict):
        return float(reference)
    file = pathlib.Path(folder) / reference["file"]
    where = reference["where"]
    found = matching_rows(read_table(file), where)
    if len(found) != 1:
        raise InputError(f"{file}: {len(found)} rows have {where}; exactly one must")
    return reference.get("factor", 1.0) * number_in(file, reference["column"], found[0])


def read_comparison(case):
    """compare.toml of a case folder, with every reference of the case looked up and every default filled in."""
    file = pathlib.Path(case) / "compare.toml"
    wanted = read_toml(file)
    _check_comparison(file, wanted)
    _check_pictures(file, wanted)
    wanted.setdefault("source", "reference")
    wanted.setdefault("analyse", {})
    for value in wanted.setdefault("value", []) + wanted.setdefault("slope", []):
        # A cell of a table that is yet to be made is looked up when it is compared.
        if not (isinstance(value["reference"], dict) and "table" in value["reference"]):
            value["reference"] = look_up(case, value["reference"])
        value.setdefault("run", None)
        value.setdefault("band", None)
        value.setdefault("relative", True)
    wanted.setdefault("picture", [])
    for change in wanted.setdefault("change", []):
        change["reference"] = look_up(case, change.get("reference", 0.0))
        change.setdefault("band", None)
    return wanted
