"""Command lines that must be refused."""

from malformed_rows import Row, surface

RUN = "run case.toml --output new"
TOO_LONG = "a" * 300  # for a name on any file system

SUBCOMMANDS = [
    Row("no subcommand", "", ["subcommand"]),
    Row("a subcommand that is none", "rnu case.toml", ["'rnu'", "did you mean run?"]),
    Row("an option before the subcommand", "--threads 2 run case.toml", ["--threads"]),
    Row("a component without its subcommand", "coupler", ["subcommand"]),
    Row("a mesh that is none", "mesh cube x.vtu", ["cube"]),
    Row("a study that is none", "study viscometer", ["viscometer"]),
]

RUNS = [
    Row("no case", "run", ["a case file (or --resume DIR) is needed"]),
    Row("a plan of nothing", "plan", ["case"]),
    Row("a case that is not there", "run none.toml", ["none.toml: there is no such case file"]),
    Row("a case that is a folder", "run .", [".: is a folder, not a case file; give the path of a .toml"]),
    Row("a case that is a run", "plan out", ["out: is a folder, not a case file; give the path of a .toml, as out/echo.toml"], run=True),
    Row("two cases", "run case.toml case.toml", ["case.toml"]),
    Row("an option that is none", RUN + " --treads 2", ["--treads"]),
    Row("an option without its value", RUN + " --set", ["--set"]),
    Row("an assignment of nothing", RUN + " --set flow.box", ["--set flow.box: write key=value"]),
    Row("an assignment to nothing", RUN + " --set =3", ["--set =3: write key=value"]),
    Row("an assignment to a key that is none", RUN + " --set flow.bxo=3", ["flow.bxo", "did you mean flow.box?"]),
    Row("an assignment to the sixth capsule", RUN + " --set capsule.5.radius=3", ["capsule.5", "there is 1 capsule, number 0"]),
    Row("an assignment to capsule x", RUN + " --set capsule.x.radius=3", ["capsule.x"]),
    Row("an assignment to capsule 10^20", RUN + " --set capsule.100000000000000000000.radius=3", ["capsule.100000000000000000000"]),
    Row("an assignment beyond a list", RUN + " --set flow.box.7=3", ["flow.box.7", "elements 0 to 2"]),
    Row("an assignment within a number", RUN + " --set flow.wall_speed.x=3", ["flow.wall_speed is a single value"]),
    Row("an assignment that is not TOML", RUN + " --set flow.box=[12,12", ["flow.box", "not valid TOML"]),
    Row("an assignment of 3000 parts", RUN + " --set " + ".".join(["a"] * 3000) + "=1", ["more than 32 parts"]),
    Row("threads that are a word", RUN + " --threads two", ["--threads", "two"]),
    Row("threads below nought", RUN + " --threads -1", ["--threads", "-1"]),
    Row("an end that is a word", RUN + " --shear-time soon", ["--shear-time", "soon"]),
    Row("an end below nought", RUN + " --shear-time -1", ["shear", "-1"]),
    Row("a resume of nothing", "run --resume none", ["--resume none", "echo.toml"]),
    Row("a resume of a file", "run --resume case.toml", ["--resume case.toml", "echo.toml"]),
    Row("a resume elsewhere", "run --resume out --output new", ["--resume", "--output"]),
    Row("a resume elsewhere by another name", "run --resume out --out new", ["--resume", "--output"]),
    Row("a resume with other keys", "run --resume out --set run.threads=1", ["--resume", "--set"]),
    Row("a resume into the past", "run --resume out --shear-time 0.001", ["--shear-time 0.001", "give a later time"], run=True),
    Row("a record that ends before it begins", RUN + " --record r --from 5 --to 2", ["--from 5 --to 2"]),
    Row("a record beyond the end", RUN + " --record r --to 100000", ["--to 100000"]),
    Row("a record of no name", RUN + " --from 1", ["--from", "--record"]),
    Row("a record beside files", RUN + " --record r --through-files", ["--record", "--through-files"]),
    Row("a record over a file", RUN + " --record case.toml", ["--record case.toml", "is no directory"]),
    Row("a record over another", RUN + " --record record", ["--record record", "holds something already"], run=True),
    Row("an output that is a file", "run case.toml --output case.toml", ["--output case.toml: is a file"]),
    Row("an output over a run", "run case.toml --output out", ["--output out", "--force", "--resume out"], run=True),
    Row("--force over what is no run", "run case.toml --output . --force", ["--output .", "--force removes an earlier run only"]),
]

PATHS = [
    Row(f"a path that the system refuses: {what}", command, [f"{TOO_LONG}", ": File name too long; give another path"])
    for what, command in (
        ("case", f"plan {TOO_LONG}"), ("output", f"run case.toml --output {TOO_LONG}"), ("resume", f"run --resume {TOO_LONG}"),
        ("record", RUN + f" --record {TOO_LONG}"), ("diff", f"diff {TOO_LONG} case.toml"), ("replay", f"replay {TOO_LONG} --only fluid"),
        ("surface", f"coupler spread --case case.toml --in {TOO_LONG} --out new.vti"), ("motion", f"membrane --case case.toml --motion twist --out {TOO_LONG}"),
    )
]  # fmt: skip

NUMBERS = [
    Row("a level in hexadecimal digits", "mesh sphere --level 0x3 x.vtu", ["--level 0x3", "decimal digits"]),
    Row("a level of 20 digits", "mesh sphere --level 99999999999999999999 x.vtu", ["--level 99999999999999999999"]),
    Row("a radius beyond all numbers", "mesh sphere --radius 1e400 x.vtu", ["--radius 1e400", "double precision"]),
    Row("a radius in hexadecimal digits", "mesh sphere --radius 0x1p3 x.vtu", ["--radius 0x1p3", "is no number"]),
    Row("an infinite radius", "mesh sphere --radius inf x.vtu", ["--radius inf", "is not finite"]),
    Row("a centre that is not a number", "mesh sphere --centre 1 2 nan --radius 1 x.vtu", ["--centre nan", "is not finite"]),
    Row("an end beyond all steps", RUN + " --shear-time 1e18", ["run.shear_time", "over the 9999999999 that a run can have"]),
    Row("threads beyond 32 bits", RUN + " --threads 99999999999", ["--threads 99999999999", "<= 1024"]),
    Row("a step as a real number", RUN + " --record r --from 1e3", ["--from 1e3", "decimal digits"]),
    Row("steps beyond 64 bits", "fluid --case case.toml --steps 99999999999999999999 --out x.vti", ["--steps 99999999999999999999"]),
    Row("a box of 32 bits", RUN + " --set flow.box=[2147483647,4,4]", ["flow.box", "<= 100000"]),
    Row("a plan for no rank", "plan case.toml --ranks 0", ["--ranks 0", ">= 1 and <= 10000000"]),
    Row("a plan for a prime number of ranks", "plan case.toml --ranks 99991", ["case.toml: --ranks 99991", "would do"]),
    Row("messages that take no time to arrive", RUN + " --set run.message_bandwidth_GB_s=0", ["run.message_bandwidth_GB_s", ">= 1e-06"]),
    Row("an update every 10^11 steps", RUN + " --set membrane.viscous.interval=99999999999", ["interval", "<= 1000000"]),
    Row("a time step of 10^-300", "study maxwell --dt 1e-300 --out x.csv", ["1e-300", "make it longer"]),
    Row("a box of two", "study twisting-sphere --box 2 --out x.csv", ["--box 2", ">= 4"]),
    Row("an axis of no length", "study twisting-sphere --axis 0 0 0 --out x.csv", ["the axis must not be zero"]),
]

OVER_OTHERS = [
    Row("a sphere over a case", "mesh sphere --level 0 case.toml", ["case.toml", "ends in .vtu"]),
    Row("a sphere as STL", "mesh sphere --level 0 ball.stl", ["ball.stl", "ends in .vtu"]),
    Row("a fluid over a case", "fluid --case case.toml --steps 1 --out case.toml", ["--out case.toml", "ends in .vti"]),
    Row("a membrane as a grid", "membrane --case case.toml --out x.vti", ["--out x.vti", "ends in .vtu"]),
    Row("a table over a case", "study maxwell --out case.toml", ["--out case.toml", "ends in .csv"]),
]

WRONG_FILES = [
    Row("a record below a file", RUN + " --record case.toml/x", ["--record case.toml/x", "is no directory"]),
    Row("an output below a file", "run case.toml --output case.toml/x", ["case.toml/x"]),
    Row("a case for a surface", "membrane --case case.toml --in case.toml --out x.vtu", ["case.toml", "is a TOML file, not a surface (.vtu)"]),
    Row("a case for a mesh", "mesh info case.toml", ["case.toml", "is a TOML file, not a surface (.vtu)"]),
    Row("a surface for a case", "run a.vtu --output new", ["a.vtu:1: not valid TOML"], {"a.vtu": surface()}),
    Row("a motion into a file", "membrane --case case.toml --motion twist --out case.toml", ["--out case.toml", "is no directory"]),
    Row("a replay of a run", "replay out --only fluid", ["out: holds no begin"], run=True),
    Row("a replay of a case", "replay case.toml --only fluid", ["case.toml: holds no echo.toml"]),
]

STAGES = [
    Row("a membrane of no case", "membrane --out x.vtu", ["--case"]),
    Row("a membrane to nowhere", "membrane --case case.toml", ["--out"]),
    Row("a membrane to a folder that is not there", "membrane --case case.toml --out none/x.vtu", ["none/x.vtu: there is no folder"]),
    Row("a membrane to a folder", "membrane --case case.toml --out .", ["is a folder"]),
    Row("a membrane from nothing", "membrane --case case.toml --in none.vtu --out x.vtu", ["none.vtu: no such file"]),
    Row("a move of nothing", "membrane --case case.toml --move --out x.vtu", ["--move", "--in"]),
    Row("a drag into a file", "membrane drag --case case.toml --out case.toml", ["--out case.toml", "is no directory"]),
    Row("a drag of nothing", "membrane drag --case case.toml --drag 0 --out x", ["--drag 0", "> 0"]),
    Row("a drag without a case", "membrane drag --out x", ["--case"]),
    Row("a drag without an output", "membrane drag --case case.toml", ["--out"]),
    Row("a membrane without an output", "membrane --case case.toml", ["--out"]),
    Row("a drag from what is not there", "membrane drag --case case.toml --in none.vtu --out x", ["none.vtu: no such file"]),
    Row("a drag from another mesh", "membrane drag --case case.toml --in sphere.vtu --out x", ["sphere.vtu", "capsule 0 has"], {"sphere.vtu": surface()}),
    Row("a drag on a program", "membrane drag --case case.toml --set membrane.command=['sh'] --out x", ["membrane.command"]),
    Row("a drag with a spring that is implicit", "membrane drag --case case.toml --set {viscous} --out x", ["spring"], words={"viscous": "membrane.viscous={scheme='implicit', boussinesq_shear=1, spring_stiffness=10}"}),
    Row("strains that nothing remembers", "membrane drag --case case.toml --in none.vtu --set {viscous} --out x", ["--in none.vtu", "remembers"], words={"viscous": "membrane.viscous={scheme='fd', boussinesq_shear=1, spring_stiffness=10}"}),
    Row("a motion that is not there", "membrane --case case.toml --motion none.pvd --out x", ["none.pvd: no such file"]),
    Row("a twist of no period", "membrane --case case.toml --motion twist --period 0 --out x", ["--period", "0"]),
    Row("a twist of one word", "membrane --case case.toml --motion twist --every often --out x", ["--every", "often"]),
    Row("a spread of nothing", "coupler spread --case case.toml --in none.vtu --out x.vti", ["none.vtu: no such file"]),
    Row("an interpolation without a grid", "coupler interpolate --case case.toml --in a.vtu --out x.vtu", ["--grid"]),
    Row("implicit forces without a grid", "implicit --case case.toml --in a.vtu --out x.vtu", ["--grid"]),
    Row("implicit forces of nothing", "implicit --case case.toml --grid a.vti --out x.vtu", ["--in"]),
    Row("implicit forces from nothing", "implicit --case case.toml --in none.vtu --grid none.vti --out x.vtu", ["none.vtu: no such file"]),
    Row("implicit forces as a grid", "implicit --case case.toml --in none.vtu --grid none.vti --out x.vti", ["--out x.vti", "ends in .vtu"]),
    Row("implicit forces of no viscosity", "implicit --case case.toml --in record/begin/membrane.vtu --grid record/grid_velocity/grid_velocity_0000000001.vti --out x.vtu", ["case.toml: no capsule has an implicit viscosity"], run=True),
    Row("a replay of implicit forces of no viscosity", "replay record --only implicit", ["--only implicit: no capsule has an implicit viscosity"], run=True),
    Row("a free velocity as a surface", "fluid --case case.toml --out x.vti --free x.vtu", ["--free x.vtu", "ends in .vti"]),
    Row("a free velocity in the place of the state", "fluid --case case.toml --out x.vti --free x.vti", ["--free and --out name one file"]),
    Row("a fluid of -1 steps", "fluid --case case.toml --steps -1 --out x.vti", ["--steps", "-1"]),
    Row("a fluid of one step and a half", "fluid --case case.toml --steps 1.5 --out x.vti", ["--steps", "1.5"]),
    Row("a fluid of two files in one", "fluid --case case.toml --out x.vti --fields x.vti", ["--fields and --out name one file"]),
    Row("a fluid from nothing", "fluid --case case.toml --state none.vti --out x.vti", ["none.vti: no such file"]),
    Row("a replay of no record", "replay . --only fluid", ["holds no echo.toml"]),
    Row("a replay of no component", "replay record --only brain", ["--only", "brain"]),
    Row("a replay into a full folder", "replay record --only fluid --out out", ["--out out: holds something already"], run=True),
]

MESHES = [
    Row("a sphere of level nine", "mesh sphere --level 9 x.vtu", ["--level", "9"]),
    Row("a sphere of level half", "mesh sphere --level 0.5 x.vtu", ["--level", "0.5"]),
    Row("a sphere of no radius", "mesh sphere --radius 0 x.vtu", ["--radius", "0"]),
    Row("a sphere of a comma", "mesh sphere --radius 3,5 x.vtu", ["--radius", "3,5"]),
    Row("a sphere of two coordinates", "mesh sphere --centre 1 2 --radius 1 x.vtu", ["--centre"]),
    Row("a sphere of no name", "mesh sphere", ["file"]),
    Row("a sphere in no folder", "mesh sphere none/x.vtu", ["none/x.vtu", "there is no folder"]),
    Row("a biconcave mesh of level nine", "mesh biconcave --level 9 x.vtu", ["--level", "9"]),
    Row("a biconcave mesh of no radius", "mesh biconcave --radius 0 x.vtu", ["--radius", "0"]),
    Row("a biconcave mesh over a case", "mesh biconcave --level 0 case.toml", ["case.toml", "ends in .vtu"]),
    Row("a spheroid of no shape", "mesh spheroid x.vtu", ["give --aspect-ratio or --reduced-volume"]),
    Row("a spheroid of two shapes", "mesh spheroid --aspect-ratio 2 --reduced-volume 0.9 x.vtu", ["--aspect-ratio", "--reduced-volume"]),
    Row("a spheroid as a needle", "mesh spheroid --aspect-ratio 20 x.vtu", ["--aspect-ratio 20", "0.1"]),
    Row("a spheroid of no volume", "mesh spheroid --reduced-volume 0.1 x.vtu", ["--reduced-volume 0.1", "0.5"]),
    Row("a mesh that is not there", "mesh info none.vtu", ["none.vtu: no such file"]),
    Row("a mesh that is a folder", "mesh info .", [".: is a folder"]),
]

STUDIES = [
    Row("a scheme that is none", "study maxwell --scheme euler --out x.csv", ["euler"]),
    Row("a time step of nought", "study maxwell --dt 0 --out x.csv", ["--dt 0: must be a number > 0"]),
    Row("a stiffness that is not a number", "study maxwell --k nan --out x.csv", ["nan"]),
    Row("a period below nought", "study maxwell --period -20 --out x.csv", ["-20"]),
    Row("a table in no folder", "study maxwell --out none/x.csv", ["none/x.csv", "there is no folder"]),
    Row("a kernel that is none", "study strain-rate-noise --kernel round --out x.csv", ["round"]),
    Row("a grid of no nodes", "study strain-rate-noise --nodes 0 --out x.csv", ["nodes", "0"]),
    Row("an interval of no steps", "study strain-rate-noise --interval 0 --out x.csv", ["0"]),
    Row("layers of no viscosity", "study layers --lambda 0 --out x.csv", ["--lambda 0: must be a number > 0"]),
    Row("layers of a viscosity that is no form", "study layers --form soft --out x.csv", ["--form", "soft"]),
    Row("layers with no room for the kernel", "study layers --height 4 --out x.csv", ["height of 4", "stockie6", "give a greater height"]),
    Row("layers that take for ever", "study layers --height 8 --lambda 1e9 --out x.csv", ["falls by 1/e in", "viscosity ratio nearer to 1"]),
    Row("an approach that is none", "study twisting-sphere --approach air --out x.csv", ["--approach", "air"]),
    Row("a level that is none", "study twisting-sphere --level 12 --out x.csv", ["--level", "12"]),
]

DIFFERENCES = [
    Row("one file", "diff case.toml", ["second"]),
    Row("a file and nothing", "diff case.toml none.toml", ["none.toml: no such file or directory"]),
    Row("a file and a folder", "diff case.toml .", ["is a directory"]),
    Row("two kinds of files", "diff case.toml a.vtu", ["files of two kinds"], {"a.vtu": surface()}),
    Row("a tolerance below nought", "diff case.toml case.toml --tolerance -1", ["--tolerance -1: must be a number >= 0"]),
    Row("a tolerance that is not a number", "diff case.toml case.toml --tolerance nan", ["--tolerance nan"]),
]

ROWS = [*SUBCOMMANDS, *RUNS, *PATHS, *NUMBERS, *OVER_OTHERS, *WRONG_FILES, *STAGES, *MESHES, *STUDIES, *DIFFERENCES]
