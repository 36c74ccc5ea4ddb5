"""Surfaces of triangles in the formats of other programs."""

import pathlib

import meshio
import numpy

from . import gmsh_surfaces, ply_surfaces, text_surfaces, vtk_surfaces
from .faces import triangles_of
from .observables import InputError
from .surface import Surface


def _read_stl(file):
    """A binary STL by meshio, where the number in its head is that of its length; else one in ASCII."""
    with open(file, "rb") as stream:
        start = stream.read(84)
    n_bytes, n_triangles = file.stat().st_size, int.from_bytes(start[80:], "little")
    if n_bytes == 84 + 50 * n_triangles:
        return meshio.stl.read(str(file))
    if start.lstrip().lower().startswith(b"solid"):
        return text_surfaces.read_stl(file)
    raise InputError(
        f"{file}: it is no STL in ASCII, which begins with 'solid', nor a binary one: {n_triangles} triangles, as its head says, are "
        f"{84 + 50 * n_triangles} bytes, it has {n_bytes}; it is damaged or cut off: write or copy it again"
    )


READERS = {
    ".stl": _read_stl,
    ".obj": text_surfaces.read_obj,
    ".ply": ply_surfaces.read,
    ".off": text_surfaces.read_off,
    ".msh": gmsh_surfaces.read,
    ".vtu": vtk_surfaces.read,
    ".pvtu": vtk_surfaces.read,
    ".vtp": vtk_surfaces.read,
}
WRITTEN = (".stl", ".obj", ".ply", ".off", ".msh", ".vtu")
HAVE_TEXT_AND_BINARY = (".stl", ".ply", ".msh")
FLAT = {"triangle", "quad", "polygon"}


def suffix_of(file, known=tuple(READERS)):
    """The suffix in small letters, if it is one of the known. @throws InputError"""
    suffix = pathlib.Path(file).suffix.lower()
    if suffix not in known:
        raise InputError(f"{file}: its name must end with one of {', '.join(known)}, which says the format")
    return suffix


def read_mesh(file):
    """The whole file as a meshio.Mesh, with as many points and cells as its head says. Whatever a reader throws is a refusal."""
    file, suffix = pathlib.Path(file), suffix_of(file)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    if file.stat().st_size == 0:
        raise InputError(f"{file}: it is empty")
    try:
        return READERS[suffix](file)
    except (InputError, OSError):
        raise
    except Exception as error:
        words = f"{type(error).__name__}: {error}" if str(error) else type(error).__name__
        raise InputError(f"{file}: it cannot be read ({words}); it is damaged, cut off, or not of the format that its name says") from error


def read_surface(file):
    """(Surface, notes): all triangles of the file, and its faces of more corners, split. @throws InputError"""
    mesh = read_mesh(file)
    points = _coordinates(numpy.asarray(mesh.points), file)
    flat = [block for block in mesh.cells if block.type in FLAT and len(block.data)]
    others = sorted({block.type for block in mesh.cells} - FLAT)
    _require_faces(flat, others, file)
    _require_nodes_that_exist(flat, len(points), file)
    triangles, faces = triangles_of(points, [block.data for block in flat], file)
    notes = [f"left out: cells of kind {', '.join(others)}"] if others else []
    arrays = [*mesh.point_data, *mesh.cell_data]
    if arrays:
        notes.append(f"left out: arrays {', '.join(arrays)}")
    return Surface(points, triangles, numpy.arange(len(points)), faces), notes + _notes_of_splitting(flat)


def _notes_of_splitting(flat):
    """A line for the faces of four corners, and one for those of more."""
    n_quads = sum(len(block.data) for block in flat if block.data.shape[1] == 4)
    n_polygons = sum(len(block.data) for block in flat if block.data.shape[1] > 4)
    notes = [f"split {n_quads} quadrilaterals into two triangles each, along the shorter diagonal"] if n_quads else []
    return notes + ([f"split {n_polygons} faces of five corners or more into triangles"] if n_polygons else [])


def _coordinates(points, file):
    """N x 3 doubles. Numbers after the third are colours or weights of an OBJ."""
    if points.ndim != 2 or points.shape[1] < 3:
        n = points.shape[1] if points.ndim == 2 else 0
        raise InputError(f"{file}: there are no triangles" if n == 0 else f"{file}: its points have {n} coordinates; a membrane needs 3")
    return numpy.array(points[:, :3], dtype=float)


def _require_faces(flat, others, file):
    curved = [kind for kind in others if kind.startswith(("triangle", "quad"))]
    if curved:
        raise InputError(f"{file}: it has curved cells ({', '.join(curved)}), whose shape would be lost; write it with straight ones, of order 1")
    fewest = min((block.data.shape[1] for block in flat), default=3)
    if fewest < 3:
        raise InputError(f"{file}: a face has {fewest} corners only; the file is damaged or cut off")
    if not flat:
        only = f", only cells of kind {', '.join(others)}; write its surface" if others else ""
        raise InputError(f"{file}: there are no triangles{only}")


def _require_nodes_that_exist(flat, n_points, file):
    first = 0
    for block in flat:
        wrong = numpy.argwhere((block.data < 0) | (block.data >= n_points))
        if len(wrong):
            face, corner = wrong[0]
            raise InputError(f"{file}: face {first + face} names node {block.data[face, corner]}, of 0 to {n_points - 1}; the file is damaged")
        first += len(block.data)


def write_surface(file, suffix, surface, ascii=False, gmsh_version="4.1"):
    """Writes points and triangles. ASCII means text with all digits of a double; .obj and .off are always text."""
    # PLY has no 64-bit integers: meshio would say that it makes them shorter.
    kind = numpy.int32 if suffix == ".ply" else numpy.int64
    mesh = meshio.Mesh(surface.points, [("triangle", surface.triangles.astype(kind))])
    if suffix in (".stl", ".ply"):
        {".stl": meshio.stl, ".ply": meshio.ply}[suffix].write(file, mesh, binary=not ascii)
    elif suffix == ".msh":
        _write_gmsh(file, mesh, ascii, gmsh_version)
    else:
        {".obj": meshio.obj, ".off": meshio.off, ".vtu": meshio.vtu}[suffix].write(file, mesh)


def _write_gmsh(file, mesh, ascii, version):
    """Gmsh's format of that version."""
    if version == "2.2":  # has a physical and a geometrical number with each triangle; meshio would warn that it makes them up
        ones = numpy.ones(len(mesh.cells[0].data), dtype=numpy.int32)
        mesh.cell_data = {"gmsh:physical": [ones], "gmsh:geometrical": [ones]}
    meshio.gmsh.write(file, mesh, fmt_version=version, binary=not ascii)
