"""What is drawn of an output directory: array, component, title, range, axes, times. Knows nothing of ParaView."""

import difflib
import math
import os
import shlex
from collections import namedtuple

from tanktread_post.observables import InputError
from tanktread_post.series import read_files, read_series

AXES = "xyz"
MAGNITUDE = -1
COMPONENTS = {2: ("first", "second"), 3: tuple(AXES), 9: tuple(a + b for a in AXES for b in AXES)}
LATTICE_UNITS = ("velocity", "elastic_force", "total_force", "stress", "viscous_stress")

# association: "POINTS" or "CELLS"; n_components: 1, 2, 3, 9 ...
Array = namedtuple("Array", "association name n_components")
# component: from 0, or MAGNITUDE
Field = namedtuple("Field", "array component")


def component_names(array):
    """Names of the components of an array; [] if it has one."""
    if array.n_components == 1:
        return []
    return list(COMPONENTS.get(array.n_components, [str(k) for k in range(array.n_components)]))


def choose_array(arrays, name, owner="the membrane"):
    """The array of that name. Throws InputError with those there are."""
    for array in arrays:
        if array.name == name:
            return array
    names = sorted({array.name for array in arrays})
    near = difflib.get_close_matches(name, names, 1)
    hint = f"; did you mean {near[0]}?" if near else ""
    raise InputError(f"'{name}': {owner} has no such array; it has {', '.join(names)}{hint}")


def choose_field(array, component=None):
    """The array and one component of it: a number, a name, "magnitude", or None for the magnitude."""
    names = component_names(array)
    if not names:
        if component not in (None, "0"):
            raise InputError(f"--component {component}: {array.name} has one component; leave the option out")
        return Field(array, 0)
    if component is None or component.lower() == "magnitude":
        return Field(array, MAGNITUDE)
    # A number counts from 0, whatever the names are.
    numbers = [str(k) for k in range(array.n_components)]
    for known in (numbers, names):
        if component.lower() in known:
            return Field(array, known.index(component.lower()))
    known = ", ".join(number if number == said else f"{number} ({said})" for number, said in zip(numbers, names))
    raise InputError(f"--component {component}: {array.name} has the components {known}, and magnitude")


def title(field):
    """What the colour bar says, in short lines: name, component, unit."""
    words = field.array.name.replace("_", " ")
    if field.array.n_components > 1:
        component = "magnitude" if field.component == MAGNITUDE else component_names(field.array)[field.component]
        words += (" " if len(component) <= 2 else "\n") + component
    return words + ("\n(lattice units)" if field.array.name in LATTICE_UNITS else "")


def colour_range(low, high):
    """The range of the colours for values from low to high: about 0 where they go both ways, never empty."""
    greatest = max(abs(low), abs(high))
    # A sign that only rounding makes does not take half of the colours.
    if low < 0.0 < high and min(-low, high) > 0.1 * greatest:
        return -greatest, greatest
    if high - low <= 1e-12 * greatest:
        return low, low + (greatest or 1.0)
    return low, high


def goes_both_ways(limits):
    """Whether a range lies about 0, so that its middle colour means 0."""
    return math.isclose(limits[0], -limits[1], rel_tol=1e-9)


def labels(limits, n=5):
    """n values at equal distances, the limits with them."""
    return [limits[0] + k * (limits[1] - limits[0]) / (n - 1) for k in range(n)]


def open_times(folder, name):
    """Shear times of the files of a series NAME.pvd; [] if the run wrote none. Throws InputError if a file is missing."""
    file = os.path.join(folder, name + ".pvd")
    if not os.path.isfile(file):
        raise InputError(f"{file}: there is no such file; is {folder} the output of a run?")
    files = read_files(file)
    for _, written in files:
        if not written.is_file():
            raise InputError(f"{written}: {name}.pvd names this file, and it is not there")
    return [time for time, _ in files]


def open_entries(folder, name):
    """[(shear time, own shear time of the file named then) ...] of a series NAME.pvd, which may name a file again."""
    file = os.path.join(folder, name + ".pvd")
    own = {written: time for time, written in read_files(file)}
    return [(time, own[written]) for time, written in read_series(file)]


def nearest(times, shear_time):
    """The time nearest to a shear time; the last for None."""
    return times[-1] if shear_time is None else min(times, key=lambda time: abs(time - shear_time))


def time_shown(entries, time):
    """The own time of the file that ParaView 5.11 shows at a moment, of entries as open_entries: between two it takes the later one."""
    return next((own for entry, own in entries if entry >= time), entries[-1][1])


def flow_lag(times, entries):
    """By how much the flow drawn is (older, younger) than the membrane, at most."""
    older = [time - time_shown(entries, time) for time in times]
    return max(0.0, *older), max(0.0, *(-lag for lag in older))


def axes_of_run(folder):
    """(flow axis, vorticity axis, wall axis) as 0, 1, 2, from echo.toml; x, y, z where that cannot be read."""
    try:
        # Needs tomllib, which the Python of ParaView has from 3.11 on.
        from tanktread_post.run_folder import read_echo

        flow = read_echo(folder)["flow"]
        flow_axis, wall_axis = (AXES.index(flow[key]) for key in ("flow_axis", "wall_axis"))
    except (ImportError, InputError, KeyError, ValueError):
        flow_axis, wall_axis = 0, 2
    return flow_axis, 3 - flow_axis - wall_axis, wall_axis


def place_slices(slices, bounds, vorticity_axis):
    """[(axis, position) ...] of slices through the fluid's bounds (None: no fluid), the middle where no position was given.

    Throws InputError for a plane outside. Fluid files may hold one sheet of nodes, which then is the slice, or a line, which is not drawn.
    """
    flat = [axis for axis in range(3) if bounds[2 * axis] == bounds[2 * axis + 1]] if bounds else []
    if not bounds or len(flat) > 1:
        if slices:
            raise InputError("--slice: there are no fluid files, or they hold a line of nodes only (output.fluid_every, output.fluid_box)")
        return []
    return [_place(axis, position, bounds, flat) for axis, position in slices or [(flat[0] if flat else vorticity_axis, None)]]


def _place(axis, position, bounds, flat):
    """One of place_slices."""
    name, low, high = AXES[axis], bounds[2 * axis], bounds[2 * axis + 1]
    if flat and axis not in flat:
        sheet = AXES[flat[0]]
        raise InputError(f"--slice {name}: the fluid files hold one sheet of nodes across {sheet} (output.fluid_box); use --slice {sheet}")
    if position is not None and not low <= position <= high:
        raise InputError(f"--slice {name}:{position:g}: the fluid nodes reach from {low:g} to {high:g} along {name}")
    return axis, 0.5 * (low + high) if position is None else position


def slice_opacity(places, membrane_box):
    """1 for one slice that cuts the membrane; less where a slice might hide the membrane or another slice."""
    cut = [membrane_box[2 * axis] <= position <= membrane_box[2 * axis + 1] for axis, position in places if membrane_box]
    return 1.0 if len(places) == 1 and all(cut) else 0.7


def listing(folder, series):
    """The text of --list. `series`: [(name, arrays, times) ...]."""
    lines = []
    for name, arrays, times in series:
        if not times:
            lines.append(f"{name}: no files (output.{name}_every is 0?)")
            continue
        lines.append(f"{name}: {len(times)} times: " + " ".join(f"{time:.4g}" for time in times))
        where = {"POINTS": "nodes" if name == "membrane" else "grid", "CELLS": "triangles"}
        for array in arrays:
            names = component_names(array)
            lines.append(f"  {array.name:20} {where[array.association]:10} {' '.join(names)}".rstrip())
    lines.append(f"e.g. pvbatch post/paraview/open_output.py {shlex.quote(folder)} picture.png --color stress --component xx")
    return "\n".join(lines)
