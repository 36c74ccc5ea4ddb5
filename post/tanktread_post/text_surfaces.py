"""Surfaces in text, to the last digit: Wavefront OBJ, STL in ASCII, OFF.

meshio 5.0.0 refuses, or takes for something else, much that other programs write into them: normals of faces and negative node numbers in
an OBJ, capital letters and an empty last line in an STL, comments, quadrilaterals and colours in an OFF. VTK reads them in single precision.
Each reader gives a meshio.Mesh of points and faces, and raises InputError with the number of the line.
"""

import meshio
import numpy

from .faces import blocks_of
from .observables import InputError


def _lines(file, continued=False):
    """(number, words) of each line that has any, without comments ('#' to the end of the line). `continued`: a '\\' at a line's end joins the next one."""
    text = file.read_text(encoding="utf-8", errors="replace")
    joined, first = "", None
    for number, line in enumerate(text.splitlines(), 1):
        first = first or number
        joined += line.split("#")[0]
        if continued and joined.rstrip().endswith("\\"):
            joined = joined.rstrip()[:-1] + " "
            continue
        if joined.split():
            yield first, joined.split()
        joined, first = "", None


def _numbers(file, line, words, kind, least=0):
    """The words as numbers, at least so many."""
    numbers = []
    for word in words:
        try:
            numbers.append(kind(word.replace("_", "?")))  # to Python 1_0 is ten
        except ValueError:
            what = "whole number" if kind is int else "number"
            raise InputError(f"{file}, line {line}: '{word}' is no {what}; the file is damaged, or of another format") from None
    if len(numbers) < least:
        raise InputError(f"{file}, line {line}: {len(numbers)} numbers where {least} must be; the file is damaged or cut off")
    return numbers


def _mesh(points, faces):
    return meshio.Mesh(numpy.array(points, dtype=float).reshape(-1, 3), blocks_of(faces))


# What an OBJ may hold besides faces that has a place in space, and how it is called when it is left out. All else says how a face looks.
LEFT_OUT = {"l": "line", "p": "vertex", "curv": "curve", "surf": "free-form surface"}


def read_obj(file):
    """Wavefront OBJ: v and f. Normals, textures, groups, materials and colours are left out."""
    points, faces, others = [], [], set()
    for line, (key, *words) in _lines(file, continued=True):
        if key == "v":
            points.append(_numbers(file, line, words, float, least=3)[:3])
        elif key == "f":
            faces.append(_corners(file, line, words, len(points)))
        elif key in LEFT_OUT:
            others.add(LEFT_OUT[key])
    mesh = _mesh(points, faces)
    mesh.cells += [meshio.CellBlock(kind, numpy.empty((0, 1), dtype=int)) for kind in sorted(others)]
    return mesh


def _corners(file, line, words, n_points):
    """The nodes of a face, from 0: of node, node/texture/normal, ..., numbered from 1, or backwards from -1, the last one so far."""
    numbers = _numbers(file, line, [word.split("/")[0] for word in words], int)
    nodes = [number - 1 if number > 0 else n_points + number for number in numbers]
    if 0 in numbers or min(nodes, default=0) < 0:
        raise InputError(f"{file}, line {line}: a face names node {min(numbers)}; nodes count from 1, or from -1 backwards to -{n_points}, the first so far")
    return nodes


def read_stl(file):
    """STL in ASCII, any number of solids: the corners of its facets, equal ones made one. The normals are left out."""
    corners, opened, closed, n_facets = [], 0, 0, 0
    for line, (key, *words) in _lines(file):
        key = key.lower()
        if key == "vertex":
            corners.append(_numbers(file, line, words, float, least=3)[:3])
        elif key == "endfacet":
            n_facets += 1
            if len(corners) != 3 * n_facets:
                raise InputError(f"{file}, line {line}: a facet ends that has not three vertices; the file is damaged")
        elif key in ("solid", "endsolid"):
            opened, closed = opened + (key == "solid"), closed + (key == "endsolid")
        elif key not in ("facet", "outer", "endloop"):
            raise InputError(f"{file}, line {line}: it begins with '{key}', as no line of an STL does; the file is damaged, or of another format")
    if len(corners) != 3 * n_facets or opened != closed:
        raise InputError(f"{file}: it ends within a solid, after {n_facets} facets; it is cut off: write or copy it again")
    if not corners:
        return _mesh([], [])
    points, first, inverse = numpy.unique(numpy.array(corners), axis=0, return_index=True, return_inverse=True)
    order = numpy.argsort(first)  # of their first appearance
    return meshio.Mesh(points[order], [("triangle", numpy.argsort(order)[inverse].reshape(-1, 3))])


def read_off(file):
    """OFF, with normals, colours and textures of points (NOFF, COFF, STOFF) or colours of faces, all of which are left out."""
    lines = list(_lines(file))
    kind = lines[0][1][0] if lines else ""
    if kind.removeprefix("ST").removeprefix("C").removeprefix("N") != "OFF" or lines[0][1][1:2] == ["BINARY"]:
        raise InputError(f"{file}: its first word is '{kind}', must be OFF, COFF, NOFF or STOFF, in text; the file is of another format")
    lines[0] = (lines[0][0], lines[0][1][1:])  # the counts may stand beside it
    lines = lines if lines[0][1] else lines[1:]
    if not lines:
        raise InputError(f"{file}: it ends after its first word; it is cut off: write or copy it again")
    n_points, n_faces = _numbers(file, *lines[0], int, least=2)[:2]
    if min(n_points, n_faces) < 0 or len(lines) != 1 + n_points + n_faces:
        raise InputError(f"{file}: it has {len(lines) - 1} lines after its counts, which are {n_points} points and {n_faces} faces; it is damaged or cut off")
    points = [_numbers(file, line, words[:3], float, least=3) for line, words in lines[1 : 1 + n_points]]
    return _mesh(points, [_off_face(file, *line) for line in lines[1 + n_points :]])


def _off_face(file, line, words):
    (n,) = _numbers(file, line, words[:1], int)
    return _numbers(file, line, words[1 : 1 + n], int, least=n)
