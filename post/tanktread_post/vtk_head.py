"""The head of VTK's XML files of cells, .vtu and .vtp: how many points and cells they say that they hold, over all their pieces."""

import xml.parsers.expat

from .observables import InputError

# VTK ends its process when there is no memory for the numbers that a head announces. No file holds so many points in a byte.
MOST_IN_A_BYTE = 100
# The parts of a piece that hold its geometry, the attribute with their number, and the numbers that each has in an array of these names.
PARTS = {
    "Points": ("NumberOfPoints", 3, None),
    **{part: (f"NumberOf{part}", 1, ("offsets", "types")) for part in ("Cells", "Verts", "Lines", "Strips", "Polys")},
}


class _Parser:
    """Collects the kinds of data and the pieces of a file, and what its arrays in text hold other than said."""

    def __init__(self):
        self.kinds, self.pieces, self.wrong = [], [], []
        self.part, self.array, self.text, self.within = None, None, [], 0

    def start(self, name, attributes):
        if self.array is not None:
            self.within += 1  # what VTK notes of an array, as its range, is no part of it
        elif name == "VTKFile":
            self.kinds.append(attributes.get("type", "no kind of data"))
        elif name == "Piece":
            self.pieces.append({key: int(attributes[key]) for key, _, _ in PARTS.values() if key in attributes})
        elif name == "AppendedData":
            raise StopIteration  # the rest is numbers, which need not be XML
        elif name in PARTS:
            self.part = name
        elif name == "DataArray" and self.part and attributes.get("format", "ascii") == "ascii":
            self.array, self.text = attributes.get("Name", ""), []

    def characters(self, text):
        if self.array is not None and not self.within:
            self.text.append(text)

    def end(self, name):
        if self.within:
            self.within -= 1
        elif name == "DataArray" and self.array is not None:
            key, each, names = PARTS[self.part]
            expected, found = each * self.pieces[-1].get(key, 0), len("".join(self.text).split())
            if (names is None or self.array in names) and found != expected:
                self.wrong.append(f"piece {len(self.pieces) - 1} has {found} numbers in '{self.array or self.part}' of its {self.part}, {expected} by its head")
            self.array = None
        elif name == self.part:
            self.part = None


def read(file):
    """(kind of data, points, cells). @throws InputError where that cannot be"""
    parsed = _parsed(file)
    wanted = "PolyData" if file.suffix.lower() == ".vtp" else "UnstructuredGrid"
    if parsed.kinds != [wanted]:
        fix = {"PolyData": "; its name must end with .vtp", "UnstructuredGrid": "; its name must end with .vtu"}.get("".join(parsed.kinds), "")
        raise InputError(f"{file}: it holds {' '.join(parsed.kinds) or 'nothing'}, where its name says {wanted}{fix}")
    n_points = sum(piece["NumberOfPoints"] for piece in parsed.pieces)
    n_cells = sum(number for piece in parsed.pieces for key, number in piece.items() if key != "NumberOfPoints")
    size = file.stat().st_size
    if any(number < 0 for piece in parsed.pieces for number in piece.values()) or max(n_points, n_cells) > MOST_IN_A_BYTE * size:
        raise InputError(f"{file}: its head says {n_points} points and {n_cells} cells, which a file of {size} bytes cannot hold; it is damaged")
    if parsed.wrong:  # VTK says so only if they are too few
        raise InputError(f"{file}: {parsed.wrong[0]}; it is damaged")
    return wanted, n_points, n_cells


def _parsed(file):
    parsed, parser = _Parser(), xml.parsers.expat.ParserCreate()
    parser.StartElementHandler, parser.CharacterDataHandler, parser.EndElementHandler = parsed.start, parsed.characters, parsed.end
    try:
        with open(file, "rb") as stream:
            parser.ParseFile(stream)
    except StopIteration:
        pass
    except xml.parsers.expat.ExpatError as error:
        raise InputError(f"{file}: it is not VTK's XML ({error}); it is damaged, cut off, or of another format") from None
    except (ValueError, IndexError):
        parsed.pieces.append({})
    if not all("NumberOfPoints" in piece for piece in parsed.pieces):
        raise InputError(f"{file}: a piece does not say how many points and cells it has; it is damaged")
    return parsed
