"""Files and folders that appear whole or not at all: written under a temporary name beside their place, then renamed."""

import contextlib
import os
import pathlib
import shutil

from .observables import InputError


def require_place(target, force=False):
    """Refuses a target that is there already (with `force`: one that is no file), or whose folder is not there."""
    target = pathlib.Path(target)
    if target.exists() and not force:
        raise InputError(f"{target}: it is there already; choose another name, or --force to replace it")
    if target.exists() and not target.is_file():
        raise InputError(f"{target}: it is no file, so it cannot be replaced; choose another name")
    _require_parent(target)


def require_empty(folder):
    """Refuses a folder that has something in it; one that is not there yet will do."""
    folder = pathlib.Path(folder)
    if folder.exists() and not (folder.is_dir() and not any(folder.iterdir())):
        raise InputError(f"{folder}: it is there already; choose the name of a new or empty folder")
    _require_parent(folder)


def _require_parent(target):
    if not target.parent.is_dir():
        raise InputError(f"{target}: there is no folder {target.parent}; make it first")


@contextlib.contextmanager
def writing(target):
    """The temporary name to write to. It becomes `target`, replacing what is there, unless something goes wrong."""
    target = pathlib.Path(target)
    temporary = target.with_name(f".{target.name}.{os.getpid()}.tmp")
    try:
        yield temporary
        os.replace(temporary, target)
    except OSError as error:
        raise InputError(f"{target}: cannot be written: {error.strerror or error}") from error
    finally:
        if temporary.is_dir():
            shutil.rmtree(temporary)
        temporary.unlink(missing_ok=True)
