"""Tests of include_graph.py on a small project made for them: what it must refuse, and what it must let pass."""

import pathlib
import sys
import tempfile
import unittest

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))

import include_graph  # noqa: E402


class IncludeGraph(unittest.TestCase):
    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.source = pathlib.Path(directory.name)
        for component in include_graph.COMPONENTS:
            self.write(f"{component}/{component}.hpp", "#include <vector>\n")

    def write(self, file, text):
        path = self.source / file
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(text)

    def refused(self, file, line, words):
        """The line, as the second of the file, is the only violation, and the message names file, line and reason."""
        self.write(file, f"// first line\n{line}\n")
        found = include_graph.violations(self.source)
        self.assertEqual(len(found), 1, found)
        self.assertIn(words, found[0])
        if file.endswith("pp"):
            self.assertIn(f"{file}:2:", found[0])

    def test_a_star_passes(self):
        self.write("membrane/a.cpp", '#include "membrane/membrane.hpp"\n#include <Eigen/Core>\n#include <omp.h>\n#include <cmath>\n')
        self.write("exchange/a.cpp", "#include <vtkNew.h>\n#include <fmt/format.h>\n#include <xxhash.h>\n#include <sys/stat.h>\n")
        self.write("driver/a.cpp", '#include "fluid/fluid.hpp"\n#include "exchange/exchange.hpp"\n#include <toml++/toml.h>\n#include <CLI/CLI.hpp>\n')
        self.write("driver/CMakeLists.txt", "target_link_libraries(t PUBLIC tanktread::fluid CLI11::CLI11)  # VTK::No\n")
        self.assertEqual(include_graph.violations(self.source), [])

    def test_components_that_must_not_know_each_other(self):
        for component in ("fluid", "membrane", "coupler", "exchange"):
            for other in include_graph.COMPONENTS:
                if other != component:
                    with self.subTest(component=component, other=other):
                        self.refused(f"{component}/a.cpp", f'#include "{other}/x.hpp"', f"{component} must not know {other}")
                        self.refused(f"{component}/a.cpp", f"  #  include <{other}/x.hpp>", f"{component} must not know {other}")
                        (self.source / component / "a.cpp").unlink()

    def test_libraries_where_they_do_not_belong(self):
        for component, header, library in (
            ("fluid", "Eigen/Core", "Eigen"),
            ("coupler", "Eigen/LU", "Eigen"),
            ("membrane", "vtkNew.h", "VTK"),
            ("driver", "vtkNew.h", "VTK"),
            ("driver", "xxhash.h", "xxHash"),
            ("exchange", "toml++/toml.h", "toml++"),
            ("membrane", "CLI/CLI.hpp", "CLI11"),
            ("fluid", "fmt/format.h", "fmt"),
            ("coupler", "unistd.h", "POSIX"),
        ):
            with self.subTest(component=component, header=header):
                self.refused(f"{component}/a.hpp", f"#include <{header}>", f"{component} must not know {library}")
                (self.source / component / "a.hpp").unlink()

    def test_unknown_libraries_and_relative_paths(self):
        self.refused("fluid/a.cpp", "#include <boost/any.hpp>", "say there who may know it")
        self.refused("fluid/a.cpp", '#include "fluid.hpp"', "by its path from the top")

    def test_links(self):
        self.refused("fluid/CMakeLists.txt", "target_link_libraries(f PUBLIC tanktread::membrane)", "fluid must not link membrane")
        self.refused("fluid/CMakeLists.txt", "target_link_libraries(f PUBLIC Eigen3::Eigen)", "fluid must not link Eigen")
        self.refused("fluid/CMakeLists.txt", "target_link_libraries(f PUBLIC Boost::any)", "say there who may link it")

    def test_a_room_knows_only_rooms_below_it(self):
        rooms = list(include_graph.ROOMS)
        for room in rooms:
            for other in rooms:
                with self.subTest(room=room, other=other):
                    include = f'#include "driver/{other}/x.hpp"'
                    if other == room or other in include_graph.ROOMS[room]:
                        self.write(f"driver/{room}/a.cpp", include)
                        self.assertEqual(include_graph.violations(self.source), [])
                    else:
                        self.refused(f"driver/{room}/a.cpp", include, f"driver/{room} must not know driver/{other}")
            self.refused(f"driver/{room}/a.cpp", '#include "driver/main.hpp"', "must not know what lies in driver/ itself")
            self.write("driver/main.cpp", f'#include "driver/{room}/a.hpp"')
            (self.source / f"driver/{room}/a.cpp").unlink()
            self.assertEqual(include_graph.violations(self.source), [])

    def test_a_room_that_is_in_no_list(self):
        self.refused("driver/attic/a.cpp", '#include "driver/case/x.hpp"', "driver/attic is in no list")
        self.refused("driver/attic/a.cpp", '#include "driver/attic/x.hpp"', "driver/attic is in no list")

    def test_a_circle_in_the_list_of_rooms(self):
        found = include_graph.order_violations({"case": ("units",), "units": ("case", "units")})
        self.assertEqual([line.split(": ", 1)[1].split(",")[0] for line in found], ["driver/case may know driver/units", "driver/units may know driver/units"])
        self.assertEqual(include_graph.order_violations(), [])

    def test_a_circle_of_files(self):
        self.write("driver/case/a.hpp", '#include "driver/case/b.hpp"\n')
        self.write("driver/case/b.hpp", '#include "driver/case/c.hpp"\n')
        self.write("driver/case/c.hpp", '#include "driver/case/a.hpp"\n')
        circle = "driver/case/a.hpp -> driver/case/b.hpp -> driver/case/c.hpp -> driver/case/a.hpp"
        self.assertEqual(include_graph.violations(self.source), [f"a circle of includes: {circle}"])

    def test_an_empty_folder_is_not_a_pass(self):
        (self.source / "fluid/fluid.hpp").unlink()
        self.assertIn("there are no sources", include_graph.violations(self.source)[0])


if __name__ == "__main__":
    unittest.main()
