"""Reading with VTK's readers, whose complaints are errors here: VTK prints them, and goes on with what it has."""

import contextlib
import multiprocessing
import os
import re
import resource

from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow, vtkVersion

from .observables import InputError

DAMAGED = "it is damaged or cut off: write or copy it again"
END = b"</VTKFile>"


def read_by(reader, file):
    """What a reader of VTK's XML makes of a file. @throws InputError with VTK's words"""
    require_end(file)
    reader.SetFileName(str(file))
    with _words_of_vtk() as words:
        reader.Update()
        data = reader.GetOutput()
    for kind, said in words:
        advice = DAMAGED if kind == "ERROR" else f"write it for VTK {vtkVersion.GetVTKVersion()}"
        raise InputError(f"{file}: it cannot be read: {said}; {advice}")
    return data


def require_end(file):
    """@throws InputError unless the file ends as VTK's XML does. VTK takes what is behind the end of a file for lengths, and ends the process when there is no memory for them."""
    with open(file, "rb") as stream:
        stream.seek(max(0, os.path.getsize(file) - 100))
        if not stream.read().rstrip().endswith(END):
            raise InputError(f"{file}: it does not end with {END.decode()}; it is cut off, or of another format: write or copy it again")


def apart(call, file):
    """What `call` returns, from a process of its own with a limit to its memory: a damaged file may end VTK. @throws InputError then, and what `call` throws"""
    context = multiprocessing.get_context("fork")
    receiver, sender = context.Pipe(duplex=False)

    def work():
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # the last words of a library that gives up
        _limit_memory(os.path.getsize(file))
        try:
            sender.send((call(), None))
        except Exception as error:
            sender.send((None, error))

    child = context.Process(target=work)
    child.start()
    sender.close()
    try:
        result, error = receiver.recv()
    except EOFError:
        raise InputError(f"{file}: the library that reads it broke down over it; {DAMAGED}") from None
    finally:
        child.join()
    if error is not None:
        raise error
    return result


def _limit_memory(n_bytes):
    """What is in use, and 200 times a file, which compression does not reach, and 1 GiB."""
    with open("/proc/self/statm") as stream:
        in_use = int(stream.read().split()[0]) * resource.getpagesize()
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    wanted = in_use + 200 * n_bytes + 2**30
    resource.setrlimit(resource.RLIMIT_AS, (wanted if most == resource.RLIM_INFINITY else min(wanted, most), most))


@contextlib.contextmanager
def _words_of_vtk():
    """A list that gets what VTK has to complain of, [("ERROR" or "Warning", its words without addresses)]; nothing of it is printed."""
    words, window, before = [], vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield words
    finally:
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
        vtkOutputWindow.SetInstance(before)
        found = re.findall(r"^(ERROR|Warning): In .*\n\w+ \(\w+\): (.*)", window.GetOutput(), re.MULTILINE)
        words += [(kind, " ".join(text.split()).rstrip(".")) for kind, text in found]
