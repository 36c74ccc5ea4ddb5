"""PLY, in text and binary, with any elements and properties besides points and faces; all of it must be there, and no more.

meshio 5.0.0 knows one name of the list of a face, and takes other properties of faces in a binary file for nodes. VTK reads single precision.
"""

import meshio
import numpy

from .faces import blocks_of
from .observables import InputError

TYPES = {
    "char": "i1", "int8": "i1", "uchar": "u1", "uint8": "u1", "short": "i2", "int16": "i2", "ushort": "u2", "uint16": "u2",
    "int": "i4", "int32": "i4", "uint": "u4", "uint32": "u4", "int64": "i8", "uint64": "u8",
    "float": "f4", "float32": "f4", "double": "f8", "float64": "f8",
}  # fmt: skip
FORMATS = {"ascii": None, "binary_little_endian": "<", "binary_big_endian": ">"}
CORNERS = ("vertex_indices", "vertex_index")  # names of the list of a face


class _Values:
    """The numbers behind the head, one after the other."""

    def __init__(self, file, body, byte_order):
        self.file, self.order, self.place = file, byte_order, 0
        self.data = body.replace(b"_", b"?").split() if byte_order is None else body  # to Python 1_0 is ten

    def take(self, kind, n):
        """The next n numbers of a type, or of a list of types n times: a structured array in a binary file, else rows of doubles."""
        if self.order is None:
            width = 1 if isinstance(kind, str) else len(kind)
            words = self._next(n * width)
            return words if width == 1 and isinstance(kind, str) else numpy.array(words, dtype=float).reshape(n, width)
        kind = self.order + kind if isinstance(kind, str) else [(f"{k}", self.order + one) for k, one in enumerate(kind)]
        return numpy.frombuffer(self._next(n * numpy.dtype(kind).itemsize), dtype=kind)

    def _next(self, length):
        part = self.data[self.place : self.place + length]
        if length < 0 or len(part) < length:
            raise InputError(f"{self.file}: it has fewer numbers than its head says; it is damaged or cut off: write or copy it again")
        self.place += length
        return part


def read(file):
    """A meshio.Mesh of the points and faces of a PLY."""
    text, _, body = file.read_bytes().partition(b"end_header")
    byte_order, elements = _head(file, text.decode("latin-1").splitlines())
    # A line ends with one character or two; the first number of a binary file may look like a second.
    body = body.split(b"\n", 1)[1] if b"\n" in body else b""
    values = _Values(file, body, byte_order)
    try:
        points, faces = _elements(file, values, elements)
    except ValueError:
        raise InputError(f"{file}: something that is no number stands among its numbers, or a fraction among its nodes; it is damaged") from None
    if values.place != len(values.data):
        raise InputError(f"{file}: it has more numbers than its head says; it is damaged: write or copy it again")
    return meshio.Mesh(points, blocks_of(faces))


def _elements(file, values, elements):
    """(points, faces) of all elements, one after the other."""
    points, faces = None, []
    for name, count, properties in elements:
        if name == "vertex":
            points = _points(file, values, count, properties)
        elif any(isinstance(kind, tuple) for _, kind in properties):
            faces += _rows(values, count, properties, CORNERS if name == "face" else ())
        else:
            values.take([kind for _, kind in properties], count)
    return points, faces


def _head(file, lines):
    """(byte order, [(element, its number, [(property, type or (type of the length, type))])])."""
    byte_order, elements = "", []
    for line in lines:
        words = line.split()
        try:
            if words[:1] == ["format"]:
                byte_order = FORMATS[words[1]]
            elif words[:1] == ["element"]:
                elements.append((words[1], int(words[2]), []))
            elif words[:2] == ["property", "list"]:
                elements[-1][2].append((words[4], (TYPES[words[2]], TYPES[words[3]])))
            elif words[:1] == ["property"]:
                elements[-1][2].append((words[2], TYPES[words[1]]))
        except (IndexError, KeyError, ValueError):
            raise InputError(f"{file}: '{line.strip()}' is no line of the head of a PLY; it is damaged, or of another format") from None
    names = {name: dict(properties) for name, count, properties in elements if count >= 0 and properties}
    if lines[:1] != ["ply"] or byte_order == "" or len(names) != len(elements) or not {"x", "y", "z"} <= set(names.get("vertex", ())):
        raise InputError(f"{file}: its head is not that of a PLY with x, y and z of an element vertex; it is damaged, or of another format")
    if not any(isinstance(names.get("face", {}).get(corners), tuple) for corners in CORNERS):
        raise InputError(f"{file}: there are no triangles: it has no element face with a list called {' or '.join(CORNERS)}")
    return byte_order, elements


def _points(file, values, count, properties):
    """N x 3 doubles."""
    names = [name for name, _ in properties]
    if any(isinstance(kind, tuple) for _, kind in properties):
        raise InputError(f"{file}: its points have lists ({', '.join(names)}); write it without them")
    table = values.take([kind for _, kind in properties], count)
    places = [names.index(axis) for axis in "xyz"]
    columns = [table[:, k] if values.order is None else table[f"{k}"] for k in places]
    return numpy.stack(columns, axis=1).astype(float)


def _rows(values, count, properties, wanted):
    """Of each row its list that has one of the wanted names, as whole numbers; [] where none has."""
    found = []
    for _ in range(count):
        for name, kind in properties:
            if not isinstance(kind, tuple):
                values.take(kind, 1)
                continue
            row = values.take(kind[1], int(values.take(kind[0], 1)[0]))
            if name in wanted:
                found.append([int(node) for node in row])
    return found
