"""Moments of a run at which it can be killed. Each waits for itself and says in a word what it met."""

import os
import re
import time

import run_folder

PAUSE = 1e-4  # seconds between two looks: a write with its fsync takes longer

WRITES = {
    "fluid of a checkpoint": r"checkpoints/\.step_\d+\.tmp/\.fluid",
    "membrane of a checkpoint": r"checkpoints/\.step_\d+\.tmp/\.membrane",
    "membrane file": r"membrane/\.membrane_",
    "fluid file": r"fluid/\.fluid_",
    "series": r"\.(membrane|fluid)\.pvd",
    "table": r"\.observables\.csv",
    "echo": r"\.echo\.toml",
    "parameters": r"\.parameters\.toml",
    "packet": r"packets/\.",
}


def _watch(process, look):
    """Looks until there is something to see or the process is at its end; what was seen."""
    while process.poll() is None:
        seen = look()
        if seen:
            return seen
        time.sleep(PAUSE)
    return None


def _names(folder):
    try:
        return os.listdir(folder)
    except (FileNotFoundError, NotADirectoryError):
        return []


def half_written(folder):
    """The temporary files of a run, by relative path."""
    places = ["", "membrane/", "fluid/", "packets/", "checkpoints/"]
    places += [f"checkpoints/{name}/" for name in _names(folder / "checkpoints") if name.endswith(".tmp")]
    return {
        place + name for place in places for name in _names(folder / place) if name.startswith(".") and name.endswith(".tmp")
    }


class Instant:
    """Some seconds after the start."""

    def __init__(self, seconds, what="any moment"):
        self.seconds, self.what = seconds, what

    def wait(self, process, _):
        end = time.monotonic() + self.seconds
        return _watch(process, lambda: time.monotonic() >= end and self.what)


class InWrite:
    """In the n-th write of a kind, once the temporary file is seen."""

    def __init__(self, what, number=1):
        self.what, self.number = what, number

    def wait(self, process, output):
        met = half_written(output)  # what an earlier process left
        left = [self.number]

        def look():
            for name in half_written(output) - met:
                met.add(name)
                left[0] -= bool(re.match(WRITES[self.what], name))
            return left[0] <= 0 and f"in a write: {self.what}"

        return _watch(process, look)


class AfterStep:
    """Some seconds after the table has come to a step."""

    def __init__(self, step, seconds=0.0):
        self.step, self.seconds = step, seconds

    def wait(self, process, output):
        reached = _watch(process, lambda: run_folder.last_row(output) >= self.step)
        return reached and Instant(self.seconds).wait(process, output)


class BeforeOldestGoes:
    """Between the renaming of a checkpoint and the end of the removal of the oldest, at or after a step."""

    def __init__(self, step):
        self.name = f"step_{step:010d}"

    def wait(self, process, output):
        def look():
            names = [name for name in _names(output / "checkpoints") if name.startswith("step_")]
            return len(names) > 2 and max(names) >= self.name and "as the oldest checkpoint goes"

        return _watch(process, look)


class AsEarlierRunGoes:
    """While --force removes an earlier run: once a file of it is gone."""

    def __init__(self, file):
        self.file = file

    def wait(self, process, output):
        return _watch(process, lambda: not (output / self.file).exists() and "as the earlier run goes")
