"""How a command ends: 0; 1 a value outside its band, a run not finished; 2 bad input; 3 a fault of ours. Never by a traceback alone, whose code is 1."""

import os
import sys
import traceback

from .observables import InputError

FAULT = "this is a fault of tanktread_post (or of the analyse.py named above), not of your input; please report it with the lines above"


def ended(program, call):
    """The exit code of what `call` does; what goes wrong is said, with the name of the program."""
    try:
        return call()
    except InputError as error:
        print(f"{program}: error: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:  # of `| head`: nothing is left to say, and nobody to say it to
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 141
    except OSError as error:
        print(f"{program}: error: {error.filename or 'a file'}: {error.strerror or error}", file=sys.stderr)
        return 2
    except Exception:
        traceback.print_exc()
        print(f"{program}: error: {FAULT}", file=sys.stderr)
        return 3
