"""The numbers a case is held against: compare.toml and the tables of its reference/ folder.

A compare.toml has a title, a source, and any of

    [[value]]            a value at a shear time, held against a reference
    run = "mesh-3"       which run; left out in a case of one run
    name = "deformation" a column of observables.csv
    shear_time = 4.17
    reference = 1.0      a number, or { file, column, where = { column = value, ... } }: one row of a CSV;
                         with `factor`, that number times it
    band = 0.015         largest difference allowed; left out: shown, not judged
    relative = true      whether the band is a share of the reference (default), or in the quantity's unit

    [[change]]           the relative change of a value from one run to another
    name, shear_time, from, to, band

    [[snapshot]]         a moment of a run, for one picture of all of them (see snapshots.py)
    run, shear_time, label, field (default "area_ratio")

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
import tomllib

from .observables import InputError


def read_table(file):
    """The rows of a CSV whose comment lines begin with '#', as dictionaries of text."""
    file = pathlib.Path(file)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    with open(file, newline="") as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


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


def look_up(folder, reference):
    """The number of a `reference` entry of compare.toml; its file is taken from the folder."""
    if not isinstance(reference, dict):
        return float(reference)
    file = pathlib.Path(folder) / reference["file"]
    where = reference["where"]
    found = matching_rows(read_table(file), where)
    if len(found) != 1:
        raise InputError(f"{file}: {len(found)} rows have {where}; exactly one must")
    if reference["column"] not in found[0]:
        raise InputError(f"{file}: there is no column '{reference['column']}', only {', '.join(found[0])}")
    return reference.get("factor", 1.0) * float(found[0][reference["column"]])


def read_comparison(case):
    """compare.toml of a case folder, with every reference of the case looked up and every default filled in."""
    file = pathlib.Path(case) / "compare.toml"
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    with open(file, "rb") as stream:
        wanted = tomllib.load(stream)
    wanted.setdefault("source", "reference")
    for value in wanted.setdefault("value", []) + wanted.setdefault("slope", []):
        # A cell of a table that is yet to be made is looked up when it is compared.
        if not (isinstance(value["reference"], dict) and "table" in value["reference"]):
            value["reference"] = look_up(case, value["reference"])
        value.setdefault("run", None)
        value.setdefault("band", None)
        value.setdefault("relative", True)
    for change in wanted.setdefault("change", []):
        change.setdefault("band", None)
    return wanted
