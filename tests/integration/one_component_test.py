"""Programs of one component against the whole one. Usage: one_component_test.py TANKTREAD ALONE [unittest arguments].

TANKTREAD is the whole program; ALONE/fluid, ALONE/membrane and ALONE/coupler are build folders of programs of that component.
"""

import filecmp
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

COMPONENTS = ("fluid", "membrane", "coupler")

CASE = """
title = "Small viscous capsule"
[flow]
box = [24, 24, 24]
wall_speed = 0.02
[[capsule]]
radius = 5.0
position = [12.0, 12.0, 12.0]
mesh = { level = 2 }
[membrane]
capillary_number = 0.3
viscous = { scheme = "fd", boussinesq_shear = 1.0, spring_stiffness = 10.0 }
"""

# A time step through files, and what else the components do by themselves: who does it, and how.
STAGES = (
    ("membrane", "membrane --case case.toml --out rest.vtu"),
    ("fluid", "fluid --case case.toml --steps 20 --out state.vti --fields flow.vti"),
    ("coupler", "coupler interpolate --case case.toml --in rest.vtu --grid flow.vti --out moving.vtu"),
    ("membrane", "membrane --case case.toml --in moving.vtu --move --state rest.vtu --out forces.vtu"),
    ("coupler", "coupler spread --case case.toml --in forces.vtu --out force.vti"),
    ("fluid", "fluid --case case.toml --state state.vti --force force.vti --out next.vti --free free.vti"),
    ("membrane", "membrane --case case.toml --motion twist --shear-time 0.05 --out twist"),
    ("membrane", "mesh sphere --level 2 sphere.vtu"),
    ("membrane", "mesh info sphere.vtu"),
    ("membrane", "study maxwell --out maxwell.csv"),
    ("coupler", "study strain-rate-noise --out noise.csv"),
    ("coupler", "study kernel --out kernel.csv"),
    ("fluid", "diff state.vti next.vti"),
)

ALL = "the fluid, the membrane and the coupler"
NEEDS = {
    "run": ALL,
    "plan": ALL,
    "membrane": "the membrane",
    "mesh": "the membrane",
    "coupler": "the coupler",
    "fluid": "the fluid",
    "implicit": "the membrane and the coupler",
}
MISSING = {
    "fluid": {name: needs for name, needs in NEEDS.items() if name != "fluid"} | {"study": "the membrane or the coupler"},
    "membrane": {name: needs for name, needs in NEEDS.items() if name not in ("membrane", "mesh")},
    "coupler": {name: needs for name, needs in NEEDS.items() if name != "coupler"},
}

# A subcommand that reads the case file.
READING = {
    "fluid": "fluid --case case.toml --steps 1 --out out.vti",
    "membrane": "membrane --case case.toml --out out.vtu",
    "coupler": "coupler interpolate --case case.toml --in rest.vtu --grid flow.vti --out out.vtu",
}
# Names that a case takes from a component.
OF_A_COMPONENT = {
    "membrane.elastic_law": "membrane",
    "membrane.viscous.scheme": "membrane",
    "coupler.kernel": "coupler",
}


def alone(component):
    """The program of one component."""
    return ALONE / component / "driver" / "tanktread"


def listed(help_text, heading):
    """The commands under a heading of --help, with their descriptions."""
    block = re.search(rf"^{heading}:\n((?:  .*\n)+)", help_text, re.MULTILINE)
    return dict(re.findall(r"^  (\S+) +(.+)$", block.group(1), re.MULTILINE)) if block else {}


class OneComponent(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def call(self, program, command, folder=""):
        """Runs a command of a program in a folder that has the case file."""
        where = self.folder / folder
        where.mkdir(exist_ok=True)
        (where / "case.toml").write_text(CASE)
        return subprocess.run([program, *command.split()], cwd=where, capture_output=True, text=True)

    def test_each_component_by_its_own_program_gives_the_files_of_the_whole_one(self):
        for component, command in STAGES:
            whole = self.call(WHOLE, command, "whole")
            ours = self.call(alone(component), command, "alone")
            self.assertIn(whole.returncode, (1,) if command.startswith("diff") else (0,), whole.stderr)
            self.assertEqual((ours.returncode, ours.stdout, ours.stderr), (whole.returncode, whole.stdout, whole.stderr), command)
        files = sorted(path.relative_to(self.folder / "whole") for path in (self.folder / "whole").rglob("*") if path.is_file())
        self.assertGreaterEqual(len(files), 12)
        _, different, missing = filecmp.cmpfiles(self.folder / "whole", self.folder / "alone", files, shallow=False)
        self.assertEqual((different, missing), ([], []))

    def test_each_component_is_replayed_by_its_own_program(self):
        recorded = self.call(WHOLE, "run case.toml --output run --shear-time 0.02 --record record --from 2 --to 8")
        self.assertEqual(recorded.returncode, 0, recorded.stderr)
        for program in COMPONENTS:
            for component in COMPONENTS:
                with self.subTest(program=program, component=component):
                    ended = self.call(alone(program), f"replay record --only {component}")
                    if program == component:
                        self.assertEqual((ended.returncode, ended.stderr), (0, ""))
                        self.assertIn(f"{component}: identical: 6 steps", ended.stdout)
                    else:
                        self.assertEqual(ended.returncode, 2)
                        self.assertIn(f"--only {component}: left out of this program, since it needs the {component};", ended.stderr)

    def test_forces_that_two_components_find_together_are_missing_where_one_of_them_is(self):
        viscous = "--set membrane.viscous={scheme='implicit',boussinesq_shear=1}"
        recorded = self.call(WHOLE, f"run case.toml --output run --shear-time 0.01 --record record {viscous}")
        self.assertEqual(recorded.returncode, 0, recorded.stderr)
        whole = self.call(WHOLE, "replay record --only implicit")
        self.assertIn("implicit: identical: 6 steps", whole.stdout, whole.stderr)
        for program in COMPONENTS:
            with self.subTest(program=program):
                replayed = self.call(alone(program), f"replay record --only {program}")
                self.assertEqual((replayed.returncode, replayed.stderr), (0, ""))
                self.assertIn(f"{program}: identical: 6 steps", replayed.stdout)
                missing = self.call(alone(program), "replay record --only implicit")
                self.assertEqual(missing.returncode, 2)
                self.assertIn("--only implicit: left out of this program, since it needs the membrane and the coupler;", missing.stderr)

    def test_help_names_what_is_there_and_what_is_missing(self):
        there = listed(self.call(WHOLE, "--help").stdout, "Subcommands")
        self.assertGreaterEqual(there.keys(), {"diff", "replay", "study", *NEEDS})
        for component in COMPONENTS:
            with self.subTest(component=component):
                text = self.call(alone(component), "--help").stdout
                missing = {name: f"needs {needs}" for name, needs in MISSING[component].items()}
                self.assertEqual(listed(text, "Left out of this program"), missing)
                self.assertEqual(listed(text, "Subcommands").keys(), there.keys() - missing.keys())
                self.assertLess(text.index("\nSubcommands:"), text.index("\nLeft out of this program:"))

    def test_a_missing_command_is_refused_whatever_its_arguments(self):
        for component in COMPONENTS:
            for name, needs in MISSING[component].items():
                for arguments in ("", " --help", " case.toml --out x"):
                    with self.subTest(component=component, command=name + arguments):
                        if name == "study":
                            arguments = " maxwell" + arguments
                            needs = "the membrane"
                        ended = self.call(alone(component), name + arguments)
                        self.assertEqual(ended.returncode, 2)
                        self.assertIn(f"left out of this program, since it needs {needs};", ended.stderr)

    def test_a_study_of_another_component_is_missing_among_the_studies(self):
        text = self.call(alone("membrane"), "study --help").stdout
        self.assertEqual(listed(text, "Subcommands").keys(), {"maxwell"})
        self.assertEqual(listed(text, "Left out of this program").keys(), {"strain-rate-noise", "kernel", "twisting-sphere", "layers"})

    def test_nothing_of_the_other_components_is_linked(self):
        for component in COMPONENTS:
            symbols = subprocess.run(["nm", "--demangle", alone(component)], capture_output=True, text=True, check=True).stdout
            # Functions and data of the libraries: not what headers alone make, which is weak.
            found = set(re.findall(r"^\w+ [TtDdRrBb] tanktread::(fluid|membrane|coupler)::", symbols, re.MULTILINE))
            self.assertEqual(found, {component})

    def test_a_mistake_in_the_case_is_refused_in_the_words_of_the_whole_program(self):
        for component in COMPONENTS:
            for mistake in ("flow.bocks=1", "flow.relaxation_time=0.4", "membrane.capillary_number=-1", "coupler=1", "coupler.tangential_correction=1", "run.threads=2.5"):
                with self.subTest(component=component, mistake=mistake):
                    command = f"{READING[component]} --set {mistake}"
                    ours, whole = self.call(alone(component), command), self.call(WHOLE, command)
                    self.assertEqual(whole.returncode, 2)
                    self.assertEqual((ours.returncode, ours.stderr), (whole.returncode, whole.stderr))

    def test_names_are_checked_by_the_component_that_has_them(self):
        for _, command in STAGES[:2]:
            self.call(WHOLE, command)
        for component in COMPONENTS:
            for key, owner in OF_A_COMPONENT.items():
                with self.subTest(component=component, key=key):
                    command = f"{READING[component]} --set {key}='mine'"
                    ours, whole = self.call(alone(component), command), self.call(WHOLE, command)
                    self.assertEqual(whole.returncode, 2)
                    if component == owner:
                        self.assertEqual((ours.returncode, ours.stderr), (2, whole.stderr))
                    else:
                        self.assertEqual((ours.returncode, ours.stderr), (0, ""))


if __name__ == "__main__":
    WHOLE, ALONE = (pathlib.Path(sys.argv.pop(1)).resolve() for _ in range(2))
    unittest.main()
