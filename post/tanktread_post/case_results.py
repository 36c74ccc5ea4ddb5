"""What a case makes of its results: which pictures are drawn and which tables are printed, by its compare.toml, study.toml and analyse.py."""

import pathlib

from . import case_analysis, compare, measured, series
from .observables import InputError
from .reference import ANALYSE, read_comparison
from .run_folder import is_run
from .table import print_tables

COMPARED = ("value", "slope", "change")


def draw(output, case=None):
    """Draws the plots of a folder of results into it. Returns the files. Without a case: those of any run."""
    from . import plot, plot_study  # matplotlib is slow to load

    if case is None:
        return plot.plot_observables(output)
    analysis = case_analysis.load(case)
    files = [] if analysis is None else analysis.pictures(output, case)
    if (pathlib.Path(case) / "study.toml").is_file():
        files += plot_study.plot_tables(output, case)
    elif analysis is None or read_comparison(case)["picture"]:
        files += plot.plot_observables(output, case)
    return files


def keep(output, case, command):
    """Copies the tables of the case's own analysis, and its pictures, to its measured/. Returns the files. For a case with a script of its own."""
    analysis = case_analysis.load(case)
    if analysis is None:
        raise InputError(f"{case}: there is no {ANALYSE} in it, so there are no tables to keep")
    files = [measured.add_own(case, name, text, command) for name, text in analysis.measured(output, case).items()]
    pictures = draw(output, case)
    measured.add_pictures(case, pictures)
    return [*files, *(pathlib.Path(case) / "measured" / pathlib.Path(picture).name for picture in pictures)]


def reached_snapshots(output, case):
    """The [[snapshot]] entries that their runs have reached: each with the folder of the run and the time of the nearest membrane."""
    reached = []
    for entry in read_comparison(case).get("snapshot", []):
        run = pathlib.Path(output) / entry["run"]
        membranes, wanted = run / "membrane.pvd", entry["shear_time"]
        last = series.at(membranes, None) if is_run(run) else None
        if last is not None and last[0] >= wanted:
            reached.append((entry, run, series.at(membranes, wanted)[0]))
    return reached


def judge(output, case):
    """Prints the tables of a case; 1 if anything lies outside its band, else 0."""
    analysis, wanted = case_analysis.load(case), read_comparison(case)
    code = 0 if analysis is None else print_tables(analysis.tables(output, case))
    if analysis is None or any(wanted[name] for name in COMPARED):
        code = max(code, compare.compare(output, case))
    return code
