"""The error of D and inclination over what it costs, for three ways of computing them; and what a larger step does.

The cost is the number of node updates to the shear time that is read, over one speed for all, so that it depends neither on the
machine nor on what else it did. The membrane and the coupler take more of a run on a coarse grid, which node updates do not see:
with the share f of the fluid that the log of a run tells, its cost is more by f0/f, f0 that of the run that gave the speed.

The converged value is where the new default goes with the mesh of one level as the grid is refined at one Reynolds number: its
error is of second order in the grid step (docs/kernels.md), and so is that of the lattice's compressibility when the wall speed goes as
1/L. So it is the end of a line in 1/L^2.
"""

import dataclasses
import math
import pathlib

from tanktread_post.extrapolation import intercept
from tanktread_post.observables import InputError, Observables
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import matching_rows, number_in, read_comparison, read_table
from tanktread_post.run_folder import finished_runs, read_cost, read_echo, read_parameters
from tanktread_post.table import Table
from tanktread_post.toml_tables import check_keys

SETTINGS = (
    ("shear_time", "mlups_a_core", "fluid_percent", "cost_ratio", "widths", "level", "step_deformation", "step_inclination", "measured"),
    (),
)
MEASURED = (("way", "capsule", "file", "run"), ())
NEW, EARLIER, THESIS = "new default", "earlier default", "thesis"
CAPSULES = {"elastic": "elastic, Bq_s = 0", "viscous": "viscous, Bq_s = 10"}
QUANTITIES = ("deformation", "inclination_deg")


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run at the shear time that is read."""

    run: str
    way: str
    capsule: str  # a key of CAPSULES
    width: int  # nodes across the box
    level: int  # of the mesh
    wall_speed: float
    relaxation_time: float  # tau+
    inertia: bool
    steps: float  # to the shear time read
    deformation: float
    inclination_deg: float
    volume_ratio: float
    fluid_percent: float  # of the cost of the run, by its log; NaN without one

    @property
    def updates(self):
        """Node updates to the shear time read."""
        return self.steps * self.width**3


def read_run(directory, settings):
    """The reading of one finished run."""
    echo, observables = read_echo(directory), Observables(directory)
    flow, capsule = echo["flow"], echo["capsule"][0]
    membrane, time = capsule["membrane"], settings["shear_time"]
    cost = read_cost(directory.with_name(directory.name + ".log"))
    return Reading(
        run=directory.name,
        way=NEW if echo["coupler"].get("tangential_correction") else EARLIER,
        capsule="elastic" if membrane.get("viscous", {}).get("scheme", "none") == "none" else "viscous",
        width=flow["box"][2],
        level=capsule["mesh"]["level"],
        wall_speed=flow["wall_speed"],
        relaxation_time=flow["relaxation_time"],
        inertia=flow["inertia"],
        steps=read_parameters(directory)["flow"]["steps_per_shear_time"] * time,
        volume_ratio=observables.at("volume_ratio", time),
        fluid_percent=cost.get("fluid_percent", math.nan),
        **{name: observables.at(name, time) for name in QUANTITIES},
    )


def read_measured(case, entry, settings):
    """The reading of a run of another case, by its measured results (measured.py)."""
    file, time = pathlib.Path(case) / entry["file"], settings["shear_time"]
    rows = matching_rows(read_table(file), {"run": entry["run"], "shear_time": time})
    if len(rows) != 1:
        raise InputError(f"{file}: {len(rows)} rows have run '{entry['run']}' at shear time {time:g}; exactly one must")
    (row,) = rows
    width, wall_speed = int(row["box"].split()[-1]), float(row["shear_rate_by"].removeprefix("wall_speed "))
    return Reading(
        run=entry["run"],
        way=entry["way"],
        capsule=entry["capsule"],
        width=width,
        level=int(row["mesh"].split()[-1]),
        wall_speed=wall_speed,
        relaxation_time=1.0,  # of all runs that compare.toml names
        inertia=row.get("inertia") != "false",
        steps=time * width / (2 * wall_speed),  # g = 2 U0/L
        **{name: number_in(file, name, row) for name in (*QUANTITIES, "volume_ratio", "fluid_percent")},
    )


@dataclasses.dataclass(frozen=True)
class Study:
    """All readings of the case: of the ways, which start at rest, and of the step, from the developed flow."""

    settings: dict
    ways: list
    steps: list

    def of(self, capsule):
        """The readings of a capsule, the cheapest of each way first."""
        order = {way: k for k, way in enumerate(dict.fromkeys(r.way for r in self.ways if r.way != NEW))}
        return sorted((r for r in self.ways if r.capsule == capsule), key=lambda r: (order.get(r.way, len(order)), r.updates, r.level))

    def series(self, capsule):
        """The runs from which the converged value comes, from coarse to fine; [] while one of them is missing."""
        chosen = [r for r in self.of(capsule) if r.way == NEW and r.level == self.settings["level"] and r.width in self.settings["widths"]]
        return chosen if {r.width for r in chosen} == set(self.settings["widths"]) else []

    def converged(self, capsule, quantity, finest=0):
        """The end of the line in 1/L^2 through the series (or its `finest` runs); NaN while it is not whole."""
        series = self.series(capsule)[-finest:]
        return intercept([r.width**-2.0 for r in series], [getattr(r, quantity) for r in series])

    def errors(self, reading):
        """(error of D as a share, error of the inclination in degrees)."""
        deformation, inclination = (self.converged(reading.capsule, quantity) for quantity in QUANTITIES)
        return reading.deformation / deformation - 1.0, reading.inclination_deg - inclination

    def core_seconds(self, reading):
        """Of the node updates alone."""
        return reading.updates / (1e6 * self.settings["mlups_a_core"])

    def whole_core_seconds(self, reading):
        """With what membrane and coupler take in that run; NaN where that is not known."""
        return self.core_seconds(reading) * self.settings["fluid_percent"] / reading.fluid_percent

    def thesis(self, capsule):
        """The run that is judged against; None where compare.toml has none."""
        return next((r for r in self.of(capsule) if r.way == THESIS), None)

    def reaches(self, reading):
        """Whether a run of the new default has no larger an error than the thesis's way, and costs little enough."""
        bar = self.thesis(reading.capsule)
        if bar is None or reading.way != NEW:
            return False
        no_worse = all(abs(ours) <= abs(theirs) for ours, theirs in zip(self.errors(reading), self.errors(bar)))
        return no_worse and reading.updates * self.settings["cost_ratio"] <= bar.updates

    def smallest_step(self):
        """The run of the step map with the most steps, and of those the least tau+, without inertia."""
        candidates = [r for r in self.steps if not r.inertia]
        return max(candidates, key=lambda r: (r.steps, -r.relaxation_time)) if candidates else None


def read_study(output, case):
    """All that is there. Runs that start from the developed flow are of the step map, but for those of the group `elsewhere`."""
    settings = read_comparison(case)["analyse"]
    for entry in settings["measured"]:
        check_keys(f"{pathlib.Path(case) / 'compare.toml'}: [[analyse.measured]]", entry, MEASURED)
    measured_before = [read_measured(case, entry, settings) for entry in settings["measured"]]
    folders = {True: [], False: []}
    for directory in finished_runs(output):
        if directory.name.startswith("elsewhere-"):
            continue
        folders[read_echo(directory)["flow"]["start"] == "developed"].append(read_run(directory, settings))
    return Study(settings, measured_before + folders[False], folders[True])


def _percent(share):
    return "" if math.isnan(share) else f"{100 * share:+.2f} %"


def _degrees(difference):
    return "" if math.isnan(difference) else f"{difference:+.2f}"


def _seconds(value):
    return "" if math.isnan(value) else f"{value:.0f}"


def _way_row(study, reading):
    deformation, inclination = study.errors(reading)
    bar = study.thesis(reading.capsule)
    more = math.nan if bar is None else reading.updates / bar.updates
    share = "" if math.isnan(more) else f"{more:.3g}" if more >= 1 else f"1/{1 / more:.3g}"
    return (
        reading.way, reading.run, f"{reading.width}^3", f"{20 * 4**reading.level}",
        f"{reading.deformation:.5f}", _percent(deformation), f"{reading.inclination_deg:.3f}", _degrees(inclination), f"{reading.volume_ratio:.5f}",
        f"{reading.updates / 1e9:.2f}", _seconds(study.core_seconds(reading)), share, _seconds(study.whole_core_seconds(reading)),
        "reaches it" if study.reaches(reading) else "",
    )  # fmt: skip


def _said_of(study, capsule):
    """Lines below the table of a capsule (the converged values, how sure they are), and the verdict."""
    if not study.series(capsule):
        return ["not judged yet: a run of the new default is missing from which the converged value comes"], None
    values = [study.converged(capsule, quantity) for quantity in QUANTITIES]
    finest = [study.converged(capsule, quantity, finest=2) for quantity in QUANTITIES]
    lines = [f"converged: D = {values[0]:.5f}, {values[1]:.3f} degrees; by the two finest runs alone {finest[0]:.5f}, {finest[1]:.3f}"]
    pair = [r for r in study.of(capsule) if r.way.startswith(THESIS)]
    if len(pair) == 2:
        at_rest = [intercept([r.wall_speed for r in pair], [getattr(r, quantity) for r in pair]) for quantity in QUANTITIES]
        found = f"D = {at_rest[0]:.5f} ({_percent(at_rest[0] / values[0] - 1.0)}), {at_rest[1]:.3f} degrees ({_degrees(at_rest[1] - values[1])})"
        seconds = sum(study.core_seconds(r) for r in pair)
        lines.append(f"the thesis's way at Re = 0, by a line through its two steps: {found}, for {seconds:.0f} core-seconds")
    if study.thesis(capsule) is None:
        return lines, None
    inside = any(study.reaches(r) for r in study.of(capsule))
    word = "inside" if inside else "OUTSIDE"
    return [*lines, f"judged: the thesis's errors, or less, for at most 1/{study.settings['cost_ratio']:g} of its core-seconds: {word}"], inside


def _way_table(study, capsule, **more):
    header = (
        "way", "run", "box", "triangles", "D", "error", "inclination", "error", "volume",
        "10^9 updates", "core-s", "of the thesis's", "with membrane", "",
    )  # fmt: skip
    lines, inside = _said_of(study, capsule)
    rows = [_way_row(study, r) for r in study.of(capsule)]
    return Table(f"{CAPSULES[capsule]}, shear time {study.settings['shear_time']:g}", header, rows, (inside,), after=lines, **more)


def changes(reading, reference):
    """(change of D as a share, of the inclination in degrees) from a reference run."""
    return reading.deformation / reference.deformation - 1.0, reading.inclination_deg - reference.inclination_deg


def _keeps(study, reading):
    """Whether a step changes no more than the accuracy wanted, against the smallest."""
    deformation, inclination = changes(reading, study.smallest_step())
    return abs(deformation) <= study.settings["step_deformation"] and abs(inclination) <= study.settings["step_inclination"]


def _step_row(study, reading):
    deformation, inclination = changes(reading, study.smallest_step())
    return (
        "with inertia" if reading.inertia else "without", f"{reading.relaxation_time:g}", f"{reading.wall_speed:g}", f"{reading.steps:.0f}",
        f"{reading.deformation:.5f}", _percent(deformation), f"{reading.inclination_deg:.3f}", _degrees(inclination), f"{reading.volume_ratio:.5f}",
        "keeps it" if _keeps(study, reading) else "",
    )  # fmt: skip


def _in_order(study):
    return sorted(study.steps, key=lambda r: (r.inertia, r.relaxation_time, r.wall_speed))


def _step_tables(study):
    """The map of the step, where it has begun."""
    if study.smallest_step() is None:
        return []
    settings = study.settings
    accuracy = f"{100 * settings['step_deformation']:g} % of D and {settings['step_inclination']:g} degrees"
    best = min((r for r in study.steps if _keeps(study, r)), key=lambda r: (r.steps, r.inertia, r.relaxation_time))
    line = f"the largest step that keeps {accuracy}: tau+ = {best.relaxation_time:g}, U0 = {best.wall_speed:g}, {best.steps:.0f} steps"
    header = ("inertia", "tau+", "U0", "steps", "D", "change", "inclination", "change", "volume", "")
    title = f"the step: changes against the smallest one, elastic, shear time {settings['shear_time']:g}"
    return [Table(title, header, [_step_row(study, r) for r in _in_order(study)], after=[line])]


def tables(output, case):
    """What each way costs, a table a capsule with its verdict; and the map of the step."""
    study = read_study(output, case)
    if not finished_runs(output):
        raise InputError(f"{output}: no finished run is there")
    said = [f"core-seconds: node updates at {study.settings['mlups_a_core']:g} million a second"]
    ways = [_way_table(study, capsule, before=said if k == 0 else ()) for k, capsule in enumerate(CAPSULES)]
    return [*ways, *_step_tables(study)]


def measured(output, case):
    """cost.csv: the tables of the ways as numbers."""
    study, rows = read_study(output, case), []
    for r in (r for capsule in CAPSULES for r in study.of(capsule)):
        errors, seconds = study.errors(r), (study.core_seconds(r), study.whole_core_seconds(r))
        numbers = (r.deformation, errors[0], r.inclination_deg, errors[1], r.updates, *seconds)
        rows.append(",".join([r.capsule, r.way.replace(",", ""), r.run, str(r.width), str(r.level), *(f"{value:.6g}" for value in numbers)]))
    columns = "deformation,deformation_error,inclination_deg,inclination_error,updates,core_seconds,core_seconds_with_membrane"
    return {"cost.csv": "\n".join([f"capsule,way,run,width,level,{columns}", *rows, ""])}


def _draw_cost(output, study, number, unit, label, file):
    """A picture of one of the two errors over core-seconds, with the corner in which the thesis's way is beaten."""
    figure, axes = new_axes("core-seconds", label)
    axes.set_xscale("log")
    axes.set_yscale("log")
    colours = dict(zip(dict.fromkeys(r.way for r in study.ways), COLOURS))
    for capsule, mark, line in zip(CAPSULES, "os", ("solid", "dashed")):
        axes.plot([], [], mark, color="black", label=CAPSULES[capsule])
        for reading in study.of(capsule) if study.series(capsule) else []:
            error, cost, colour = unit * abs(study.errors(reading)[number]), study.core_seconds(reading), colours[reading.way]
            axes.plot(cost, error, mark, color=colour, markerfacecolor=colour if reading.level == study.settings["level"] else "white")
            if reading.way == THESIS:
                corner, bottom = cost / study.settings["cost_ratio"], error / 5
                axes.plot([corner / 10, corner, corner], [error, error, bottom], color=colour, linewidth=1, linestyle=line)
    for way, colour in colours.items():
        axes.plot([], [], "o", color=colour, label=way)
    axes.legend(frameon=False, fontsize="small", title="open: 1280 triangles", loc="center left", bbox_to_anchor=(1.0, 0.5))
    return save(figure, pathlib.Path(output) / file)


def pictures(output, case):
    """deformation.png and inclination.png: error over core-seconds. While no converged value is known there are none."""
    study = read_study(output, case)
    if not any(study.series(capsule) for capsule in CAPSULES):
        return []
    return [
        _draw_cost(output, study, 0, 100.0, "error of $D$  (%)", "deformation.png"),
        _draw_cost(output, study, 1, 1.0, "error of the inclination  (degrees)", "inclination.png"),
    ]
