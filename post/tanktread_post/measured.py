"""Measured results of a case: cases/NAME/measured/results.csv, to which runs are added with command, date, and
the commit of the program that made them; and means.csv, of what a run does in the long run.

Each run is one block: a comment line that says how it was made, then its rows. Measuring a run again replaces
its block.
"""

import datetime
import pathlib
import shutil
import subprocess

from . import going_on
from .observables import InputError, Observables
from .reference import ANALYSE
from .run_folder import is_finished, is_run, read_cost, read_echo, read_parameters
from .toml_tables import require_name_of

QUANTITIES = ("deformation", "inclination_deg", "length", "width", "breadth", "volume_ratio", "area_ratio")
PARAMETERS = ("elastic_law", "capillary_number", "capillary_modulus", "kernel", "radius", "box", "mesh", "shear_rate_by")
COST = ("mlups", "fluid_percent", "coupler_percent", "membrane_percent")
VISCOUS = ("scheme", "boussinesq_shear", "boussinesq_dilatational", "spring", "interval", "strain_sampling")
SWITCHES = ("tangential_correction", "inertia", "keep_volume", "viscosity_ratio", "shear_dipole")  # true, or nothing; inertia: false, or nothing; a number, or nothing where it is 1; of another, true or nothing
COLUMNS = ("run", *PARAMETERS, "shear_time", *QUANTITIES, *COST, *VISCOUS, *SWITCHES)
OWN = ("results.csv", "means.csv")  # what is written here for any case
MEANS = ("run", "from", "to", *QUANTITIES, "highest_deformation", "highest_at")  # means, but for the last two: over the whole run


def parameters(echo):
    """The parameters of a run that tell it from the others of its case, as text."""
    flow, capsule = echo["flow"], echo["capsule"][0]
    membrane, mesh = capsule["membrane"], capsule["mesh"]
    rate = next((key for key in ("reynolds_number", "wall_speed", "shear_rate") if key in flow), "")
    return {
        "elastic_law": membrane["elastic_law"],
        "capillary_number": repr(membrane["capillary_number"]),
        "capillary_modulus": membrane["capillary_modulus"],
        "kernel": echo["coupler"]["kernel"],
        "radius": repr(capsule["radius"]),
        "box": " x ".join(str(n) for n in flow["box"]),
        "mesh": mesh.get("file") or f"{mesh['shape']} level {mesh['level']}",
        "shear_rate_by": f"{rate} {flow[rate]!r}" if rate else "",
    }


def viscous_parameters(echo):
    """The membrane viscosity of a run as text; nothing without one."""
    viscous = echo["capsule"][0]["membrane"].get("viscous", {})
    if viscous.get("scheme", "none") == "none":
        return dict.fromkeys(VISCOUS, "")
    springs = (f"{key} {viscous[key]!r}" for key in viscous if key.startswith("spring_"))
    words = {name: str(viscous.get(name, "")) for name in VISCOUS} | {"spring": " ".join(springs)}
    if "strain_rates" in viscous:  # of the implicit scheme
        words["scheme"] += f" {viscous['strain_rates']}"
    return words


def switches(echo):
    """What a run has on or off, as text where it is not as in most."""
    coupler, flow = echo["coupler"], echo["flow"]
    ratio = echo["capsule"][0].get("viscosity_ratio", flow.get("viscosity_ratio", 1))
    return {
        "tangential_correction": "true" if coupler.get("tangential_correction") else "",
        "inertia": "" if flow.get("inertia", True) else "false",
        "keep_volume": "true" if coupler.get("keep_volume") else "",
        "viscosity_ratio": "" if ratio == 1 else f"{ratio:g}",
        "shear_dipole": "true" if coupler.get("shear_dipole") and ratio != 1 else "",
    }


def rows_of(directory, run, shear_times, log=None):
    """The rows of one run at the shear times asked for, as dictionaries of text."""
    observables, cost = Observables(directory), read_cost(log)
    echo = read_echo(directory)
    common = {"run": run, **parameters(echo), **viscous_parameters(echo), **switches(echo)}
    rows = []
    for time in shear_times:
        row = {**common, "shear_time": f"{time:g}"}
        row.update({name: f"{observables.at(name, time):.10g}" for name in QUANTITIES})
        row.update({name: f"{cost[name]:g}" if name in cost else "" for name in COST})
        rows.append(row)
    return rows


def program_commit():
    """The commit that the tanktread in PATH was built from."""
    said = subprocess.run(["tanktread", "--version"], capture_output=True, text=True, check=True).stdout
    return said[said.index("(commit ") :].removeprefix("(commit ").rstrip(")\n")


def means_of(directory, run, start, end):
    """The row of one run, with the means from one shear time to another, as a dictionary of text."""
    observables = Observables(directory)
    means = {name: f"{observables.mean(name, start, end):.10g}" for name in QUANTITIES}
    top = observables["deformation"].argmax()
    highest = {"highest_deformation": f"{observables['deformation'][top]:.10g}", "highest_at": f"{observables['shear_time'][top]:g}"}
    return {"run": run, "from": f"{start:g}", "to": f"{end:g}", **means, **highest}


def read_blocks(file, columns):
    """The blocks of a file of results: {run: lines}, in their order."""
    blocks, comment = {}, None
    for line in file.read_text().splitlines()[1:] if file.is_file() else []:
        if line.startswith("#"):
            comment = line
        elif line:
            run = line.split(",")[0]
            if comment is not None:
                blocks[run] = [comment]
                comment = None
            # A file of before a column was added: its cells are empty.
            blocks.setdefault(run, []).append(line + "," * (len(columns) - 1 - line.count(",")))
    return blocks


def _add_block(file, columns, directory, run, rows, command):
    """Adds the rows of a finished run to a file of results, or replaces them there."""
    blocks = read_blocks(file, columns)
    made = f"# {datetime.date.today().isoformat()}, commit {read_parameters(directory)['commit']}: {command}"
    blocks[run] = [made] + [",".join(row[name] for name in columns) for row in rows]
    file.parent.mkdir(exist_ok=True)
    lines = [",".join(columns)] + [line for block in blocks.values() for line in block]
    file.write_text("\n".join(lines) + "\n")


def _refuse_what_cannot_be_added(directory, run, command):
    if not is_run(directory):
        raise InputError(f"{directory}: it is not the output of a run, for it holds no echo.toml; give the directory that --output named")
    if not is_finished(directory):
        raise InputError(f"{directory}: the run is not finished; go on with: {going_on.command(directory)}")
    if "," in run or "\n" in command:
        raise InputError(f"run '{run}', command '{command}': no commas in a run's name, no line breaks in a command")


def add(case, directory, run, shear_times, command, log=None):
    """Adds a finished run to measured/results.csv of a case (or replaces it there). Returns the file."""
    _refuse_what_cannot_be_added(directory, run, command)
    file = pathlib.Path(case) / "measured" / "results.csv"
    if not shear_times:
        raise InputError(f"{directory}: the run ended before the first shear time of read_at in {pathlib.Path(case) / 'compare.toml'}")
    _add_block(file, COLUMNS, directory, run, rows_of(directory, run, shear_times, log), command)
    return file


def add_means(case, directory, run, stretch, command):
    """Adds the means of a finished run over a stretch of shear time [start, end] to measured/means.csv. Returns the file."""
    _refuse_what_cannot_be_added(directory, run, command)
    file = pathlib.Path(case) / "measured" / "means.csv"
    _add_block(file, MEANS, directory, run, [means_of(directory, run, *stretch)], command)
    return file


def add_own(case, name, text, command):
    """Writes a table of the case's own analysis to measured/, under a line that says how it was made. Returns the file."""
    file = pathlib.Path(case) / "measured" / name
    require_name_of(f"{case}/{ANALYSE}: measured(output, case)", name, ".csv")
    if name in OWN:
        raise InputError(f"{case}/{ANALYSE}: measured(output, case) gives {name}, which holds the runs; choose another name")
    file.parent.mkdir(exist_ok=True)
    file.write_text(f"# {datetime.date.today().isoformat()}: {command}\n" + text)
    return file


def add_pictures(case, files):
    """Copies pictures to measured/, beside the numbers that they show."""
    folder = pathlib.Path(case) / "measured"
    folder.mkdir(exist_ok=True)
    for file in files:
        shutil.copy(file, folder / pathlib.Path(file).name)


def add_table(case, table, command, commit):
    """Copies a table of a study to measured/ of its case, under a line that says how it was made. Returns the file."""
    file = pathlib.Path(case) / "measured" / pathlib.Path(table).name
    file.parent.mkdir(exist_ok=True)
    file.write_text(f"# {datetime.date.today().isoformat()}, commit {commit}: {command}\n" + pathlib.Path(table).read_text())
    return file
