"""The commands of tanktread_post.

Exit codes: 0, 1 (a comparison outside its band, a run not finished), 2 (bad input).
"""

import argparse
import pathlib
import sys

from . import compare, measured, observables, run_folder


def build_parser():
    """All commands and their arguments; each sets `call`, which does the work."""
    parser = argparse.ArgumentParser(prog="tanktread_post", description="Plots, pictures and comparison of tanktread's results")
    commands = parser.add_subparsers(dest="command", required=True)

    def add(name, call, text, case):
        command = commands.add_parser(name, help=text, description=text)
        command.add_argument("output", type=pathlib.Path, help="output directory of a run, or a folder of runs")
        if case is not None:
            command.add_argument("--case", type=pathlib.Path, required=case, help="folder of the case, with compare.toml")
        command.set_defaults(call=call)
        return command

    add("plot", _plot, "deformation.png and inclination.png: against shear time, the reference drawn in", False)
    add("plot-errors", _plot_errors, "errors.png: small deformation, the error against the resolution", True)
    add("plot-tables", _plot_tables, "the plots of study.toml, the reference drawn in", True)
    add("compare", lambda a: compare.compare(a.output, a.case), "a table ours / reference / difference", True)
    add("compare-theory", _compare_theory, "tables of the error against the limit of small deformation", True)
    add("finished", lambda a: 0 if run_folder.is_finished(a.output) else 1, "exit code 0 if the run is at its end, else 1", None)

    command = add("render", _render, "capsule.png: the membrane in the flow (without a display: xvfb-run)", None)
    command.add_argument("--field", default="area_ratio", help="cell field that colours the membrane (default: %(default)s)")
    command.add_argument("--shear-time", type=float, help="which moment (default: the last)")
    command.add_argument("--file", type=pathlib.Path, help="where to (default: capsule.png in the output directory)")

    command = add("measure", _measure, "adds a finished run to measured/results.csv of its case", True)
    command.add_argument("--at", type=float, nargs="+", required=True, metavar="SHEAR_TIME", help="when to read it")
    command.add_argument("--run", help="name of the run (default: that of its folder)")
    command.add_argument("--made-by", required=True, metavar="COMMAND", help="the command that made it")
    command.add_argument("--log", type=pathlib.Path, help="what the run printed: for its speed (default: OUTPUT.log)")

    command = commands.add_parser("convert-mesh", help="a mesh of another format as .vtu")
    command.add_argument("source", type=pathlib.Path)
    command.add_argument("target", type=pathlib.Path)
    command.set_defaults(call=_convert)
    return parser


def _said(files):
    for file in files:
        print(file)
    return 0


# matplotlib, VTK and meshio are slow to load, so only the commands that need them do.
def _plot(arguments):
    from . import plot

    return _said(plot.plot_observables(arguments.output, arguments.case))


def _plot_errors(arguments):
    from . import plot

    return _said(plot.plot_small_deformation(arguments.output, arguments.case))


def _plot_tables(arguments):
    from . import plot_study

    return _said(plot_study.plot_tables(arguments.output, arguments.case))


def _compare_theory(arguments):
    from . import small_deformation

    return small_deformation.compare(arguments.output, arguments.case)


def _render(arguments):
    from . import render

    return _said([render.render(arguments.output, arguments.field, arguments.shear_time, arguments.file)])


def _measure(arguments):
    run = arguments.run or arguments.output.resolve().name
    log = arguments.log or arguments.output.with_name(arguments.output.name + ".log")
    commit = measured.commit_of(arguments.case)
    return _said([measured.add(arguments.case, arguments.output, run, arguments.at, arguments.made_by, commit, log)])


def _convert(arguments):
    from . import mesh

    n_points, n_triangles = mesh.convert(arguments.source, arguments.target)
    print(f"{arguments.target}: {n_points} nodes, {n_triangles} triangles; now: tanktread mesh info {arguments.target}")
    return 0


def main():
    """Runs the command of the command line; the exit code."""
    arguments = build_parser().parse_args()
    try:
        return arguments.call(arguments)
    except observables.InputError as error:
        print(f"tanktread_post: error: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
