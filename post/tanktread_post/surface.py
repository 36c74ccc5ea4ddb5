"""A surface of triangles, its edges, and what hangs together on it."""

import numpy

# Points nearer than this fraction of the surface's size become one: above the rounding of single precision, 6e-8 of a
# coordinate, and a thousandth of the edges of the finest sphere that `tanktread mesh sphere` makes.
MERGE_TOLERANCE = 1e-6


class Surface:
    """Points (N x 3) and triangles (T x 3), with the number that each node and each face had in the file, from 0."""

    def __init__(self, points, triangles, nodes, faces):
        self.points, self.triangles, self.nodes, self.faces = points, triangles, nodes, faces

    def size(self):
        """The diagonal of the box around the points."""
        return float(numpy.linalg.norm(numpy.ptp(self.points, axis=0)))

    def corners(self):
        """T x 3 x 3: the positions of the corners of every triangle."""
        return self.points[self.triangles]

    def volume(self):
        """Enclosed, by the divergence theorem, about the mean of the points; negative if wound inside out."""
        p = self.corners() - self.points.mean(axis=0)
        return float(numpy.einsum("ni,ni->", p[:, 0], numpy.cross(p[:, 1], p[:, 2])) / 6)

    def areas(self):
        """T areas."""
        p = self.corners()
        return numpy.linalg.norm(numpy.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0]), axis=1) / 2

    def sides(self):
        """T x 3 lengths of sides."""
        p = self.corners()
        return numpy.linalg.norm(p - numpy.roll(p, -1, axis=1), axis=2)

    def of_triangles(self, chosen):
        """The surface of these triangles (numbers or truth values), without the points that they do not use."""
        triangles = self.triangles[chosen]
        used = numpy.unique(triangles)
        return Surface(self.points[used], numpy.searchsorted(used, triangles), self.nodes[used], self.faces[chosen])

    def turned(self, turn):
        """The surface with these triangles (truth values) wound the other way."""
        triangles = numpy.where(turn[:, None], self.triangles[:, [0, 2, 1]], self.triangles)
        return Surface(self.points, triangles, self.nodes, self.faces)


class Edges:
    """The edges of triangles. Side 3 t + k of triangle t runs from its corner k to the next one.

    nodes: E x 2, the smaller number first. n_triangles: E. edge: of each side, its edge. start: of each side, the node
    that it begins at. rises: whether a side runs from the smaller number to the larger. mate: of each side, the other
    side on the same edge; -1 where the edge has not two triangles.
    """

    def __init__(self, triangles):
        sides = numpy.stack([triangles, numpy.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
        self.start, self.rises = sides[:, 0], sides[:, 0] < sides[:, 1]
        n_nodes = int(triangles.max()) + 1
        keys, self.edge, self.n_triangles = numpy.unique(
            sides.min(axis=1) * n_nodes + sides.max(axis=1), return_inverse=True, return_counts=True
        )
        self.nodes = numpy.stack([keys // n_nodes, keys % n_nodes], axis=1)
        self.by_edge = numpy.argsort(self.edge, kind="stable")
        self.first = numpy.cumsum(self.n_triangles) - self.n_triangles
        a, b = (self.by_edge[self.first[self.n_triangles == 2] + k] for k in (0, 1))
        self.mate = numpy.full(len(sides), -1)
        self.mate[a], self.mate[b] = b, a

    def triangles_at(self, edge):
        """The triangles at an edge."""
        return self.by_edge[self.first[edge] : self.first[edge] + self.n_triangles[edge]] // 3

    def clash(self, sides, turn):
        """Of sides that have a mate: whether the two triangles, turned where `turn` says so, run along it the same way."""
        mates = self.mate[sides]
        return (self.rises[sides] == self.rises[mates]) ^ turn[sides // 3] ^ turn[mates // 3]


def flood(edges):
    """(body, turn) of each triangle: the number of the part that hangs together by edges of two triangles, and whether
    the triangle must be turned to be wound as the first one of its part. On a surface with one side only some clash."""
    n_triangles = len(edges.mate) // 3
    body, turn = numpy.full(n_triangles, -1), numpy.zeros(n_triangles, dtype=bool)
    n_bodies = 0
    for seed in range(n_triangles):
        if body[seed] >= 0:
            continue
        body[seed], front = n_bodies, numpy.array([seed])
        while front.size:
            sides = (3 * front[:, None] + numpy.arange(3)).ravel()
            sides = sides[edges.mate[sides] >= 0]
            sides = sides[body[edges.mate[sides] // 3] < 0]
            found = edges.mate[sides] // 3
            body[found] = n_bodies
            turn[found] = edges.clash(sides, turn)
            front = numpy.unique(found)
        n_bodies += 1
    return body, turn


def n_fans(edges):
    """Of each node, how many separate fans of triangles it has; for a closed surface that is wound consistently.

    The side before a side in its triangle ends at its node, and the mate of that begins there again: so going on turns
    about the node. The sides of one fan get the smallest number among them, found over 1, 2, 4 ... steps.
    """
    side = numpy.arange(len(edges.mate))
    onward = edges.mate[side - side % 3 + (side + 2) % 3]
    fan, step = side, onward
    while (fan != fan[onward]).any():
        fan, step = numpy.minimum(fan, fan[step]), step[step]
    return numpy.bincount(edges.start[numpy.unique(fan)])
