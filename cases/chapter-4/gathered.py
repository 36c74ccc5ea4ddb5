"""All that is known of the runs: of those whose output is there, and of the others what `--measure` kept in measured/."""

import dataclasses
import pathlib

from tanktread_post import outlines
from tanktread_post.case_analysis import module_of
from tanktread_post.observables import InputError
from tanktread_post.reference import read_comparison, read_table
from tanktread_post.run_folder import finished_runs

HERE = pathlib.Path(__file__).parent
readings, histories = (module_of(HERE / f"{name}.py") for name in ("readings", "histories"))
FINE = "fine"  # the group of runs.csv whose runs are not of the matrix: they are held against it in time (fine.py)
IN_TIME = {"fig-4.2", "fig-4.4", "fig-4.10", FINE}  # groups of runs.csv whose runs are drawn, or read, against time


@dataclasses.dataclass(frozen=True)
class Gathered:
    """What is known. A run of which output is there is read from it, whatever was kept."""

    settings: dict  # [analyse] of compare.toml
    readings: list  # of readings.Reading, in rising (lambda, Bq_s, Bq_d)
    kept: list  # the runs that are from measured/
    histories: dict  # {run: histories.History}
    outlines: dict  # {(run, shear time): outlines.Outline}

    def outline(self, run, shear_time):
        """The outline of a run nearest to a shear time, within 0.1; None where there is none."""
        found = [one for (name, time), one in self.outlines.items() if name == run and abs(time - shear_time) <= 0.1]
        return min(found, key=lambda one: abs(one.shear_time - shear_time), default=None)


def rows_of(case, fine=False):
    """The rows of runs.csv that are of the matrix, or those of the group FINE."""
    return [row for row in read_table(pathlib.Path(case) / "runs.csv") if (FINE in row["groups"].split()) == fine]


def gather(output, case):
    """What is known of the runs below a folder of results. @throws InputError where that is nothing"""
    case, settings = pathlib.Path(case), read_comparison(case)["analyse"]
    kept = case / "measured"
    there = {directory.name: directory for directory in finished_runs(output)}
    found = readings.read_runs(output, settings, kept / "readings.csv", without={row["run"] for row in rows_of(case, fine=True)})
    if not found:
        raise InputError(f"{output}: no finished run is there, and no {kept / 'readings.csv'}")
    in_time = {row["run"] for row in read_table(case / "runs.csv") if IN_TIME & set(row["groups"].split())}
    history = {run: histories.read_history(directory) for run, directory in there.items() if run in in_time}
    history = {run: one for run, one in histories.read_kept(kept / "histories.csv").items() if run not in there} | history
    shapes = {place: one for place, one in outlines.read_kept(kept / "outlines.csv").items() if place[0] not in there}
    for run, directory in there.items():
        times = [settings["outline_at"], *(settings["deforming_at"] if run == settings["deforming"] else ())]
        cuts = (outlines.read_outline(directory, time) for time in sorted(set(times)))
        shapes |= {(run, one.shear_time): one for one in cuts if one is not None}
    return Gathered(settings, found, [r.run for r in found if r.run not in there], history, shapes)
