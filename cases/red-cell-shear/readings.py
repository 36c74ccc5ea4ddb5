"""What is read of one cell in shear flow: how it moves, how fast, and how it lies; from its tables or from measured/readings.csv."""

import dataclasses
import math

import numpy

from tanktread_post.observables import InputError, Observables
from tanktread_post.records import read_kept
from tanktread_post.run_folder import end_of, finished_runs, read_echo, read_parameters
from tanktread_post.turning import mean_turning

MOTIONS = ("tumbling", "swinging", "tank-treading", "slow")  # slow: neither shape nor membrane turns by half in the time that is read


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run. Angles in degrees, over its last shear times; a frequency is in 1/s, one a turn by 360 degrees; NaN of what does not turn."""

    run: str
    commit: str  # of the program that made it
    state: str  # of MOTIONS
    shear_rate: float  # 1/s
    outer_viscosity: float  # Pa s
    viscosity_ratio: float
    membrane_viscosity: float  # mu_s, N s/m
    inclination: float  # mean angle of the long axis to the flow
    swing: float  # half of the way between its extremes
    tumbling_frequency: float  # of the shape
    treading_frequency: float  # of a marker of the membrane about a shape that does not turn
    deformation: float  # mean D
    least_volume: float  # over that at rest, in the whole run
    greatest_volume: float
    least_area: float
    greatest_area: float

    @property
    def fluid(self):
        """The group of runs.csv: the suspending fluid and the membrane."""
        return ("plasma" if self.viscosity_ratio > 1 else "dextran"), ("viscous" if self.membrane_viscosity > 0 else "elastic")


def motion(times, shape, marker, longest, steady_swing):
    """(state, tumbling, treading): how a cell moves in the last `longest` shear times, and the angular velocities of the shape and of the membrane (shear
    rates), NaN of what does not turn. `shape`, `marker`: angles of the long axis and of a marker, continuous, in radians. A shape is the same after half
    a turn, and so nearly is the place of a membrane whose stress-free shape is one of revolution."""
    late = times >= times[-1] - longest
    tumbling = mean_turning(times, shape, math.pi, longest)
    if math.isfinite(tumbling):
        return "tumbling", tumbling, math.nan
    treading = mean_turning(times, marker, math.pi, longest)
    if not math.isfinite(treading):
        return "slow", math.nan, math.nan
    return ("swinging" if numpy.ptp(shape[late]) / 2 > math.radians(steady_swing) else "tank-treading"), math.nan, treading


def read_run(directory, settings):
    """The reading of one finished run."""
    echo, observables, measures = read_echo(directory), Observables(directory), Observables(directory, table="measures.csv")
    si, flow, times = echo["si"], echo["flow"], measures["shear_time"]
    # The long axis is across the short one; which end of an axis is meant does not matter.
    shape = numpy.unwrap(numpy.radians(measures["short_inclination_deg"] + 90), period=math.pi)
    # At step 0 two axes of the disc are equally long, and it is the short one that is known.
    marker = numpy.unwrap(numpy.arctan2(*(measures[f"marker_{flow[axis]}"] for axis in ("wall_axis", "flow_axis"))))
    state, tumbling, treading = motion(times, shape, marker, settings["read_over"], settings["steady_swing"])
    end = min(end_of(directory), float(observables["shear_time"][-1]))
    late = times >= times[-1] - settings["read_over"]
    volume, area = observables["volume_ratio"], observables["area_ratio"]
    hertz = si["shear_rate_per_s"] / (2 * math.pi)
    return Reading(
        run=directory.name,
        commit=str(read_parameters(directory)["commit"]),
        state=state,
        shear_rate=float(si["shear_rate_per_s"]),
        outer_viscosity=float(si["viscosity_Pa_s"]),
        viscosity_ratio=float(si["inner_viscosity_Pa_s"] / si["viscosity_Pa_s"]),
        membrane_viscosity=float(si.get("membrane_shear_viscosity_N_s_per_m", 0)),
        inclination=math.nan if state == "tumbling" else float(numpy.degrees((shape[late].mean() + math.pi / 2) % math.pi - math.pi / 2)),
        swing=math.nan if state == "tumbling" else float(numpy.degrees(numpy.ptp(shape[late]) / 2)),
        tumbling_frequency=tumbling * hertz,
        treading_frequency=treading * hertz,
        deformation=observables.mean("deformation", end - settings["read_over"], end),
        least_volume=float(volume.min()),
        greatest_volume=float(volume.max()),
        least_area=float(area.min()),
        greatest_area=float(area.max()),
    )


def read_runs(output, settings, kept):
    """The readings of all finished runs below a folder, and of those of `kept` (measured/readings.csv) that are not among them, by fluid and shear rate."""
    found = {directory.name: read_run(directory, settings) for directory in finished_runs(output)}
    readings = list((read_kept(kept, Reading) | found).values())
    if not readings:
        raise InputError(f"{output}: no finished run is there")
    return sorted(readings, key=lambda r: (r.fluid, r.shear_rate))
