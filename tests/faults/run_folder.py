"""What a run left in its folder, held against the folder of the run that nothing disturbed."""

import re


def contents(folder):
    """Everything in a folder, hidden files too: relative path to bytes, of a folder None."""
    return {str(path.relative_to(folder)): None if path.is_dir() else path.read_bytes() for path in sorted(folder.rglob("*"))}


def differences(whole, other):
    """What differs between two folders' contents, a line each; nothing is left out."""
    lines = [f"{name}: is missing" for name in whole if name not in other]
    lines += [f"{name}: is too much" for name in other if name not in whole]
    return lines + [f"{name}: differs" for name in whole if name in other and whole[name] != other[name]]


def _entries(series):
    """The entries of a .pvd; None if it is not whole."""
    lines = series.decode().splitlines()
    if lines[-1:] != ["</VTKFile>"]:
        return None
    return [line for line in lines if "<DataSet" in line]


def faults_a_reader_meets(folder, whole):
    """What is wrong with the results of a run that was broken off, for someone who reads them now; a line each.

    Files are those of the whole run or not there, series are whole and name no file that is not there, the table has rows of
    the whole run only. Names that begin with a dot are nobody's business.
    """
    lines = []
    for path in sorted(folder.rglob("*")):
        name = str(path.relative_to(folder))
        if path.is_dir() or any(part.startswith(".") for part in path.relative_to(folder).parts):
            continue
        content = path.read_bytes()
        if path.suffix == ".pvd":
            lines += _faults_of_series(name, content, folder, whole[name])
        elif path.suffix == ".csv":
            if not whole[name].startswith(content) or not content.endswith(b"\n"):
                lines.append(f"{name}: has half a row, or rows that are not of the run")
        elif re.match(r"(membrane|fluid)/|\w+\.toml", name) and content != whole.get(name):
            lines.append(f"{name}: is not the file of the whole run")
    return lines


def _faults_of_series(name, content, folder, whole):
    entries = _entries(content)
    if entries is None:
        return [f"{name}: is not whole"]
    lines = [] if entries == _entries(whole)[: len(entries)] else [f"{name}: has entries that are not of the run"]
    files = [re.search('file="([^"]*)"', entry).group(1) for entry in entries]
    return lines + [f"{name}: names {file}, which is not there" for file in files if not (folder / file).is_file()]


def steps_in(folder, pattern):
    """The steps in the names of files, in order."""
    return sorted(int(re.search(r"_(\d+)", path.name).group(1)) for path in folder.glob(pattern))


def last_row(folder):
    """The step of the last whole row of the table; -1 if there is none yet."""
    try:
        rows = (folder / "observables.csv").read_text().split("\n")[1:-1]
    except FileNotFoundError:
        return -1
    return int(rows[-1].split(",")[0]) if rows else -1
