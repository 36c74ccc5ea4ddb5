"""The course of a run in time, thinned so that it can be kept: shape, contour and marker, from its tables or from measured/histories.csv."""

import csv
import dataclasses
import io
import math
import pathlib

import numpy

from tanktread_post.observables import Observables
from tanktread_post.reference import number_in, read_table
from tanktread_post.run_folder import read_echo

EVERY = 0.25  # shear times between what is kept: a half turn is about 9 of them, an oscillation 5
COLUMNS = (
    "shear_time", "deformation", "inclination_deg", "circumference", "membrane_speed", "marker_along_flow", "marker_along_gradient", "marker_speed",
)  # fmt: skip
OF_SHAPE, OF_CONTOUR = COLUMNS[1:3], COLUMNS[3:5]


@dataclasses.dataclass(frozen=True)
class History:
    """One run against shear time. What measures.csv would say is NaN where there is no such file."""

    run: str
    columns: dict  # {name of COLUMNS: numbers}; the marker's place seen from the centroid, over a, its speed over g a

    def __getitem__(self, name):
        return self.columns[name]

    def at(self, name, shear_time):
        """The value at the kept time nearest to a shear time."""
        return float(self[name][numpy.abs(self["shear_time"] - shear_time).argmin()])

    def mean(self, name, start, end):
        """The mean of the kept values from one shear time to another; NaN where there are none."""
        within = self.from_to(start, end)
        return float(self[name][within].mean()) if within.any() else math.nan

    def from_to(self, start, end):
        """Which kept values stand for the shear times from one to another: those of whole steps next to every multiple of EVERY."""
        return numpy.abs(self["shear_time"] - (start + end) / 2) <= (end - start + EVERY) / 2


def _kept_rows(times):
    """The numbers of the rows nearest to the times that are kept."""
    wanted = numpy.arange(0, times[-1] + 1e-6, EVERY)
    return numpy.unique([numpy.abs(times - one).argmin() for one in wanted])


def read_history(directory):
    """The history of a run."""
    observables, directory = Observables(directory), pathlib.Path(directory)
    times = observables["shear_time"]
    rows = _kept_rows(times)
    columns = {"shear_time": times[rows], **{name: observables[name][rows] for name in OF_SHAPE}}
    if not (directory / "measures.csv").is_file():
        return History(directory.name, columns | dict.fromkeys(COLUMNS[3:], numpy.full(len(rows), math.nan)))
    measures, flow = Observables(directory, table="measures.csv"), read_echo(directory)["flow"]
    place = [measures[f"marker_{flow[axis]}"] for axis in ("flow_axis", "wall_axis")]
    # Of all rows, before any is left out: central differences over 0.1 shear times are right to a thousandth.
    speed = numpy.hypot(*(numpy.gradient(along, measures["shear_time"]) for along in place))
    of_marker = dict(zip(COLUMNS[5:], (*place, speed)))
    of_contour = {name: measures[name] for name in OF_CONTOUR}
    read = {name: numpy.interp(times[rows], measures["shear_time"], values) for name, values in (of_contour | of_marker).items()}
    return History(directory.name, columns | read)


def table_of(histories):
    """The text of measured/histories.csv."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(("run", *COLUMNS))
    for history in histories:
        for values in zip(*(history[name] for name in COLUMNS)):
            writer.writerow((history.run, *("" if math.isnan(value) else f"{value:.5g}" for value in values)))
    return stream.getvalue()


def read_kept(file):
    """{run: History} of measured/histories.csv; nothing where there is no such file."""
    if not pathlib.Path(file).is_file():
        return {}
    rows = {}
    for row in read_table(file):
        rows.setdefault(row["run"], []).append([math.nan if row.get(name) == "" else number_in(file, name, row) for name in COLUMNS])
    return {run: History(run, dict(zip(COLUMNS, numpy.array(values).T))) for run, values in rows.items()}
