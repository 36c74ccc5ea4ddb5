"""What the thesis says of the matrix and is only shown here: rows of (quantity, ours, thesis, ""). What is not known yet has none."""

import math
import pathlib

import numpy

from tanktread_post.case_analysis import module_of
from tanktread_post.reference import number_in

verdicts, membrane_speed = (module_of(pathlib.Path(__file__).with_name(f"{name}.py")) for name in ("verdicts", "membrane_speed"))
NAMES = verdicts.NAMES
GROUP = {"viscosity_ratio": ("least_viscosity_ratio", "most_viscosity_ratio"), "boussinesq_shear": ("least_bq_s", "most_bq_s")}  # columns of crossings.csv
SHOWN = "shown only"
STEADY_FROM = 16.0  # shear time after which the thesis finds the shapes of Fig. 4.11 alike


def crossing_rows(readings, table, file, crossings):
    """How far the inclination is from being one with D; `crossings(readings, at, value, quantity)`: readings.py's."""
    rows = []
    for row in table:
        value, ends = number_in(file, "value", row), [number_in(file, end, row) for end in ("least", "most")]
        within = {name: [number_in(file, column, row) for column in columns] for name, columns in GROUP.items()}
        group = [r for r in readings if all(low <= getattr(r, name) <= high for name, (low, high) in within.items())]
        ours = crossings(group, row["at"], value, row["quantity"])
        if not math.isnan(ours[0]):
            label = f"{NAMES[row['quantity']]} where {NAMES[row['at']]} is {value:g}{_words_of(within)}"
            rows.append((label, "{:.4g} to {:.4g}".format(*ours), "{:g} to {:g}".format(*ends), SHOWN))
    return rows


def _words_of(within):
    (_, most_ratio), (_, most_shear) = within.values()
    if most_shear > 10:
        return ""
    return f", lambda {'to 3' if most_ratio <= 3 else 'from 5'}, Bq_s to {most_shear:g}"


def _by_place(readings):
    return {r.place: r for r in readings}


def frequency_rows(readings):
    """How far the two ways to the frequency are apart, of the three runs whose numbers are printed."""
    three = [_by_place(readings).get(place) for place in ((1, 0, 0), (10, 0, 0), (1, 40, 0))]
    apart = [abs(r.nu_travel / r.nu_marker - 1) for r in three if r is not None and not math.isnan(r.nu_marker)]
    return [(f"nu*: the two ways apart, most of {len(apart)} runs", f"{100 * max(apart):.2f} %", "1.14 %", SHOWN)] if apart else []


def linear_row(readings):
    """How far D is from a straight line in lambda at Bq_s = 0, over its span: the thesis finds it linear."""
    elastic = [r for r in readings if r.place[1:] == (0, 0)]
    if len(elastic) < 4 or len({r.deformation for r in elastic}) == 1:
        return []
    ratio, D = (numpy.array([getattr(r, name) for r in elastic]) for name in ("viscosity_ratio", "deformation"))
    away = numpy.abs(numpy.polyval(numpy.polyfit(ratio, D, 1), ratio) - D).max() / numpy.ptp(D)
    return [("D at Bq_s = 0: farthest from a line in lambda, over its span", f"{100 * away:.1f} %", "appears linear", SHOWN)]


def round_row(readings):
    """C* of the runs that are nearly round."""
    of = [r.circumference for r in readings if r.boussinesq_dilatational == 0 and r.deformation < 0.2 and not math.isnan(r.circumference)]
    return [(f"C* where D is below 0.2 ({len(of)} runs)", f"{min(of):.4f} to {max(of):.4f}", "about 1", SHOWN)] if of else []


def curve_rows(readings):
    """How far the inclination of viscous membranes is from that of elastic capsules of the same D: the thesis's Curves II and III below Curve I at first,
    above it in the end."""
    elastic = sorted((r for r in readings if r.place[1:] == (0, 0)), key=lambda r: r.deformation)
    rows = []
    for ratio, name in ((1, "II"), (5, "III")):
        found = []
        for r in readings:
            inside = elastic and elastic[0].deformation <= r.deformation <= elastic[-1].deformation
            if (r.viscosity_ratio, r.boussinesq_dilatational) == (ratio, 0) and r.boussinesq_shear > 0 and inside:
                same = numpy.interp(r.deformation, [e.deformation for e in elastic], [e.inclination_deg for e in elastic])
                found.append(f"{r.inclination_deg - same:+.1f} at {r.boussinesq_shear:g}")
        if found:
            rows.append((f"Curve {name} less Curve I at the same D, degrees at Bq_s", ", ".join(found), "below, then above", SHOWN))
    return rows


def dissipation_row(readings):
    """Phi_mem against Bq_s at lambda = 1."""
    known = [r for r in readings if (r.viscosity_ratio, r.boussinesq_dilatational) == (1, 0) and not math.isnan(r.membrane_dissipation)]
    if len(known) < 3:
        return []
    text = ", ".join(f"{r.membrane_dissipation:.2f} at {r.boussinesq_shear:g}" for r in known)
    return [("Phi_mem at Bq_s, lambda = 1", text, "falls at large Bq_s", SHOWN)]


def with_dilatational_rows(readings):
    """What Bq_d does beside the same Bq_s, as a share."""
    places, rows = _by_place(readings), []
    for number in sorted({r.boussinesq_dilatational for r in readings if r.boussinesq_dilatational > 0}):
        without, both = places.get((1, number, 0)), places.get((1, number, number))
        if without is None or both is None:
            continue
        change = f"{100 * (both.deformation / without.deformation - 1):+.1f} %, {both.inclination_deg - without.inclination_deg:+.2f} degrees"
        rows.append((f"D and inclination by Bq_d = Bq_s = {number:g}, less those by Bq_s", change, "about the same" if number <= 10 else "both lower", SHOWN))
    return rows


def speed_rows(readings):
    """What V* has to do with D and with the inclination (Fig. 4.7)."""
    with_D, with_inclination = membrane_speed.slopes(readings)
    rows = []
    if not math.isnan(with_D):
        rows.append(("V* with 0.1 of D more, by least squares", f"{with_D:+.3f}", "falls", SHOWN))
        rows.append(("V* with 10 degrees more, by least squares", f"{with_inclination:+.3f}", "rises", SHOWN))
    trio = membrane_speed.three_alike(readings)
    for letter, r, what in zip("bc", trio[1:], ("a smaller D", "a larger inclination")):
        rows.append((f"V* of {r.run} against {trio[0].run}: {what} (Fig. 4.7{letter})", f"{r.membrane_speed - trio[0].membrane_speed:+.3f}", "more", SHOWN))
    return rows


def outline_rows(outlines, history):
    """How far the outlines of Fig. 4.11 after STEADY_FROM are from the last one, and what D and the inclination do meanwhile; `outlines` in their order."""
    late = [one for one in outlines if one.shear_time >= STEADY_FROM]
    if len(late) < 2 or history is None:
        return []
    angles = numpy.linspace(-math.pi, math.pi, 361)
    away = max(float(numpy.abs(one.radius_at(angles) - late[-1].radius_at(angles)).max()) for one in late[:-1])
    after = history["shear_time"] >= STEADY_FROM
    ranges = [(history[name][after].min(), history[name][after].max()) for name in ("deformation", "inclination_deg")]
    words = "D {:.3f} to {:.3f}, {:.1f} to {:.1f} degrees".format(*ranges[0], *ranges[1])
    return [(f"{late[0].run}: outlines after {STEADY_FROM:g} apart, over a", f"{away:.3f}; {words}", "very similar", SHOWN)]
