"""How a red cell moves in shear flow, over the shear rate, in two fluids, with and without membrane viscosity: its state, how fast it or its membrane turns, how it lies."""

import functools
import math
import pathlib

from tanktread_post import records
from tanktread_post.case_analysis import module_of
from tanktread_post.outlines import read_outline
from tanktread_post.plot import COLOURS, new_axes, new_panels, save
from tanktread_post.reference import read_comparison, read_table
from tanktread_post.run_folder import finished_runs
from tanktread_post.table import Table

HERE = pathlib.Path(__file__).parent
readings = module_of(HERE / "readings.py")

SETTINGS = (("read_over", "steady_swing", "volume_band", "area_band", "treads_at", "tumbles_at", "drawn_at"), ())
SYMBOLS = {"tumbling": "X", "swinging": "D", "tank-treading": "o", "slow": "."}
FLUIDS = (("dextran", "elastic"), ("dextran", "viscous"), ("plasma", "elastic"), ("plasma", "viscous"))
NAMES = {"elastic": "no membrane viscosity", "viscous": "membrane viscosity 0.42 uN s/m"}


@functools.lru_cache(maxsize=8)
def known(output, case):
    """(settings, readings) of all runs of which something is known."""
    settings = read_comparison(case)["analyse"]
    return settings, readings.read_runs(pathlib.Path(output), settings, pathlib.Path(case) / "measured" / "readings.csv")


def _shown(value, form):
    return "" if math.isnan(value) else format(value, form)


def _runs_table(found, case):
    rows = [
        (
            r.run, r.state, f"{r.shear_rate:g}", f"{r.viscosity_ratio:.3g}", _shown(r.inclination, ".1f"), _shown(r.swing, ".1f"),
            _shown(r.treading_frequency, ".4g"), _shown(r.treading_frequency / r.shear_rate, ".4f"), _shown(r.tumbling_frequency, ".4g"),
            f"{r.deformation:.3f}", r.commit,
        )
        for r in found
    ]  # fmt: skip
    missing = sorted({row["run"] for row in read_table(pathlib.Path(case) / "runs.csv")} - {r.run for r in found})
    after = (f"not finished: {', '.join(missing)}",) if missing else ()
    header = ("run", "motion", "g (1/s)", "lambda", "inclination", "+-", "treads (1/s)", "over g", "tumbles (1/s)", "D", "commit")
    return Table("Angles in degrees; a turn is 360 degrees", header, rows, after=after)


def _word(inside):
    return "inside" if inside else "OUTSIDE"


def _kept_table(found, settings):
    """Volume and area of all runs."""
    rows, verdicts = [], []
    for name, band, off in (
        ("volume", settings["volume_band"], lambda r: max(abs(r.least_volume - 1), abs(r.greatest_volume - 1))),
        ("area", settings["area_band"], lambda r: max(abs(r.least_area - 1), abs(r.greatest_area - 1))),
    ):
        worst = max(found, key=off)
        verdicts.append(off(worst) <= band)
        rows.append((f"{name}, farthest of all runs", worst.run, f"{100 * off(worst):.3f} %", f"{100 * band:g} %", _word(verdicts[-1])))
    return Table("What a cell keeps", ("", "run", "off", "band", ""), rows, verdicts=tuple(verdicts))


def _statements(found, settings):
    """(statement, what was found, verdict) of all that are known."""
    by = {(*r.fluid, r.shear_rate): r for r in found}
    for membrane in ("elastic", "viscous"):
        for fluid, rates, tumbles in (("dextran", settings["treads_at"], False), ("plasma", settings["tumbles_at"], True)):
            for rate in rates:
                if (r := by.get((fluid, membrane, rate))) is not None:
                    yield f"{r.run} {'tumbles' if tumbles else 'does not tumble'}", r.state, (r.state == "tumbling") == tumbles
    for fluid, membrane in FLUIDS:
        treading = [r for r in found if r.fluid == (fluid, membrane) and math.isfinite(r.treading_frequency)]
        for slower, faster in zip(treading, treading[1:]):
            yield (
                f"{faster.run} treads faster than {slower.run}", f"{faster.treading_frequency:.4g} and {slower.treading_frequency:.4g} 1/s",
                faster.treading_frequency > slower.treading_frequency,
            )  # fmt: skip
        if membrane == "elastic":
            for r in treading:
                other = by.get((fluid, "viscous", r.shear_rate))
                if other is not None and math.isfinite(other.treading_frequency):
                    yield (
                        f"{other.run} treads slower than {r.run}", f"{other.treading_frequency:.4g} and {r.treading_frequency:.4g} 1/s",
                        other.treading_frequency < r.treading_frequency,
                    )  # fmt: skip


def tables(output, case):
    """All runs; what a cell keeps; what was said before of its motion."""
    settings, found = known(output, case)
    said = list(_statements(found, settings))
    made = [_runs_table(found, case), _kept_table(found, settings)]
    if said:
        rows = [(statement, what, _word(inside)) for statement, what, inside in said]
        made.append(Table("Said before", ("", "found", ""), rows, verdicts=tuple(inside for *_, inside in said)))
    return made


def measured(output, case):
    """readings.csv: all that is read of each run."""
    return {"readings.csv": records.table_of(known(output, case)[1], readings.Reading)}


def _over_rate(found, y_label, value, spread=lambda r: 0.0):
    """A quantity over the shear rate, a line a fluid and membrane, a symbol a state."""
    figure, axes = new_axes("shear rate  (1/s)", y_label)
    for colour, fluid in zip(COLOURS, FLUIDS):
        own = [r for r in found if r.fluid == fluid and math.isfinite(value(r))]
        if not own:
            continue
        line = "solid" if fluid[1] == "viscous" else "dashed"
        axes.plot([r.shear_rate for r in own], [value(r) for r in own], color=colour, linestyle=line, label=f"{fluid[0]}, {NAMES[fluid[1]]}")
        for r in own:
            axes.errorbar(r.shear_rate, value(r), spread(r), color=colour, marker=SYMBOLS[r.state], markersize=7, capsize=3)
    axes.set_xscale("log")
    axes.legend(frameon=False, fontsize="small")
    return figure, axes


def _states(found, file):
    """Which motion where: a row a fluid and membrane."""
    figure, axes = new_axes("shear rate  (1/s)", "")
    for row, fluid in enumerate(FLUIDS):
        for r in (r for r in found if r.fluid == fluid):
            axes.plot(r.shear_rate, row, SYMBOLS[r.state], color=COLOURS[row], markersize=11)
    for state in readings.MOTIONS:
        if any(r.state == state for r in found):
            axes.plot([], [], SYMBOLS[state], color="#555555", label=state)
    axes.set_xscale("log")
    axes.set_yticks(range(len(FLUIDS)), [f"{fluid}\n{NAMES[membrane]}" for fluid, membrane in FLUIDS])
    axes.set_ylim(-0.6, len(FLUIDS) - 0.4)
    axes.legend(frameon=False, ncols=4, loc="lower center", bbox_to_anchor=(0.4, 1.0))
    return save(figure, file)


def _outlines(output, times, file):
    """The cell in the shear plane, a panel a run, with the marker; None where no run has membranes at these times."""
    drawn = {}
    for directory in finished_runs(output):
        found = [one for one in (read_outline(directory, time) for time in times) if one is not None]
        if found:
            drawn[directory.name] = found
    if not drawn:
        return None
    n_columns = max(len(found) for found in drawn.values())
    figure, panels = new_panels(["along the flow / $a$"] * n_columns, [""] * len(drawn))
    figure.set_size_inches(2.3 * n_columns, 2.3 * len(drawn))
    for row, (run, found) in zip(panels, sorted(drawn.items())):
        for axes, one in zip(row, found):
            for curve in one.curves:
                axes.fill(*curve.T, facecolor="#d8504a", edgecolor="#7c1d1a", alpha=0.75)
            axes.plot(*one.marker, "o", color="#000000", markersize=5)
            axes.set(xlim=(-2.2, 2.2), ylim=(-2.2, 2.2), aspect="equal", title=f"$g t$ = {one.shear_time:g}")
        row[0].set_ylabel(run)
    return save(figure, file)


def pictures(output, case):
    """states.png, frequency.png, inclination.png, and outlines.png of the runs whose output is there."""
    settings, found = known(output, case)
    folder = pathlib.Path(output)
    made = [_states(found, folder / "states.png")]
    if any(math.isfinite(r.treading_frequency) for r in found):
        figure, axes = _over_rate(found, "turns of the membrane  (1/s)", lambda r: r.treading_frequency)
        axes.set_yscale("log")
        made.append(save(figure, folder / "frequency.png"))
        figure, _ = _over_rate(found, "inclination of the long axis  (degrees)", lambda r: r.inclination, lambda r: r.swing)
        made.append(save(figure, folder / "inclination.png"))
    outlines = _outlines(output, settings["drawn_at"], folder / "outlines.png")
    return made + ([outlines] if outlines else [])
