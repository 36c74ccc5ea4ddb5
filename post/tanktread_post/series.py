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
        return [(float(entry.attrib["timestep"]), file.parent / entry.attrib["file"]) for entry in entries]
    except (xml.etree.ElementTree.ParseError, ValueError) as error:
        raise InputError(f"{file}: not a .pvd, or damaged: {error}") from error
    except KeyError as error:
        raise InputError(f"{file}: not a .pvd, or damaged: an entry has no {error}") from error


def at(file, shear_time):
    """The entry (shear time, file) nearest to a shear time, or the last; None if the series is empty or not there."""
    entries = read_series(file)
    if not entries:
        return None
    return entries[-1] if shear_time is None else min(entries, key=lambda entry: abs(entry[0] - shear_time))
