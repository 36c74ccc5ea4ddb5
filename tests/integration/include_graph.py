#!/usr/bin/env python3
"""Checks that the components are a star: who may include, and link, whom.

fluid, membrane and coupler know neither each other nor exchange nor driver; exchange knows none of the others; driver
knows all. Outside libraries are known only where they belong. A header or library that is in no list here is a
violation too, so that a new dependency is a decision and not an accident.

Usage: include_graph.py SOURCE_DIRECTORY. Exit code 1 and a line for each violation, else 0.
"""

import pathlib
import re
import sys

COMPONENTS = ("fluid", "membrane", "coupler", "exchange", "driver")

# Which components a component may include and link, besides itself.
KNOWS = {"fluid": (), "membrane": (), "coupler": (), "exchange": (), "driver": COMPONENTS}

# Outside libraries by the form of their headers, and who may include them.
LIBRARIES = (
    ("Eigen", re.compile(r"Eigen/|unsupported/Eigen/"), ("membrane", "driver")),
    ("VTK", re.compile(r"vtk\w*\.h$"), ("exchange",)),
    ("toml++", re.compile(r"toml\+\+/"), ("driver",)),
    ("CLI11", re.compile(r"CLI/"), ("driver",)),
    ("fmt", re.compile(r"fmt/"), ("exchange", "driver")),
    ("xxHash", re.compile(r"xxhash\.h$"), ("exchange",)),
    ("OpenMP", re.compile(r"omp\.h$"), ("fluid", "membrane", "coupler", "driver")),
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
    found = []
    for component in COMPONENTS:
        folder = source / component
        files = sorted(path for path in folder.rglob("*") if path.suffix in (".hpp", ".cpp", ".h", ".in"))
        if not files:
            found.append(f"{folder}: there are no sources; is {source} the project?")
        for path in files:
            text = path.read_text()
            for match in INCLUDE.finditer(text):
                reason = include_violation(component, *match.groups())
                if reason:
                    found.append(f"{path}:{text.count(chr(10), 0, match.start()) + 1}: {match.group(0).strip()}: {reason}")
        build = folder / "CMakeLists.txt"
        text = re.sub(r"#.*", "", build.read_text()) if build.is_file() else ""
        for match in TARGET.finditer(text):
            reason = link_violation(component, *match.groups())
            if reason:
                found.append(f"{build}: {match.group(0)}: {reason}")
    return found


def main():
    """Checks the source directory of the command line; the exit code."""
    if len(sys.argv) != 2:
        print(__doc__, file=sys.stderr)
        return 2
    found = violations(pathlib.Path(sys.argv[1]))
    for line in found:
        print(line)
    print(f"include graph: {len(found)} violations" if found else "include graph: the components are a star")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
