"""The commands of tanktread_post.

Exit codes: 0, 1 (a comparison outside its band, a run not finished), 2 (bad input), 3 (a fault of ours).
"""

import argparse
import math
import pathlib
import sys

from . import case_results, exit_codes, measured, observables, run_folder, surface


def _number(text):
    """A number of the command line; to Python nan, inf and 1_0 are numbers too."""
    try:
        value = float(text.replace("_", "?"))
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"{text!r} is no number; write one as 0.5")
    return value


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

    add("plot", lambda a: _said(case_results.draw(a.output, a.case)), "the plots of the case: D and inclination against shear time, or its own", False)
    add("compare", lambda a: case_results.judge(a.output, a.case), "the tables of the case: ours / reference / difference", True)
    add("finished", lambda a: 0 if run_folder.is_finished(a.output) else 1, "exit code 0 if the run is at its end, else 1", None)

    command = add("render", _render, "capsule.png: the membrane in the flow (without a display: xvfb-run)", None)
    command.add_argument("--field", default="area_ratio", help="cell field that colours the membrane (default: %(default)s)")
    command.add_argument("--shear-time", type=_number, help="which moment (default: the last)")
    command.add_argument("--file", type=pathlib.Path, help="where to (default: capsule.png in the output directory)")

    command = add("strip", _strip, "strip.png: the membrane at several times, side by side, smooth and shaded (without a display: xvfb-run)", None)
    command.add_argument("--shear-times", type=_number, nargs="+", required=True, metavar="SHEAR_TIME", help="which moments")
    command.add_argument("--file", type=pathlib.Path, help="where to (default: strip.png in the output directory)")

    add("snapshots", _snapshots, "snapshots.png: the moments of a case's runs that its compare.toml lists", True)

    command = add("measure", _measure, "adds a finished run to measured/results.csv of its case", True)
    command.add_argument("--at", type=_number, nargs="+", required=True, metavar="SHEAR_TIME", help="when to read it")
    command.add_argument("--run", help="name of the run (default: that of its folder)")
    command.add_argument("--made-by", required=True, metavar="COMMAND", help="the command that made it")
    command.add_argument("--log", type=pathlib.Path, help="what the run printed: for its speed (default: OUTPUT.log)")

    command = add("keep", _keep, "copies the tables of the case's own analysis, and its pictures, to its measured/", True)
    command.add_argument("--made-by", required=True, metavar="COMMAND", help="the command that made them")

    _add_convert_surface(commands)
    _add_convert_series(commands)
    return parser


def _add_convert_surface(commands):
    text = "a closed surface of another format (.stl, .obj, .ply, .off, .msh, .vtp) as .vtu, or back; repaired and checked"
    command = commands.add_parser("convert-surface", help=text, description=text)
    command.add_argument("source", type=pathlib.Path, metavar="IN")
    command.add_argument("target", type=pathlib.Path, nargs="?", metavar="OUT", help="may be left out with --check-only")
    command.add_argument("--scale", type=_number, default=1.0, help="factor of all coordinates (default: %(default)s)")
    command.add_argument(
        "--merge-tolerance", type=_number, default=surface.MERGE_TOLERANCE, metavar="FRACTION",
        help="points nearer than this fraction of the diagonal of the surface's box become one (default: %(default)s)",
    )  # fmt: skip
    command.add_argument("--body", type=int, metavar="K", help="take one of several separate bodies, numbered from 0")
    command.add_argument("--ascii", action="store_true", help="text with all digits, for .stl, .ply and .msh (default: binary)")
    command.add_argument("--gmsh-version", choices=["4.1", "2.2"], default="4.1", help="of a .msh (default: %(default)s)")
    command.add_argument("--check-only", action="store_true", help="say what would be done, write nothing")
    command.add_argument("--force", action="store_true", help="replace OUT if it is there")
    command.set_defaults(call=_convert_surface)


def _add_convert_series(commands):
    text = "the membranes of a run as one XDMF time series, and as tables"
    command = commands.add_parser("convert-series", help=text, description=text)
    command.add_argument("output", type=pathlib.Path, metavar="OUTPUT", help="output directory of a run")
    command.add_argument("target", type=pathlib.Path, metavar="OUT.xdmf")
    command.add_argument("--csv", type=pathlib.Path, metavar="DIR", help="a new folder for tables: points and cells of each time")
    command.add_argument("--force", action="store_true", help="replace OUT.xdmf if it is there")
    command.set_defaults(call=_convert_series)


def _said(lines):
    for line in lines:
        print(line)
    return 0


# VTK and meshio are slow to load, so only the commands that need them do.
def _render(arguments):
    from . import render

    return _said([render.render(arguments.output, arguments.field, arguments.shear_time, arguments.file)])


def _strip(arguments):
    from . import strip

    return _said([strip.draw(arguments.output, arguments.shear_times, arguments.file)])


def _snapshots(arguments):
    from . import snapshots

    return _said([snapshots.draw_snapshots(arguments.output, arguments.case)])


def _measure(arguments):
    run = arguments.run or arguments.output.resolve().name
    log = arguments.log or arguments.output.with_name(arguments.output.name + ".log")
    return _said([measured.add(arguments.case, arguments.output, run, arguments.at, arguments.made_by, log)])


def _keep(arguments):
    return _said(case_results.keep(arguments.output, arguments.case, arguments.made_by))


def _convert_surface(arguments):
    from . import convert_surface

    if arguments.target is None and not arguments.check_only:
        raise observables.InputError(f"{arguments.source}: name the file to write, OUT, or give --check-only")
    return _said(
        convert_surface.convert(
            arguments.source, None if arguments.check_only else arguments.target, arguments.scale, arguments.merge_tolerance,
            arguments.body, arguments.ascii, arguments.gmsh_version, arguments.force,
        )
    )  # fmt: skip


def _convert_series(arguments):
    from . import convert_series

    return _said(convert_series.convert(arguments.output, arguments.target, arguments.csv, arguments.force))


def main(words=None):
    """Runs the command of the command line, or of these words; the exit code."""
    arguments = build_parser().parse_args(words)
    return exit_codes.ended("tanktread_post", lambda: arguments.call(arguments))


if __name__ == "__main__":
    sys.exit(main())
