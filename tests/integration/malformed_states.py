"""Finished runs, records, series and tables that were spoilt: what resuming, replaying and comparing must refuse."""

from malformed_rows import Row, array, field, grid, series, spoilt, surface

CHECKPOINT = "out/checkpoints/step_0000000012"
RESUME = "run --resume out --shear-time 0.08"


def cut(before):
    return before[:-100]


def flipped(before):
    """One bit of the numbers changed."""
    at = before.index(b'encoding="raw"') + 200
    return before[:at] + bytes([before[at] ^ 1]) + before[at + 1 :]


def resumed(name, files, *message, command=RESUME, remove=()):
    return Row(name, command, list(message), files, run=True, remove=remove)


def replayed(name, files, *message, component="membrane", remove=()):
    return Row(name, f"replay record --only {component}", list(message), files, run=True, remove=remove)


def of_series(name, content, *message, names="s.pvd"):
    """A series as the motion of a membrane."""
    return Row(name, "membrane --case case.toml --motion s.pvd --out new", [names, *message], {"s.pvd": content})


def of_another_case(key, old, new):
    """The case of a run changed after its states were made."""
    return resumed(f"a run of another {key}", {"out/echo.toml": spoilt(old, new)}, "echo.toml", key)


def words_for_rows(before):
    return before.splitlines(True)[0] + b"a,b,c\n"


def first_lines(n):
    return lambda before: b"".join(before.splitlines(True)[:n])


SPHERE_LIKE = {"point_data": array("reference_position", [0.0] * 12, 3) + array("velocity", [0.0] * 12, 3) + array("total_force", [0.0] * 12, 3)}


def no_history():
    """A membrane's state in all but its law's history."""
    return surface(**SPHERE_LIKE, field_data=field("step", [12.0]))


def of_step(step):
    """A membrane's state, or a packet of positions, of that step."""
    return surface(**SPHERE_LIKE, field_data=field("step", [float(step)]) + field("history_0", []))


FLUID, MEMBRANE = f"{CHECKPOINT}/fluid.vti", f"{CHECKPOINT}/membrane.vtu"

STATES = [
    resumed("a state of the fluid cut off", {FLUID: cut}, FLUID, "cut off", "cannot be used"),
    resumed("a state of the fluid with a bit changed", {FLUID: flipped}, FLUID, "damaged", "cannot be used"),
    resumed("a state of the fluid without its head", {FLUID: lambda before: before[40:]}, FLUID, "cannot be used"),
    resumed("a state of the fluid that is empty", {FLUID: ""}, FLUID, "cut off"),
    resumed("a state of the fluid that is a surface", {FLUID: surface()}, FLUID, "not a grid (.vti)"),
    resumed("a state of another box", {FLUID: grid("0 1 0 1 0 1")}, CHECKPOINT),
    resumed("a state without the fluid", {}, FLUID, "no such file", remove=(FLUID,)),
    resumed("a state of the membrane cut off", {MEMBRANE: cut}, MEMBRANE, "cut off", "cannot be used"),
    resumed("a state of the membrane with a bit changed", {MEMBRANE: flipped}, MEMBRANE, "damaged", "cannot be used"),
    resumed("a state of another membrane", {MEMBRANE: surface()}, MEMBRANE, "reference_position"),
    resumed("a state of a membrane without history", {MEMBRANE: no_history()}, MEMBRANE, "history_0"),
    resumed("a state of two steps", {MEMBRANE: of_step(11)}, MEMBRANE, "of step 11", "step 12"),
    resumed("a state without the membrane", {}, MEMBRANE, "no such file", remove=(MEMBRANE,)),
    resumed("a state of less than no row", {f"{CHECKPOINT}/output.toml": "rows = 3\nmeasures_rows = -1\n"}, "output.toml", "measures_rows"),
    resumed("a run without states", {}, "no checkpoint to resume from", remove=("out/checkpoints",)),
]

RUNS = [
    resumed("a run without its case", {}, "--resume out", "echo.toml", remove=("out/echo.toml",)),
    resumed("a run with an empty case", {"out/echo.toml": ""}, "out/echo.toml", "capsule: is missing"),
    resumed("a run with half a case", {"out/echo.toml": lambda before: before[:200]}, "out/echo.toml"),
    resumed("a run of a negative radius", {"out/echo.toml": spoilt(b"radius = 3.0", b"radius = -3.0")}, "out/echo.toml", "radius"),
    of_another_case("radius", b"radius = 3.0", b"radius = 2.5"),
    of_another_case("wall_speed", b"wall_speed = 0.02", b"wall_speed = 0.01"),
    of_another_case("capillary_number", b"capillary_number = 0.3", b"capillary_number = 0.1"),
    of_another_case("kernel", b'kernel = "stockie6"', b'kernel = "roma3"'),
    of_another_case("relaxation_time", b"relaxation_time = 1.0", b"relaxation_time = 0.9"),
    resumed("a run with a table that is not its own", {"out/observables.csv": "step,x\n0,1\n"}, "observables.csv", "another header"),
    resumed("a run without its table", {}, "observables.csv", "is missing", remove=("out/observables.csv",)),
    resumed("a run with an empty table", {"out/observables.csv": ""}, "observables.csv"),
    resumed("a run with a table cut short", {"out/observables.csv": first_lines(2)}, "observables.csv", "1 of 3 rows"),
    resumed("a run with a table of words", {"out/observables.csv": words_for_rows}, "observables.csv", "line 2"),
    resumed("a run with another's series", {"out/membrane.pvd": series('<DataSet timestep="0" file="cell.vtu"/>')}, "membrane.pvd", "cell.vtu"),
]

VELOCITY = "record/grid_velocity/grid_velocity_0000000001.vti"

RECORDS = [
    replayed("a record without its case", {}, "record: holds no echo.toml", remove=("record/echo.toml",)),
    replayed("a record without its beginning", {}, "record: holds no begin", remove=("record/begin",)),
    replayed("a record with a case of nothing", {"record/echo.toml": ""}, "record/echo.toml"),
    replayed("a record whose beginning is cut off", {"record/begin/membrane.vtu": cut}, "record/begin/membrane.vtu", "cut off"),
    replayed("a record whose end is another", {"record/end/membrane.vtu": surface()}, "record"),
    replayed("a record of a missing packet", {}, "positions_0000000001.vtu", "no such file", remove=("record/positions/positions_0000000001.vtu",)),
    replayed("a record of a packet cut off", {"record/node_force/node_force_0000000002.vtu": cut}, "node_force_0000000002.vtu", "cut off"),
    replayed("a record of a packet of another step", {"record/positions/positions_0000000001.vtu": of_step(7)}, "positions_0000000001.vtu", "step 7"),
    replayed("a record of a packet of another grid", {VELOCITY: grid("0 1 0 1 0 1", field_data=field("step", [1.0]))}, VELOCITY, component="coupler"),
]

SERIES = [
    of_series("a series of nothing", "", "cut off"),
    of_series("half a series", series()[:80], "cut off"),
    of_series("a series that is a surface", surface(), "is not a .pvd series"),
    of_series("a series without its collection", series().replace("Collection>", "Collections>"), "it has no element Collection"),
    of_series("a series that is no XML", "timestep,file\n0,a.vtu\n</VTKFile>", "cannot be read"),
    of_series("a series without a time", series('<DataSet file="a.vtu"/>'), "entry 0 lacks its attribute 'timestep'"),
    of_series("a series without a file", series('<DataSet timestep="0"/>'), "entry 0 lacks its attribute 'file'"),
    of_series("a series at a time of a word", series('<DataSet timestep="soon" file="a.vtu"/>'), 'timestep "soon"'),
    of_series("a series at no number", series('<DataSet timestep="nan" file="a.vtu"/>'), 'timestep "nan"'),
    of_series("a series at infinity", series('<DataSet timestep="1e999" file="a.vtu"/>'), 'timestep "1e999"'),
    of_series("a series at two numbers", series('<DataSet timestep="0 1" file="a.vtu"/>'), 'timestep "0 1"'),
    Row("a series of no entries", "membrane --case case.toml --motion s.pvd --out new", ["s.pvd"], {"s.pvd": series()}),
    of_series("a series of a file that is not there", series('<DataSet timestep="0" file="none.vtu"/>'), names="none.vtu"),
]

COMPARED = [
    Row("two series of nothing", "diff a.pvd b.pvd", ["a.pvd", "cut off"], {"a.pvd": "", "b.pvd": series()}),
    Row("a surface and half of it", "diff a.vtu b.vtu", ["b.vtu", "cut off"], {"a.vtu": surface(), "b.vtu": surface()[:300]}),
    Row("a surface and a grid of its name", "diff a.vtu b.vtu", ["b.vtu", "not a surface (.vtu)"], {"a.vtu": surface(), "b.vtu": grid()}),
    Row("a grid and half of it", "diff a.vti b.vti", ["b.vti", "cut off"], {"a.vti": grid(), "b.vti": grid()[:200]}),
]

ROWS = [*STATES, *RUNS, *RECORDS, *SERIES, *COMPARED]
