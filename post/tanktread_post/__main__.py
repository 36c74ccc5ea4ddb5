"""The commands: plot, render, compare. Exit codes: 0, 1 (comparison outside its band), 2 (bad input)."""

import argparse
import pathlib
import sys

from . import compare, observables, plot


def build_parser():
    parser = argparse.ArgumentParser(prog="tanktread_post", description=__doc__)
    commands = parser.add_subparsers(dest="command", required=True)

    command = commands.add_parser("plot", help="deformation.png and inclination.png beside observables.csv")
    command.add_argument("output", type=pathlib.Path, help="output directory of a run")
    command.add_argument("--case", type=pathlib.Path, help="folder with compare.toml, whose values are drawn in")
    command.set_defaults(run=lambda a: plot.plot_observables(a.output, a.case))

    command = commands.add_parser("render", help="capsule.png: the membrane in the flow, drawn without a screen")
    command.add_argument("output", type=pathlib.Path)
    command.add_argument("--field", default="area_ratio", help="cell field that colours the membrane")
    command.add_argument("--time", type=float, help="shear time (default: the last)")
    command.set_defaults(run=_render)

    command = commands.add_parser("compare", help="a table ours / reference / difference")
    command.add_argument("output", type=pathlib.Path)
    command.add_argument("--case", type=pathlib.Path, required=True, help="folder with compare.toml")
    command.set_defaults(run=lambda a: compare.compare(a.output, a.case))
    return parser


def _render(arguments):
    from . import render  # needs VTK's Python, the other commands do not

    return render.render(arguments.output, arguments.field, arguments.time)


def main():
    arguments = build_parser().parse_args()
    try:
        return arguments.run(arguments) or 0
    except observables.InputError as error:
        print(f"tanktread_post: error: {error}", file=sys.stderr)
        return 2


if __name__ == "__main__":
    sys.exit(main())
