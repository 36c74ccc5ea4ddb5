"""Dataclasses of texts and numbers as a table that a case keeps, a row each, and back. An empty cell is a number that is not known, NaN."""

import csv
import dataclasses
import io
import math
import pathlib

from .observables import InputError
from .reference import read_table


def table_of(records, kind, follows=()):
    """The text of a table: the members of the dataclass `kind`, then what follows from them (names of properties); numbers to 8 digits."""
    stream = io.StringIO()
    names = [*(field.name for field in dataclasses.fields(kind)), *follows]
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerow(names)
    for record in records:
        values = (getattr(record, name) for name in names)
        writer.writerow([value if isinstance(value, str) else "" if math.isnan(value) else f"{value:.8g}" for value in values])
    return stream.getvalue()


def read_kept(file, kind):
    """{run: `kind`} of such a table, whose first member is `run`; nothing where there is no such file. Members of the type str are texts."""
    if not pathlib.Path(file).is_file():
        return {}
    found = {}
    for row in read_table(file):
        try:
            values = {field.name: row[field.name] if field.type is str else float(row[field.name] or "nan") for field in dataclasses.fields(kind)}
        except (KeyError, ValueError) as error:
            raise InputError(f"{file}: {error}; it is damaged, or of before a column was added: run --measure of the run again") from error
        found[row["run"]] = kind(**values)
    return found
