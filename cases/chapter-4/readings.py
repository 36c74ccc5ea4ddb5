"""What is read of one run of the matrix: shape, contour, rotation and dissipation at its end, from its tables or from measured/readings.csv."""

import dataclasses
import math

import numpy

from tanktread_post import records
from tanktread_post.observables import Observables
from tanktread_post.run_folder import end_of, finished_runs, read_echo, read_parameters
from tanktread_post.turning import turning_frequency

SHAPE = ("deformation", "inclination_deg", "area_ratio")  # of observables.csv
CONTOUR = ("circumference", "membrane_speed", "vorticity_extent")  # of measures.csv
AMPLITUDES = ("deformation", "inclination_deg")
SETTLED = 0.02  # share of the mean of D from which D is no farther away once the run has settled


FOLLOWS = ("nu_travel", "dissipation_ratio")  # from the others


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run. Means over its last shear times; what measures.csv or energy.csv would say is NaN where there is no such file."""

    run: str
    commit: str  # of the program that made it
    viscosity_ratio: float
    boussinesq_shear: float
    boussinesq_dilatational: float
    deformation: float
    inclination_deg: float
    area_ratio: float
    deformation_amplitude: float  # half of the way from the least to the greatest value
    inclination_deg_amplitude: float
    least_volume: float  # over that at rest, over the whole run
    greatest_volume: float
    circumference: float  # C* = C/(2 pi a)
    membrane_speed: float  # V* = V/(g a)
    vorticity_extent: float  # over 2 a
    nu_marker: float  # nu* = 2 pi/(g T) by the marker
    membrane_dissipation: float  # Phi_mem, in mu_o g^2 a^3
    inner_dissipation: float  # Phi_int, likewise
    settling_time: float  # shear time from which D stays within SETTLED of its mean; 0 where it does so all the time

    @property
    def nu_travel(self):
        """nu* by the travel time along the contour."""
        return self.membrane_speed / self.circumference

    @property
    def dissipation_ratio(self):
        """d = Phi_mem/Phi_int."""
        return self.membrane_dissipation / self.inner_dissipation

    @property
    def place(self):
        """(lambda, Bq_s, Bq_d)."""
        return self.viscosity_ratio, self.boussinesq_shear, self.boussinesq_dilatational


def _contour(directory, axes, start, end, longest):
    """The means of CONTOUR and nu_marker of a run; NaN without measures.csv."""
    if not (directory / "measures.csv").is_file():
        return dict.fromkeys((*CONTOUR, "nu_marker"), math.nan)
    measures = Observables(directory, table="measures.csv")
    means = {name: measures.mean(name, start, end) for name in CONTOUR}
    marker = [measures[f"marker_{axis}"] for axis in axes]
    return means | {"nu_marker": turning_frequency(measures["shear_time"], *marker, longest)}


def _dissipation(directory, start, end):
    """The mean dissipation of membrane and inner fluid of a run, in mu_o g^2 a^3; NaN without energy.csv, and of the inner fluid where its column is
    not a number or 0 (with one viscosity, up to commit ec4822b)."""
    names = ("membrane_dissipation", "inner_dissipation")
    if not (directory / "energy.csv").is_file():
        return dict.fromkeys(names, math.nan)
    energy, parameters = Observables(directory, capsule=None, table="energy.csv"), read_parameters(directory)
    flow, radius = parameters["flow"], parameters["capsule"][0]["radius"]
    unit = flow["kinematic_viscosity"] * flow["shear_rate"] ** 2 * radius**3
    viscous = sum(energy.mean(name, start, end) for name in ("viscous_shear", "viscous_dilatational"))
    return dict(zip(names, (viscous / unit, energy.mean("inner", start, end) / unit or math.nan)))


def _settling_time(times, values, mean):
    """When the values were last farther from their mean than the share SETTLED of it."""
    away = numpy.flatnonzero(numpy.abs(values - mean) > SETTLED * abs(mean))
    return float(times[away[-1]]) if len(away) else 0.0


def read_run(directory, settings):
    """The reading of one finished run."""
    echo, observables = read_echo(directory), Observables(directory)
    capsule, flow = echo["capsule"][0], echo["flow"]
    viscous = capsule["membrane"].get("viscous", {})
    # A run to T ends with the step nearest to T.
    end = min(end_of(directory), float(observables["shear_time"][-1]))
    start = end - settings["means_over"]
    late = observables["shear_time"] >= start
    volume = observables["volume_ratio"]
    return Reading(
        run=directory.name,
        commit=str(read_parameters(directory)["commit"]),
        viscosity_ratio=float(capsule.get("viscosity_ratio", flow["viscosity_ratio"])),
        boussinesq_shear=float(viscous.get("boussinesq_shear", 0)),
        boussinesq_dilatational=float(viscous.get("boussinesq_dilatational", 0)),
        **{name: observables.mean(name, start, end) for name in SHAPE},
        **{f"{name}_amplitude": float(numpy.ptp(observables[name][late]) / 2) for name in AMPLITUDES},
        least_volume=float(volume.min()),
        greatest_volume=float(volume.max()),
        **_contour(directory, (flow["flow_axis"], flow["wall_axis"]), start, end, settings["turning_over"]),
        **_dissipation(directory, start, end),
        settling_time=_settling_time(observables["shear_time"], observables["deformation"], observables.mean("deformation", start, end)),
    )


def read_runs(output, settings, kept=None, without=()):
    """The readings of all finished runs below a folder but those named, and of those of `kept` (measured/readings.csv) that are not among them, in
    rising (lambda, Bq_s, Bq_d)."""
    found = {directory.name: read_run(directory, settings) for directory in finished_runs(output) if directory.name not in without}
    return sorted(((records.read_kept(kept, Reading) if kept else {}) | found).values(), key=lambda r: r.place)


def table_of(readings):
    """The text of measured/readings.csv: all that is read of each run, and what follows from it, a row a run."""
    return records.table_of(readings, Reading, FOLLOWS)


def curves(readings, along, by):
    """{value of `by`: [Reading]} of the matrix (Bq_d = 0), each in rising `along`; both names of parameters."""
    matrix = [r for r in readings if r.boussinesq_dilatational == 0]
    return {
        value: sorted((r for r in matrix if getattr(r, by) == value), key=lambda r: getattr(r, along))
        for value in sorted({getattr(r, by) for r in matrix})
    }


def equivalent_viscosity_ratio(elastic, quantity, value):
    """The viscosity ratio at which capsules without membrane viscosity, `elastic` (readings in rising viscosity ratio), have a value of a quantity that falls
    with it, by straight lines; NaN beyond them."""
    values = [getattr(r, quantity) for r in elastic]
    if len(values) < 2 or not min(values) <= value <= max(values):
        return math.nan
    return float(numpy.interp(-value, [-v for v in values], [r.viscosity_ratio for r in elastic]))


def crossings(readings, at, value, quantity):
    """(least, greatest) of a quantity where another one is at a value, on the curves of the matrix, by straight lines; NaN where it is nowhere."""
    found = []
    for along, by in (("viscosity_ratio", "boussinesq_shear"), ("boussinesq_shear", "viscosity_ratio")):
        for curve in curves(readings, along, by).values():
            for one, next_one in zip(curve, curve[1:]):
                a, b = getattr(one, at), getattr(next_one, at)
                if min(a, b) <= value <= max(a, b) and a != b:
                    share = (value - a) / (b - a)
                    found.append((1 - share) * getattr(one, quantity) + share * getattr(next_one, quantity))
    return (min(found), max(found)) if found else (math.nan, math.nan)
