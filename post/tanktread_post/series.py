"""The files of a .pvd series.

A run names a file again at each time at which only its other series has a new one: for ParaView, which shows at a time between two
entries what the later one names.
"""

import pathlib
import time
import xml.etree.ElementTree

from .observables import InputError

LOOKS, PAUSE = 20, 0.01  # a run that adds an entry is done within much less than LOOKS * PAUSE seconds


def read_series(file):
    """[(shear time, file), ...] of a .pvd, in its order, files named again among them; [] if there is no such file."""
    file = pathlib.Path(file)
    if not file.is_file():
        return []
    try:
        return [(float(entry["timestep"]), file.parent / entry["file"]) for entry in _data_sets(file)]
    except (xml.etree.ElementTree.ParseError, ValueError) as error:
        raise InputError(f"{file}: not a .pvd, or damaged: {error}") from error
    except KeyError as error:
        raise InputError(f"{file}: not a .pvd, or damaged: an entry has no {error}") from error


def _data_sets(file):
    """The attributes of each entry. A half that is seen while a run adds to the file is no XML: it is looked at again."""
    for look in range(LOOKS):
        try:
            return [entry.attrib for entry in xml.etree.ElementTree.fromstring(file.read_bytes()).iter("DataSet")]
        except xml.etree.ElementTree.ParseError:
            if look == LOOKS - 1:
                raise
            time.sleep(PAUSE)


def read_files(file):
    """[(shear time, file), ...] of a .pvd, each file once and at its own time."""
    first = {}
    for shear_time, named in read_series(file):
        first.setdefault(named, shear_time)
    return [(shear_time, named) for named, shear_time in first.items()]


def at(file, shear_time):
    """The (own shear time, file) nearest to a shear time, or the last; None if the series is empty or not there."""
    files = read_files(file)
    if not files:
        return None
    return files[-1] if shear_time is None else min(files, key=lambda entry: abs(entry[0] - shear_time))


def shown_at(file, shear_time):
    """The (own shear time, file) that was the last at a shear time, or the first where there was none; None as for `at`."""
    files = read_files(file)
    return max((entry for entry in files if entry[0] <= shear_time), default=files[0] if files else None, key=lambda entry: entry[0])
