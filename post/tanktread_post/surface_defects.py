"""What keeps a surface from being a capsule's membrane: each refusal says what, where and what to do.

Nodes and faces go by their numbers in the file, from 0, and by their positions.
"""

import itertools

import numpy

from .observables import InputError
from .surface import Edges, n_fans

MOST_PLACES = 3  # that a message names
LOWEST = 1e-6  # height of a triangle, as a fraction of the size: the rounding of single precision, and some
SMALLEST = 1e-12  # area, as a fraction of the longest side's square, as `tanktread mesh info` has it; volume, of the size's cube


def counted(n, noun):
    """1 edge, 2 edges."""
    return f"{n} {noun}{'' if n == 1 else 's'}"


def require_finite(surface, file):
    """Every point of a triangle has finite coordinates."""
    used = numpy.unique(surface.triangles)
    wrong = used[~numpy.isfinite(surface.points[used]).all(axis=1)]
    if len(wrong):
        places = [_node(surface, k) for k in wrong[:MOST_PLACES]]
        count = counted(len(wrong), "point")
        raise InputError(f"{file}: {count} without finite coordinates: {_listed(places, len(wrong))}; mend them where they were made")


def require_closed(surface, edges, parts, merge_tolerance, file):
    """Every edge has two triangles, there is one body, every triangle has an area."""
    several = edges.n_triangles > 2
    defects = [
        _of_edges(surface, edges, edges.n_triangles == 1, "the surface is open: {count} with one triangle only",
                  f"close the holes where it was made, or raise --merge-tolerance ({merge_tolerance:g}) if its seams do not meet"),
        _of_edges(surface, edges, several, "{count} with three triangles or more",
                  "take the inner walls and sheets out where it was made" + _closed_parts(surface, parts, several)),
        # Walls that meet part the surface in pieces that are no bodies.
        None if several.any() else _of_bodies(surface, parts),
        _of_areas(surface),
    ]  # fmt: skip
    _refuse(defects, file)


def require_two_sides(surface, edges, turn, file):
    """Turned as the flood says, neighbours run through their edge in opposite directions."""
    clash = numpy.zeros(len(edges.nodes), dtype=bool)
    clash[edges.edge[edges.clash(numpy.arange(len(edges.edge)), turn)]] = True
    what = "the surface has one side only, no outside: going over it from the first triangle, the windings clash at {count}"
    _refuse([_of_edges(surface, edges, clash, what, "part it there and join it as it should be")], file)


def require_a_sphere(surface, edges, file):
    """A closed, consistently wound surface that encloses a volume and is one sphere: no node where it touches itself, no handle."""
    fans = n_fans(edges)
    pinched = numpy.flatnonzero(fans > 1)
    euler_number = len(surface.points) - len(edges.nodes) + len(surface.triangles)
    defects = []
    if len(pinched):
        places = [f"{_node(surface, k)} with {fans[k]} fans of triangles" for k in pinched[:MOST_PLACES]]
        where = f"{counted(len(pinched), 'node')}: {_listed(places, len(pinched))}"
        defects.append(f"the surface touches itself in {where}; give each side a node of its own there")
    elif euler_number != 2:
        defects.append(f"the surface is not one sphere (nodes - edges + triangles is {euler_number}, must be 2); fill its handles")
    if not surface.volume() > SMALLEST * surface.size() ** 3:
        defects.append(f"the surface encloses no volume ({surface.volume():g}); it is flat, or one half of it is inside out")
    _refuse(defects, file)


def _refuse(defects, file):
    text = "\n".join(f"{file}: {defect}" for defect in defects if defect)
    if text:
        raise InputError(text)


def _listed(places, n):
    """The places, and how many more there are."""
    return "; ".join(places) + (f"; and {n - len(places)} more" if n > len(places) else "")


def _position(values):
    return f"({', '.join(f'{value:.6g}' for value in values)})"


def _node(surface, node):
    return f"node {surface.nodes[node]} at {_position(surface.points[node])}"


def _of_edges(surface, edges, wrong, what, fix):
    """The defect of these edges (truth values), or None."""
    chosen = numpy.flatnonzero(wrong)
    if not len(chosen):
        return None
    places = []
    for edge in chosen[:MOST_PLACES]:
        a, b = (_node(surface, node) for node in edges.nodes[edge])
        faces = ", ".join(str(surface.faces[triangle]) for triangle in edges.triangles_at(edge))
        places.append(f"from {a} to {b} (face {faces})")
    return f"{what.format(count=counted(len(chosen), 'edge'))}: {_listed(places, len(chosen))}; {fix}"


def _closed_parts(surface, parts, several):
    """How to take a part that is closed by itself, if there is one: walls cut others open."""
    if not several.any():
        return ""
    closed = (body for body in range(int(parts.max()) + 1) if (Edges(surface.of_triangles(parts == body).triangles).n_triangles == 2).all())
    return "".join(f", or take the part that is closed by itself: --body {body}" for body in itertools.islice(closed, 1))


def _of_bodies(surface, parts):
    n_bodies = int(parts.max()) + 1
    if n_bodies == 1:
        return None
    places = []
    for body in range(min(n_bodies, MOST_PLACES)):
        part = surface.of_triangles(parts == body)
        places.append(f"body {body} of {len(part.triangles)} triangles about {_position(part.points.mean(axis=0))}")
    return f"it has {n_bodies} separate bodies: {_listed(places, n_bodies)}; a capsule is one of them: take it with --body K"


def _of_areas(surface):
    """Triangles too low to have a shape, or without an area for `tanktread mesh info`."""
    areas, sides = surface.areas(), surface.sides()
    low = 2 * areas <= LOWEST * surface.size() * sides.max(axis=1)
    flat = numpy.flatnonzero(low | (areas < SMALLEST * sides.max() ** 2))
    if not len(flat):
        return None
    places = [
        f"face {surface.faces[k]} of nodes {', '.join(str(n) for n in surface.nodes[surface.triangles[k]])} "
        f"about {_position(surface.corners()[k].mean(axis=0))}"
        for k in flat[:MOST_PLACES]
    ]
    fix = "take them out where it was made and join their neighbours"
    return f"{counted(len(flat), 'triangle')} without area: {_listed(places, len(flat))}; {fix}"
