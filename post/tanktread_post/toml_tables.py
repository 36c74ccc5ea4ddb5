"""Files in TOML: read, and held against the keys that their tables may have and the kinds of their values."""

import pathlib
import tomllib

from .observables import InputError
from .table import SIDES

NUMBER, TEXT = (int, float), (str,)
# What a key of any of them must be, and how that is called.
KINDS = {
    **dict.fromkeys(("title", "source", "run", "name", "table", "column", "x", "y", "from", "to", "label", "field", "file"), (TEXT, "a text")),
    **dict.fromkeys(("shear_time", "factor"), (NUMBER, "a number")),
    "reference": ((int, float, dict), "a number, or a table that says where one stands"),
    "where": ((dict,), "a table of columns and their values"),
    "relative": ((bool,), "true or false"),
    "runs": ((list,), "a list of runs"),
    "read_at": ((list,), "a list of shear times"),
    **dict.fromkeys(("arguments", "lines"), ((list,), "a list of texts")),
}


def read_toml(file):
    """A TOML file as a dictionary."""
    if not file.is_file():
        raise InputError(f"{file}: there is no such file")
    try:
        with open(file, "rb") as stream:
            return tomllib.load(stream)
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise InputError(f"{file}: {error}") from None


def check_keys(place, table, keys):
    """Refuses a table that has not the keys it must have, or has others. `place` names it; `keys`: must, may."""
    if not isinstance(table, dict):
        raise InputError(f"{place}: it must be a table of keys, not {table!r}")
    must, may = keys
    for name in must:
        if name not in table:
            raise InputError(f"{place}: the key '{name}' is missing; it must have: {', '.join(must)}")
    for name in table:
        if name not in must + may:
            raise InputError(f"{place}: there is no key '{name}'; there are: {', '.join(must + may)}")


def check_kinds(place, table):
    """Refuses a value that is not of the kind its key is of."""
    for key, value in table.items():
        kinds, words = KINDS.get(key, ((object,), ""))
        if not isinstance(value, kinds) or (isinstance(value, bool) and kinds in (NUMBER, KINDS["reference"][0])):
            raise InputError(f"{place}: {key} = {value!r}, must be {words}")
        if key == "read_at" and not all(isinstance(time, NUMBER) for time in value):
            raise InputError(f"{place}: {key} = {value!r}, must be {words}")
        if key == "band" and not (value in SIDES or (isinstance(value, NUMBER) and value >= 0)):
            raise InputError(f"{place}: band = {value!r}, must be a number that is not negative, or one of {', '.join(SIDES)}")
        if key in ("means_over", "mean_over") and not (
            isinstance(value, list) and len(value) == 2 and all(isinstance(time, NUMBER) for time in value) and value[0] < value[1]
        ):
            raise InputError(f"{place}: {key} = {value}, must be two shear times, the first before the second, as [15, 30]")


def checked_entries(file, wanted, all_keys):
    """{name: its entries [[name]]}, each with the keys that it must and may have."""
    found = {name: wanted.get(name, []) for name in all_keys}
    for name, entries in found.items():
        if not isinstance(entries, list):
            raise InputError(f"{file}: {name} must be written [[{name}]], as often as there are any")
        for number, entry in enumerate(entries, 1):
            check_keys(f"{file}: [[{name}]] number {number}", entry, all_keys[name])
            check_kinds(f"{file}: [[{name}]] number {number}", entry)
    return found


def require_name_of(place, name, suffix):
    """Refuses the name of a file to be written that is none of its kind, or leads to another folder: it might be that of something else."""
    if pathlib.PurePath(name).name != name or pathlib.PurePath(name).suffix != suffix:
        raise InputError(f"{place}: file = {name!r}, must be a name without a folder that ends with {suffix}")
