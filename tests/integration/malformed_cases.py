"""Case files that must be refused: each row spoils the good case in one way, by its text or by --set."""

from malformed_rows import CASE, Row, changed

RUN = "run case.toml --output out"


def text(name, old, new, *message):
    """The good case with a piece of its text replaced."""
    return Row(name, RUN, list(message), {"case.toml": changed(CASE, old, new)})


def whole(name, content, *message):
    """Another case file altogether."""
    return Row(name, RUN, list(message), {"case.toml": content})


def assigned(name, assignment, *message):
    """The good case with an assignment over it, which the message names unless it says otherwise."""
    return Row(name, RUN + " --set {assignment}", list(message or [assignment]), words={"assignment": assignment})


SYNTAX = [
    whole("an empty file", "", "flow.box", "capsule: is missing"),
    whole("only a comment", "# nothing\n", "flow.box", "capsule: is missing"),
    whole("bytes that are no text", bytes(range(128, 256)), "case.toml:1", "not valid TOML"),
    whole("zero bytes", b"\0" * 64, "case.toml:1", "not valid TOML"),
    whole("UTF-16", CASE.encode("utf-16"), "case.toml:1", "not valid TOML"),
    whole("half a file", CASE[: len(CASE) // 2], "case.toml:8", "not valid TOML"),
    text("a table without its bracket", "[flow]", "[flow", "case.toml:2", "not valid TOML"),
    text("a key twice", "wall_speed = 0.02", "wall_speed = 0.02\nwall_speed = 0.03", "case.toml:5", "not valid TOML"),
    text("a table twice", "[run]", "[flow]\n[run]", "case.toml:12", "not valid TOML"),
    text("a key without a value", "wall_speed = 0.02", "wall_speed =", "case.toml:4", "not valid TOML"),
    text("a text without its end", '"Small capsule"', '"Small capsule', "case.toml:1", "not valid TOML"),
    text("a number with a comma", "wall_speed = 0.02", "wall_speed = 0,02", "case.toml:4", "not valid TOML"),
    text("an integer of 40 digits", "wall_speed = 0.02", "wall_speed = " + "1" * 40, "case.toml:4", "not valid TOML"),
    text("a date", "wall_speed = 0.02", "wall_speed = 2021-01-01", "case.toml:4", "flow.wall_speed", "a number > 0"),
    text("lists in lists, 300 deep", "wall_speed = 0.02", "wall_speed = " + "[" * 300 + "]" * 300, "case.toml:4", "not valid TOML"),
    text("a key of 3000 parts", "wall_speed = 0.02", ".".join(["a"] * 3000) + " = 1", "case.toml:4", "parts"),
    text("a key of 100 kB", "wall_speed = 0.02", "a" * 100_000 + " = 1", "case.toml:4", "unknown key"),
]

NAMES = [
    text("a key that is none", "wall_speed", "wall_sped", "case.toml:4", "did you mean flow.wall_speed?"),
    text("a table that is none", "[membrane]", "[membrame]", "case.toml:9", "did you mean membrane?"),
    text("a key in another table", "[run]", '[run]\nkernel = "roma3"', "did you mean coupler.kernel?"),
    text("a dotted name in quotes", "[flow]", '"flow.kind" = "shear"\n[flow]', "must not be quoted"),
    text("an empty name", "wall_speed", '"" = 1\nwall_speed', "case.toml:2: flow.: unknown key"),
    text("one bracket for a capsule", "[[capsule]]", "[capsule]", "write [[capsule]]"),
    text("a capsule that is a number", "[[capsule]]", "[capsules]", "capsule: is missing"),
    whole("capsules that are numbers", "capsule = [1, 2]\n" + CASE[: CASE.find("[[capsule")], "capsule", "list of tables"),
    whole("a table that is a number", "run = 3\n" + CASE[: CASE.find("[run]")], "run = 3", "must be a table"),
]

TYPES = [
    assigned("a text for a number", "flow.wall_speed=fast"),
    assigned("true for a number", "flow.wall_speed=true"),
    assigned("a number for a text", "flow.kind=3"),
    assigned("a number for true", "flow.inertia=1"),
    assigned("a list for a number", "capsule.0.radius=[1, 2]"),
    assigned("a table for a number", "capsule.0.radius={a = 1}"),
    assigned("a real for an integer", "capsule.0.mesh.level=2.0"),
    assigned("two for three", "flow.box=[12, 12]"),
    assigned("four for three", "flow.box=[12, 12, 12, 12]"),
    assigned("a text in a list of numbers", "capsule.0.position=[6, 6, 'a']"),
    assigned("a list in a list of numbers", "capsule.0.position=[6, 6, [6]]"),
    assigned("two words in one range", "output.fluid_box=[[0, 1], [0, 1], [0]]"),
    assigned("a program that is a text", "membrane.command=sh"),
    assigned("a program of numbers", "membrane.command=[1]"),
    assigned("a word that is none", "flow.kind=sheer", 'did you mean "shear"?'),
    assigned("an empty word", "coupler.kernel=", "coupler.kernel"),
]

RANGES = [
    assigned("not a number", "flow.wall_speed=nan", "is not finite"),
    assigned("infinite", "flow.wall_speed=inf", "is not finite"),
    assigned("minus infinite", "flow.body_force=[0, 0, -inf]"),
    assigned("no wall speed", "flow.wall_speed=0"),
    assigned("a negative radius", "capsule.0.radius=-3"),
    assigned("no radius", "capsule.0.radius=0.0"),
    assigned("relaxation time of one half", "flow.relaxation_time=0.5", "a number > 0.5"),
    assigned("a box of three", "flow.box=[12, 12, 3]", "three integers >= 4"),
    assigned("a negative box", "flow.box=[12, 12, -12]", "three integers >= 4"),
    assigned("a box beyond 32 bits", "flow.box=[12, 12, 4294967308]", "three integers"),
    assigned("a level of nine", "capsule.0.mesh.level=9", "an integer >= 0 and <= 8"),
    assigned("a negative level", "capsule.0.mesh.level=-1", "an integer >= 0 and <= 8"),
    assigned("a level beyond 64 bits", "capsule.0.mesh.level=99999999999999999999"),
    assigned("a needle for a spheroid", "capsule.0.mesh={shape='spheroid', aspect_ratio=20}", "capsule.0.mesh.aspect_ratio", "a number >= 0.1 and <= 10"),
    assigned("a leaf for a spheroid", "capsule.0.mesh={shape='spheroid', reduced_volume=0.4}", "capsule.0.mesh.reduced_volume", "a number >= 0.5 and <= 1"),
    assigned("more than a sphere without stress", "capsule.0.stress_free={shape='spheroid', reduced_volume=1.1}", "a number >= 0.5 and <= 1"),
    assigned("a shape that is none", "capsule.0.mesh.shape=biconvex", 'one of "sphere", "biconcave", "spheroid"'),
    assigned("a stress-free shape that is none", "capsule.0.stress_free.shape=cube", "capsule.0.stress_free.shape"),
    assigned("a direction that is not a number", "capsule.0.mesh.direction=[0, nan, 1]", "capsule.0.mesh.direction"),
    assigned("a direction in a plane", "capsule.0.mesh.direction=[0, 1]", "capsule.0.mesh.direction", "three numbers"),
    assigned("an infinite angle", "capsule.0.mesh.euler_angles=[0, inf, 0]", "capsule.0.mesh.euler_angles"),
    assigned("a Poisson ratio of one", "membrane.poisson_ratio=1"),
    assigned("a load without a direction", "capsule.0.load.direction=[0, 0, 0]", "capsule.0.load.direction", "has the length 0; give a vector"),
    assigned("a load along two numbers", "capsule.0.load.direction=[1, 0]"),
    assigned("a patch of nothing", "capsule.0.load.patch=0", "a number > 0 and <= 0.5"),
    assigned("a patch of more than half", "capsule.0.load.patch=0.6", "a number > 0 and <= 0.5"),
    assigned("a load that ends before it begins", "capsule.0.load.until=0", "a number > 0"),
    assigned("a load that is not finite", "capsule.0.load.force=inf"),
    assigned("a load in newtons without SI", "si.load_force_N=1e-11", "si."),
    assigned("a negative bending modulus", "membrane.bending_modulus=-1", "membrane.bending_modulus", "a number >= 0"),
    assigned("a curvature that is not finite", "membrane.spontaneous_curvature=inf", "membrane.spontaneous_curvature"),
    assigned("a negative modulus of the whole area", "membrane.global_area_modulus=-1", "membrane.global_area_modulus", "a number >= 0"),
    assigned("an area modulus that is not a number", "membrane.local_area_modulus=nan", "membrane.local_area_modulus"),
    assigned("a negative volume modulus", "membrane.volume_modulus=-1", "membrane.volume_modulus", "a number >= 0"),
    assigned("an area at rest of zero", "membrane.reference_area=0", "membrane.reference_area", "a number > 0"),
    assigned("a negative volume at rest", "membrane.reference_volume=-0.5", "membrane.reference_volume", "a number > 0"),
    assigned("a capillary number of zero", "membrane.capillary_number=0", "a number > 0"),
    assigned("an interval of zero", "membrane.viscous.interval=0", "an integer >= 1"),
    assigned("negative threads", "run.threads=-1", "an integer >= 0"),
    assigned("a million threads", "run.threads=1000000"),
    assigned("a negative end", "run.shear_time=-1"),
    assigned("an end that is not a number", "run.shear_time=nan", "is not finite"),
    assigned("no checkpoints", "run.checkpoint_every=0", "a number > 0"),
    assigned("a negative output interval", "output.membrane_every=-0.5"),
    assigned("measures in words", "output.measures_every='often'", "output.measures_every", "a number >= 0"),
    assigned("a negative interval of the energy", "output.energy_every=-1", "output.energy_every", "a number >= 0"),
    whole("the energy of an outside fluid", changed(CASE, "[flow]", "[output]\nenergy_every = 0.1\n[flow]\ncommand = ['sh']"), "output.energy_every", "flow.command"),
    assigned("a fluid box outside", "output.fluid_box=[[0, 12], [0, 1], [0, 1]]", "output.fluid_box", "<= 11"),
    assigned("a fluid box backwards", "output.fluid_box=[[3, 2], [0, 1], [0, 1]]", "output.fluid_box", "first <= last"),
]

# Five nodes along x, and a capsule that has room there.
NARROW = changed(changed(changed(CASE, "12, 12, 12", "5, 12, 12"), "6.0, 6.0, 6.0", "2.5, 6.0, 6.0"), "radius = 3.0", "radius = 2.0")

# A program in the place of the fluid, of which an implicit viscosity asks too much.
IMPLICIT_OUTSIDE = changed(CASE, "[flow]", "[flow]\ncommand = ['sh']").replace("capillary_number = 0.3", "capillary_number = 0.3\nviscous.scheme = 'implicit'")

TOGETHER = [
    assigned("two speeds", "flow.reynolds_number=0.1", "contradicts"),
    assigned("a shear rate between walls", "flow.shear_rate=1e-4", 'kind = "periodic"'),
    assigned("a wall across the flow", "flow.flow_axis=z", "wall axis"),
    assigned("a parameter of another law", "membrane.area_ratio=1", "neo-hookean", "has none"),
    assigned("a modulus of another law", "membrane.capillary_modulus=gamma", "contradicts elastic_law"),
    assigned("a bending modulus beside no law", "membrane={elastic_law='none', capillary_number=1, bending_modulus=1}", "membrane.bending_modulus", "of kappa_b"),
    assigned("the modulus of a law without a law", "membrane={elastic_law='none', capillary_number=1, capillary_modulus='G_s'}", "give \"kappa_b\""),
    assigned("energies beside a program", "membrane={capillary_number=1, volume_modulus=1, command=['sh']}", "membrane.volume_modulus", "contradicts membrane.command"),
    assigned("no law beside a program", "membrane={elastic_law='none', capillary_number=1, command=['sh']}", "membrane.elastic_law", "contradicts membrane.command"),
    assigned("a scheme without a spring", "membrane.viscous.scheme=fd", "exactly one of spring_stiffness"),
    assigned("an implicit scheme with two springs", "membrane.viscous={scheme='implicit', spring_stiffness=1, spring_modulus=1}", "at most one of spring_stiffness"),
    assigned("an implicit scheme every three steps", "membrane.viscous={scheme='implicit', interval=3}", "membrane.viscous.interval", "in every step"),
    assigned("an implicit scheme with samples of strain", "membrane.viscous={scheme='implicit', strain_sampling='latest'}", "looks at no strain"),
    assigned("an implicit scheme of dE/dt", "membrane.viscous={scheme='implicit', stress_measure='rate-of-strain'}", "rate of deformation"),
    assigned("strain rates of an explicit scheme", "membrane.viscous={scheme='fd', spring_stiffness=1, strain_rates='nodes'}", "of scheme = \"implicit\" only"),
    assigned("a tolerance of no equations", "coupler.implicit_tolerance=1e-6", "which no capsule has"),
    assigned("iterations of no equations", "coupler.implicit_iterations=10", "which no capsule has"),
    whole("implicit forces of an outside fluid", IMPLICIT_OUTSIDE, "membrane.viscous.scheme", "contradicts flow.command"),
    assigned("an inner viscosity of none", "flow.viscosity_ratio=0", "a number > 0"),
    assigned("a negative viscosity ratio", "capsule.0.viscosity_ratio=-1", "a number > 0"),
    assigned("an inner viscosity without physical values", "si.inner_viscosity_Pa_s=1e-3", "si."),
    whole("two viscosities of an outside fluid", changed(CASE, "[flow]", "[flow]\ncommand = ['sh']\nviscosity_ratio = 5"), "flow.command", "the same viscosity everywhere"),
    assigned("a program that is not there", "membrane.command=['no-such-program']", "no-such-program"),
    assigned("a spheroid of no numbers", "capsule.0.mesh.shape=spheroid", "needs aspect_ratio or reduced_volume"),
    assigned("a stress-free spheroid of no numbers", "capsule.0.stress_free.shape=spheroid", "needs aspect_ratio or reduced_volume"),
    assigned("a spheroid of two numbers", "capsule.0.mesh={shape='spheroid', aspect_ratio=0.5, reduced_volume=0.9}", "contradicts aspect_ratio"),
    assigned("an aspect ratio of a sphere", "capsule.0.mesh.aspect_ratio=0.5", 'of "spheroid" only'),
    assigned("a stress-free reduced volume of no shape", "capsule.0.stress_free.reduced_volume=0.9", 'of "spheroid" only'),
    assigned("a direction of no length", "capsule.0.mesh.direction=[0, 0, 0]", "capsule.0.mesh.direction", "points nowhere"),
    assigned("a direction and angles", "capsule.0.mesh={direction=[1, 0, 0], euler_angles=[0, 90, 0]}", "contradicts mesh.direction"),
    assigned("a stress-free file that is not there", "capsule.0.stress_free.file=none.vtu", "there is no file", "none.vtu"),
    assigned("a hash of no stress-free file", "capsule.0.stress_free.file_hash=0123456789abcdef", "is of the file beside it"),
    assigned("a disc across the wall", "capsule.0.mesh={shape='biconcave', level=1, direction=[1, 0, 0]}", "capsule.0.position"),
    assigned("a capsule outside the box", "capsule.0.position=[6, 6, 60]", "capsule.0.position", "outside the box"),
    assigned("a capsule in the wall", "capsule.0.position=[6, 6, 1]", "capsule.0.position", "wall"),
    assigned("a capsule near a wall", "capsule.0.position=[6, 6, 5.5]", "leaves 2.5 grid steps", "stockie6 reaches 3", 'or coupler.kernel = "peskin4"'),
    whole("a box narrower than the kernel", NARROW, "flow.box", "5 nodes along x", "stockie6 is 6 wide", 'or coupler.kernel = "peskin4"'),
    assigned("a capsule over its image", "capsule.0.radius=6.5", "capsule.0.radius", "periodic image"),
    assigned("a position that is not a number", "capsule.0.position=[6, nan, 6]", "capsule.0.position"),
    text("two capsules in one place", "[membrane]", "[[capsule]]\nradius = 3\nposition = [6, 6, 6]\n[membrane]", "overlaps capsule 0"),
    text("no box", "box = [12, 12, 12]\n", "", "flow.box: is missing"),
    text("no speed", "wall_speed = 0.02\n", "", "flow.reynolds_number: is missing"),
    text("no radius at all", "radius = 3.0\n", "", "capsule.0.radius: is missing"),
    text("numbers in two unit systems", "[run]", "[si]\nradius_m = 4e-6\n[run]", "si.", "capillary_number"),
]

ROWS = [*SYNTAX, *NAMES, *TYPES, *RANGES, *TOGETHER]
