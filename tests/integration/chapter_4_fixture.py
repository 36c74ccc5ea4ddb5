"""Runs of the case chapter-4 made of functions that are known, and a test case with a copy of the case."""

import csv
import math
import shutil

import numpy

from post_fixture import ROOT, InFolder, said, write_echo, write_observables

from tanktread_post import case_analysis, case_results, reference

CASE = ROOT / "cases/chapter-4"
chapter_4 = case_analysis.module_of(CASE / "analyse.py")
readings = chapter_4.readings

END, EVERY, ENERGY_EVERY = 45.0, 0.05, 0.5  # shear times, as in the case
RADIUS, SHEAR_RATE, VISCOSITY = 8.0, 2e-4, 1 / 6
UNIT = VISCOSITY * SHEAR_RATE**2 * RADIUS**3  # of a power
PERIOD = 10.0  # of what oscillates: the stretch of the means, over which it vanishes


def write_table(file, columns):
    """A table of a run from {name: values}."""
    with open(file, "w", newline="") as stream:
        writer = csv.writer(stream, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows(zip(*([repr(value) for value in values.tolist()] for values in columns.values())))


def ellipse(times, frequency, length=1.5, width=0.6, tilt_deg=15.0, start=0.3):
    """(along the flow, along the gradient) of a marker that goes round an ellipse, clockwise, at an even rate of its parameter."""
    phase, tilt = start - frequency * times, math.radians(tilt_deg)
    along, across = length * numpy.cos(phase), width * numpy.sin(phase)
    return along * math.cos(tilt) - across * math.sin(tilt), along * math.sin(tilt) + across * math.cos(tilt)


def write_run(
    folder, ratio=1.0, shear=0.0, dilatational=0.0, deformation=0.4, inclination=20.0, swing=0.0, frequency=0.33, circumference=1.1, speed=0.36,
    extent=1.0, area=1.1, volume=1.0, membrane=0.0, inner=1.0, measures=True, energy=True, end=END, planned=END,
):  # fmt: skip
    """A run folder; D and the inclination swing by shares of their means, C* and V* likewise; inner None: what is inside is not marked."""
    viscous = {"scheme": "implicit", "boussinesq_shear": shear, "boussinesq_dilatational": dilatational}
    write_echo(folder, radius=RADIUS, capillary_number=0.3, modulus="E_s", shear_time=planned, viscosity_ratio=ratio, viscous=viscous)
    with open(folder / "parameters.toml", "a") as stream:
        stream.write(f"[flow]\nshear_rate = {SHEAR_RATE!r}\nkinematic_viscosity = {VISCOSITY!r}\n")
    times = numpy.arange(round(end / EVERY) + 1) * EVERY
    wave = 1 + swing * numpy.cos(2 * math.pi * times / PERIOD)
    rows = [
        {"shear_time": repr(t), "deformation": repr(deformation * w), "inclination_deg": repr(inclination * w), "area_ratio": area, "volume_ratio": v}
        for t, w, v in zip(times.tolist(), wave.tolist(), numpy.linspace(1, volume, len(times)).tolist())
    ]
    write_observables(folder, rows)
    zero = numpy.zeros(len(times))
    if measures:
        x, z = ellipse(times, frequency)
        columns = {"step": numpy.arange(len(times)), "shear_time": times, "capsule": numpy.zeros(len(times), int), "circumference": circumference * wave}
        columns |= {"membrane_speed": speed * wave, "vorticity_extent": extent + zero, "marker_x": x, "marker_y": zero, "marker_z": z}
        write_table(folder / "measures.csv", columns)
    if energy:
        times = numpy.arange(round(end / ENERGY_EVERY) + 1) * ENERGY_EVERY
        names = "elastic_energy elastic_power viscous_shear viscous_dilatational spring_power inner outer walls body_force correction kinetic_energy remainder"
        columns = {"step": numpy.arange(len(times)), "shear_time": times} | {name: 0 * times for name in names.split()}
        # Two parts of the membrane's, and a transient that is over when the means begin.
        early = (times < 30).astype(float)
        columns |= {"viscous_shear": UNIT * (0.75 * membrane + early), "viscous_dilatational": UNIT * (0.25 * membrane + early)}
        if inner is not None:
            columns["inner"] = UNIT * (inner + early)
        write_table(folder / "energy.csv", columns)


class OfChapter4(InFolder):
    """A test with a copy of the case, without what was measured, and a folder of runs."""

    def setUp(self):
        super().setUp()
        self.case, self.output = self.folder / "case", self.folder / "out"
        shutil.copytree(CASE, self.case, ignore=shutil.ignore_patterns("measured", "__pycache__"))
        self.output.mkdir()

    def run_at(self, ratio, shear, dilatational=0, **what):
        name = f"l{ratio:g}-bqs{shear:g}" + (f"-bqd{dilatational:g}" if dilatational else "")
        write_run(self.output / name, ratio, shear, dilatational, **what)

    def read(self):
        settings = reference.read_comparison(self.case)["analyse"]
        return {r.place: r for r in readings.read_runs(self.output, settings)}

    def judged(self):
        return said(case_results.judge, self.output, self.case)

    def line(self, *words):
        """The one printed line that has all the words."""
        (line,) = (line for line in self.judged()[1].splitlines() if all(word in line for word in words))
        return line
