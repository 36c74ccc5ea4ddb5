"""Reading observables.csv and the numbers a case is compared with."""

import csv
import pathlib
import tomllib

import numpy


class InputError(Exception):
    """A file is missing or not what it should be; the message names it."""


class Observables:
    """The columns of observables.csv for one capsule, as arrays."""

    def __init__(self, directory, capsule=0):
        self.file = pathlib.Path(directory) / "observables.csv"
        if not self.file.is_file():
            raise InputError(f"{self.file}: there is no such file; is {directory} the output of a run?")
        with open(self.file, newline="") as stream:
            rows = [row for row in csv.DictReader(stream) if int(row["capsule"]) == capsule]
        if not rows:
            raise InputError(f"{self.file}: it has no rows of capsule {capsule}")
        self.columns = {name: numpy.array([float(row[name]) for row in rows]) for name in rows[0]}

    def __getitem__(self, name):
        if name not in self.columns:
            raise InputError(f"{self.file}: there is no column '{name}', only {', '.join(self.columns)}")
        return self.columns[name]

    def at(self, name, shear_time):
        """The value at a shear time, by linear interpolation between rows. Never beyond the last row."""
        times = self["shear_time"]
        if not times[0] <= shear_time <= times[-1]:
            raise InputError(f"{self.file}: shear time {shear_time} is outside {times[0]:.6g} to {times[-1]:.6g}")
        return float(numpy.interp(shear_time, times, self[name]))


def read_comparison(case):
    """The table of compare.toml: {"title": ..., "value": [{name, shear_time, reference, band, relative}, ...]}."""
    file = pathlib.Path(case) / "compare.toml"
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    with open(file, "rb") as stream:
        return tomllib.load(stream)
