"""The files of a .pvd series."""

import pathlib
import xml.etree.ElementTree

from .observables import InputError


def read_series(file):
    """[(shear time, file), ...] of a .pvd, in its order; [] if there is no such file."""
    file = pathlib.Path(file)
    if not file.is_file():
        return []
    try:
        entries = xml.etree.ElementTree.parse(file).iter("DataSet")
    except xml.etree.ElementTree.ParseError as error:
        raise InputError(f"{file}: not a .pvd: {error}") from error
    return [(float(entry.get("timestep")), file.parent / entry.get("file")) for entry in entries]


def at(file, shear_time):
    """The entry (shear time, file) nearest to a shear time, or the last; None if the series is empty or not there."""
    entries = read_series(file)
    if not entries:
        return None
    return entries[-1] if shear_time is None else min(entries, key=lambda entry: abs(entry[0] - shear_time))
