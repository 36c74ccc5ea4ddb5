"""Surfaces and grids in pieces: the files that an index, .pvtu or .pvti, names, and surfaces put together of them."""

import xml.etree.ElementTree

import meshio
import numpy

from .observables import InputError

KINDS = {".pvtu": "PUnstructuredGrid", ".pvti": "PImageData"}


def is_index(file):
    return file.suffix.lower() in KINDS


def pieces_of(file):
    """The pieces of an index, in its order; all of them are there. @throws InputError"""
    root, kind = _parsed(file), KINDS[file.suffix.lower()]
    main = root.find(kind)
    if root.get("type") != kind or main is None:
        raise InputError(f"{file}: it holds {root.get('type', 'no kind of data')}, where its name says {kind}; it is damaged, or of another format")
    if kind == "PUnstructuredGrid" and main.get("GhostLevel", "0") != "0":
        raise InputError(f"{file}: its pieces overlap (GhostLevel=\"{main.get('GhostLevel')}\"), and triangles would be there twice; write it without ghost cells")
    names = [piece.get("Source") for piece in main.iter("Piece")]
    if not names or None in names:
        raise InputError(f"{file}: it names no piece, or one without its Source; it is damaged: write or copy it again")
    if len(set(names)) < len(names):
        raise InputError(f"{file}: it names a piece twice; it is damaged: write or copy it again")
    pieces = [file.parent / name for name in names]
    for piece in pieces:
        if not piece.is_file():
            raise InputError(f"{piece}: there is no such file, a piece of {file}")
    return pieces


def _parsed(file):
    try:
        return xml.etree.ElementTree.fromstring(file.read_bytes())
    except xml.etree.ElementTree.ParseError as error:
        raise InputError(f"{file}: it is not VTK's XML ({error}); it is damaged, cut off, or of another format") from None


def joined(meshes, pieces, file):
    """One meshio.Mesh of those of the pieces of an index: points and cells one piece's after the other's. @throws InputError"""
    filled = [(mesh, piece) for mesh, piece in zip(meshes, pieces) if len(mesh.points)]
    if not filled:
        return meshes[0]
    names = _names(filled, file)
    blocks, first = [], 0  # of each block its kind, and of each piece that has cells there nodes and arrays
    for mesh, _ in filled:
        for k, block in enumerate(mesh.cells):
            part = (block.data + first, {name: mesh.cell_data[name][k] for name in names[1]})
            if blocks and blocks[-1][0] == block.type and blocks[-1][1][-1][0].shape[1] == block.data.shape[1]:
                blocks[-1][1].append(part)
            else:
                blocks.append((block.type, [part]))
        first += len(mesh.points)
    return meshio.Mesh(
        numpy.concatenate([mesh.points for mesh, _ in filled]),
        [(kind, numpy.concatenate([nodes for nodes, _ in parts])) for kind, parts in blocks],
        point_data={name: numpy.concatenate([mesh.point_data[name] for mesh, _ in filled]) for name in names[0]},
        cell_data={name: [numpy.concatenate([arrays[name] for _, arrays in parts]) for _, parts in blocks] for name in names[1]},
        field_data=_field_data(zip(meshes, pieces), file),
    )


def _names(filled, file):
    """(names of point data, of cell data), which all pieces have."""
    first, of_first = filled[0]
    for mesh, piece in filled[1:]:
        for ours, others in ((first.point_data, mesh.point_data), (first.cell_data, mesh.cell_data)):
            if set(ours) != set(others):
                found = ", ".join(sorted(set(ours) ^ set(others)))
                raise InputError(f"{piece}: of {found} it has what {of_first} lacks, or lacks what that has; pieces of {file} have the same arrays")
    return list(first.point_data), list(first.cell_data)


def _field_data(meshes, file):
    """The numbers of the whole, which all pieces have, and those that one has by itself. A hash is that of one piece."""
    found = {}
    for mesh, piece in meshes:
        for name, values in mesh.field_data.items():
            if name in ("content_hash", "padding_for_meshio"):
                continue
            if not numpy.array_equal(found.setdefault(name, values), values, equal_nan=True):
                raise InputError(f"{piece}: has another '{name}' than the other pieces of {file}: they do not belong together; write or copy all again")
    return found
