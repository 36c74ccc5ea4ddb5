#!/usr/bin/env python3
"""Checks that the components are a star, and the rooms of the driver an order: who may include, and link, whom.

fluid, membrane and coupler know neither each other nor exchange nor driver; exchange and ranks know none of the others;
driver knows all. Within driver/ each folder is a room, and a room knows only rooms below it, so that there is no circle.
Outside libraries are known only where they belong. A header or library that is in no list here is a violation too, so
that a new dependency is a decision and not an accident.

Usage: include_graph.py SOURCE_DIRECTORY. Exit code 1 and a line for each violation, else 0.
"""

import pathlib
import re
import sys

COMPONENTS = ("fluid", "membrane", "coupler", "exchange", "ranks", "driver")

# Which components a component may include and link, besides itself.
KNOWS = {"fluid": (), "membrane": (), "coupler": (), "exchange": (), "ranks": (), "driver": COMPONENTS}

# The rooms of driver/ from the ground up, each with the rooms it may know besides itself: only such as stand above it in
# this list. What lies in driver/ itself (main.cpp, program_main.cpp, command_line.cpp) may know all.
ROOMS = {
    "program": (),  # what all subcommands share: their list, errors, version, signals, output directory
    "case": ("program",),  # what a user says
    "units": ("program", "case"),  # numbers of a case to the lattice and back
    "packets": ("program", "case"),  # what crosses a border, in memory and in files
    "outside": ("program", "case", "units", "packets"),  # a user's program in the place of a component
    "system": ("program", "case", "units", "packets", "outside"),  # the components put together; phases; the step
    "study": ("program", "case"),  # one component or two against an exact answer
    "stages": ("program", "case", "units", "packets", "outside", "system", "study"),  # one component from files; replay
    "observe": ("program", "case", "units", "packets", "outside", "system"),  # what is read of a system at a time
    "engine": ("program", "case", "units", "packets", "outside", "system", "observe"),  # what makes the steps of a run
    "plan": ("program", "case", "units", "packets", "outside", "system", "observe"),  # what a case will be and cost
    "run": ("program", "case", "units", "packets", "outside", "system", "stages", "observe", "engine", "plan"),  # the run, its output
    "diff": ("program",),  # two outputs compared
    "absent": ("program", "case", "system", "stages", "engine"),  # in the place of commands whose component is not built
}

# Outside libraries by the form of their headers, and who may include them.
LIBRARIES = (
    ("Eigen", re.compile(r"Eigen/|unsupported/Eigen/"), ("membrane", "driver")),
    ("VTK", re.compile(r"vtk\w*\.h$"), ("exchange",)),
    ("toml++", re.compile(r"toml\+\+/"), ("driver",)),
    ("CLI11", re.compile(r"CLI/"), ("driver",)),
    ("fmt", re.compile(r"fmt/"), ("exchange", "driver")),
    ("xxHash", re.compile(r"xxhash\.h$"), ("exchange",)),
    ("OpenMP", re.compile(r"omp\.h$"), ("fluid", "membrane", "coupler", "driver")),
    ("MPI", re.compile(r"mpi\.h$"), ("ranks",)),
    ("memory pages", re.compile(r"sys/mman\.h$"), ("fluid",)),
    ("POSIX", re.compile(r"(unistd|fcntl|poll|spawn|sys/\w+)\.h$"), ("exchange", "driver")),
)
# The same libraries by the names of their CMake targets.
TARGETS = (
    ("Eigen", "Eigen3::"),
    ("VTK", "VTK::"),
    ("toml++", "tomlplusplus::"),
    ("CLI11", "CLI11::"),
    ("fmt", "fmt::"),
    ("OpenMP", "OpenMP::"),
    ("MPI", "MPI::"),
)
ALLOWED = {name: components for name, _, components in LIBRARIES}

INCLUDE = re.compile(r'^\s*#\s*include\s*(["<])([^">]+)[">]', re.MULTILINE)
STANDARD = re.compile(r"[a-z0-9_]+$")  # <vector>, <cmath>: no dot, no slash
TARGET = re.compile(r"\b(\w+::)(\w+)")


def include_violation(component, quote, header):
    """Why this include is not allowed in a file of the component; None if it is."""
    first = header.split("/")[0]
    if quote == '"' or first in COMPONENTS:
        if first == component or first in KNOWS[component]:
            return None
        if first in COMPONENTS:
            return f"{component} must not know {first}"
        return f'a file of this project is included by its path from the top, "{component}/...", not "{header}"'
    if STANDARD.match(header):
        return None
    for name, form, components in LIBRARIES:
        if form.match(header):
            return None if component in components else f"{component} must not know {name}"
    return "this library is in no list of tests/integration/include_graph.py: say there who may know it"


def room_of(path):
    """The room of a file or header below driver/, "" for what lies in driver/ itself. `path`: parts below driver/."""
    return path[0] if len(path) > 1 else ""


def room_violation(file, header):
    """Why a file of driver/ may not include this header of driver/; None if it may. Both as paths below the source directory."""
    room, other = (room_of(pathlib.PurePosixPath(path).parts[1:]) for path in (file, header))
    for name in (room, other):
        if name and name not in ROOMS:
            return f"driver/{name} is in no list of tests/integration/include_graph.py: say there whom it may know"
    if room in ("", other) or other in ROOMS[room]:
        return None
    return f"driver/{room} must not know {f'driver/{other}' if other else 'what lies in driver/ itself'}"


def order_violations(rooms=None):
    """One line for each room that may know itself, a room that there is not, or one that does not stand above it in the list."""
    rooms = ROOMS if rooms is None else rooms
    names = list(rooms)
    return [
        f"tests/integration/include_graph.py: driver/{name} may know driver/{known}, which must stand above it in the list"
        for place, name in enumerate(names)
        for known in rooms[name]
        if known not in names[:place]
    ]


def circle_violations(includes):
    """One line for each circle of files that include each other. `includes`: {file: files of the project it includes}."""
    found, done = [], set()

    def follow(file, way):
        if file in way:
            found.append("a circle of includes: " + " -> ".join([*way[way.index(file) :], file]))
        elif file not in done:
            for other in includes.get(file, ()):
                follow(other, [*way, file])
            done.add(file)

    for file in sorted(includes):
        follow(file, [])
    return found


def link_violation(component, namespace, target):
    """Why this CMake target is not allowed in the component's CMakeLists.txt; None if it is."""
    if namespace == "tanktread::":
        return None if target in (component, *KNOWS[component]) else f"{component} must not link {target}"
    for name, known in TARGETS:
        if namespace == known:
            return None if component in ALLOWED[name] else f"{component} must not link {name}"
    return "this library is in no list of tests/integration/include_graph.py: say there who may link it"


def violations(source):
    """One line for each violation below a source directory."""
    found, includes = order_violations(), {}
    for component in COMPONENTS:
        folder = source / component
        files = sorted(path for path in folder.rglob("*") if path.suffix in (".hpp", ".cpp", ".h", ".in"))
        if not files:
            found.append(f"{folder}: there are no sources; is {source} the project?")
        for path in files:
            text = path.read_text()
            includes[path.relative_to(source).as_posix()] = [header for _, header in INCLUDE.findall(text)]
            for match in INCLUDE.finditer(text):
                reason = include_violation(component, *match.groups())
                if not reason and component == "driver" and match[2].startswith("driver/"):
                    reason = room_violation(path.relative_to(source).as_posix(), match[2])
                if reason:
                    found.append(f"{path}:{text.count(chr(10), 0, match.start()) + 1}: {match.group(0).strip()}: {reason}")
        build = folder / "CMakeLists.txt"
        text = re.sub(r"#.*", "", build.read_text()) if build.is_file() else ""
        for match in TARGET.finditer(text):
            reason = link_violation(component, *match.groups())
            if reason:
                found.append(f"{build}: {match.group(0)}: {reason}")
    return found + circle_violations(includes)


def main():
    """Checks the source directory of the command line; the exit code."""
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    found = violations(pathlib.Path(sys.argv[1]))
    for line in found:
        print(line)
    print(f"include graph: {len(found)} violations" if found else "include graph: the components are a star, the rooms of the driver an order")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
