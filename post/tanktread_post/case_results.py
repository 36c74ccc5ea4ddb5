"""What a case makes of its results: which pictures are drawn and which tables are printed, by its compare.toml and study.toml."""

import pathlib

from . import compare, first_peak, small_deformation
from .reference import read_comparison

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


def judge(output, case):
    """Prints the tables of a case; 1 if anything lies outside its band, else 0."""
    wanted = read_comparison(case)
    judges = [small_deformation.compare] if "small_deformation" in wanted else []
    judges += [first_peak.compare] if "first_peak" in wanted else []
    if any(wanted[name] for name in COMPARED) or not judges:
        judges.append(compare.compare)
    return max([one(output, case) for one in judges])
