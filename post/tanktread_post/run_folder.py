"""What a run folder says about its run: the case with every key resolved, what follows from it, whether it is finished, its speed."""

import pathlib
import re

from .observables import InputError, Observables
from .toml_tables import read_toml


def _laid_over(shared, own):
    """Two tables as one, key by key, where the second holds."""
    return shared | {key: _laid_over(shared.get(key, {}), value) if isinstance(value, dict) else value for key, value in own.items()}


class _Table(dict):
    """A table of a file: a key that is missing is named with the file."""

    def __init__(self, file, values):
        super().__init__({key: _of(file, value) for key, value in values.items()})
        self.file = file

    def __missing__(self, key):
        raise InputError(f"{self.file}: the key '{key}' is missing; it is not as tanktread writes it")


def _of(file, value):
    if isinstance(value, list):
        return [_of(file, one) for one in value]
    return _Table(file, value) if isinstance(value, dict) else value


def _read_toml(directory, name):
    """A file of the folder as a dictionary."""
    file = pathlib.Path(directory) / name
    if not file.is_file():
        raise InputError(f"{file}: there is no such file; is {directory} the output of a run?")
    return _Table(file, read_toml(file))


def read_echo(directory):
    """echo.toml: the case that made this folder, as a dictionary. Each capsule has its whole membrane."""
    echo = _read_toml(directory, "echo.toml")
    for capsule in echo.get("capsule", []):
        capsule["membrane"] = _Table(echo.file, _laid_over(echo.get("membrane", {}), capsule.get("membrane", {})))
    return echo


def read_parameters(directory):
    """parameters.toml: program, commit, and what follows from the case in lattice units, as a dictionary."""
    return _read_toml(directory, "parameters.toml")


def is_run(directory):
    """Whether a folder is the output of a run, finished or not."""
    return (pathlib.Path(directory) / "echo.toml").is_file()


def end_of(directory):
    """The shear time that the case asks for."""
    end = read_echo(directory)["run"]["shear_time"]
    if isinstance(end, (int, float)):
        return end
    raise InputError(f"{directory}/echo.toml: run.shear_time is {end!r}, must be a number; it is not as tanktread writes it")


def is_finished(directory):
    """Whether the run has reached the end that its case asks for."""
    try:
        return Observables(directory).reaches(end_of(directory))
    except InputError:
        return False


def finished_runs(output):
    """The folders of all finished runs below a folder, in the order of their names."""
    folder = pathlib.Path(output)
    return [path for path in sorted(folder.iterdir()) if path.is_dir() and is_finished(path)] if folder.is_dir() else []


def capillary_number_by_shear_modulus(membrane):
    """Ca_G = mu g a/G_s of a [capsule.membrane] table; E_s = 2 G_s in Skalak's law as the thesis writes it."""
    modulus = membrane["capillary_modulus"]
    if modulus == "gamma":
        raise InputError("an interfacial tension has no shear modulus, so no capillary number by it")
    return membrane["capillary_number"] * (2.0 if modulus == "E_s" else 1.0)


# The accounts of time in a run's log, by component.
COMPONENTS = {
    "fluid_percent": ("fluid", "forced nodes"),
    "coupler_percent": ("stencils", "interpolation", "spreading", "correction", "inside"),
    "membrane_percent": ("membranes", "implicit forces"),
}


def read_cost(log):
    """Speed, and how the components share the time of the steps, from the log of a run: {} where the log has no closing lines (yet)."""
    if log is None or not pathlib.Path(log).is_file():
        return {}
    text = pathlib.Path(log).read_text(errors="replace")
    cost = {}
    closing = re.findall(r"ended at step \d+ with ([\d.]+) MLUPS", text)
    table = text[text.rfind("\ntime of ") :] if "\ntime of " in text else ""
    seconds = {name: float(number) for name, number in re.findall(r"^  ([a-z ]+?) +([\d.]+) +[\d.]+$", table, re.MULTILINE)}
    if closing:
        cost["mlups"] = float(closing[-1])
    shares = {component: sum(seconds.get(name, 0.0) for name in names) for component, names in COMPONENTS.items()}
    if sum(shares.values()) > 0:
        cost |= {component: round(100.0 * share / sum(shares.values()), 1) for component, share in shares.items()}
    return cost


def breakdown(log):
    """What the log of a run says of the breakdown with which it ended last; None if it did not break down."""
    if not pathlib.Path(log).is_file():
        return None
    text = pathlib.Path(log).read_text(errors="replace")
    start = text.rfind("tanktread: error: ")
    if start < 0 or start < text.rfind("ended at step"):
        return None
    # What goes wrong with a file (a full disk) has no step before it.
    message = text[start:].splitlines()[0].removeprefix("tanktread: error: ")
    return message if re.match(r"step \d+: ", message) else None
