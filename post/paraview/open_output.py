"""Opens the output of a run in ParaView: the membrane coloured by a field, the velocity in slices through the flow.

In the window, where options come from the environment:
    TANKTREAD_OUTPUT=output/shear-capsule paraview --script=post/paraview/open_output.py
    TANKTREAD_OPTIONS="--color stress --component xx" TANKTREAD_OUTPUT=... paraview --script=...
Without a window (without a display: xvfb-run -a -s "-noreset -screen 0 1280x1024x24" pvbatch ...):
    pvbatch post/paraview/open_output.py output/shear-capsule --list
    pvbatch post/paraview/open_output.py output/shear-capsule picture.png --color viscous_stress --component xx
    pvbatch post/paraview/open_output.py output/shear-capsule --frames frames

Exit codes: 0, 2 (bad input: nothing was written), 3 (a picture could not be saved).
"""

import os
import sys


def own_folder():
    """Where this script is: the window of ParaView 5.11 does not tell it, but was started with its name."""
    if "__file__" in globals():
        return os.path.dirname(os.path.abspath(__file__))
    try:
        with open("/proc/self/cmdline") as stream:
            words = stream.read().replace("\0--script=", "\0--script\0").split("\0")
        return os.path.dirname(os.path.abspath(words[words.index("--script") + 1]))
    except (OSError, ValueError):
        return os.path.abspath("post/paraview")


# Of the script itself only; the files beside it, and post/tanktread_post.
sys.path[:0] = [own_folder(), os.path.dirname(own_folder())]

import output_camera as camera  # noqa: E402
import output_fields as fields  # noqa: E402
import output_options  # noqa: E402
import output_scene as scene  # noqa: E402
from paraview import simple  # noqa: E402
from tanktread_post.observables import InputError  # noqa: E402


def open_all(folder):
    """{name: (source or None, its times)} of membrane and fluid."""
    times = {name: fields.open_times(folder, name) for name in ("membrane", "fluid")}
    if not any(times.values()):
        raise InputError(f"{folder}: membrane.pvd and fluid.pvd name no files; there is nothing to show")
    return {name: (scene.open_series(os.path.join(folder, name + ".pvd"), name) if times[name] else None, times[name]) for name in times}


def print_list(folder, series):
    """--list."""
    print(fields.listing(folder, [(name, scene.arrays_of(source) if source else [], times) for name, (source, times) in series.items()]))


def found_limits(option, field, values):
    """Limits of the colours for values (from, to), printed so that another picture can be given the same."""
    name = " ".join(fields.title(field).splitlines())
    limits = fields.colour_range(*values)
    if values[0] == values[1]:
        print(f"note: {name} is {values[0]:g} everywhere and at all times")
    print(f"{name}: colours from {limits[0]:.6g} to {limits[1]:.6g}; {option} {limits[0]:.6g} {limits[1]:.6g} gives another run the same")
    return limits


def show_membrane(source, times, field, view, options):
    """The membrane of `options`."""
    limits = options.range or found_limits("--range", field, scene.over_time([source], times, field.array, [field.component])[0])
    scene.show_membrane(source, view, field, limits, not options.no_edges)


def show_flow(source, times, places, opacity, flow_axis, view, options):
    """The slices and arrows of `options`, at places [(axis, position) ...]."""
    velocity = fields.choose_array(scene.arrays_of(source), "velocity", "the flow")
    field = fields.choose_field(velocity, options.velocity or fields.AXES[flow_axis])
    planes = [scene.slice_of(source, axis, position) for axis, position in places]
    values, speeds = scene.over_time(planes, times, velocity, [field.component, fields.MAGNITUDE])
    limits = options.velocity_range or found_limits("--velocity-range", field, values)
    for plane, (axis, position) in zip(planes, places):
        scene.show_slice(plane, view, field, limits, opacity)
        if options.arrows:
            scene.show_arrows(source, view, axis, position, options.arrows, speeds[1] or 1.0)


def build(options, series, in_window):
    """The whole scene. Returns the view and the times to show. Throws InputError before it draws."""
    (membrane, membrane_times), (fluid, fluid_times) = series["membrane"], series["fluid"]
    axes = fields.axes_of_run(options.output)
    bounds = fluid.GetDataInformation().GetBounds() if fluid and not options.no_slice else None
    places = fields.place_slices(options.slices, bounds, axes[1])
    if not membrane and not places:
        raise InputError(f"{options.output}: there is no membrane file, and with --no-slice nothing is left to draw")
    if membrane:
        field = fields.choose_field(fields.choose_array(scene.arrays_of(membrane), options.color), options.component)
    times = membrane_times or fluid_times
    shown = times if options.frames else [fields.nearest(times, options.shear_time)]

    view = simple.GetActiveViewOrCreate("RenderView")
    # Fonts grow with the picture, from their sizes at this width. A window keeps its own.
    scene.prepare(view, None if in_window else [1200, round(1200 * options.size[1] / options.size[0])])
    membrane_box = scene.bounds_over_time(membrane, shown) if membrane else None
    if places:
        show_flow(fluid, fluid_times, places, fields.slice_opacity(places, membrane_box), axes[0], view, options)
    if membrane:
        show_membrane(membrane, membrane_times, field, view, options)
    scene.show_time(view)
    boxes = [camera.flat_box(bounds, *place) for place in places] + ([membrane_box] if membrane else [])
    normal = places[0][0] if places else axes[1]
    scene.look(view, boxes, *camera.view_axes(normal, axes), len(places), options.zoom)
    simple.SetActiveSource(membrane or fluid)
    if places:
        say_lag(*fields.flow_lag(shown, fields.open_entries(options.output, "fluid")))
    return view, shown


def say_lag(older, younger):
    """Says that the flow drawn is of another time than the membrane, where one would see it."""
    if older > 0.01:
        print(
            f"note: the flow drawn is up to {older:.2g} shear times older than the membrane: it is the last one that was written before; "
            "with output.fluid_every = output.membrane_every both are of the same step"
        )
    if younger > 0.01:
        print(
            f"note: the flow drawn is up to {younger:.2g} shear times younger than the membrane: fluid.pvd has no entry at its times, as "
            "older runs wrote it, and ParaView shows the next one; choose a --shear-time at which both have files (--list)"
        )


def show_time(view, time):
    """Sets the scene to a time."""
    animation = simple.GetAnimationScene()
    animation.UpdateAnimationUsingDataTimeSteps()
    animation.AnimationTime = time
    simple.Render(view)


def save(view, file, size):
    """Saves what the view shows. Throws OSError if that fails."""
    # ParaView 5.11 reports success even where nothing could be written.
    before = os.stat(file).st_mtime_ns if os.path.isfile(file) else None
    simple.SaveScreenshot(file, view, ImageResolution=size)
    if not os.path.isfile(file) or os.stat(file).st_mtime_ns == before:
        raise OSError(f"{file}: could not be saved; may the folder be written to, and is there room?")


def save_all(options, view, times):
    """The picture and the frames of `options`."""
    if options.picture:
        show_time(view, fields.nearest(times, options.shear_time))
        save(view, options.picture, options.size)
        print(options.picture)
    if options.frames:
        os.makedirs(options.frames, exist_ok=True)
        for k, time in enumerate(times):
            show_time(view, time)
            save(view, os.path.join(options.frames, f"frame_{k:04d}.png"), options.size)
        print(f"{options.frames}: frame_0000.png to frame_{len(times) - 1:04d}.png; a film of them:")
        print(output_options.film_command(options.frames, len(times)))


def main(words, in_window):
    """Does what the words of the command line ask for; the exit code."""
    options = output_options.parse(output_options.build_parser(__doc__), words, in_window)
    try:
        series = open_all(options.output)
        if options.list:
            print_list(options.output, series)
            return 0
        view, times = build(options, series, in_window)
        show_time(view, times[-1])
        if not in_window or options.picture or options.frames:
            save_all(options, view, times)
    except InputError as error:
        print(f"open_output.py: error: {error}", file=sys.stderr)
        return 2
    except OSError as error:
        print(f"open_output.py: error: {error}", file=sys.stderr)
        return 3
    return 0


def main_in_window():
    """Like main, with the words of the environment; an error is shown and leaves the window open."""
    words = output_options.words_from_environment(os.environ)
    if not words:
        print("open_output.py: TANKTREAD_OUTPUT is not set: start ParaView with it, as told here.\n" + __doc__, file=sys.stderr)
        return
    try:
        main(words, True)
    except SystemExit:
        pass


# The window runs a script without arguments, that of 5.11 without a name.
if not sys.argv[0] or (len(sys.argv) < 2 and os.environ.get("TANKTREAD_OUTPUT")):
    main_in_window()
else:
    code = main(sys.argv[1:], False)
    if code:
        # sys.exit after something was drawn lets the display fail, and the exit code with it. Code 0 comes by the end of the script.
        sys.stdout.flush()
        sys.stderr.flush()
        os._exit(code)
