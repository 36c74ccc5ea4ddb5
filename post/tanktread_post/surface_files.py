"""Surfaces of triangles in the formats of other programs, through meshio."""

import pathlib

import meshio
import numpy

from .observables import InputError
from .surface import Surface

# What meshio cannot read, though other programs write it: it often says no more than "cannot reshape array".
LIMITS = {
    ".stl": "ASCII STL must be in small letters and without a blank line at its end",
    ".obj": "it must have faces of absolute node numbers and nothing else but v, vt, vn, g, s",
    ".ply": "the list of a face must be named vertex_indices; a binary PLY may have no other property of faces",
    ".off": "its first line must be OFF alone, its counts parted by single blanks; triangles only, no colours, no comments further down",
    ".msh": "it must be a Gmsh file of version 2.2, 4.0 or 4.1",
    ".vtu": "it must be a VTK unstructured grid of file version 0.1 or 1.0, uncompressed, zlib or lzma",
}
READERS = {
    ".stl": meshio.stl.read,
    ".obj": meshio.obj.read,
    ".ply": meshio.ply.read,
    ".off": meshio.off.read,
    ".msh": meshio.gmsh.read,
    ".vtu": meshio.vtu.read,
}
HAVE_TEXT_AND_BINARY = (".stl", ".ply", ".msh")
FLAT = {"triangle", "quad", "polygon"}


def suffix_of(file):
    """The suffix in small letters, if it is one of ours. @throws InputError"""
    suffix = pathlib.Path(file).suffix.lower()
    if suffix not in READERS:
        raise InputError(f"{file}: its name must end with one of {', '.join(READERS)}, which says the format")
    return suffix


def read_mesh(file):
    """The file as meshio reads it. meshio's readers let through what their parsers throw, so any exception is a refusal."""
    file, suffix = pathlib.Path(file), suffix_of(file)
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    if file.stat().st_size == 0:
        raise InputError(f"{file}: it is empty")
    try:
        return READERS[suffix](str(file))
    except Exception as error:
        words = f"{type(error).__name__}: {error}" if str(error) else f"{type(error).__name__}, without a reason"
        raise InputError(
            f"{file}: meshio cannot read it ({words}); it may be damaged or cut off. Otherwise: {LIMITS[suffix]}; "
            "another program, such as MeshLab, can write it anew"
        ) from error


def read_surface(file):
    """(Surface, notes): all triangles of the file and its quadrilaterals, each split in two. @throws InputError"""
    mesh = read_mesh(file)
    points = _coordinates(numpy.asarray(mesh.points), file)
    flat = [block for block in mesh.cells if block.type in FLAT and len(block.data)]
    others = sorted({block.type for block in mesh.cells} - FLAT)
    _require_triangles_or_quads(flat, others, file)
    _require_nodes_that_exist(flat, len(points), file)
    triangles, faces = _triangles(points, flat)
    notes = [f"left out: cells of kind {', '.join(others)}"] if others else []
    n_quads = len(triangles) - faces[-1] - 1
    if n_quads:
        notes.append(f"split {n_quads} quadrilaterals into two triangles each, along the shorter diagonal")
    return Surface(points, triangles, numpy.arange(len(points)), faces), notes


def _coordinates(points, file):
    """N x 3 doubles. Numbers after the third are colours or weights of an OBJ."""
    if points.ndim != 2 or points.shape[1] < 3:
        n = points.shape[1] if points.ndim == 2 else 0
        raise InputError(f"{file}: there are no triangles" if n == 0 else f"{file}: its points have {n} coordinates; a membrane needs 3")
    return numpy.array(points[:, :3], dtype=float)


def _require_triangles_or_quads(flat, others, file):
    curved = [kind for kind in others if kind.startswith(("triangle", "quad"))]
    if curved:
        raise InputError(f"{file}: it has curved cells ({', '.join(curved)}); write it with straight ones (gmsh -order 1)")
    corners = sorted({block.data.shape[1] for block in flat} - {3, 4})
    if corners and corners[0] < 3:
        raise InputError(f"{file}: a face has {corners[0]} corners only; the file is damaged or cut off")
    if corners:
        raise InputError(
            f"{file}: it has faces of {', '.join(map(str, corners))} corners; triangulate it where it was made "
            "(Blender: Triangulate Faces; MeshLab: Turn into a Pure-Triangular mesh)"
        )
    if not flat:
        only = f", only cells of kind {', '.join(others)}; triangulate its surface" if others else ""
        raise InputError(f"{file}: there are no triangles{only}")


def _require_nodes_that_exist(flat, n_points, file):
    first = 0
    for block in flat:
        wrong = numpy.argwhere((block.data < 0) | (block.data >= n_points))
        if len(wrong):
            face, corner = wrong[0]
            raise InputError(
                f"{file}: face {first + face} names node {block.data[face, corner]}, of 0 to {n_points - 1}; "
                "an OBJ must have absolute node numbers (not negative ones)"
            )
        first += len(block.data)


def _triangles(points, flat):
    """(triangles, the number of the face that each comes from); faces are numbered in the order of the file."""
    triangles, faces, first = [], [], 0
    for block in flat:
        data, numbers = numpy.asarray(block.data, dtype=numpy.int64), first + numpy.arange(len(block.data))
        first += len(data)
        if data.shape[1] == 4:
            data, numbers = _split(points, data), numpy.repeat(numbers, 2)
        triangles.append(data)
        faces.append(numbers)
    return numpy.concatenate(triangles), numpy.concatenate(faces)


def _split(points, quads):
    """Two triangles a quadrilateral, wound as it is, along the shorter diagonal."""
    with numpy.errstate(invalid="ignore"):  # what is not finite is refused later, with its place
        diagonal = [numpy.linalg.norm(points[quads[:, k]] - points[quads[:, k + 2]], axis=1) for k in (0, 1)]
    turned = (diagonal[1] < diagonal[0])[:, None]
    a, b, c, d = numpy.where(turned, numpy.roll(quads, -1, axis=1), quads).T
    return numpy.stack([a, b, c, a, c, d], axis=1).reshape(-1, 3)


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
