"""What the thesis says of series of runs of the matrix, and whether it holds here: a row each, as in verdicts.py, and its verdict.

A statement is judged once all of its runs in runs.csv are finished; `wanted` below are the places (lambda, Bq_s, Bq_d) of these.
"""

import math
import pathlib

from tanktread_post.case_analysis import module_of

verdicts = module_of(pathlib.Path(__file__).with_name("verdicts.py"))
NAMES, WORDS = verdicts.NAMES, verdicts.WORDS
SYMBOLS = {"viscosity_ratio": "lambda", "boussinesq_shear": "Bq_s"}
INDEX = {"viscosity_ratio": 0, "boussinesq_shear": 1}  # in a place


def _of_series(label, of, places, readings, judge):
    """A statement about a series: (ours, holds) of its readings by `judge`, in the order of the places; holds None: a number is not known."""
    by_place = {r.place: r for r in readings}
    missing = [place for place in places if place not in by_place]
    if missing or not places:
        return (label, of, "", "", "", "", f"not judged yet: {len(places) - len(missing)} of {len(places)} runs"), None
    ours, holds = judge([by_place[place] for place in places])
    return (label, of, ours, "", "", "", WORDS[holds]), holds


def _judge_of(quantity, holds, digits=4):
    """A judge by a function of the values of a quantity; nothing is judged where one is not known."""

    def judge(series):
        values = [getattr(r, quantity) for r in series]
        known = not any(map(math.isnan, values))
        return " ".join(f"{value:.{digits}f}" for value in values) if known else "", holds(values) if known else None

    return judge


def falls(quantity, digits=4):
    """A judge: whether a quantity falls from each run to the next."""
    return _judge_of(quantity, lambda values: all(b < a for a, b in zip(values, values[1:])), digits)


def rises(quantity, digits=4):
    """A judge: whether a quantity rises from each run to the next."""
    return _judge_of(quantity, lambda values: all(b > a for a, b in zip(values, values[1:])), digits)


def falls_then_rises(quantity):
    """A judge: whether a quantity has one least value, inside the series, and falls to it and rises from it."""

    def holds(values):
        least = values.index(min(values))
        down, up = values[: least + 1], values[least:]
        return 0 < least < len(values) - 1 and all(b < a for a, b in zip(down, down[1:])) and all(b > a for a, b in zip(up, up[1:]))

    return _judge_of(quantity, holds)


def least_inclination_between(low, high):
    """A judge: whether the inclination is least at a Bq_s from `low` to `high`."""

    def judge(series):
        least = min(series, key=lambda r: r.inclination_deg)
        return f"{least.inclination_deg:.2f} degrees at {least.boussinesq_shear:g}", low <= least.boussinesq_shear <= high

    return judge


def falls_less_at_last(series):
    """Whether D falls less from a Bq_s of 20 to one of 40 than from 0 to 10, each by Bq_s."""
    D = {r.boussinesq_shear: r.deformation for r in series}
    first, last = (D[0] - D[10]) / 10, (D[20] - D[40]) / 20
    return f"{first:.4f}, {last:.4f} a Bq_s", last < first


def place_of_least(quantity, along, by, moves):
    """A judge of the whole matrix: whether the `along` at which a quantity is least moves one way (+1 up, -1 down, or stays) as `by` rises."""

    def judge(series):
        values = sorted({getattr(r, by) for r in series})
        if any(math.isnan(getattr(r, quantity)) for r in series):
            return "", None
        least = [getattr(min((r for r in series if getattr(r, by) == value), key=lambda r: getattr(r, quantity)), along) for value in values]
        text = ", ".join(f"{one:g} at {value:g}" for one, value in zip(least, values))
        return text, all(moves * (b - a) >= 0 for a, b in zip(least, least[1:]))

    return judge


def _extreme_of_three(series):
    """Whether of the three runs whose numbers are printed the one with the longest contour turns most slowly, the one with the shortest fastest."""
    by_length = sorted(series, key=lambda r: r.circumference)
    nu = [r.nu_travel for r in by_length]
    return " ".join(f"{value:.4f}" for value in nu), None if any(map(math.isnan, nu)) else nu[0] == max(nu) and nu[-1] == min(nu)


def _with_dilatational(readings, wanted):
    """Bq_s = Bq_d against Bq_s alone: less D and a lower inclination above 10, alike below; and how long Bq_d alone takes."""
    rows = []
    for number in sorted({place[2] for place in wanted if place[2] > 0}):
        places = [(1.0, number, 0.0), (1.0, number, number)]
        for quantity, digits in (("deformation", 4), ("inclination_deg", 2)):
            if number > 10:
                rows.append(_of_series(f"Bq_d as well: {NAMES[quantity]} is less", f"Bq_s = {number:g}", places, readings, falls(quantity, digits)))
    alone = sorted(place for place in wanted if place[:2] == (1.0, 0.0))
    rows.append(_of_series("D settles later with Bq_d alone", "Bq_s = 0", alone, readings, rises("settling_time", 1)))
    return rows


def rows_of(readings, wanted, settings):
    """All statements."""
    matrix = sorted(place for place in wanted if place[2] == 0)
    ratios, shears = sorted({p[0] for p in matrix}), sorted({p[1] for p in matrix})
    of_shear = {shear: [p for p in matrix if p[1] == shear] for shear in shears}
    of_ratio = {ratio: [p for p in matrix if p[0] == ratio] for ratio in ratios}
    rows = []

    def add(label, of, places, judge):
        rows.append(_of_series(label, of, places, readings, judge))

    for quantity, digits in (("deformation", 4), ("inclination_deg", 2)):
        for shear, places in of_shear.items():
            add(f"{NAMES[quantity]} falls with lambda", f"Bq_s = {shear:g}", places, falls(quantity, digits))
    for ratio, places in of_ratio.items():
        add("D falls with Bq_s", f"lambda = {ratio:g}", places, falls("deformation"))
        add("D falls less at high Bq_s", f"lambda = {ratio:g}", places, falls_less_at_last)
    for ratio, places in of_ratio.items():
        low, high = settings["least_inclination_between"] if ratio == 1 else (shears[1], shears[-2])
        label = "inclination is least near Bq_s = 10" if ratio == 1 else "inclination falls, then rises with Bq_s"
        add(label, f"lambda = {ratio:g}", places, least_inclination_between(low, high))
    spoon = falls_then_rises("membrane_speed")
    add("V* is spoon-shaped in Bq_s", "lambda = 0.2", of_ratio.get(0.2, []), spoon)
    add("V* is spoon-shaped in lambda", "Bq_s = 0", of_shear.get(0.0, []), spoon)
    add("C* rises with Bq_s", "lambda = 10", of_ratio.get(10.0, []), rises("circumference"))
    add("nu* is least at the greatest C*, most at the least", "the printed three", [(1.0, 0.0, 0.0), (10.0, 0.0, 0.0), (1.0, 40.0, 0.0)], _extreme_of_three)
    for quantity, along, by, moves in (
        ("inclination_deg", "boussinesq_shear", "viscosity_ratio", 1),
        ("membrane_speed", "boussinesq_shear", "viscosity_ratio", -1),
        ("membrane_speed", "viscosity_ratio", "boussinesq_shear", -1),
    ):  # fmt: skip
        label = f"{SYMBOLS[along]} of the least {NAMES[quantity]} moves {'up' if moves > 0 else 'down'} with {SYMBOLS[by]}"
        add(label, "the matrix", matrix, place_of_least(quantity, along, by, moves))
    return rows + _with_dilatational(readings, wanted)
