"""What a case makes of its results: which pictures are drawn and which tables are printed, by its compare.toml and study.toml."""

import pathlib

from . import compare, first_peak, series, small_deformation
from .reference import read_comparison
from .run_folder import is_run

COMPARED = ("value", "slope", "change")


def draw(output, case=None):
    """Draws the plots of a folder of results into it. Returns the files. Without a case: those of any run."""
    from . import plot, plot_first_peak, plot_study  # matplotlib is slow to load

    if case is None:
        return plot.plot_observables(output)
    if (pathlib.Path(case) / "study.toml").is_file():
        return plot_study.plot_tables(output, case)
    wanted = read_comparison(case)
    if "small_deformation" in wanted:
        return plot.plot_small_deformation(output, case)
    if "first_peak" in wanted:
        return plot_first_peak.plot_first_peak(output, case)
    return plot.plot_observables(output, case)


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
    wanted = read_comparison(case)
    judges = [small_deformation.compare] if "small_deformation" in wanted else []
    judges += [first_peak.compare] if "first_peak" in wanted else []
    if any(wanted[name] for name in COMPARED) or not judges:
        judges.append(compare.compare)
    return max([one(output, case) for one in judges])
