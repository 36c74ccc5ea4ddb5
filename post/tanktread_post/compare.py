"""A table ours / reference / difference, and whether every value lies in its band."""

import pathlib

from . import study
from .observables import InputError, Observables
from .reference import read_comparison
from .run_folder import is_run

SIDES = ("below", "above")
HEADER = ("quantity", "at", "ours", "reference", "difference", "band", "")


def difference(ours, reference, relative):
    """The difference as a band counts it: a share of the reference, or in the quantity's own unit."""
    return (ours - reference) / abs(reference) if relative else ours - reference


def shown(amount, relative, sign="+"):
    """A difference or a band as text."""
    return format(100 * amount, f"{sign}.2f") + " %" if relative else format(amount, f"{sign}.4f")


def verdict(amount, band):
    """True inside the band, False outside, None where nothing is judged. NaN is outside."""
    if band is None:
        return None
    if band in SIDES:
        return amount < 0 if band == "below" else amount > 0
    return abs(amount) <= band


def number(value):
    """A number as text; a small one with its digits, not with zeros."""
    return f"{value:.6f}" if value == 0 or abs(value) >= 1e-2 else f"{value:.4g}"


def table_row(label, at, ours, reference, relative, band):
    """One row of text, and its verdict; `at` says where it was read."""
    amount = difference(ours, reference, relative)
    inside = verdict(amount, band)
    allowed = "" if band is None else band if band in SIDES else shown(band, relative, "")
    word = {True: "inside", False: "OUTSIDE", None: "shown only"}[inside]
    return (label, at, number(ours), number(reference), shown(amount, relative), allowed, word), inside


def print_rows(title, header, rows):
    """Prints a table with columns as wide as they need to be: text to the left, numbers to the right."""
    widths = [max(len(row[k]) for row in [header, *rows]) for k in range(len(header))]
    print(f"\n{title}")
    for row in [header, *rows]:
        cells = [row[k].ljust(widths[k]) if k in (0, len(row) - 1) else row[k].rjust(widths[k]) for k in range(len(row))]
        print("  ".join(cells).rstrip())


def _run_directory(output, run, shear_time):
    """The folder of a run; None if it is not there, or (of a case of many) has not come to the shear time yet.

    A case of one run has its results in `output` itself.
    """
    directory = pathlib.Path(output) if run is None else pathlib.Path(output) / run
    if not is_run(directory):
        return None
    if run is not None and Observables(directory)["shear_time"][-1] < shear_time:
        return None
    return directory


def _cell_row(output, value):
    label = value.get("name") or f"{value['column']} {', '.join(map(str, value['where'].values()))}"
    if not (pathlib.Path(output) / value["table"]).is_file():
        return None, label
    ours, wanted = study.value(output, value)
    return table_row(label, value["table"], ours, wanted, value["relative"], value["band"]), label


def _slope_row(output, slope):
    label = slope.get("name") or f"slope of {slope['y']} against {slope['x']}"
    if not (pathlib.Path(output) / slope["table"]).is_file():
        return None, label
    ours = study.slope(output, slope)
    return table_row(label, slope["table"], ours, slope["reference"], slope["relative"], slope["band"]), label


def _value_row(output, value):
    if "table" in value:
        return _cell_row(output, value)
    directory = _run_directory(output, value["run"], value["shear_time"])
    label = value["name"] if value["run"] is None else f"{value['run']}: {value['name']}"
    if directory is None:
        return None, label
    ours = Observables(directory).at(value["name"], value["shear_time"])
    return table_row(label, f"{value['shear_time']:.2f}", ours, value["reference"], value["relative"], value["band"]), label


def _change_row(output, change):
    directories = [_run_directory(output, change[key], change["shear_time"]) for key in ("from", "to")]
    label = f"{change['from']} to {change['to']}: {change['name']}"
    if None in directories:
        return None, label
    first, second = (Observables(directory).at(change["name"], change["shear_time"]) for directory in directories)
    return table_row(label, f"{change['shear_time']:.2f}", second, first, True, change["band"]), label


def compare(output, case):
    """Prints the table of a case; 1 if a value lies outside its band, else 0. Runs that are not there are named.

    A choice of runs may have no value that is judged; that is said, and is no failure.
    """
    wanted = read_comparison(case)
    rows, verdicts, absent = [], [], []
    for make, entries in ((_value_row, wanted["value"]), (_slope_row, wanted["slope"]), (_change_row, wanted["change"])):
        for entry in entries:
            row, label = make(output, entry)
            if row is None:
                absent.append(label)
            else:
                rows.append(row[0])
                verdicts.append(row[1])
    if not rows:
        raise InputError(f"{output}: none of the runs or tables of {case} is there")
    header = tuple(wanted["source"] if name == "reference" else name for name in HEADER)
    print_rows(wanted["title"], header, rows)
    if absent:
        print("not run yet: " + ", ".join(absent))
    if all(inside is None for inside in verdicts):
        print("nothing was judged: no value with a band is there")
    return 1 if False in verdicts else 0
