"""A membrane for the tests of programs in its place: springs to the undeformed places, and a memory of the velocity.

Usage: outside_membrane.py [WHAT STEP]. From that step on it does what is said, one of ANSWERS or `die`, `hang`, `chat`.
"""

import os
import pathlib
import sys
import time

import meshio
import numpy


def good(mesh):
    """A reply with state of its own: `memory` on nodes, `age` on triangles."""
    memory = 0.9 * mesh.point_data.get("memory", 0.0) + mesh.point_data["velocity"]
    age = mesh.cell_data.get("age", [numpy.zeros(len(mesh.cells_dict["triangle"]))])[0] + 1.0
    stretch = mesh.points - mesh.point_data["reference_position"]
    stiffness = 1e-2 * mesh.field_data["shear_modulus"][0]
    force = -stiffness * (stretch + 10.0 * memory) * (1.0 + 1e-3 * age[0])
    return meshio.Mesh(mesh.points, mesh.cells, point_data={"total_force": force, "memory": memory}, cell_data={"age": [age]})


def changed(mesh, **point_data):
    """The good reply with other arrays on points."""
    reply = good(mesh)
    reply.point_data.update(point_data)
    return reply


def with_nan(mesh):
    force = good(mesh).point_data["total_force"]
    force[17, 1] = numpy.nan
    return changed(mesh, total_force=force)


def with_everything(mesh):
    """All that a membrane file has, in recognisable numbers; `viscous_stress` in a shape that it does not have there."""
    reply = changed(mesh, elastic_force=numpy.full((len(mesh.points), 3), 7.0))
    n_triangles = len(mesh.cells_dict["triangle"])
    reply.cell_data |= {"stress": [numpy.full((n_triangles, 9), 8.0)], "viscous_stress": [numpy.zeros((n_triangles, 3))]}
    return reply


def without_force(mesh):
    reply = good(mesh)
    del reply.point_data["total_force"]
    return reply


def first_nodes(mesh):
    """Only the first triangle, of three nodes."""
    return meshio.Mesh(mesh.points[:3], [("triangle", [[0, 1, 2]])], point_data={"total_force": numpy.zeros((3, 3))})


def turned(mesh):
    """The corners of the triangles in another order."""
    return meshio.Mesh(mesh.points, [("triangle", mesh.cells_dict["triangle"][:, ::-1])], point_data=good(mesh).point_data)


ANSWERS = {
    "good": good,
    "everything": with_everything,
    "no-force": without_force,
    "scalar": lambda mesh: changed(mesh, total_force=numpy.zeros(len(mesh.points))),
    "float32": lambda mesh: changed(mesh, total_force=numpy.zeros((len(mesh.points), 3), numpy.float32)),
    "nan": with_nan,
    "strong": lambda mesh: changed(mesh, total_force=numpy.full((len(mesh.points), 3), 10.0)),
    "fewer": first_nodes,
    "turned": turned,
    "name": lambda mesh: changed(mesh, **{"µ": mesh.points}),
}


def answer(what, packet):
    """Writes the reply to a packet, and says its name."""
    name = packet.with_name("output.vtu")
    if what == "stale" and name.exists():
        return name
    mesh = meshio.read(packet)
    ANSWERS.get(what, good)(mesh).write(name, binary=what != "text")
    if what == "cut":
        name.write_bytes(name.read_bytes()[:-30])
    return "nowhere.vtu" if what == "nowhere" else packet if what == "input" else "" if what == "nothing" else name


def main():
    what, first = (sys.argv[1], int(sys.argv[2])) if len(sys.argv) > 1 else ("good", 0)
    for n_done, line in enumerate(sys.stdin):
        packet = pathlib.Path(line.rstrip("\n"))
        if n_done == 0:
            print(f"packets are in {packet.parent}", file=sys.stderr, flush=True)
        now = what if n_done + 1 >= first else "good"
        if now == "die":
            sys.exit(7)
        if now == "hang":
            time.sleep(600)
        if now == "chat":
            os.write(1, b"hello\nworld\n")
        print(answer(now, packet), flush=True)


if __name__ == "__main__":
    main()
