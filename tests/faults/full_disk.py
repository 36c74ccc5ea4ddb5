"""A disk that fills up at chosen points of a run: a small tmpfs, and a file beside the run that leaves it so much room."""

import dataclasses
import os
import re
import shutil
import subprocess

import moments
import run_folder
import two_capsules

PAGE = 4096
REASON = "No space left on device"
SIZE = 128  # MiB, several times what the run needs

# More files between two checkpoints than a checkpoint is large: else it is always a checkpoint that finds no room.
EVERY = two_capsules.Every(observables=1, membrane=1, fluid=1, checkpoint=24)
N_STEPS = 96
# In the order in which a step writes them.
ORDER = ["membrane file", "membrane.pvd", "fluid file", "fluid.pvd", "observables.csv", "fluid of a checkpoint", "membrane of a checkpoint"]
KINDS = {
    "membrane file": r"membrane/\.?membrane_",
    "fluid file": r"fluid/\.?fluid_",
    "fluid of a checkpoint": r"checkpoints/[^/]*/fluid\.vti",
    "membrane of a checkpoint": r"checkpoints/[^/]*/membrane\.vtu",
}


class Disk:
    """A tmpfs, mounted while this lives. @throws OSError where that is not allowed"""

    def __init__(self, place):
        self.place = place
        place.mkdir()
        done = subprocess.run(
            ["mount", "-t", "tmpfs", "-o", f"size={SIZE}m,huge=never", "tmpfs", place], capture_output=True, text=True
        )  # fmt: skip
        if done.returncode != 0:
            place.rmdir()
            raise OSError(done.stderr.strip() or "mount failed")

    def __enter__(self):
        return self

    def __exit__(self, *_):
        subprocess.run(["umount", self.place], check=True)
        self.place.rmdir()

    def make_room(self):
        """Takes the file away that fills it."""
        (self.place / "filler").unlink(missing_ok=True)

    def leave(self, pages):
        """Fills it up to so many pages."""
        self.make_room()
        state = os.statvfs(self.place)
        with open(self.place / "filler", "wb") as stream:
            os.posix_fallocate(stream.fileno(), 0, (state.f_bavail - pages) * PAGE)


@dataclasses.dataclass
class Stop:
    """Where a run on a full disk stopped."""

    pages: int
    code: int
    error: str
    file: str  # relative to the run's folder, as the message names it
    position: tuple  # (step, place in ORDER), to compare with others

    @property
    def kind(self):
        for kind, pattern in KINDS.items():
            if re.match(pattern, self.file):
                return kind
        return self.file


@dataclasses.dataclass
class Point:
    """A point at which the disk filled up, and how it went on."""

    wanted: str
    stop: Stop = None
    faults: list = dataclasses.field(default_factory=list)


class FullDisk:
    """Runs on a disk that fills up, against the whole run."""

    def __init__(self, program, disk, variant, whole):
        self.program, self.disk, self.variant, self.whole = program, disk, variant, whole
        self.output = disk.place / "run"
        self.stops = []

    def try_with(self, pages, arguments=None):
        """A new run (or another command) with so many pages of room."""
        if arguments is None:
            self.disk.make_room()
            shutil.rmtree(self.output, ignore_errors=True)
            arguments = self.program.run(self.variant, self.output)
        self.disk.leave(pages)
        ended = self.program.do(arguments)
        stop = Stop(pages, ended.code, ended.error, "", ())
        named = re.search(re.escape(str(self.disk.place)) + r"/(\S+?):? ", ended.error)
        stop.file = named.group(1).removeprefix("run/") if named else ""
        stop.position = self._position(stop)
        self.stops.append(stop)
        return stop

    def _position(self, stop):
        if stop.code == 0:
            return (self.program.n_steps + 1, 0)
        if stop.kind not in ORDER:
            return (-1, 0)
        digits = re.search(r"_(\d{10})", stop.file)
        written = run_folder.steps_in(self.output, "membrane/membrane_*.vtu") + run_folder.steps_in(self.output, "fluid/fluid_*.vti")
        step = int(digits.group(1)) if digits else max(written + [run_folder.last_row(self.output)], default=0)
        return (step, ORDER.index(stop.kind))

    def find(self, kind, step):
        """A stop in a file of that kind, looked for about that step by halving; None if there is none."""
        known = [stop for stop in self.stops if stop.kind == kind and stop.position[0] >= step > 0]
        if known:
            return self.try_with(known[0].pages)
        wanted = (step, ORDER.index(kind))
        low = max([stop.pages for stop in self.stops if stop.position < wanted], default=-1) + 1
        high = min([stop.pages for stop in self.stops if stop.position > wanted], default=SIZE * 2**20 // PAGE // 2) - 1
        while low <= high:
            middle = (low + high) // 2
            stop = self.try_with(middle)
            if stop.code != 0 and stop.kind == kind:
                return stop
            low, high = (middle + 1, high) if stop.position < wanted else (low, middle - 1)
        return None

    def kill_and_go_on_with(self, pages, *more):
        """A run that is killed half-way, soon after a checkpoint, and goes on with so many pages of room and further options."""
        self.disk.make_room()
        shutil.rmtree(self.output)
        process = self.program.start(self.program.run(self.variant, self.output))
        moments.AfterStep(self.program.n_steps // 2 + 3).wait(process, self.output)
        process.kill()
        self.program.end(process)
        return self.try_with(pages, [*self.program.resume(self.variant, self.output), *more])

    def faults_of(self, stop):
        """What is wrong with the way in which it stopped, and with what is there now."""
        faults = []
        begun = any(self.output.glob("checkpoints/step_*"))
        if stop.code not in ((3,) if begun else (2, 3)):
            faults.append(f"exit code {stop.code}")
        if REASON not in stop.error or re.search(r"vtk[A-Z]|0x[0-9a-f]", stop.error):
            faults.append("the message does not name the reason, or in words of a lower layer")
        faults += run_folder.faults_a_reader_meets(self.output, self.whole)
        for file in (*sorted(self.output.glob("checkpoints/step_*/*")), *self.output.glob("*.pvd"), *self.output.glob("*.csv")):
            read = self.program.do(["diff", file, file])
            if read.code != 0:
                faults.append(f"cannot be read: {read.error}")
        return faults + ([stop.error] if faults else [])

    def go_on(self, still_full):
        """Goes on when there is room, after a try without. Faults."""
        faults = []
        resume = any(self.output.glob("checkpoints/step_*"))
        arguments = self.program.resume(self.variant, self.output)
        if not resume:
            force = ["--force"] if (self.output / "echo.toml").exists() else []
            arguments = self.program.run(self.variant, self.output, *force)
        if still_full:
            again = self.program.do(arguments)
            stop = Stop(0, again.code, again.error, "", ())
            faults += [f"once more without room: {fault}" for fault in self.faults_of(stop)]
        self.disk.make_room()
        ended = self.program.do(arguments)
        if ended.code != 0:
            faults.append(f"when there is room: exit code {ended.code}: {ended.error}")
        return faults + run_folder.differences(self.whole, run_folder.contents(self.output))


def grows_over_a_page(content, lines_a_step, every_checkpoint):
    """The step at which a file that grows by some lines each step needs another page.

    A checkpoint needs room for a third one, which is given back: a smaller file meets the end of the room only late between two
    checkpoints, and so the latest such step is taken.
    """
    lines = content.decode().splitlines(keepends=True)
    rows = [k for k, line in enumerate(lines) if re.match(r"\d|\s*<DataSet", line)]
    end, steps = sum(map(len, lines[: rows[0]] + lines[rows[-1] + 1 :])), {}
    for number, k in enumerate(rows):
        if end // PAGE != (end + len(lines[k])) // PAGE:
            step = number // lines_a_step
            steps[(step - 1) % every_checkpoint] = step
        end += len(lines[k])
    return steps[max(steps)]


def points_of(program, whole):
    """(kind, step) of the points that are looked for; step 0: about the start."""
    every = program.every.checkpoint
    return [
        ("fluid of a checkpoint", 0),
        ("membrane file", every - 1),
        ("fluid file", 2 * every - 2),
        ("membrane.pvd", grows_over_a_page(whole["membrane.pvd"], 1, every)),
        ("fluid.pvd", grows_over_a_page(whole["fluid.pvd"], 1, every)),
        ("fluid of a checkpoint", 2 * every),
        ("membrane of a checkpoint", 3 * every),
    ]


class Points:
    """The points so far."""

    def __init__(self, report):
        self.points, self.report = [], report

    def add(self, wanted, full, stop):
        """One more: how it stopped, how it goes on."""
        point = Point(wanted, stop)
        if stop is None:
            point.faults.append("was not met")
        else:
            point.faults += full.faults_of(stop) + full.go_on(still_full=len(self.points) % 2 == 0)
        self.points.append(point)
        self.report(f"{len(self.points)} points of a full disk, {sum(not point.faults for point in self.points)} as they should be")


def run(campaign, disk, report):
    """Fills the disk at each point. @return the points, and how many runs found them"""
    program, points = campaign.program, Points(report)
    whole = campaign.whole(two_capsules.PLAIN)
    full = FullDisk(program, disk, two_capsules.PLAIN, whole)
    for pages, wanted in ((0, "echo.toml"), (2, "parameters.toml")):
        points.add(wanted, full, full.try_with(pages))
    for kind, step in points_of(program, whole):
        points.add(f"{kind}, step {step}", full, full.find(kind, step))
    for pages in (0, 1, 3):
        points.add(f"as a killed run goes on, {pages} pages", full, full.kill_and_go_on_with(pages))
    recorded = full.kill_and_go_on_with(300, "--record", disk.place / "record")
    points.add("a record, as a killed run goes on", full, recorded)
    # Where series are written, the room that they need for a moment is more than the next rows take.
    whole = campaign.whole(two_capsules.TABLE_ONLY)
    table = FullDisk(program, disk, two_capsules.TABLE_ONLY, whole)
    step = grows_over_a_page(whole["observables.csv"], 2, program.every.checkpoint)
    points.add(f"observables.csv, step {step}", table, table.find("observables.csv", step))
    return points.points, len(full.stops) + len(table.stops)
