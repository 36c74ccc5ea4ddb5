"""Pictures in the form of the thesis's Figures 4.2, 4.5, 4.6, 4.8, 4.9 and 4.10, and the viscosity ratio that a membrane viscosity amounts to."""

import math
import pathlib

from tanktread_post.plot import COLOURS, LINES, SMALLEST_DEFORMATION, new_axes, new_panels, save

TIME, LAMBDA, SHEAR = r"shear time  $\dot\gamma t$", r"viscosity ratio  $\lambda$", "$Bq_s$"
LABELS = {
    "deformation": "Taylor deformation  $D$",
    "inclination_deg": "inclination  (degrees)",
    "circumference": "circumference  $C^*$",
    "membrane_speed": "membrane speed  $V^*$",
    "nu_travel": r"frequency  $\nu^*$",
}
SYMBOLS = {"viscosity_ratio": r"$\lambda$", "boussinesq_shear": "$Bq_s$"}
# Where the printed numbers of a quantity are drawn.
PRINTED = {"marker": "o", "color": "black", "markerfacecolor": "white", "markersize": 7, "linestyle": "none", "zorder": 3}


def _legend(axes, where="best"):
    if axes.get_legend_handles_labels()[0]:
        axes.legend(frameon=False, fontsize="small", loc=where)


def evolution(file, columns):
    """D and the inclination against time, a column for each list of (label, History). Returns the file, None where there is no run."""
    if not any(columns):
        return None
    figure, panels = new_panels([TIME] * len(columns), [LABELS["deformation"], LABELS["inclination_deg"]])
    for number, runs in enumerate(columns):
        for k, (label, history) in enumerate(runs):
            seen = history["deformation"] > SMALLEST_DEFORMATION
            form = {"color": COLOURS[k % len(COLOURS)], "linestyle": LINES[k // len(COLOURS) % len(LINES)], "label": label}
            panels[0, number].plot(history["shear_time"], history["deformation"], **form)
            panels[1, number].plot(history["shear_time"][seen], history["inclination_deg"][seen], **form)
        for axes in panels[:, number]:
            axes.set_xlim(left=0)
        _legend(panels[1, number], "upper right")  # the inclination falls from 45 degrees
    return save(figure, file)


def over_the_matrix(file, quantities, curves, printed):
    """Quantities against Bq_s, a curve a viscosity ratio (left, with half of the way between their extremes as bars where it is known), and against
    the viscosity ratio, a curve a Bq_s (right). `curves(along, by)`: the curves; `printed`: {quantity: [(lambda, Bq_s, value)]}."""
    both = (("boussinesq_shear", "viscosity_ratio"), ("viscosity_ratio", "boussinesq_shear"))
    known = [r for runs in curves(*both[0]).values() for r in runs if not all(math.isnan(getattr(r, quantity)) for quantity in quantities)]
    if not known:
        return None
    figure, panels = new_panels([SHEAR, LAMBDA], [LABELS[quantity] for quantity in quantities])
    for number, (along, by) in enumerate(both):
        for row, quantity in enumerate(quantities):
            axes = panels[row, number]
            for k, (value, runs) in enumerate(curves(along, by).items()):
                points = [(getattr(r, along), getattr(r, quantity), getattr(r, f"{quantity}_amplitude", 0.0)) for r in runs]
                points = [point for point in points if not math.isnan(point[1])]
                if not points:
                    continue
                x, y, bars = zip(*points)
                form = {"color": COLOURS[k % len(COLOURS)], "marker": "o", "markersize": 4, "label": f"{SYMBOLS[by]} = {value:g}"}
                axes.errorbar(x, y, yerr=bars if number == 0 and any(bars) else None, capsize=2, linewidth=1.2, elinewidth=0.8, **form)
            here = [(shear if number == 0 else ratio, value) for ratio, shear, value in printed.get(quantity, ())]
            if here:
                axes.plot(*zip(*here), **PRINTED, label="thesis, printed")
        _legend(panels[0, number])
    return save(figure, file)


def inclination_over_deformation(file, readings, curves):
    """The inclination against D of all runs of the matrix, with the thesis's curves I (Bq_s = 0), II (lambda = 1) and III (lambda = 5)."""
    matrix = [r for r in readings if r.boussinesq_dilatational == 0]
    if not matrix:
        return None
    figure, axes = new_axes(LABELS["deformation"], LABELS["inclination_deg"])
    for viscous_inside, colour, marker in ((False, COLOURS[1], "o"), (True, COLOURS[0], "s")):
        for viscous_membrane in (False, True):
            chosen = [r for r in matrix if (r.viscosity_ratio >= 5, r.boussinesq_shear >= 20) == (viscous_inside, viscous_membrane)]
            if chosen:
                label = (r"$\lambda \geq 5$" if viscous_inside else r"$\lambda \leq 3$") + (r", $Bq_s \geq 20$" if viscous_membrane else r", $Bq_s \leq 10$")
                face = "white" if viscous_membrane else colour
                axes.plot([r.deformation for r in chosen], [r.inclination_deg for r in chosen], marker, color=colour, markerfacecolor=face, label=label)
    series = (
        ("I", curves("viscosity_ratio", "boussinesq_shear").get(0.0), "solid"),
        ("II", curves("boussinesq_shear", "viscosity_ratio").get(1.0), "dashed"),
        ("III", curves("boussinesq_shear", "viscosity_ratio").get(5.0), "dotted"),
    )
    for name, runs, style in series:
        if runs:
            axes.plot([r.deformation for r in runs], [r.inclination_deg for r in runs], color="black", linestyle=style, linewidth=1, label=f"curve {name}", zorder=1)
    _legend(axes)
    return save(figure, file)


def equivalent(file, rows):
    """The viscosity ratio that each Bq_s amounts to; rows of (Bq_s, by D, by the inclination, by the dissipation), NaN where it is not known."""
    columns = (("as of D", 1), ("as of the inclination", 2), (r"$\lambda$ + d, by the dissipation", 3))
    drawn = {label: [(row[0], row[k]) for row in rows if not math.isnan(row[k])] for label, k in columns}
    if not any(drawn.values()):
        return None
    figure, axes = new_axes(SHEAR, r"viscosity ratio of an elastic capsule that is alike")
    for colour, (label, points) in zip(COLOURS, drawn.items()):
        if points:
            axes.plot(*zip(*points), "o-", color=colour, label=label)
    axes.set_xlim(left=0)
    _legend(axes)
    return save(figure, file)


def dissipation(file, series):
    """What is dissipated in the membrane and inside (left), and their ratio (right), against Bq_s; `series`: Readings of one viscosity ratio."""
    known = [r for r in series if not math.isnan(r.dissipation_ratio)]
    if len(known) < 2:
        return None
    x, membrane, inner = zip(*((r.boussinesq_shear, r.membrane_dissipation, r.inner_dissipation) for r in known))
    figure, panels = new_panels([SHEAR, SHEAR], [r"dissipation  $\Phi/(\mu_o\dot\gamma^2a^3)$"])
    drawn = ((membrane, r"$\Phi_{mem}$"), (inner, r"$\Phi_{int}$"), ([a + b for a, b in zip(membrane, inner)], "sum"))
    for colour, (values, label) in zip(COLOURS, drawn):
        panels[0, 0].plot(x, values, "o-", color=colour, label=label)
    panels[0, 1].plot(x, [r.dissipation_ratio for r in known], "o-", color=COLOURS[0])
    panels[0, 1].set_ylabel(r"$d = \Phi_{mem}/\Phi_{int}$")
    _legend(panels[0, 0])
    return save(figure, file)


def all_pictures(output, readings, curves, printed, equivalents, histories):
    """Draws what can be drawn of the runs that are there; `histories`: {run: History}. Returns the files."""
    output = pathlib.Path(output)
    by_place = {r.place: histories[r.run] for r in readings if r.run in histories}
    elastic = [(rf"$\lambda$ = {place[0]:g}", one) for place, one in sorted(by_place.items()) if place[1:] == (0, 0)]
    viscous = [(f"$Bq_s$ = {place[1]:g}", one) for place, one in sorted(by_place.items()) if (place[0], place[2]) == (1, 0)]
    numbers = sorted({place[2] for place in by_place if place[2] > 0})
    without = [("$Bq_s$ = $Bq_d$ = 0", by_place[1.0, 0.0, 0.0])] if numbers and (1.0, 0.0, 0.0) in by_place else []
    alone = [(f"$Bq_d$ = {n:g}, $Bq_s$ = 0", by_place[1.0, 0.0, n]) for n in numbers if (1.0, 0.0, n) in by_place]
    together = [(f"$Bq_s$ = $Bq_d$ = {n:g}", by_place[1.0, n, n]) for n in numbers if (1.0, n, n) in by_place]
    drawn = [
        evolution(output / "fig-4.2.png", [elastic, viscous]),
        over_the_matrix(output / "fig-4.5.png", ("deformation", "inclination_deg"), curves, printed),
        over_the_matrix(output / "fig-4.6.png", ("circumference", "membrane_speed", "nu_travel"), curves, printed),
        dissipation(output / "fig-4.8.png", curves("boussinesq_shear", "viscosity_ratio").get(1.0, [])),
        inclination_over_deformation(output / "fig-4.9.png", readings, curves),
        evolution(output / "fig-4.10.png", [without + alone, without + together] if numbers else []),
        equivalent(output / "equivalent.png", equivalents),
    ]
    return [file for file in drawn if file is not None]
