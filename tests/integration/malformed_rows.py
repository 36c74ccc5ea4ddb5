"""What a row of the tables of malformed inputs is, and the good inputs that rows spoil."""

import base64
import dataclasses
import struct

CASE = """title = "Small capsule"
[flow]
box = [12, 12, 12]
wall_speed = 0.02
[[capsule]]
radius = 3.0
position = [6.0, 6.0, 6.0]
mesh = { level = 1 }
[membrane]
elastic_law = "neo-hookean"
capillary_number = 0.3
[run]
threads = 1
shear_time = 0.04
checkpoint_every = 0.02
"""


@dataclasses.dataclass
class Row:
    """A command that must be refused: exit code 2, a message that has all of `message`, nothing written.

    `files` maps names in the command's folder to texts or bytes, laid over a good `case.toml`; a function gets the bytes that
    stand there and gives others. With `run` the folder holds a finished run, `out`, and its record, `record`.
    """

    name: str
    command: str  # split at spaces; {name} for a word that has some
    message: list
    files: dict = dataclasses.field(default_factory=dict)
    words: dict = dataclasses.field(default_factory=dict)
    run: bool = False
    remove: tuple = ()

    def arguments(self):
        return [self.words.get(word.strip("{}"), word) if word.startswith("{") else word for word in self.command.split()]


def changed(text, old, new):
    """The text with one piece replaced, which must be there."""
    assert text.count(old) >= 1, old
    return text.replace(old, new, 1)


def spoilt(old, new):
    """A file's bytes with one piece replaced, for Row.files."""
    return lambda before: changed(before, old, new)


FORMATS = {"Float64": "d", "Float32": "f", "Int64": "q", "Int32": "i", "UInt8": "B"}


def encoded(kind, values):
    """Numbers in base64 as VTK has them within its XML, with their length before them."""
    numbers = struct.pack(f"<{len(values)}{FORMATS[kind]}", *values)
    return base64.b64encode(struct.pack("<I", len(numbers)) + numbers).decode()


def array(name, values, components=1, kind="Float64", attributes=""):
    """A DataArray in base64."""
    head = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" {attributes} format="binary">'
    return head + encoded(kind, values) + "</DataArray>\n"


def field(name, values, kind="Float64"):
    """An array of field data."""
    return array(name, values, kind=kind, attributes=f'NumberOfTuples="{len(values)}"')


def vtk_file(kind, body, attributes="", field_data=""):
    return (
        f'<?xml version="1.0"?>\n<VTKFile type="{kind}" version="1.0" byte_order="LittleEndian" header_type="UInt32">\n'
        f"<{kind} {attributes}>\n<FieldData>{field_data}</FieldData>\n{body}</{kind}>\n</VTKFile>\n"
    )


TETRAHEDRON = (0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1)
TRIANGLES = (0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3)


def surface(
    points=TETRAHEDRON, corners=TRIANGLES, offsets=None, types=None, point_data="", cell_data="", n_points=None, n_cells=None, field_data="", more=""
):  # fmt: skip
    """A .vtu as another program writes it; of a tetrahedron unless said otherwise."""
    n_cells = len(corners) // 3 if n_cells is None else n_cells
    offsets = range(3, len(corners) + 1, 3) if offsets is None else offsets
    types = [5] * (len(corners) // 3) if types is None else types
    body = (
        f'<Piece NumberOfPoints="{len(points) // 3 if n_points is None else n_points}" NumberOfCells="{n_cells}">\n'
        f"<Points>{array('Points', points, 3)}</Points>\n<Cells>\n{array('connectivity', corners, kind='Int64')}"
        f"{array('offsets', list(offsets), kind='Int64')}{array('types', types, kind='UInt8')}{more}</Cells>\n"
        f"<PointData>{point_data}</PointData>\n<CellData>{cell_data}</CellData>\n</Piece>\n"
    )
    return vtk_file("UnstructuredGrid", body, field_data=field_data)


def grid(extent="0 11 0 11 0 11", origin="0.5 0.5 0.5", spacing="1 1 1", point_data="", cell_data="", field_data="", direction="", piece=None):
    """A .vti as another program writes it; of the good case's box unless said otherwise."""
    body = f'<Piece Extent="{piece or extent}">\n<PointData>{point_data}</PointData>\n<CellData>{cell_data}</CellData>\n</Piece>\n'
    return vtk_file("ImageData", body, f'WholeExtent="{extent}" Origin="{origin}" Spacing="{spacing}" {direction}', field_data)


def index(*pieces, extent="0 11 0 11 0 11", point_data='<PDataArray type="Float64" Name="velocity" NumberOfComponents="3"/>'):
    """A .pvti of pieces, each (file, extent)."""
    body = f"<PPointData>{point_data}</PPointData>\n" + "".join(f'<Piece Extent="{of_piece}" Source="{file}"/>\n' for file, of_piece in pieces)
    return vtk_file("PImageData", body, f'WholeExtent="{extent}" GhostLevel="0" Origin="0.5 0.5 0.5" Spacing="1 1 1"')


def surface_index(*pieces, point_data='<PDataArray type="Float64" Name="total_force" NumberOfComponents="3"/>', ghosts=0):
    """A .pvtu of these pieces."""
    points = '<PPoints><PDataArray type="Float64" Name="Points" NumberOfComponents="3"/></PPoints>\n'
    body = f"{points}<PPointData>{point_data}</PPointData>\n" + "".join(f'<Piece Source="{file}"/>\n' for file in pieces)
    return vtk_file("PUnstructuredGrid", body, f'GhostLevel="{ghosts}"')


def series(*entries):
    """A .pvd with these DataSet elements."""
    return (
        '<?xml version="1.0"?>\n<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n<Collection>\n'
        + "\n".join(entries)
        + "\n</Collection>\n</VTKFile>\n"
    )
