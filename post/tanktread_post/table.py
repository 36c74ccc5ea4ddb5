"""Tables as they are printed: text in columns, and whether every value lies in its band."""

import dataclasses

SIDES = ("below", "above")


@dataclasses.dataclass(frozen=True)
class Table:
    """A table to print. `header` and each of `rows` are as many texts; `verdicts`: of what was judged in it, as of `verdict`."""

    title: str
    header: tuple
    rows: list
    verdicts: tuple = ()
    before: tuple = ()  # lines above the title
    after: tuple = ()  # lines below the rows

    def print(self):
        """Prints it with columns as wide as they need to be: text to the left, numbers to the right."""
        widths = [max(len(row[k]) for row in [self.header, *self.rows]) for k in range(len(self.header))]
        for line in (*self.before, f"\n{self.title}"):
            print(line)
        for row in [self.header, *self.rows]:
            cells = [row[k].ljust(widths[k]) if k in (0, len(row) - 1) else row[k].rjust(widths[k]) for k in range(len(row))]
            print("  ".join(cells).rstrip())
        for line in self.after:
            print(line)


def print_tables(tables):
    """Prints them; 1 if anything judged in them lies outside its band, else 0."""
    for table in tables:
        table.print()
    return 1 if any(False in table.verdicts for table in tables) else 0


def difference(ours, reference, relative):
    """The difference as a band counts it: a share of the reference, or in the quantity's own unit."""
    return (ours - reference) / abs(reference) if relative else ours - reference


def shown(amount, relative, sign="+"):
    """A difference or a band as text."""
    return format(100 * amount, f"{sign}.2f") + " %" if relative else format(amount, f"{sign}.4f")


def verdict(amount, band):
    """True inside the band, False outside, None where nothing is judged. NaN is outside."""
    if band is None:
        return None
    if band in SIDES:
        return amount < 0 if band == "below" else amount > 0
    return abs(amount) <= band


def number(value):
    """A number as text; a small one with its digits, not with zeros."""
    return f"{value:.6f}" if value == 0 or abs(value) >= 1e-2 else f"{value:.4g}"


def table_row(label, at, ours, reference, relative, band):
    """One row of text, and its verdict; `at` says where it was read."""
    amount = difference(ours, reference, relative)
    inside = verdict(amount, band)
    allowed = "" if band is None else band if band in SIDES else shown(band, relative, "")
    word = {True: "inside", False: "OUTSIDE", None: "shown only"}[inside]
    return (label, at, number(ours), number(reference), shown(amount, relative), allowed, word), inside
