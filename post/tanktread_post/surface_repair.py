"""Makes a surface from another program one that a capsule can have, or says what stands against it and where."""

import numpy
from vtkmodules.vtkCommonCore import reference, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPointLocator

from . import surface_defects
from .observables import InputError
from .surface import MERGE_TOLERANCE, Edges, Surface, flood


def repaired(surface, file, merge_tolerance=MERGE_TOLERANCE, body=None):
    """(Surface, notes): points merged, leftovers dropped, all triangles wound so that the volume is positive.

    `merge_tolerance`: a fraction of the diagonal of the box around the surface. `body`: which separate part to take.
    @throws InputError with every defect that is left, each with the name of the file
    """
    surface_defects.require_finite(surface, file)
    n_points = len(surface.points)
    surface = surface.of_triangles(slice(None))
    notes = _note("dropped", n_points - len(surface.points), "point", "of no triangle")
    surface, more = _merged(surface, merge_tolerance * surface.size(), file)
    surface, part = _one_body(surface, body, file)
    edges = Edges(surface.triangles)
    parts, turn = flood(edges)
    surface_defects.require_closed(surface, edges, parts, merge_tolerance, file)
    surface_defects.require_two_sides(surface, edges, turn, file)
    surface, turned = _outward(surface, turn)
    surface_defects.require_a_sphere(surface, Edges(surface.triangles), file)
    return surface, notes + more + part + turned


def _note(done, n, noun, which):
    """A line for what was done to n of these, if any."""
    return [f"{done} {surface_defects.counted(n, noun)} {which}"] if n else []


def _merged(surface, distance, file):
    """Equal points made one; triangles that collapse by it dropped, and those that are there twice."""
    first, of_point = first_within(surface.points, distance)
    notes = _note("merged", len(surface.points) - len(first), "point", "with another one")
    joined = Surface(surface.points, first[of_point][surface.triangles], surface.nodes, surface.faces)
    a, b, c = joined.triangles.T
    whole = (a != b) & (b != c) & (c != a)
    notes += _note("dropped", int((~whole).sum()), "triangle", "with a corner twice")
    if not whole.any():
        apart = (surface.sides() > 0).all(axis=1).any()
        fix = "lower --merge-tolerance" if apart else "all of its triangles have two corners at one place: it is no surface"
        raise InputError(f"{file}: no triangle is left after merging points nearer than {distance:g}; {fix}")
    surface = joined.of_triangles(whole)
    _, once = numpy.unique(numpy.sort(surface.triangles, axis=1), axis=0, return_index=True)
    notes += _note("dropped", len(surface.triangles) - len(once), "triangle", "with the corners of another one")
    return surface.of_triangles(numpy.sort(once)), notes


def first_within(points, distance):
    """(first, of_point): the points that stay, none nearer to an earlier one than the distance; of each point, which one
    of these it becomes. Positions are never averaged, so that what is not merged keeps every bit."""
    kept, locator = vtkPoints(), vtkPointLocator()
    kept.SetDataTypeToDouble()
    locator.SetTolerance(distance)
    bounds = numpy.stack([points.min(axis=0), points.max(axis=0)], axis=1)
    locator.InitPointInsertion(kept, bounds.ravel(), len(points))
    number, first, of_point = reference(0), [], numpy.empty(len(points), dtype=int)
    for k, point in enumerate(points):
        if locator.InsertUniquePoint(point, number):
            first.append(k)
        of_point[k] = number.get()
    return numpy.array(first), of_point


def _one_body(surface, body, file):
    """The part of that number, if one is asked for."""
    if body is None:
        return surface, []
    parts, _ = flood(Edges(surface.triangles))
    n_parts = int(parts.max()) + 1
    if not 0 <= body < n_parts:
        raise InputError(f"{file}: --body {body}: it has {n_parts} separate bodies, numbered from 0")
    return surface.of_triangles(parts == body), [f"took body {body} of {n_parts}"]


def _outward(surface, turn):
    """Triangles turned to one winding, and all of them if they then enclose a negative volume."""
    consistent = surface.turned(turn)
    if consistent.volume() < 0:
        turn = ~turn
        consistent = surface.turned(turn)
    if turn.all():
        return consistent, ["turned all triangles: the surface was inside out"]
    return consistent, _note("turned", int(turn.sum()), "triangle", "wound against the others")
