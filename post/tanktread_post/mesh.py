"""Meshes made elsewhere (STL, OBJ, PLY, Gmsh ...) as the .vtu that `mesh = { file = ... }` of a case reads."""

import meshio
import numpy

from .observables import InputError


def merge_equal_points(points, triangles):
    """Points that coincide to the last bit become one: an STL repeats every corner for each of its triangles."""
    unique, inverse = numpy.unique(points, axis=0, return_inverse=True)
    return unique, inverse.reshape(-1)[triangles]


def convert(source, target):
    """Reads any mesh that meshio knows, keeps its triangles, writes a .vtu of doubles."""
    try:
        mesh = meshio.read(source)
    except (OSError, meshio.ReadError, SystemExit) as error:
        raise InputError(f"{source}: cannot be read: {error}") from error
    blocks = [block.data for block in mesh.cells if block.type == "triangle"]
    if not blocks:
        kinds = ", ".join(sorted({block.type for block in mesh.cells})) or "no cells"
        raise InputError(f"{source}: there are no triangles, only {kinds}; triangulate its surface first")
    if mesh.points.shape[1] != 3:
        raise InputError(f"{source}: its points have {mesh.points.shape[1]} coordinates; a membrane needs 3")
    points, triangles = merge_equal_points(mesh.points.astype(float), numpy.concatenate(blocks))
    meshio.write(target, meshio.Mesh(points, [("triangle", triangles.astype(numpy.int64))]), file_format="vtu")
    return len(points), len(triangles)
