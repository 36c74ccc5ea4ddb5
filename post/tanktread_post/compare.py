"""A table ours / reference / difference, and whether every value lies in its band."""

from .observables import Observables, read_comparison


def difference(ours, value):
    """The difference as the band counts it: relative to the reference, or in the quantity's own unit."""
    return (ours - value["reference"]) / value["reference"] if value["relative"] else ours - value["reference"]


def table_rows(observables, values):
    """(name, shear time, ours, reference, difference, band, relative, inside) of each value."""
    rows = []
    for value in values:
        ours = observables.at(value["name"], value["shear_time"])
        gap = difference(ours, value)
        inside = abs(gap) <= value["band"]
        rows.append((value["name"], value["shear_time"], ours, value["reference"], gap, value["band"], value["relative"], inside))
    return rows


def print_table(title, rows):
    """Prints the table."""
    print(title)
    print(f"{'quantity':<18} {'at':>6} {'ours':>12} {'thesis':>12} {'difference':>12} {'band':>9}")
    for name, time, ours, reference, gap, band, relative, inside in rows:
        shown = f"{100 * gap:+.2f} %" if relative else f"{gap:+.4f}"
        allowed = f"{100 * band:.2f} %" if relative else f"{band:.4f}"
        print(f"{name:<18} {time:>6.2f} {ours:>12.6f} {reference:>12.6f} {shown:>12} {allowed:>9}{'' if inside else '  OUTSIDE'}")


def compare(output, case):
    """Prints the table of a case; 1 if a value lies outside its band, else 0."""
    wanted = read_comparison(case)
    rows = table_rows(Observables(output), wanted["value"])
    print_table(wanted["title"], rows)
    return 0 if all(row[-1] for row in rows) else 1
