"""Files of surfaces, and the octahedron that they hold."""

import numpy
from post_fixture import InFolder, octahedron

from tanktread_post import convert_surface, surface_files
from tanktread_post.observables import InputError
from tanktread_post.surface_repair import repaired

POINTS, TRIANGLES = octahedron(numpy.array([3.0, 4.0, 5.0]), 2.0)


class Files(InFolder):
    def put(self, name, content):
        """A file of this text or these bytes."""
        (self.folder / name).write_bytes(content if isinstance(content, bytes) else content.encode())
        return self.folder / name

    def assert_octahedron(self, file):
        """The file holds the octahedron, its corners and the order of its triangles."""
        surface, _ = repaired(surface_files.read_surface(file)[0], file)
        self.assertEqual(surface.corners().tolist(), POINTS[TRIANGLES].tolist())

    def refused(self, file, *words):
        with self.assertRaises(InputError) as caught:
            convert_surface.convert(file, None)
        for word in (file.name, *words):
            self.assertIn(word, str(caught.exception))
        self.assertNotIn("broke down", str(caught.exception), "it is not to get to a library that ends over it")


def rows(numbers):
    """A line for each row."""
    return "".join(" ".join(map(repr, row)) + "\n" for row in numpy.asarray(numbers).tolist())
