"""Surfaces and grids that must be refused: meshes of the user's, packets for a component by itself."""

import base64
import re
import struct
import zlib

from malformed_rows import TETRAHEDRON, TRIANGLES, Row, array, changed, field, grid, index, series, surface, surface_index, vtk_file

GOOD = surface()


def mesh(name, content, *message):
    """A mesh from another program, looked at and given to a case."""
    return Row(name, "mesh info cell.vtu", ["cell.vtu", *message], {"cell.vtu": content})


def of_case(name, content, *message, value="capsule.0.mesh={file = 'cell.vtu'}"):
    return Row(name, "run case.toml --output new --set {mesh}", ["cell.vtu", *message], {"cell.vtu": content}, {"mesh": value})


HEADS = [
    mesh("an empty mesh", "", "cut off, or not a VTK XML file"),
    mesh("a mesh of zeros", b"\0" * 1000, "cut off, or not a VTK XML file"),
    mesh("half a mesh", GOOD[: len(GOOD) // 2], "cut off"),
    mesh("a mesh without its first half", GOOD[len(GOOD) // 2 :], "cell.vtu: cannot be read"),
    mesh("only the end of a mesh", "</VTKFile>", "cannot be read"),
    mesh("XML of another kind", "<svg></svg><!-- </VTKFile> -->\n</VTKFile>", "cannot be read"),
    mesh("a root that is no VTKFile", '<File type="UnstructuredGrid"><VTKFile></VTKFile></File></VTKFile>', "cannot be read"),
    mesh("a mesh of no type", GOOD.replace(' type="UnstructuredGrid"', ""), "is not a VTK XML file"),
    mesh("a grid for a mesh", grid(), "is a grid (.vti), not a surface (.vtu)"),
    mesh("a series for a mesh", series(), "is a series (.pvd), not a surface (.vtu)"),
    mesh("two types of numbers", GOOD.replace('"Float64"', '"Float65"'), "unknown type 'Float65'"),
    mesh("data that are no array", surface(point_data="<Numbers></Numbers>"), "PointData holds an element Numbers"),
    mesh("an array without a type", GOOD.replace(' type="Int64"', "", 1), "unknown type ''"),
    mesh("a parent that is not closed", GOOD.replace("</Cells>", ""), "cannot be read"),
    mesh("an entity that is none", GOOD.replace('Name="Points"', 'Name="&points;"'), "cannot be read"),
]

CELLS = [
    mesh("no points", surface(points=(), corners=()), "cell.vtu"),
    mesh("a node that is not there", surface(corners=(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 4)), "triangle 3 has node 4, outside 0 to 3"),
    mesh("a node below nought", surface(corners=(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, -1)), "triangle 3 has node -1"),
    mesh("a node of 2^62", surface(corners=(0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 2**62)), "triangle 3 has node"),
    mesh("quadrilaterals", surface(corners=TRIANGLES, offsets=(4, 8, 12), types=(9, 9, 9), n_cells=3), "only triangles can be read"),
    mesh("a line among triangles", surface(types=(5, 5, 5, 3)), "cell 3", "only triangles"),
    mesh("a triangle of four nodes", surface(offsets=(3, 6, 8, 12)), "cell 2"),
    mesh("a type that is none", surface(types=(5, 5, 5, 200)), "cell 3"),
    mesh("polyhedra", surface(more=array("faces", [1, 3, 0, 1, 2] * 4, kind="Int64")), "holds polyhedra"),
    mesh("ends that go back", surface(offsets=(3, 9, 6, 12)), "offsets"),
    mesh("ends below nought", surface(offsets=(3, -6, 9, 12)), "offsets"),
    mesh("ends beyond the corners", surface(offsets=(3, 6, 9, 15)), "cell.vtu"),
    mesh("more cells than there are", surface(n_cells=7), "cell.vtu"),
    mesh("more points than there are", surface(n_points=7), "cell.vtu"),
    mesh("points of two coordinates", surface().replace('Name="Points" NumberOfComponents="3"', 'Name="Points" NumberOfComponents="2"'), "cell.vtu"),
    mesh("cells without their types", surface().replace('Name="types"', 'Name="kinds"'), "cell.vtu"),
    mesh("a mesh of no points' array", changed(GOOD, array("Points", TETRAHEDRON, 3), ""), "cell.vtu"),
]

def packed(match):
    """An array in base64, compressed."""
    numbers = base64.b64decode(match.group(2))
    block = zlib.compress(numbers[4:])
    head = struct.pack("<4I", 1, len(numbers) - 4, 0, len(block))
    return match.group(1) + base64.b64encode(head).decode() + base64.b64encode(block).decode() + "<"


def compressed(n_blocks=1, length=8 * 4 * 250_000, packed_length=None):
    """A mesh with a million zeros, which take some kilobytes, in blocks as the head of their array says."""
    zeros = zlib.compress(bytes(8 * 4 * 250_000))
    head = base64.b64encode(struct.pack("<4I", n_blocks, length, 0, packed_length or len(zeros))).decode()
    data = f'<DataArray type="Float64" Name="zeros" NumberOfComponents="250000" format="binary">{head}{base64.b64encode(zeros).decode()}</DataArray>'
    others = re.sub(r'(format="binary">)([^<]*)<', packed, surface())
    return changed(changed(others, "<PointData>", "<PointData>" + data), "header_type", 'compressor="vtkZLibDataCompressor" header_type')


def appended(text):
    """The array of zeros behind all others, and its format not said: VTK goes by the offset."""
    found = re.search(r'Name="zeros" (.*) format="binary">(.*)</DataArray>', text)
    text = text.replace(found.group(0), f'Name="zeros" {found.group(1)} offset="0"></DataArray>')
    return text.replace("</VTKFile>", f'<AppendedData encoding="base64">\n_{found.group(2)}</AppendedData>\n</VTKFile>')


PROMISES = [
    mesh("a promise of 10^12 points", surface(n_points=10**12), "promises"),
    mesh("a promise of 10^30 points", surface(n_points=10**30), "NumberOfPoints"),
    mesh("a promise of -4 points", surface(n_points=-4), "NumberOfPoints"),
    mesh("a promise of some points", surface(n_points="some"), "NumberOfPoints"),
    mesh("a promise of 10^12 cells", surface(n_cells=10**12), "promises"),
    mesh("a promise of -1 cells", surface(n_cells=-1), "NumberOfCells"),
    mesh("a promise of 10^12 numbers", surface(field_data=field("step", [1]).replace('NumberOfTuples="1"', 'NumberOfTuples="1000000000000"')), "promises"),
    mesh("a promise of 10^9 components", surface(point_data=array("a", [1, 2, 3, 4], 10**9)), "promises"),
    mesh("a promise of 10^5 compressed blocks", compressed(n_blocks=10**5), "array 'zeros' is said to be of 100000 compressed blocks"),
    # 100096, whose first digit in base64 is zero, which is A and for VTK an equals sign too.
    mesh("a promise that begins with =", re.sub(">AIcBA", ">=IcBA", compressed(n_blocks=100096)), "said to be of 100096 compressed blocks"),
    mesh("a promise behind all arrays", appended(compressed(n_blocks=10**5)), "said to be of 100000 compressed blocks"),
    mesh("a promise of a block of 10^9 bytes", compressed(length=10**9), "array 'zeros' is said to be of 1 compressed blocks of 1000000000 bytes"),
    mesh("a promise of a packed block of 10^6 bytes", compressed(packed_length=10**6), "array 'zeros' is said to be of a compressed block that takes 1000000"),
    mesh("a promise of no components", surface(point_data=array("a", [1, 2, 3, 4], 0)), "NumberOfComponents"),
]

APART = surface(TETRAHEDRON + tuple(v + 5 for v in TETRAHEDRON), TRIANGLES + tuple(corner + 4 for corner in TRIANGLES))
TWO = "capsule=[{radius=1,position=[6,6,6],mesh={file='cell.vtu'}},{radius=1,position=[6.5,6,6],mesh={file='cell.vtu'}}]"
LONG = "capsule.0={radius=2.5,position=[6,6,6],mesh={file='cell.vtu'}}"
NEEDLE = surface((0, 0, 0, 40, 0, 0, 0, 1, 0, 0, 0, 1))

SHAPES = [
    mesh("a mesh of two parts", APART, "2 separate parts"),
    of_case("a case's mesh of two parts", APART, "2 separate parts"),
    Row("two meshes in one place", "run case.toml --output new --set {mesh}", ["overlaps capsule 0"], {"cell.vtu": GOOD}, {"mesh": TWO}),
    Row("a mesh over its image", "run case.toml --output new --set {mesh}", ["capsule.0", "periodic image"], {"cell.vtu": NEEDLE}, {"mesh": LONG}),
    of_case("a stress-free file of other triangles", GOOD, "4 triangles", "the mesh of the capsule has 80", value="capsule.0.stress_free={file = 'cell.vtu'}"),
    of_case("a stress-free file that is open", surface(corners=TRIANGLES[:9]), "the surface is open", value="capsule.0.stress_free={file = 'cell.vtu'}"),
    of_case("a stress-free file that is cut off", GOOD[:-20], "cut off", value="capsule.0.stress_free={file = 'cell.vtu'}"),
    Row("a stress-free shape of a mesh from a file", "run case.toml --output new --set {mesh} --set capsule.0.stress_free.shape=sphere",
        ["capsule.0.stress_free.shape", "has not the triangles of mesh.file"], {"cell.vtu": GOOD}, {"mesh": "capsule.0.mesh={file = 'cell.vtu'}"}),
    mesh("an open mesh", surface(corners=TRIANGLES[:9]), "the surface is open"),
    mesh("a mesh inside out in part", surface(corners=(0, 1, 2) + TRIANGLES[3:]), "wound against each other"),
    mesh("a flat mesh", surface(points=(0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0)), "cell.vtu"),
    mesh("a mesh of one point", surface(points=(0, 0, 0) * 4), "cell.vtu"),
    mesh("a mesh of a point that is not a number", surface(points=TETRAHEDRON[:11] + (float("nan"),)), "cell.vtu"),
    mesh("a mesh out to infinity", surface(points=TETRAHEDRON[:11] + (float("inf"),)), "cell.vtu"),
    mesh("a mesh beyond all squares", surface(points=TETRAHEDRON[:11] + (1e300,)), "cell.vtu"),
    mesh("a triangle of two nodes", surface(corners=(0, 2, 2) + TRIANGLES[3:]), "cell.vtu"),
    of_case("a case's mesh that is open", surface(corners=TRIANGLES[:9]), "the surface is open"),
    of_case("a case's mesh that is cut off", GOOD[:-20], "cut off"),
    of_case("a case's mesh of another program's making", "solid cell\nendsolid cell\n", "cell.vtu"),
]


def spread(name, content, *message):
    return Row(name, "coupler spread --case case.toml --in a.vtu --out x.vti", ["a.vtu", *message], {"a.vtu": content})


def interpolate(name, content, *message):
    """A velocity on a grid; of a good surface."""
    files = {"a.vtu": INSIDE, "g.vti": content}
    return Row(name, "coupler interpolate --case case.toml --in a.vtu --grid g.vti --out x.vtu", ["g.vti", *message], files)


def moved(x):
    return tuple(6 + v + x for v in TETRAHEDRON)


FORCE = array("total_force", [0.0] * 12, 3)
INSIDE = surface(moved(0), point_data=FORCE)
VELOCITY = array("velocity", [0.0] * (3 * 12**3), 3)

PACKETS = [
    spread("a packet without its array", surface(points=moved(0)), "total_force"),
    spread("a packet of scalars", surface(points=moved(0), point_data=array("total_force", [0.0] * 4)), "has 1 components; a vector has 3"),
    spread("a packet of single numbers", surface(points=moved(0), point_data=array("total_force", [0.0] * 12, 3, "Float32")), "total_force", "not double"),
    spread("a packet of text numbers", INSIDE.replace('format="binary"', 'format="ascii"'), "ASCII"),
    spread("a packet of an array cut short", surface(points=moved(0), point_data=array("total_force", [0.0] * 9, 3)), "a.vtu"),
    spread("a packet outside the box", surface(moved(100), point_data=FORCE), "node"),
    spread("a packet nowhere", surface(moved(float("nan")), point_data=FORCE), "node"),
    spread("a packet of capsule 7 alone", surface(points=moved(0), cell_data=array("capsule", [7.0] * 4)), "capsule"),
    spread("a packet of capsules in disorder", surface(points=moved(0), cell_data=array("capsule", [0.0, 1, 0, 1])), "must count the capsules from 0"),
    spread("a packet of half a capsule", surface(points=moved(0), cell_data=array("capsule", [0.0, 0.5, 1, 1])), "must count the capsules from 0"),
    spread("a packet of capsules that share nodes", surface(points=moved(0), cell_data=array("capsule", [0.0, 0, 1, 1])), "must lie together"),
    spread("a packet of a newer program", surface(points=moved(0), field_data=field("schema_version", [99.0])), "schema version 99"),
    spread("a packet of no version", surface(points=moved(0), field_data=field("schema_version", [])), "schema"),
    spread("a packet of half a step", surface(moved(0), point_data=FORCE, field_data=field("step", [0.5])), "'step' must be one whole number"),
    spread("a packet of two steps", surface(moved(0), point_data=FORCE, field_data=field("step", [1.0, 2.0])), "'step' must be one whole number"),
    interpolate("a grid without its array", grid(), "velocity"),
    interpolate("a grid of scalars", grid(point_data=array("velocity", [0.0] * 12**3)), "has 1 components"),
    interpolate("a grid of another box", grid("0 1 0 1 0 1", point_data=array("velocity", [0.0] * 24, 3)), "2 x 2 x 2", "flow.box = [12, 12, 12]"),
    interpolate("a grid elsewhere", grid(origin="0 0 0", point_data=VELOCITY), "(0, 0, 0)"),
    interpolate("a grid of wider steps", grid(spacing="2 2 2", point_data=VELOCITY), "(2, 2, 2)"),
    interpolate("a grid without nodes", grid("0 -1 0 -1 0 -1"), "g.vti"),
    interpolate("a grid of 10^12 nodes", grid("0 9999 0 9999 0 9999", point_data=VELOCITY), "promises"),
    interpolate("a grid of 10^27 nodes", grid("0 999999999 0 999999999 0 999999999", point_data=VELOCITY), "promises"),
    interpolate("a grid beyond 32 bits", grid("0 4294967307 0 11 0 11", point_data=VELOCITY), "WholeExtent"),
    interpolate("a grid of five ends", grid("0 11 0 11 0", point_data=VELOCITY), "WholeExtent"),
    interpolate("a grid of words", grid("a b c d e f", point_data=VELOCITY), "WholeExtent"),
    interpolate("a grid that is turned", grid(direction='Direction="0 1 0 -1 0 0 0 0 1"', point_data=VELOCITY), "axes are turned"),
    interpolate("a grid of cells", grid(cell_data=array("velocity", [0.0] * (3 * 11**3), 3)), "cell data"),
    interpolate("a grid of a part", grid(piece="0 5 0 11 0 11", point_data=array("velocity", [0.0] * (3 * 6 * 12**2), 3)), "a part is missing"),
    interpolate("a grid that is a surface", surface(), "is a surface (.vtu), not a grid (.vti)"),
    interpolate("a grid of a spacing that is not a number", grid(spacing="nan 1 1", point_data=VELOCITY), 'Spacing="nan 1 1"', "3 finite numbers"),
    interpolate("a grid from nowhere", grid(origin="a b c", point_data=VELOCITY), 'Origin="a b c"', "3 finite numbers"),
    interpolate("a grid of half an axis", grid(direction='Direction="1 0 0 0"', point_data=VELOCITY), "9 finite numbers"),
]



def in_two_pieces():
    """A grid whose two pieces share the nodes at their border."""
    pieces = "".join(
        f'<Piece Extent="{extent}">\n<PointData>{array("velocity", [0.0] * (3 * n * 12**2), 3)}</PointData>\n</Piece>\n'
        for extent, n in (("0 5 0 11 0 11", 6), ("5 11 0 11 0 11", 7))
    )
    return vtk_file("ImageData", pieces, 'WholeExtent="0 11 0 11 0 11" Origin="0.5 0.5 0.5" Spacing="1 1 1"')


LOW, HIGH = "0 5 0 11 0 11", "5 11 0 11 0 11"


def pieces(name, content, *message, **files):
    """A grid of two pieces with an index; `files` in the place of theirs."""
    halves = {f"{half}.vti": grid(extent, point_data=array("velocity", [0.0] * (3 * n * 12**2), 3)) for half, extent, n in (("low", LOW, 6), ("high", HIGH, 7))}
    all_files = {"a.vtu": INSIDE, "g.pvti": content, **halves, **{f"{half}.vti": spoilt for half, spoilt in files.items()}}
    return Row(name, "coupler interpolate --case case.toml --in a.vtu --grid g.pvti --out x.vtu", [*message], all_files)


BOTH = index(("low.vti", LOW), ("high.vti", HIGH))

IN_PIECES = [
    pieces("an empty index", "", "g.pvti", "cut off, or not a VTK XML file"),
    pieces("half an index", BOTH[: len(BOTH) // 2], "g.pvti", "cut off"),
    pieces("an index that is a grid", grid(point_data=VELOCITY), "g.pvti", "is a grid (.vti), not the index"),
    pieces("a piece that is not there", index(("low.vti", LOW), ("none.vti", HIGH)), "none.vti: no such file, a piece of g.pvti"),
    pieces("pieces without a layer in common", index(("low.vti", LOW), ("high.vti", "6 11 0 11 0 11")), "g.pvti", "share one layer of nodes"),
    pieces("a piece twice", index(("low.vti", LOW), ("low.vti", LOW)), "g.pvti", "have cells in common"),
    pieces("a piece outside", index(("low.vti", LOW), ("high.vti", "5 12 0 11 0 11")), "g.pvti", "is no part of the grid"),
    pieces("pieces of words", BOTH.replace(f'"{HIGH}"', '"a b c d e f"'), "g.pvti", "Extent"),
    pieces("a piece of another extent", BOTH, "high.vti", "other than g.pvti says", high=grid(LOW, point_data=array("velocity", [0.0] * (3 * 6 * 12**2), 3))),
    pieces("a piece without its array", BOTH, "high.vti", "has no array 'velocity'", high=grid(HIGH)),
    pieces("a piece that is a surface", BOTH, "high.vti", "is a surface (.vtu), not a grid (.vti)", high=surface()),
    pieces("pieces of 10^12 nodes", index(("low.vti", "0 9999 0 9999 0 9999"), extent="0 9999 0 9999 0 9999"), "g.pvti", "promises"),
    pieces("pieces of arrays of no components", BOTH.replace('Components="3"', 'Components="0"'), "g.pvti", "NumberOfComponents"),
]


def surfaces(name, content, *message, **files):
    """A surface of two pieces with an index; `files` in the place of theirs."""
    halves = {"left.vtu": INSIDE, "right.vtu": surface(moved(2), point_data=FORCE)}
    all_files = {"a.pvtu": content, **halves, **{f"{half}.vtu": spoilt for half, spoilt in files.items()}}
    return Row(name, "coupler spread --case case.toml --in a.pvtu --out x.vti", [*message], all_files)


LEFT_AND_RIGHT = surface_index("left.vtu", "right.vtu")

SURFACES_IN_PIECES = [
    surfaces("an empty index of surfaces", "", "a.pvtu", "cut off, or not a VTK XML file"),
    surfaces("half an index of surfaces", LEFT_AND_RIGHT[: len(LEFT_AND_RIGHT) // 2], "a.pvtu", "cut off"),
    surfaces("an index that is a surface", GOOD, "a.pvtu", "is a surface (.vtu), not the index of a surface in pieces (.pvtu)"),
    surfaces("an index of grids for one of surfaces", BOTH, "a.pvtu", "is the index of a grid in pieces (.pvti), not the index"),
    surfaces("a piece of a surface that is not there", surface_index("left.vtu", "none.vtu"), "none.vtu: no such file, a piece of a.pvtu"),
    surfaces("a piece of a surface twice", surface_index("left.vtu", "left.vtu"), "a.pvtu", "it names the piece 'left.vtu' twice"),
    surfaces("no piece of a surface", surface_index(), "a.pvtu", "it names no piece"),
    surfaces("pieces of a surface that overlap", surface_index("left.vtu", "right.vtu", ghosts=1), "a.pvtu", "GhostLevel"),
    surfaces("a piece of a surface without its array", LEFT_AND_RIGHT, "right.vtu", "has no array 'total_force' of 3 components", right=surface(moved(2))),
    surfaces("a piece of a surface that is a grid", LEFT_AND_RIGHT, "right.vtu", "is a grid (.vti), not a surface (.vtu)", right=grid()),
    surfaces("a piece of a surface that is the index", surface_index("left.vtu", "a.pvtu"), "is the index of a surface in pieces (.pvtu), not a surface"),
    surfaces("a piece of a surface that is cut off", LEFT_AND_RIGHT, "left.vtu", "cut off", left=INSIDE[:-20]),
    surfaces("pieces that both have a number", LEFT_AND_RIGHT, "right.vtu: has the field data 'gap', as has left.vtu", "only one piece can have them",
        left=surface(moved(0), point_data=FORCE, field_data=field("gap", [1.0])), right=surface(moved(2), point_data=FORCE, field_data=field("gap", [1.0]))),
]  # fmt: skip

# What must go well: neighbours of rows, spoilt in nothing.
ACCEPTED = [
    Row("a mesh", "mesh info cell.vtu", [], {"cell.vtu": GOOD}),
    Row("a mesh that is compressed", "mesh info cell.vtu", [], {"cell.vtu": compressed()}),
    Row("a mesh that is compressed and appended", "mesh info cell.vtu", [], {"cell.vtu": appended(compressed())}),
    Row("a packet", "coupler spread --case case.toml --in a.vtu --out x.vti", [], {"a.vtu": INSIDE}),
    Row("a grid", "coupler interpolate --case case.toml --in a.vtu --grid g.vti --out x.vtu", [], {"a.vtu": INSIDE, "g.vti": grid(point_data=VELOCITY)}),
    Row("a grid in two pieces", "coupler interpolate --case case.toml --in a.vtu --grid g.vti --out x.vtu", [], {"a.vtu": INSIDE, "g.vti": in_two_pieces()}),
    pieces("a grid in pieces", BOTH),
    surfaces("a surface in pieces", LEFT_AND_RIGHT),
]

ROWS = [*HEADS, *CELLS, *PROMISES, *SHAPES, *PACKETS, *IN_PIECES, *SURFACES_IN_PIECES]
