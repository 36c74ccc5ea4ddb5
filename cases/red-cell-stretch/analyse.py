"""Diameters of the stretched cell over the force, against the band between the published sets; and its shapes.

The results are output/SET/FORCE/drag.csv, SET a set of parameters of runs.csv, FORCE in pN. Its last row is the cell at rest under that
force. Diameters are over 2 a there, a = si.radius_m of the case.
"""

import dataclasses
import pathlib

import numpy

from tanktread_post import series
from tanktread_post.observables import InputError
from tanktread_post.plot import COLOURS, new_axes, new_panels, save
from tanktread_post.reference import number_in, read_comparison, read_table
from tanktread_post.table import Table
from tanktread_post.toml_tables import read_toml

SETTINGS = (("reference", "judged", "band", "still", "drawn", "shapes"), ())
DIAMETERS = ("axial_um", "transverse_um")
MARKERS = ("o", "s")


@dataclasses.dataclass(frozen=True)
class Reading:
    """A cell at rest under a force."""

    force_pN: float
    axial_um: float
    transverse_um: float
    volume_ratio: float
    area_ratio: float


class Band:
    """Where a diameter is allowed to be: from the lower to the higher of the published sets, and a share beyond either."""

    def __init__(self, rows, file, share):
        self.share = share
        self.sets = {}  # {name: {"force_pN", "axial_um", "transverse_um": values}}
        for name in dict.fromkeys(row["set"] for row in rows):
            own = [row for row in rows if row["set"] == name]
            self.sets[name] = {column: numpy.array([number_in(file, column, row) for row in own]) for column in ("force_pN", *DIAMETERS)}

    def published(self, column, force):
        """(lower, higher) of the sets at forces, by straight lines between their points."""
        values = [numpy.interp(force, one["force_pN"], one[column]) for one in self.sets.values()]
        return numpy.min(values, axis=0), numpy.max(values, axis=0)

    def off(self, column, force, ours):
        """How far a diameter is outside the published sets: a share of the nearer one, 0 between them, negative below."""
        low, high = self.published(column, force)
        return min(0.0, ours / low - 1) + max(0.0, ours / high - 1)


def band_of(case, settings):
    """The Band of a case."""
    file = pathlib.Path(case) / settings["reference"]
    return Band(read_table(file), file, settings["band"])


def read_drag(folder, micrometres, still):
    """The Reading of a folder of `tanktread membrane drag`, whose name is the force. InputError where the cell still moves."""
    file = pathlib.Path(folder) / "drag.csv"
    rows = read_table(file)
    if not rows:
        raise InputError(f"{file}: there is no row in it; run it again")
    axial, transverse, volume, area, speed = (
        number_in(file, name, rows[-1]) for name in ("axial_diameter", "transverse_diameter", "volume_ratio", "area_ratio", "speed")
    )
    if not speed <= still:
        raise InputError(f"{file}: at its end a node still moves, {speed:g} radii per shear time; it must be at most {still:g}: run longer")
    return Reading(float(pathlib.Path(folder).name), axial * micrometres, transverse * micrometres, volume, area)


def readings(output, case, settings):
    """{set: [Reading, ...] by force} of what is there, in the order of runs.csv."""
    micrometres = 2e6 * read_toml(pathlib.Path(case) / "case.toml")["si"]["radius_m"]
    found = {}
    for row in read_table(pathlib.Path(case) / "runs.csv"):
        folders = [file.parent for file in (pathlib.Path(output) / row["run"]).glob("*/drag.csv")]
        if folders:
            found[row["run"]] = sorted((read_drag(folder, micrometres, settings["still"]) for folder in folders), key=lambda one: one.force_pN)
    if not found:
        raise InputError(f"{output}: there are no results of a set of {case}/runs.csv")
    return found


def _table(name, cells, band, judged):
    """The cells of a set against the band, a row a force."""
    rows, verdicts = [], []
    for cell in cells:
        texts, inside = [], []
        for column in DIAMETERS:
            ours, off = getattr(cell, column), band.off(column, cell.force_pN, getattr(cell, column))
            low, high = band.published(column, cell.force_pN)
            texts += [f"{ours:.2f}", f"{low:.2f} to {high:.2f}", f"{100 * off:+.1f} %" if off else "between"]
            inside.append(abs(off) <= band.share)
        verdicts += inside if judged else []
        word = ("inside" if all(inside) else "OUTSIDE") if judged else f"shown only{'' if all(inside) else ', outside'}"
        rows.append((f"{cell.force_pN:g}", *texts, f"{cell.volume_ratio:.4f}", f"{cell.area_ratio:.4f}", word))
    header = ("pN", "axial", "published", "off", "transverse", "published", "off", "V/V0", "A/A0", "")
    return Table(f"{name}: diameters in micrometres; band {100 * band.share:g} % beyond the published", header, rows, verdicts=tuple(verdicts))


def tables(output, case):
    """A table a set."""
    settings = read_comparison(case)["analyse"]
    band = band_of(case, settings)
    return [_table(name, cells, band, name in settings["judged"]) for name, cells in readings(output, case, settings).items()]


def measured(output, case):
    """stretch.csv: a row a set and force."""
    columns = [field.name for field in dataclasses.fields(Reading)]
    text = ",".join(("set", *columns)) + "\n"
    for name, cells in readings(output, case, read_comparison(case)["analyse"]).items():
        text += "".join(",".join((name, *(f"{getattr(cell, column):.6g}" for column in columns))) + "\n" for cell in cells)
    return {"stretch.csv": text}


def _draw_diameters(found, band, file):
    """Both diameters over the force: the published sets with their band, a line a set of ours."""
    figure, axes = new_axes("force  (pN)", r"diameter  ($\mu$m)")
    force = numpy.linspace(0, max(one["force_pN"].max() for one in band.sets.values()), 200)
    for column in DIAMETERS:
        low, high = band.published(column, force)
        label = f"band: between them, {100 * band.share:g} % beyond" if column == DIAMETERS[0] else None
        axes.fill_between(force, (1 - band.share) * low, (1 + band.share) * high, color="black", alpha=0.12, linewidth=0, label=label)
        for marker, (name, one) in zip(MARKERS, band.sets.items()):
            label = name if column == DIAMETERS[0] else None
            axes.plot(one["force_pN"], one[column], marker, color="black", markerfacecolor="white", markersize=5, label=label)
        for colour, (name, cells) in zip(COLOURS, found.items()):
            label = name if column == DIAMETERS[0] else None
            axes.plot([c.force_pN for c in cells], [getattr(c, column) for c in cells], color=colour, label=label, zorder=3)
    axes.set_xlim(left=0)
    axes.set_ylim(bottom=0)
    axes.legend(frameon=False, fontsize="small")
    return save(figure, file)


def _draw_shapes(folder, forces, micrometres, file):
    """The cell at some forces, seen along its axis and along the transverse diameter, shaded by the area of its triangles."""
    from matplotlib.collections import PolyCollection

    from tanktread_post import vtk_surfaces  # VTK is slow to load

    figure, panels = new_panels([r"$x$  ($\mu$m)"] * len(forces), [r"$y$  ($\mu$m)", r"$z$  ($\mu$m)"])
    for column, force in enumerate(forces):
        mesh = vtk_surfaces.read(series.at(folder / f"{force:g}" / "membrane.pvd", None)[1])
        triangles, ratio = mesh.cells_dict["triangle"], mesh.cell_data_dict["area_ratio"]["triangle"]
        points = micrometres * (mesh.points - mesh.points.mean(axis=0))
        for axes, (across, along) in zip(panels[:, column], ((1, 2), (2, 1))):
            seen_from = 1 if along == 2 else -1
            order = numpy.argsort(seen_from * points[triangles][:, :, along].mean(axis=1))
            drawn = PolyCollection(points[triangles[order]][:, :, [0, across]], array=ratio[order], cmap="viridis", edgecolor="black", linewidth=0.1)
            drawn.set_clim(0.5, 1.5)
            axes.add_collection(drawn)
            axes.set_aspect("equal")
            axes.set_xlim(-10, 10)
            axes.set_ylim(-5, 5)
        panels[0, column].set_title(f"{force:g} pN", fontsize=10)
    figure.colorbar(drawn, ax=panels, label="area of a triangle over that at rest", shrink=0.7)
    return save(figure, file)


def pictures(output, case):
    """stretch.png, and shapes.png where the shapes to draw are there."""
    settings, output = read_comparison(case)["analyse"], pathlib.Path(output)
    files = [_draw_diameters(readings(output, case, settings), band_of(case, settings), output / "stretch.png")]
    folder, wanted = output / settings["drawn"], read_toml(pathlib.Path(case) / "case.toml")
    if all((folder / f"{force:g}" / "membrane.pvd").is_file() for force in settings["shapes"]):
        grid_step = 1e6 * wanted["si"]["radius_m"] / wanted["capsule"][0]["radius"]
        files.append(_draw_shapes(folder, settings["shapes"], grid_step, output / "shapes.png"))
    return files
