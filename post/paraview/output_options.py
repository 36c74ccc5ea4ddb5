"""The options of open_output.py. Knows nothing of ParaView."""

import argparse
import math
import os
import shlex

AXES = "xyz"
PICTURES = (".png", ".jpg", ".jpeg", ".tif", ".tiff", ".bmp")


def build_parser(description):
    """All options, with their defaults."""
    parser = argparse.ArgumentParser(
        prog="open_output.py",
        usage="%(prog)s OUTPUT [PICTURE] [options]; --help tells them",
        description=description,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("output", metavar="OUTPUT", help="output directory of a run")
    parser.add_argument("picture", metavar="PICTURE", nargs="?", help="save a picture here (" + " ".join(PICTURES) + ")")
    parser.add_argument("--list", action="store_true", help="print the arrays and the times, draw nothing")

    what = parser.add_argument_group("the membrane")
    what.add_argument("--color", metavar="ARRAY", default="area_ratio", help="array of points or triangles that colours it (default: %(default)s)")
    what.add_argument("--component", metavar="C", help="number (from 0) or name of a component, or magnitude (default: magnitude)")
    what.add_argument("--range", metavar=("LOW", "HIGH"), nargs=2, type=_number, help="range of the colours (default: of all times)")
    what.add_argument("--no-edges", action="store_true", help="leave out the edges of the triangles")

    flow = parser.add_argument_group("the flow")
    flow.add_argument(
        "--slice", metavar="AXIS[:POSITION]", dest="slices", action="append", type=_slice,
        help="draw the velocity in a plane across x, y or z, at a position in grid steps; may be given again "
        "(default: the shear plane, through the middle)",
    )  # fmt: skip
    flow.add_argument("--no-slice", action="store_true", help="draw no flow")
    flow.add_argument("--velocity", choices=[*AXES, "magnitude"], help="what colours the slices (default: along the flow)")
    flow.add_argument("--velocity-range", metavar=("LOW", "HIGH"), nargs=2, type=_number, help="range of these colours (default: of all times)")
    flow.add_argument("--arrows", metavar="N", type=_count, default=16, help="arrows along the longer side (default: %(default)s; 0: none)")

    when = parser.add_argument_group("time and pictures")
    when.add_argument("--shear-time", metavar="T", type=_number, help="show the moment nearest to this (default: the last)")
    when.add_argument("--frames", metavar="DIR", help="save frame_0000.png ... here, one for each membrane file")
    when.add_argument("--size", metavar=("WIDTH", "HEIGHT"), nargs=2, type=_pixels, default=[1200, 900], help="in pixels (default: 1200 900)")
    when.add_argument("--zoom", metavar="FACTOR", type=_zoom, default=1.0, help="above 1: nearer (default: 1)")
    return parser


def parse(parser, words, in_window):
    """The options; exits with code 2 and a message if they cannot be. `in_window`: there, nothing need be saved."""
    # argparse takes -1e-3 for an option; with a blank before it, it does not.
    options = parser.parse_args([" " + word if _is_negative_number(word) else word for word in words])
    for name in ("range", "velocity_range"):
        limits = getattr(options, name)
        if limits and not limits[0] < limits[1]:
            parser.error("--{} {:g} {:g}: LOW must be below HIGH".format(name.replace("_", "-"), *limits))
    if options.no_slice and options.slices:
        parser.error("--no-slice and --slice contradict each other")
    if not in_window and not (options.picture or options.frames or options.list):
        parser.error("nothing to make: give a PICTURE, --frames DIR or --list; to look at the run, open the script in the window of ParaView")
    if options.frames and options.shear_time is not None and not options.picture:
        parser.error("--shear-time chooses one moment, --frames saves all")
    if options.picture:
        _check_picture(parser, options.picture)
    if options.frames and os.path.exists(options.frames) and not os.path.isdir(options.frames):
        parser.error(f"--frames {options.frames}: it is there already and is no folder")
    return options


def words_from_environment(environment):
    """What the window of ParaView cannot give as arguments: [TANKTREAD_OUTPUT, words of TANKTREAD_OPTIONS ...]; [] without the first."""
    output = environment.get("TANKTREAD_OUTPUT", "")
    return [output, *shlex.split(environment.get("TANKTREAD_OPTIONS", ""))] if output else []


def film_command(folder, n_frames):
    """The ffmpeg command that makes a film of the frames."""
    # A % of the folder's own is doubled: ffmpeg reads the name as a pattern. The number of frames leaves out older ones.
    pattern = os.path.join(folder.replace("%", "%%"), "frame_%04d.png")
    film = os.path.join(folder, "film.mp4")
    return f"ffmpeg -framerate 10 -i {shlex.quote(pattern)} -frames:v {n_frames} -pix_fmt yuv420p {shlex.quote(film)}"


def _check_picture(parser, picture):
    """Exits unless a picture can be saved under this name."""
    if os.path.splitext(picture)[1].lower() not in PICTURES:
        parser.error(f"{picture}: the name of a picture ends with one of " + " ".join(PICTURES))
    folder = os.path.dirname(picture) or "."
    if not os.path.isdir(folder):
        parser.error(f"{picture}: there is no folder {folder}; make it first")


def _is_negative_number(word):
    try:
        return word.startswith("-") and math.isfinite(float(word))
    except ValueError:
        return False


def _number(word):
    """A finite number."""
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not math.isfinite(value):
        raise argparse.ArgumentTypeError(f"'{word.strip()}' is not a finite number")
    return value


def _integer(word, low, high, what):
    """An integer from low to high."""
    if not word.strip().isdecimal() or not low <= int(word) <= high:
        raise argparse.ArgumentTypeError(f"'{word.strip()}' is not {what} from {low} to {high}")
    return int(word)


def _count(word):
    if word.strip() == "0":
        return 0
    return _integer(word, 2, 200, "0 or a number of arrows")


def _pixels(word):
    # Films in yuv420p have even sides.
    value = _integer(word, 64, 16384, "a number of pixels")
    if value % 2:
        raise argparse.ArgumentTypeError(f"'{word}' is odd; films need even sides")
    return value


def _zoom(word):
    value = _number(word)
    if not 0.01 <= value <= 100.0:
        raise argparse.ArgumentTypeError(f"'{word.strip()}' is not between 0.01 and 100")
    return value


def _slice(word):
    """(axis, position) of AXIS[:POSITION]; the position is None for the middle."""
    axis, colon, position = word.partition(":")
    if len(axis) != 1 or axis not in AXES:
        raise argparse.ArgumentTypeError(f"'{word}' does not begin with x, y or z; e.g. y or y:30")
    return AXES.index(axis), _number(position) if colon else None
