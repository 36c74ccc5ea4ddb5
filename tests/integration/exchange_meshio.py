"""Compares our surfaces as meshio reads them with the numbers they were made of, and writes surfaces with meshio.

check FOLDER  each FOLDER/NAME.vtu against NAME/points, triangles, point_..., cell_..., field_...: raw 64-bit numbers
write FOLDER  the surface of `made_by_meshio` as zlib.vtu (meshio's default), plain.vtu, float32.vtu, quads.vtu
"""
import pathlib
import sys

import meshio
import numpy as np


def same_bits(found, expected):
    """Equal as bits: NaN equals itself, -0.0 is not 0.0."""
    found = np.ascontiguousarray(found)
    return found.dtype == expected.dtype and np.array_equal(found.ravel().view(np.uint64), expected.view(np.uint64))


def require(condition, what):
    if not condition:
        sys.exit(f"meshio: {what} is not what was written")


def check(folder):
    files = sorted(folder.glob("*.vtu"))
    require(files, "the list of files")
    for file in files:
        check_file(file, file.with_suffix(""))


def check_file(file, folder):
    mesh = meshio.read(file)
    require([block.type for block in mesh.cells] == ["triangle"], "the kind of cells")
    found = {"points": mesh.points, "triangles": mesh.cells[0].data}
    found |= {f"point_{name}": values for name, values in mesh.point_data.items()}
    found |= {f"cell_{name}": blocks[0] for name, blocks in mesh.cell_data.items()}
    found |= {f"field_{name}": values for name, values in mesh.field_data.items()}
    require(found.pop("field_content_hash").shape == (2,), "the hash")
    found.pop("field_padding_for_meshio", None)
    names = {path.name for path in folder.iterdir()}
    require(set(found) == names, f"the list of arrays ({sorted(found)})")
    for name, values in found.items():
        kind = np.int64 if name == "triangles" else np.float64
        require(same_bits(values, np.fromfile(folder / name, dtype=kind)), f"{name} of {file.name}")
    n_nodes, n_triangles = mesh.points.shape[0], mesh.cells[0].data.shape[0]
    require(mesh.points.shape == (n_nodes, 3) and mesh.cells[0].data.shape == (n_triangles, 3), "the shape")
    require(mesh.point_data["velocity"].shape == (n_nodes, 3), "the shape of velocity")
    require(mesh.cell_data["stress"][0].shape == (n_triangles, 9), "the shape of stress")
    require(mesh.cell_data["area_ratio"][0].size == n_triangles, "the shape of area_ratio")


def made_by_meshio(kind):
    points = np.array([[0, 0, 0], [1, 0, 0.1], [1, 1, 1 / 3], [0, 1, -2.5]], dtype=kind)
    cells = [("triangle", np.array([[0, 1, 2], [0, 2, 3]]))]
    return meshio.Mesh(
        points,
        cells,
        point_data={"speed": np.array([0.1, 1 / 3, 1e-310, -0.0], dtype=kind)},
        cell_data={"label": [np.array([7, 8], dtype=np.int32)]},
    )


def write(folder):
    made_by_meshio(np.float64).write(folder / "zlib.vtu")
    made_by_meshio(np.float64).write(folder / "plain.vtu", compression=None)
    made_by_meshio(np.float32).write(folder / "float32.vtu")
    quads = meshio.Mesh(np.eye(4, 3), [("quad", np.array([[0, 1, 2, 3]]))])
    quads.write(folder / "quads.vtu")


if __name__ == "__main__":
    command, *arguments = sys.argv[1:]
    {"check": check, "write": write}[command](*map(pathlib.Path, arguments))
