"""What a case computes, prints and draws by code of its own: cases/NAME/analyse.py, found by its name.

It is a Python file that uses tanktread_post and has

    tables(output, case)     a list of Table (table.py), printed before the tables of compare.toml; the exit code is 1 if a
                             verdict in one of them is False
    pictures(output, case)   draws into `output`; a list of the files

with `output` the folder of the results and `case` that of the case. Both raise InputError (observables.py) about results that
are not there. It may have

    SETTINGS                 (keys that must be there, keys that may be there) of the table [analyse] in the case's compare.toml,
                             which read_comparison(case)["analyse"] gives. Default: none
    BREAKDOWN_IS_A_RESULT    True: a run that breaks down does not end a series of many. Default: False
    measured(output, case)   {file name: text}: tables that --measure keeps in measured/ beside results.csv. Default: none
"""

import dataclasses
import importlib.util
import pathlib
import typing

from .observables import InputError
from .reference import ANALYSE, read_comparison
from .table import Table
from .toml_tables import check_keys

FUNCTIONS = ("tables", "pictures")  # that it must have


@dataclasses.dataclass(frozen=True)
class CaseAnalysis:
    """The analyse.py of a case."""

    tables: typing.Callable
    pictures: typing.Callable
    measured: typing.Callable = lambda output, case: {}
    breakdown_is_a_result: bool = False


def load(case):
    """The CaseAnalysis of a case folder, its settings checked; None where there is no analyse.py."""
    file = pathlib.Path(case) / ANALYSE
    if not file.is_file():
        return None
    module = module_of(file)
    missing = [name for name in FUNCTIONS if not callable(getattr(module, name, None))]
    if missing:
        raise InputError(f"{file}: it must have the function{'s'[: len(missing) - 1]} {' and '.join(f'{name}(output, case)' for name in missing)}")
    check_keys(f"{file.with_name('compare.toml')}: [analyse]", read_comparison(case)["analyse"], getattr(module, "SETTINGS", ((), ())))
    given = {"measured": getattr(module, "measured", None), "breakdown_is_a_result": getattr(module, "BREAKDOWN_IS_A_RESULT", None)}
    tables = _giving(file, module.tables, lambda one: isinstance(one, Table), "Table (table.py)")
    pictures = _giving(file, module.pictures, lambda one: pathlib.Path(one).is_file(), "files that are there")
    return CaseAnalysis(tables, pictures, **{name: value for name, value in given.items() if value is not None})


def _giving(file, function, good, words):
    """The function, whose results must be lists of what is good."""

    def checked(output, case):
        made = function(output, case)
        if not (isinstance(made, list) and all(good(one) for one in made)):
            raise InputError(f"{file}: {function.__name__}(output, case) gives {made!r}, must be a list of {words}")
        return made

    return checked


def module_of(file):
    """The file as a module of its own."""
    specification = importlib.util.spec_from_file_location("analyse", file)
    module = importlib.util.module_from_spec(specification)
    try:
        specification.loader.exec_module(module)
    except Exception as error:
        raise InputError(f"{file}: it cannot be loaded: {type(error).__name__}: {error}") from error
    return module
