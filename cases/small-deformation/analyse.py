"""The limit of small deformation: how far a series of runs is from it, and where it goes as the grid is refined.

Theory (Barthes-Biesel and Rallison 1981, doi 10.1017/S0022112081003480; steady, unbounded Stokes shear flow):
    D = (5/8) Ca_G (3 + G_s/K_s).
A run differs from it by its capillary number, its resolution and its box:
    D = D_theory (1 + k Ca_G^2) (1 + r/a) (1 + w (a/L)^3).
- Ca_G: at the next order the shape gains a part along the flow axes, at right angles (in the plane of shapes) to
  the first, so D changes by a share of Ca_G^2 only. The slope D/Ca_G at Ca_G = 0 comes from a line in Ca_G^2.
- a (grid steps): the immersed boundary is of first order in the grid step, so a line in 1/a. Coarse grids, on which
  the next order shows, are left out of the line: it begins at the `least_radius` of compare.toml.
- L: a capsule is a stresslet, whose velocity falls like 1/r^2; walls and periodic images at a distance L
  change the shear rate that it sees by a share of (a/L)^3.
"""

import dataclasses
import math
import pathlib

import numpy

from tanktread_post.extrapolation import intercept, line
from tanktread_post.observables import InputError, Observables
from tanktread_post.plot import COLOURS, new_axes, save
from tanktread_post.reference import read_comparison
from tanktread_post.run_folder import capillary_number_by_shear_modulus, finished_runs, read_echo
from tanktread_post.table import Table, verdict
from tanktread_post.viscous_capsule import steady_state

SETTINGS = (
    (
        "shear_time", "band", "laws", "kernel", "slope_kernels", "judged_kernel", "kernels", "kernel_law", "kernel_capillary_number",
        "box_in_radii", "least_radius", "box_radius",
    ),
    ("corrected_kernel", "corrected_bands", "corrected_box_radius", "corrected_inclination_band"),
)  # fmt: skip


@dataclasses.dataclass(frozen=True)
class Reading:
    """One run: its parameters and the deformation read."""

    run: str
    law: str
    kernel: str
    corrected: bool  # with coupler.tangential_correction
    capillary_number: float  # by G_s
    radius: float  # grid steps
    width: int  # grid steps, of the cubic box
    inertia: bool
    theory: float  # D of the theory at this capillary number
    theory_inclination_deg: float  # to first order in D
    deformation: float
    inclination_deg: float

    @property
    def ratio(self):
        """D over that of the theory."""
        return self.deformation / self.theory


def area_to_shear_modulus(membrane):
    """K_s/G_s of a law at rest."""
    law = membrane["elastic_law"]
    if law == "skalak":
        return 1.0 + 2.0 * membrane["area_ratio"]
    if law == "neo-hookean":
        return 3.0
    if law == "hookean":
        return (1.0 + membrane["poisson_ratio"]) / (1.0 - membrane["poisson_ratio"])
    raise InputError(f"the limit of small deformation is not known for the law '{law}'")


def theory(membrane):
    """D of the theory for a [capsule.membrane] table."""
    return 5.0 / 8.0 * capillary_number_by_shear_modulus(membrane) * (3.0 + 1.0 / area_to_shear_modulus(membrane))


def theory_inclination_deg(membrane):
    """The inclination of the first-order theory for a [capsule.membrane] table, degrees."""
    return steady_state(capillary_number_by_shear_modulus(membrane), area_modulus=area_to_shear_modulus(membrane))[1]


def read_run(directory, shear_time):
    """The reading of one finished run."""
    echo = read_echo(directory)
    capsule, observables = echo["capsule"][0], Observables(directory)
    return Reading(
        run=pathlib.Path(directory).name,
        law=capsule["membrane"]["elastic_law"],
        kernel=echo["coupler"]["kernel"],
        corrected=bool(echo["coupler"].get("tangential_correction")),
        capillary_number=capillary_number_by_shear_modulus(capsule["membrane"]),
        radius=capsule["radius"],
        width=echo["flow"]["box"][2],
        inertia=echo["flow"]["inertia"],
        theory=theory(capsule["membrane"]),
        theory_inclination_deg=theory_inclination_deg(capsule["membrane"]),
        deformation=observables.at("deformation", shear_time),
        inclination_deg=observables.at("inclination_deg", shear_time),
    )


def read_runs(output, shear_time):
    """The readings of all finished runs below a folder."""
    return [read_run(directory, shear_time) for directory in finished_runs(output)]


def slope_ratio(readings):
    """D/Ca_G over that of the theory at Ca_G = 0, by a line in Ca_G^2; one capillary number alone: its ratio."""
    if len(readings) == 1:
        return readings[0].ratio
    return intercept([r.capillary_number**2 for r in readings], [r.ratio for r in readings])


def box_factor(readings, widths):
    """D in a box of L = `widths` radii over D in an unbounded fluid, by a line in (a/L)^3; NaN without two boxes."""
    unbounded, gradient = line([(r.radius / r.width) ** 3 for r in readings], [r.ratio for r in readings])
    return 1.0 + gradient / unbounded / widths**3


class Series:
    """The readings of a case, sorted into the series that its tables need."""

    def __init__(self, readings, settings):
        self.settings = settings
        self.readings = [r for r in readings if r.inertia and not r.corrected]
        self.stokes = [r for r in readings if not r.inertia and not r.corrected]
        self.corrected = [r for r in readings if not r.inertia and r.corrected and r.kernel == settings.get("corrected_kernel")]

    def in_box(self, reading):
        """Whether the run is in the box in which the resolution is varied."""
        return abs(reading.width / reading.radius - self.settings["box_in_radii"]) < 0.5

    def select(self, **wanted):
        """The readings whose members equal those given, in the box of the resolution series."""
        return [r for r in self.readings if self.in_box(r) and all(getattr(r, k) == v for k, v in wanted.items())]

    def slopes(self, law, kernel):
        """{radius: D/Ca_G over that of the theory at Ca_G = 0}."""
        chosen = self.select(law=law, kernel=kernel)
        radii = sorted({r.radius for r in chosen})
        by_radius = {radius: [r for r in chosen if r.radius == radius] for radius in radii}
        return {radius: slope_ratio(group) for radius, group in by_radius.items() if len(group) > 1}

    def kernel_ratios(self, kernel):
        """{radius: D over theory} at the capillary number of the kernel series, law of the kernel series."""
        chosen = self.select(
            kernel=kernel, law=self.settings["kernel_law"], capillary_number=self.settings["kernel_capillary_number"]
        )
        return {r.radius: r.ratio for r in sorted(chosen, key=lambda r: r.radius)}

    def boxes(self):
        """The runs in which the box is varied: of one radius, one law, one kernel and one capillary number."""
        return [
            r
            for r in self.readings
            if (r.law, r.kernel, r.radius, r.capillary_number)
            == (
                self.settings["kernel_law"],
                self.settings["kernel"],
                self.settings["box_radius"],
                self.settings["kernel_capillary_number"],
            )
        ]

    def factor(self):
        """The factor of the box of the resolution series."""
        return box_factor(self.boxes(), self.settings["box_in_radii"])


def extrapolated(ratios, factor, least_radius):
    """The ratio at 1/a = 0 in an unbounded fluid, of {radius: ratio}, from the radii of at least `least_radius`."""
    fine = {radius: ratio for radius, ratio in ratios.items() if radius >= least_radius}
    return intercept([1.0 / radius for radius in fine], list(fine.values())) / factor


def _percent(ratio):
    return "" if ratio is None or math.isnan(ratio) else f"{100 * (ratio - 1):+.2f} %"


def _table(title, label, rows, radii, **more):
    """A table of errors: one row a series (name, {radius: ratio}, extrapolation, word)."""
    header = (label, *(f"a = {radius:g}" for radius in radii), "a to infinity", "")
    texts = [(name, *(_percent(ratios.get(a)) for a in radii), _percent(limit), word) for name, ratios, limit, word in rows]
    return Table(title, header, texts, **more)


def _slope_row(series, law, kernel, factor):
    """A row of the table of slopes, and whether it lies in the band; None where that is not known, or not judged."""
    slopes = series.slopes(law, kernel)
    limit = extrapolated(slopes, factor, series.settings["least_radius"])
    if math.isnan(limit):
        return (law, slopes, limit, "not judged yet"), None
    if kernel != series.settings["judged_kernel"]:
        return (law, slopes, limit, "shown only"), None
    inside = abs(limit - 1.0) <= series.settings["band"]
    return (law, slopes, limit, "inside" if inside else "OUTSIDE"), inside


def _slope_table(series, kernel, factor, radii, **more):
    rows, verdicts = zip(*(_slope_row(series, law, kernel, factor) for law in series.settings["laws"]))
    title = f"slope D/Ca_G at Ca_G = 0, kernel {kernel}; band {100 * series.settings['band']:g} %"
    return _table(title, "law", rows, radii, verdicts=verdicts, **more)


def _kernel_table(series, factor, radii):
    settings, rows = series.settings, []
    for kernel in settings["kernels"]:
        ratios = series.kernel_ratios(kernel)
        rows.append((kernel, ratios, extrapolated(ratios, factor, settings["least_radius"]), ""))
    return _table(f"kernels, {settings['kernel_law']}, Ca_G = {settings['kernel_capillary_number']:g}", "kernel", rows, radii)


def _box_table(series, factor):
    settings, boxes = series.settings, sorted(series.boxes(), key=lambda r: r.width)
    return Table(
        f"box, a = {settings['box_radius']:g}: the box of {settings['box_in_radii']:g} a changes D by {_percent(factor) or 'an unknown share'}",
        ("L/a", "error", "inclination", ""),
        [(f"{r.width / r.radius:g}", _percent(r.ratio), f"{r.inclination_deg:.2f}", "") for r in boxes],
        after=[f"without inertia, {r.run}: error {_percent(r.ratio)}, inclination {r.inclination_deg:.2f}" for r in series.stokes],
    )


def _corrected_table(series):
    """The default, kernel and tangential correction: at each radius judged by itself, the box taken off."""
    settings = series.settings
    factor = box_factor([r for r in series.corrected if r.radius == settings["corrected_box_radius"]], settings["box_in_radii"])
    bands = {radius: band for radius, band in settings["corrected_bands"]}
    rows, verdicts = [], []
    for r in sorted((r for r in series.corrected if series.in_box(r)), key=lambda r: r.radius):
        turned, band = r.inclination_deg - r.theory_inclination_deg, bands.get(r.radius)
        judged = None if math.isnan(factor) or band is None else (
            verdict(r.ratio / factor - 1, band) and verdict(turned, settings["corrected_inclination_band"])
        )
        verdicts.append(judged)
        word = {None: "shown only", True: "inside", False: "OUTSIDE"}[judged]
        band_text = "" if band is None else f"{100 * band:g} %"
        rows.append((f"{r.radius:g}", _percent(r.ratio), _percent(r.ratio / factor), band_text, f"{r.inclination_deg:.2f}", f"{turned:+.2f}", word))
    title = (
        f"{settings['corrected_kernel']} with the tangential correction, the default; the box of {settings['box_in_radii']:g} a "
        f"changes D by {_percent(factor) or 'an unknown share'}; band of the inclination {settings['corrected_inclination_band']:g} degrees"
    )
    header = ("a", "error", "without the box", "band", "inclination", "less theory", "")
    return Table(title, header, rows, verdicts=tuple(verdicts))


def tables(output, case):
    """The errors against the theory; an extrapolated slope is judged by the band."""
    settings = read_comparison(case)["analyse"]
    readings = read_runs(output, settings["shear_time"])
    if not readings:
        raise InputError(f"{output}: no finished run is there")
    series = Series(readings, settings)
    radii, factor = sorted({r.radius for r in series.readings}), series.factor()
    said = [f"D over that of the theory, less one, read at shear time {settings['shear_time']:g}"]
    slopes = [
        _slope_table(series, kernel, factor, radii, before=said if number == 0 else ())
        for number, kernel in enumerate(settings["slope_kernels"])
    ]
    corrected = [_corrected_table(series)] if "corrected_kernel" in settings else []
    return [*slopes, _kernel_table(series, factor, radii), _box_table(series, factor), *corrected]


def pictures(output, case):
    """errors.png: D over that of the theory, less one, against 1/a, a line a kernel.

    With no finished run of the kernel series there is nothing to draw, and no file.
    """
    settings = read_comparison(case)["analyse"]
    series = Series(read_runs(output, settings["shear_time"]), settings)
    ratios_of = {kernel: series.kernel_ratios(kernel) for kernel in settings["kernels"]}
    if not any(ratios_of.values()):
        return []
    figure, axes = new_axes(r"grid steps a radius, inverse  $1/a$", "error of $D$ against the theory  (%)")
    for colour, (kernel, ratios) in zip(COLOURS, ratios_of.items()):
        if not ratios:
            continue
        x, y = [1.0 / radius for radius in ratios], [100 * (ratio - 1) for ratio in ratios.values()]
        axes.plot(x, y, "o", color=colour, label=kernel)
        fine = [k for k, radius in enumerate(ratios) if radius >= settings["least_radius"]]
        if len(fine) > 1:
            fitted = numpy.polynomial.Polynomial.fit([x[k] for k in fine], [y[k] for k in fine], 1)
            ends = numpy.array([0, max(x)])
            axes.plot(ends, fitted(ends), color=colour, linewidth=1, alpha=0.6)
    axes.axhline(0, color="black", linewidth=0.8)
    axes.set_xlim(left=0)
    axes.legend(frameon=False, title=f"$Ca_G$ = {settings['kernel_capillary_number']:g}, box {settings['box_in_radii']:g} $a$")
    return [save(figure, pathlib.Path(output) / "errors.png")]
