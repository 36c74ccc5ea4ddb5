"""What this case prints and draws: the bending energy of vesicles at rest against the shape equations, over the mesh, and their meridians."""

import dataclasses
import math
import pathlib

import meshio
import numpy
from tanktread_post import plot
from tanktread_post.observables import InputError
from tanktread_post.reference import number_in, read_comparison, read_table
from tanktread_post.run_folder import read_parameters
from tanktread_post.table import Table, shown
from tanktread_post.vesicle_shapes import shape

# band: the largest difference of an energy. still: the greatest speed of a node, a/(mu_o a^3/kappa_b), of a vesicle at rest; run.sh ends a round there.
# A drag takes up what the energy gives, -dE/dt = zeta times the integral of u^2, at most zeta A still^2 = 4 pi R^2 still^2 in units of kappa_b over that of
# time: a share (R/a)^2 still^2/(2 e) of E = 8 pi kappa_b e. With (R/a)^2 = v^(-2/3) <= 1.5 (v >= 0.55), e >= 1.1 and still = 0.03 that is 6e-4 a unit of
# time. What is left to fall is that over twice the slowest rate, which is 8 and more here, 3 without the law (the speeds of drag.csv): 1e-4 at most, a
# hundredth of the band.
SETTINGS = (("band", "still"), ())
BRANCHES = ("oblate", "prolate", "stomatocyte")


@dataclasses.dataclass(frozen=True)
class Vesicle:
    """A vesicle on the mesh of a level, as its last round ended. Energies over 8 pi kappa_b; points in units of the radius of the sphere of its area, from its centroid."""

    shape: str
    branch: str
    level: int
    n_triangles: int  # of its mesh
    reduced_volume: float
    energy: float
    theory: float  # the energy of its branch at its reduced volume
    speed: float  # of its fastest node at the end, in a and mu_o a^3/kappa_b
    law: float  # energy of the law over that of bending
    points: numpy.ndarray

    @property
    def error(self):
        return self.energy / self.theory - 1


def theory_energy(case, branch, reduced_volume):
    """Energy of a branch between two rows of the reference, by the cubic of their energies and slopes, dE/dv = -P/6."""
    file = pathlib.Path(case) / "reference/energies.csv"
    rows = [[number_in(file, name, row) for name in ("reduced_volume", "energy", "pressure")] for row in read_table(file) if row["branch"] == branch]
    for (v0, e0, p0), (v1, e1, p1) in zip(rows, rows[1:]):
        if v0 <= reduced_volume <= v1:
            t, width = (reduced_volume - v0) / (v1 - v0), v1 - v0
            slopes = -(p0 * (1 - t) - p1 * t) / 6 * width * t * (1 - t)
            return e0 + (e1 - e0) * t * t * (3 - 2 * t) + slopes
    raise InputError(f"{file}: it has no {branch} of the reduced volume {reduced_volume:.5f}")


def at_rest(vesicle, still):
    """Whether its fastest node is no faster; not a number is not at rest."""
    return vesicle.speed <= still


def measures(points, triangles):
    """(area, volume, centroid of the volume) of a closed surface."""
    a, b, c = (points[triangles[:, k]] for k in range(3))
    volumes = numpy.einsum("ij,ij->i", a, numpy.cross(b, c)) / 6
    area = numpy.linalg.norm(numpy.cross(b - a, c - a), axis=1).sum() / 2
    return float(area), float(volumes.sum()), ((a + b + c) / 4 * volumes[:, None]).sum(axis=0) / volumes.sum()


def read_vesicle(case, folder, row, level):
    """The vesicle of a row of shapes.csv on a level, from the folder of its run."""
    surface = meshio.read(folder / "end.vtu")
    area, volume, centroid = measures(surface.points, surface.cells_dict["triangle"])
    v = volume / (4 * math.pi / 3 * (area / (4 * math.pi)) ** 1.5)
    (at_rest,) = read_table(folder / "energy/energy.csv")
    kappa_b = read_parameters(folder / "energy")["capsule"][0]["bending_modulus"]
    energy = number_in(folder / "energy/energy.csv", "bending_energy", at_rest) / (8 * math.pi * kappa_b)
    file, end = folder / "drag/drag.csv", read_table(folder / "drag/drag.csv")[-1]
    speed, of_law = (number_in(file, name, end) for name in ("speed", "elastic_energy"))
    points = (surface.points - centroid) / math.sqrt(area / (4 * math.pi))
    return Vesicle(row["shape"], row["branch"], level, len(surface.cells_dict["triangle"]), v, energy, theory_energy(case, row["branch"], v), speed, of_law / (8 * math.pi * kappa_b * energy), points)


def read_vesicles(output, case):
    """{name: [Vesicle], the finest last} of what is finished."""
    found = {}
    for row in read_table(pathlib.Path(case) / "shapes.csv"):
        for level in range(9):
            folder = pathlib.Path(output) / f"{row['shape']}-{level}"
            if (folder / "energy/energy.csv").is_file():
                found.setdefault(row["shape"], []).append(read_vesicle(case, folder, row, level))
    if not found:
        raise InputError(f"{output}: there is no finished vesicle; cases/run vesicle makes them")
    return found


def limit(vesicles, still):
    """Where the line in 1/triangles through the errors of the two finest meshes goes; None with one mesh, or if not both are at rest."""
    if len(vesicles) < 2 or not all(at_rest(one, still) for one in vesicles[-2:]):
        return None
    coarse, fine = vesicles[-2:]
    return fine.error + (fine.error - coarse.error) / (fine.n_triangles / coarse.n_triangles - 1)


def meridian(vesicle):
    """Profile of the theory at the reduced volume of a vesicle, (r, z) from the centroid of its volume."""
    exact = shape(vesicle.branch, vesicle.reduced_volume)
    slabs = numpy.diff(exact.z) * (exact.r[1:] ** 2 + exact.r[:-1] ** 2)  # of a cup the hollow counts negative
    middle = (slabs * (exact.z[1:] + exact.z[:-1]) / 2).sum() / slabs.sum()
    return exact.r, exact.z - middle


def distance(vesicle):
    """Root of the mean square distance of the nodes from the theory's meridian, in radii of the sphere of equal area."""
    r, z = meridian(vesicle)
    start, along = numpy.stack([r[:-1], z[:-1]], axis=1), numpy.stack([numpy.diff(r), numpy.diff(z)], axis=1)
    nodes = numpy.stack([numpy.hypot(vesicle.points[:, 0], vesicle.points[:, 1]), vesicle.points[:, 2]], axis=1)
    offset = nodes[:, None, :] - start[None]
    share = numpy.clip((offset * along).sum(axis=2) / (along**2).sum(axis=1), 0, 1)
    nearest = numpy.linalg.norm(offset - share[..., None] * along, axis=2).min(axis=1)
    return float(numpy.sqrt((nearest**2).mean()))


def tables(output, case):
    settings = read_comparison(case)["analyse"]
    band, still = settings["band"], settings["still"]
    found = read_vesicles(output, case)
    rows, verdicts, not_finished = [], [], []
    for vesicles in found.values():
        for one in vesicles:
            moves = not at_rest(one, still)
            of_it = (one.shape, f"{one.n_triangles}", f"{one.reduced_volume:.4f}", f"{one.energy:.4f}", f"{one.theory:.4f}", shown(one.error, True))
            rows.append((*of_it, f"{one.law:.1e}", f"{one.speed:.1e}", "NOT AT REST" if moves else ""))
            if moves:
                not_finished.append(f"{one.shape} with {one.n_triangles} triangles")
                verdicts.append(False)
        end = limit(vesicles, still)
        if end is not None:
            verdicts.append(abs(end) <= band)
            rows.append((vesicles[0].shape, "limit", "", "", "", shown(end, True), "", "", "inside" if verdicts[-1] else "OUTSIDE"))
    levels = sorted({one.level for vesicles in found.values() for one in vesicles})
    missing = []
    for row in read_table(pathlib.Path(case) / "shapes.csv"):
        there = {one.level for one in found.get(row["shape"], ())}
        missing += [f"{row['shape']} on level {level}" for level in levels if level >= int(row["coarsest_level"]) and level not in there]
    named = (("not finished, a node is faster than {:g}".format(still), not_finished), ("not run yet, or gone wrong", missing))
    header = ("vesicle", "triangles", "reduced volume", "E/(8 pi kappa_b)", "theory", "difference", "law", "speed", "")
    title = f"bending energy of vesicles at rest; judged: the limit, to {shown(band, True, '')}. law: its energy over that of bending"
    return [Table(title, header, rows, verdicts, after=[f"{words}: {', '.join(names)}" for words, names in named if names])]


def pictures(output, case):
    found = read_vesicles(output, case)
    return [draw_energies(found, output, case), draw_shapes(found, output)]


def draw_energies(found, output, case):
    """Energies over reduced volume: the branches, and the vesicles of each mesh."""
    figure, axes = plot.new_axes("reduced volume", r"$E/(8\pi\kappa_b)$")
    file = pathlib.Path(case) / "reference/energies.csv"
    for branch, colour in zip(BRANCHES, plot.COLOURS):
        rows = [row for row in read_table(file) if row["branch"] == branch]
        axes.plot(*([number_in(file, name, row) for row in rows] for name in ("reduced_volume", "energy")), color=colour, label=f"{branch}, shape equations")
    every = [one for vesicles in found.values() for one in vesicles]
    for level, marker in zip(sorted({one.level for one in every}), "xosd^v"):
        points = [(one.reduced_volume, one.energy) for one in every if one.level == level]
        axes.plot(*zip(*points), marker, color="black", markerfacecolor="none", label=f"{20 * 4**level} triangles, or about as many")
    axes.legend(frameon=False)
    return plot.save(figure, pathlib.Path(output) / "energies.png")


def draw_shapes(found, output):
    """The nodes of each vesicle on its finest mesh, turned about the axis into a plane, over the meridian of theory."""
    n_columns = 3
    n_rows = -(-len(found) // n_columns)
    figure, panels = plot.new_panels([r"$r/R$"] * n_columns, [r"$z/R$"] * n_rows)
    for axes, vesicles in zip(panels.flat, found.values()):
        one, colour = vesicles[-1], plot.COLOURS[BRANCHES.index(vesicles[-1].branch)]
        r, z = meridian(one)
        axes.plot([*r, *-r[::-1]], [*z, *z[::-1]], color=colour)
        axes.plot(numpy.hypot(one.points[:, 0], one.points[:, 1]) * numpy.where(one.points[:, 0] < 0, -1, 1), one.points[:, 2], ".", color="black", markersize=2)
        axes.set_aspect("equal")
        axes.set_title(f"{one.branch}, v = {one.reduced_volume:.4f}, {one.n_triangles} triangles")
    for axes in panels.flat[len(found) :]:
        axes.set_visible(False)
    return plot.save(figure, pathlib.Path(output) / "shapes.png")


def measured(output, case):
    lines = ["shape,branch,triangles,reduced_volume,energy,theory,error,distance_from_meridian,law_energy,speed"]
    for vesicles in read_vesicles(output, case).values():
        for one in vesicles:
            numbers = (one.reduced_volume, one.energy, one.theory, one.error, distance(one), one.law)
            lines.append(",".join([one.shape, one.branch, str(one.n_triangles), *(f"{n:.6f}" for n in numbers), f"{one.speed:.3g}"]))
    return {"energies.csv": "\n".join(lines) + "\n"}
