"""The run that is broken off: two capsules with viscous membranes, files and states every few steps."""

import dataclasses
import pathlib
import subprocess

STEPS_A_SHEAR_TIME = 500  # 1/g of walls at +-0.02, 20 apart


@dataclasses.dataclass(frozen=True)
class Every:
    """Steps from one output to the next."""

    observables: int = 2
    membrane: int = 4
    fluid: int = 5
    checkpoint: int = 6


# An interval of 5 steps and a moving average, so that most checkpoints fall within an interval.
CASE = """title = "Two viscous capsules"
[flow]
kind = "shear"
box = [32, 20, 20]
wall_speed = 0.02
start = "developed"
[[capsule]]
radius = 4.0
position = [9.0, 10.0, 11.0]
mesh = { level = 2 }
[[capsule]]
radius = 3.5
position = [23.0, 10.5, 9.5]
mesh = { level = 2 }
[membrane]
elastic_law = "skalak"
capillary_number = 0.3
[membrane.viscous]
scheme = "fd"
boussinesq_shear = 10.0
boussinesq_dilatational = 2.0
spring_stiffness = 50.0
interval = 5
strain_sampling = "moving-average"
[coupler]
kernel = "cosine4"
[run]
threads = 1
"""


def case_text(n_steps, every):
    """The case file of a run of so many steps."""

    def time(steps):
        return repr(steps / STEPS_A_SHEAR_TIME)

    return (
        f"{CASE}shear_time = {time(n_steps)}\ncheckpoint_every = {time(every.checkpoint)}\n"
        f"[output]\nobservables_every = {time(every.observables)}\nmembrane_every = {time(every.membrane)}\n"
        f"fluid_every = {time(every.fluid)}\nfluid_box = [[0, 31], [0, 19], [8, 11]]\n"
    )


@dataclasses.dataclass(frozen=True)
class Variant:
    """A way of running the case."""

    name: str
    options: tuple = ()  # of the first command
    resume_options: tuple = ()
    records: bool = False  # --record: its folder is a new one each time
    replaces: bool = False  # --force: an earlier run is in the way
    extends: bool = False  # --resume --shear-time: a run of half the steps is at its end


CORRECTION = ("--set", "coupler.kernel=stockie6")  # the default, which has the tangential correction
PLAIN = Variant("plain")
TABLE_ONLY = Variant("table only", ("--set", "output.membrane_every=0", "--set", "output.fluid_every=0"))
CORRECTED = Variant("corrected", CORRECTION)
THROUGH_FILES = Variant("--through-files", ("--through-files",), ("--through-files",))
RECORDED = Variant("--record", records=True)
EXTENDED = Variant("--shear-time", extends=True)
FORCED = Variant("--force", replaces=True)


@dataclasses.dataclass
class Ended:
    """How a command ended: its exit code, -9 where SIGKILL ended it, and what it said to the two streams."""

    code: int
    output: str
    error: str


class Program:
    """The program, and the commands that a user gives it."""

    def __init__(self, path, folder, n_steps, every=Every()):
        self.path, self.folder = pathlib.Path(path).resolve(), pathlib.Path(folder)
        self.n_steps, self.every = n_steps, every
        self.folder.mkdir(exist_ok=True)
        self.case = self.folder / "case.toml"
        self.case.write_text(case_text(n_steps, every))
        self.n_commands = 0

    def time(self, steps):
        """The option that says where a run ends."""
        return ["--shear-time", repr(steps / STEPS_A_SHEAR_TIME)]

    def run(self, variant, output, *more):
        """The arguments that start the case anew."""
        record = ("--record", self.folder / f"record_{self.n_commands}") if variant.records else ()
        return ["run", self.case, "--output", output, *variant.options, *record, *more]

    def resume(self, variant, output):
        """The arguments that go on with it."""
        return ["run", "--resume", output, *variant.resume_options, *(self.time(self.n_steps) if variant.extends else [])]

    def start(self, arguments):
        """A process at work; what it prints goes to files."""
        self.n_commands += 1
        log = self.folder / f"command_{self.n_commands}"
        with open(f"{log}.out", "wb") as output, open(f"{log}.err", "wb") as error:
            process = subprocess.Popen([self.path, *map(str, arguments)], stdout=output, stderr=error)
        process.logs = [pathlib.Path(f"{log}.out"), pathlib.Path(f"{log}.err")]
        return process

    def end(self, process):
        """Waits for the end of a process."""
        code = process.wait()
        ended = Ended(code, *(log.read_text(errors="replace").strip() for log in process.logs))
        for log in process.logs:
            log.unlink()
        return ended

    def do(self, arguments):
        """A command from its start to its end."""
        return self.end(self.start(arguments))
