"""Gmsh's .msh, read by meshio, and held against the numbers in its head.

meshio 5.0.0 reads as many blocks as are announced and leaves out what follows; of points that are announced and not there (version 4 in
text, 4.1) it makes some up. Names and groups, which are left out here, can make it refuse a file: it gets points and elements only.
"""

import pathlib
import re
import tempfile

import meshio
import numpy

from .observables import InputError

READ = ("MeshFormat", "Nodes", "Elements")  # the sections that hold a surface


def read(file):
    """A meshio.Mesh of the points and elements of a .msh."""
    sections = _sections(file)
    version, binary, size_of_size = _format(file, sections)
    said = _said(file, sections["Nodes"], version, binary, size_of_size), _said(file, sections["Elements"], version, binary, size_of_size)
    _require_points(file, sections["Nodes"], said[0], version, binary, size_of_size)
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "surface.msh"
        sections["MeshFormat"] = version.encode() + sections["MeshFormat"][sections["MeshFormat"].index(b" ") :]
        copy.write_bytes(b"".join(b"$%s\n%s$End%s\n" % (name.encode(), sections[name], name.encode()) for name in READ))
        mesh = meshio.gmsh.read(copy)
    found = len(mesh.points), sum(len(block.data) for block in mesh.cells)
    if found != tuple(numbers[-1] for numbers in said):
        expected = f"{said[0][-1]} points and {said[1][-1]} elements"
        raise InputError(f"{file}: its head says {expected}, it holds {found[0]} and {found[1]}; it is damaged: write or copy it again")
    return meshio.Mesh(mesh.points, mesh.cells)


def _sections(file):
    """{name: what stands between $NAME and $EndNAME} of those that are read, each once."""
    text, sections = file.read_bytes(), {}
    for name in READ:
        found = re.findall(rb"^\$%s[ \t]*\r?\n(.*?)\$End%s\b" % (name.encode(), name.encode()), text, re.DOTALL | re.MULTILINE)
        if len(found) != 1:
            raise InputError(f"{file}: it has {len(found)} whole sections ${name}, must be one; it is damaged, cut off, or no .msh of version 2.2, 4.0 or 4.1")
        sections[name] = found[0]
    return sections


def _format(file, sections):
    """(version, whether binary, the size of a size). Gmsh calls 4.0 "4", as others do 4.1, whose points begin with four numbers, not two."""
    words = sections["MeshFormat"].split()[:3]
    try:
        version, binary, size = words[0].decode(), int(words[1]), int(words[2])
    except (ValueError, IndexError):
        raise InputError(f"{file}: its $MeshFormat is not that of a .msh; it is damaged") from None
    numbers = len(sections["Nodes"].split(b"\n", 1)[0].split())
    version = {"2": "2.2", "4": "4.0" if not binary and numbers == 2 else "4.1"}.get(version, version)
    if version not in ("2.2", "4.0", "4.1") or binary not in (0, 1) or size != 8:
        raise InputError(f"{file}: it is of version {version} with sizes of {size} bytes; write it as version 2.2, 4.0 or 4.1 (8 bytes)")
    return version, bool(binary), size


def _said(file, section, version, binary, size):
    """The numbers at the start of a section: (number), of version 4: (number of blocks, number)."""
    n = {"2.2": 1, "4.0": 2, "4.1": 2}[version]
    try:
        if binary and version != "2.2":
            return tuple(int(value) for value in numpy.frombuffer(section[: n * size], dtype=f"u{size}"))
        return tuple(int(word) for word in section.split(None, n)[:n])
    except ValueError:
        raise InputError(f"{file}: a section begins with no number; it is damaged") from None


def _require_points(file, section, said, version, binary, size):
    """As many points as announced: by the length of the section, in words of text, or in bytes (a line end among them)."""
    blocks, n = said[0] if len(said) > 1 else 0, said[-1]
    if binary:
        expected = {"2.2": len(f"{n}\n") + 28 * n, "4.0": 2 * size + (12 + size) * blocks + 28 * n, "4.1": 4 * size + (12 + size) * blocks + (size + 24) * n}
        right = 0 <= len(section) - expected[version] <= 2
    else:
        expected = {"2.2": 1 + 4 * n, "4.0": 2 + 4 * blocks + 4 * n, "4.1": 4 + 4 * blocks + 4 * n}
        right = len(section.split()) == expected[version]
    if not right:
        raise InputError(f"{file}: its head says {n} points, and its section $Nodes does not hold as many, with three coordinates each (Mesh.SaveParametric = 0); write it again")
