"""Outlines: the curves in which the shear plane through the centroid cuts a membrane, from the files of a run or from a table that a case keeps."""

import csv
import dataclasses
import io
import math
import pathlib

import numpy

from . import series, vtk_surfaces
from .observables import Observables
from .reference import number_in, read_table
from .run_folder import read_echo

HEADER = ("run", "shear_time", "curve", "along_flow", "along_gradient")
MARKER = -1  # number of the "curve" that is the marker's place


@dataclasses.dataclass(frozen=True)
class Outline:
    """One moment of a run, seen from the centroid, over a: along the flow, along the gradient."""

    run: str
    shear_time: float
    curves: tuple  # of N x 2 points in their order around each curve; more than one where the membrane is folded
    marker: numpy.ndarray  # 2

    def radius_at(self, angles):
        """Distance from the centroid to the longest curve, at angles from the flow axis in radians."""
        curve = max(self.curves, key=len)
        around = numpy.arctan2(curve[:, 1], curve[:, 0])
        order = numpy.argsort(around)
        return numpy.interp(angles, around[order], numpy.linalg.norm(curve, axis=1)[order], period=2 * math.pi)


def centroid(points, triangles):
    """Of the enclosed volume, by the divergence theorem about the mean of the points."""
    middle = points.mean(axis=0)
    corners = (points - middle)[triangles]
    volumes = numpy.einsum("ni,ni->n", corners[:, 0], numpy.cross(corners[:, 1], corners[:, 2]))
    return middle + numpy.einsum("n,ni->i", volumes, corners.sum(axis=1)) / (4 * volumes.sum())


def cut(points, triangles, axis, at):
    """The closed curves, each N x 3, in which the plane x[axis] = at cuts a closed surface. A point on the plane counts as above it, so that each edge
    is cut once or not at all."""
    above = points[:, axis] >= at
    beyond = {}  # of each cut edge (low, high) the cut edges of its two triangles
    for triangle in triangles[above[triangles].any(axis=1) & ~above[triangles].all(axis=1)].tolist():
        ends = [(min(a, b), max(a, b)) for a, b in zip(triangle, triangle[1:] + triangle[:1]) if above[a] != above[b]]
        for edge, other in (ends, ends[::-1]):
            beyond.setdefault(edge, []).append(other)
    curves = []
    while beyond:
        edge, curve = next(iter(beyond)), []
        while edge is not None:
            curve.append(edge)
            edge = next((other for other in beyond.pop(edge) if other in beyond), None)
        low, high = numpy.array(curve).T
        share = (at - points[low, axis]) / (points[high, axis] - points[low, axis])
        curves.append(points[low] + share[:, None] * (points[high] - points[low]))
    return curves


def read_outline(directory, shear_time, tolerance=0.1):
    """The outline of a run at the membrane nearest to a shear time; None where none is within the tolerance, or there is no measures.csv."""
    directory = pathlib.Path(directory)
    found = series.at(directory / "membrane.pvd", shear_time)
    if found is None or abs(found[0] - shear_time) > tolerance or not (directory / "measures.csv").is_file():
        return None
    echo = read_echo(directory)
    axes = ["xyz".index(echo["flow"][axis]) for axis in ("flow_axis", "wall_axis")]
    vorticity, radius = 3 - sum(axes), echo["capsule"][0]["radius"]
    mesh = vtk_surfaces.read(found[1])
    points, triangles = mesh.points, mesh.cells_dict["triangle"]
    centre = centroid(points, triangles)
    curves = tuple((curve - centre)[:, axes] / radius for curve in cut(points, triangles, vorticity, centre[vorticity]))
    measures = Observables(directory, table="measures.csv")
    marker = numpy.array([measures.at(f"marker_{'xyz'[axis]}", min(found[0], measures["shear_time"][-1])) for axis in axes])
    return Outline(directory.name, round(found[0], 3), curves, marker)


def table_of(outlines):
    """The text of a table of outlines."""
    stream = io.StringIO()
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(HEADER)
    for one in outlines:
        for number, curve in [(MARKER, one.marker[None]), *enumerate(one.curves)]:
            # Edges that meet in a node on the plane are cut there, each of them: such a point is kept once.
            places = [(f"{x:.4f}", f"{z:.4f}") for x, z in curve]
            writer.writerows((one.run, f"{one.shear_time:g}", number, *place) for k, place in enumerate(places) if k == 0 or place != places[k - 1])
    return stream.getvalue()


def read_kept(file):
    """{(run, shear time): Outline} of such a table; nothing where there is no such file."""
    if not pathlib.Path(file).is_file():
        return {}
    curves = {}
    for row in read_table(file):
        _, time, number, *place = (row["run"], *(number_in(file, name, row) for name in HEADER[1:]))
        curves.setdefault((row["run"], time), {}).setdefault(int(number), []).append(place)
    return {
        (run, time): Outline(run, time, tuple(numpy.array(curve) for number, curve in found.items() if number != MARKER), numpy.array(found[MARKER][0]))
        for (run, time), found in curves.items()
    }
