"""The tables of compare.toml: ours / reference / difference, and whether every value lies in its band."""

import pathlib

from . import study
from .observables import InputError, Observables
from .reference import read_comparison
from .run_folder import is_run
from .table import Table, table_row

HEADER = ("quantity", "at", "ours", "reference", "difference", "band", "")


def _end(entry):
    """The last shear time that an entry reads."""
    return entry["mean_over"][1] if "mean_over" in entry else entry["shear_time"]


def _when(entry):
    return "mean {:g} to {:g}".format(*entry["mean_over"]) if "mean_over" in entry else f"{entry['shear_time']:.2f}"


def _read(directory, entry):
    """The value that an entry reads of a run."""
    observables = Observables(directory)
    if "mean_over" in entry:
        return observables.mean(entry["name"], *entry["mean_over"])
    return observables.at(entry["name"], entry["shear_time"])


def _run_directory(output, run, shear_time):
    """The folder of a run; None if it is not there, or (of a case of many) has not come to the shear time yet.

    A case of one run has its results in `output` itself.
    """
    directory = pathlib.Path(output) if run is None else pathlib.Path(output) / run
    if not is_run(directory):
        return None
    if run is not None and not Observables(directory).reaches(shear_time):
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
    directory = _run_directory(output, value["run"], _end(value))
    label = value["name"] if value["run"] is None else f"{value['run']}: {value['name']}"
    if directory is None:
        return None, label
    ours = _read(directory, value)
    return table_row(label, _when(value), ours, value["reference"], value["relative"], value["band"]), label


def _change_row(output, change):
    directories = [_run_directory(output, change[key], _end(change)) for key in ("from", "to")]
    label = f"{change['from']} to {change['to']}: {change['name']}"
    if None in directories:
        return None, label
    first, second = (_read(directory, change) for directory in directories)
    return table_row(label, _when(change), second, first * (1 + change["reference"]), True, change["band"]), label


def _holds_results(output):
    """Whether a folder holds a run, runs, or tables."""
    output = pathlib.Path(output)
    return is_run(output) or (output.is_dir() and any(is_run(path) or path.suffix == ".csv" for path in output.iterdir()))


def compare(output, case):
    """Prints the table of a case; 1 if a value lies outside its band, else 0. Runs that are not there are named.

    A choice of runs may have no value that is compared or judged; that is said, and is no failure.
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
    if not _holds_results(output):
        raise InputError(f"{output}: none of the runs or tables of {case} is there")
    if rows:
        header = tuple(wanted["source"] if name == "reference" else name for name in HEADER)
        Table(wanted["title"], header, rows).print()
    if absent:
        print("not run yet: " + ", ".join(absent))
    if all(inside is None for inside in verdicts):
        print("nothing was judged: no value with a band is there")
    return 1 if False in verdicts else 0
