"""Run folders as tanktread writes them, made for the tests of post/, and a test case with a folder of its own."""

import contextlib
import csv
import io
import pathlib
import sys
import tempfile
import unittest

import meshio
import numpy

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(ROOT / "post"))

COLUMNS = (
    "step,shear_time,deformation,inclination_deg,length,width,breadth,volume_ratio,area_ratio,elastic_energy,max_speed,capsule,x,y,z"
).split(",")

ECHO = """title = 'made for a test'
[flow]
kind = 'shear'
box = [{width}, {width}, {width}]
wall_axis = 'z'
flow_axis = 'x'
reynolds_number = 0.1
viscosity_ratio = {viscosity_ratio}
inertia = {inertia}
[[capsule]]
radius = {radius}
position = [{centre}, {centre}, {centre}]
mesh = {{ shape = 'sphere', level = {level} }}
[membrane]
elastic_law = '{law}'
capillary_number = {capillary_number}
capillary_modulus = '{modulus}'
{law_parameters}
[coupler]
kernel = '{kernel}'
tangential_correction = {corrected}
[run]
shear_time = {shear_time}
"""


class InFolder(unittest.TestCase):
    """A test with a folder of its own, `self.folder`."""

    def setUp(self):
        directory = tempfile.TemporaryDirectory()
        self.addCleanup(directory.cleanup)
        self.folder = pathlib.Path(directory.name)

    def assert_refused(self, words, call, *arguments, **options):
        """The call raises InputError whose message has all the words."""
        from tanktread_post.observables import InputError

        with self.assertRaises(InputError) as caught:
            call(*arguments, **options)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, str(caught.exception))


def said(call, *arguments):
    """(what the call returns, what it prints): of case_results.judge and compare.compare the exit code and the tables."""
    printed = io.StringIO()
    with contextlib.redirect_stdout(printed):
        returned = call(*arguments)
    return returned, printed.getvalue()


def write_echo(folder, radius=8.0, width=72, law="skalak", capillary_number=0.02, modulus="G_s", kernel="cosine4", shear_time=3.0, inertia=True, viscous=None, commit="abc", corrected=False, viscosity_ratio=1.0, level=3):
    """echo.toml of a run (`viscous`: the keys of its membrane viscosity) and the beginning of its parameters.toml."""
    folder.mkdir(parents=True, exist_ok=True)
    law_parameters = ["area_ratio = 1.0"] if law == "skalak" else []
    law_parameters += [f"viscous.{key} = {value!r}" for key, value in (viscous or {}).items()]
    text = ECHO.format(
        radius=radius, width=width, centre=width / 2, law=law, capillary_number=capillary_number, modulus=modulus, kernel=kernel,
        shear_time=shear_time, inertia=str(inertia).lower(), corrected=str(corrected).lower(),
        viscosity_ratio=viscosity_ratio, level=level, law_parameters="\n".join(law_parameters),
    )  # fmt: skip
    (folder / "echo.toml").write_text(text)
    (folder / "parameters.toml").write_text(f"program = 'tanktread 0.1.0'\ncommit = '{commit}'\n[[capsule]]\nradius = {radius}\n")


def write_observables(folder, rows):
    """observables.csv; each row a dictionary, what it leaves out is 0 (capsule) or 1."""
    folder.mkdir(parents=True, exist_ok=True)
    with open(folder / "observables.csv", "w", newline="") as stream:
        writer = csv.DictWriter(stream, COLUMNS, restval="1", lineterminator="\n")
        writer.writeheader()
        writer.writerows({"capsule": 0, "step": k, **row} for k, row in enumerate(rows))


def write_run(folder, deformation=0.04, inclination=44.0, shear_time=3.0, end=None, **echo):
    """A run whose D and inclination are the same at all times, from 0 to `end` (its shear time by default)."""
    write_echo(folder, shear_time=shear_time, **echo)
    times = numpy.linspace(0.0, shear_time if end is None else end, 7)
    write_observables(folder, [{"shear_time": repr(t), "deformation": repr(deformation), "inclination_deg": repr(inclination)} for t in times])


def octahedron(centre, radius):
    """Points and triangles, counter-clockwise seen from outside."""
    points = numpy.array([[1, 0, 0], [-1, 0, 0], [0, 1, 0], [0, -1, 0], [0, 0, 1], [0, 0, -1]], float) * radius + centre
    triangles = numpy.array([[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4], [2, 0, 5], [1, 2, 5], [3, 1, 5], [0, 3, 5]])
    return points, triangles


def write_pictures(folder, width=12, fluid=True):
    """membrane.pvd with one .vtu, and fluid.pvd with one .vti (Couette flow) or nothing, at shear time 3."""
    points, triangles = octahedron(numpy.full(3, width / 2), width / 4)
    (folder / "membrane").mkdir()
    cells = {"area_ratio": [numpy.linspace(0.9, 1.1, len(triangles))], "stress": [numpy.ones((len(triangles), 9))]}
    meshio.write(folder / "membrane/membrane_1.vtu", meshio.Mesh(points, [("triangle", triangles)], cell_data=cells))
    write_series(folder / "membrane.pvd", [(3.0, "membrane/membrane_1.vtu")])
    write_series(folder / "fluid.pvd", [(3.0, "fluid/fluid_1.vti")] if fluid else [])
    if not fluid:
        return
    (folder / "fluid").mkdir()
    z = numpy.arange(width) + 0.5
    along = numpy.repeat(z - width / 2, width * width) / 1000
    velocity = numpy.stack([along, 0 * along, 0 * along], axis=1)
    extent = f"0 {width - 1} 0 {width - 1} 0 {width - 1}"
    (folder / "fluid/fluid_1.vti").write_text(
        f"""<VTKFile type="ImageData" version="0.1" byte_order="LittleEndian">
<ImageData WholeExtent="{extent}" Origin="0.5 0.5 0.5" Spacing="1 1 1"><Piece Extent="{extent}"><PointData>
<DataArray type="Float64" Name="velocity" NumberOfComponents="3" format="ascii">
{" ".join(map(repr, velocity.ravel().tolist()))}
</DataArray></PointData></Piece></ImageData></VTKFile>
"""
    )


def write_series(file, entries):
    """A .pvd."""
    rows = "".join(f'<DataSet timestep="{time!r}" part="0" file="{name}"/>' for time, name in entries)
    file.write_text(f'<VTKFile type="Collection" version="0.1"><Collection>{rows}</Collection></VTKFile>')
