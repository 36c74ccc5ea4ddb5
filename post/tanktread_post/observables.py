"""Reading observables.csv and the other tables of a run against shear time: one capsule's quantities, or those of the whole run."""

import csv
import pathlib

import numpy

from . import going_on


class InputError(Exception):
    """A file is missing or not what it should be; the message names it and says what to do."""


class Observables:
    """The columns of observables.csv (or of another `table` of the run) for one capsule, as arrays of numbers; capsule None: of a table that has
    no column `capsule`."""

    def __init__(self, directory, capsule=0, table="observables.csv"):
        self.file = pathlib.Path(directory) / table
        if not self.file.is_file():
            raise InputError(f"{self.file}: there is no such file; is {directory} the output of a run?")
        try:
            names, rows = self._read(capsule)
            self.columns = {name: numpy.array([float(row[name]) for row in rows]) for name in names}
        except (ValueError, csv.Error) as error:
            raise InputError(f"{self.file}: {error}; it is damaged") from error
        if not rows:
            raise InputError(f"{self.file}: it has no rows" + ("" if capsule is None else f" of capsule {capsule}"))

    def _read(self, capsule):
        """The names of the columns, and the rows of a capsule."""
        # A row that a killed run left unfinished has no end of line: it is not a row yet, though its last number may look like one.
        whole = self.file.read_text().rpartition("\n")[0]
        reader = csv.DictReader(whole.splitlines())
        names = reader.fieldnames or []
        needed = ["shear_time"] if capsule is None else ["shear_time", "capsule"]
        if not set(needed) <= set(names):
            raise InputError(f"{self.file}: its first line does not name the column{'s'[: len(needed) - 1]} {' and '.join(needed)}")
        rows = list(reader)
        for number, row in enumerate(rows, 2):
            if None in row or None in row.values():
                raise ValueError(f"line {number} has not {len(names)} numbers")
        return names, [row for row in rows if capsule is None or int(row["capsule"]) == capsule]

    def __getitem__(self, name):
        if name not in self.columns:
            raise InputError(f"{self.file}: there is no column '{name}', only {', '.join(self.columns)}")
        return self.columns[name]

    def reaches(self, shear_time):
        """Whether the run has come to a shear time: a run to T ends with the step nearest to T."""
        last, step = self["shear_time"][-1], self["step"][-1]
        half_a_step = 0.500001 * last / step if step > 0 else 0.0  # and a rounding
        return bool(shear_time <= last + half_a_step)

    def at(self, name, shear_time):
        """The value at a shear time, by linear interpolation between two rows; never beyond the last step."""
        times, values = self["shear_time"], self[name]
        if shear_time < times[0]:
            raise InputError(f"{self.file}: shear time {shear_time:g} is before the first one, {times[0]:.6g}")
        if not self.reaches(shear_time):
            fix = going_on.command(self.file.parent, shear_time)
            raise InputError(f"{self.file}: shear time {shear_time:g} is outside {times[0]:.6g} to {times[-1]:.6g}; the run must go on to it: {fix}")
        return float(numpy.interp(shear_time, times, values))

    def mean(self, name, start, end):
        """The mean over a stretch of shear time, by straight lines between the rows."""
        within = (self["shear_time"] > start) & (self["shear_time"] < end)
        times = numpy.array([start, *self["shear_time"][within], end])
        values = numpy.array([self.at(name, start), *self[name][within], self.at(name, end)])
        return float(numpy.sum(0.5 * (values[1:] + values[:-1]) * numpy.diff(times)) / (end - start))
