"""Moments of a case's runs in one picture: the [[snapshot]] entries of compare.toml, each a run and a shear time."""

import math
import pathlib
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.image
import matplotlib.pyplot as pyplot

from . import render
from .observables import InputError
from .reference import read_comparison
from .run_folder import is_run

COLUMNS = 4
CROP = 0.18  # of each side of a single picture: its legends


def present_snapshots(output, case):
    """The snapshots whose run is there, with its folder."""
    wanted = read_comparison(case).get("snapshot", [])
    return [(entry, pathlib.Path(output) / entry["run"]) for entry in wanted if is_run(pathlib.Path(output) / entry["run"])]


def draw_snapshots(output, case):
    """Writes snapshots.png into the folder of the runs; the file in a list, or nothing without snapshots."""
    chosen = present_snapshots(output, case)
    if not chosen:
        raise InputError(f"{output}: none of the runs that {case}/compare.toml takes a [[snapshot]] of is there")
    n_rows = math.ceil(len(chosen) / COLUMNS)
    figure, axes = pyplot.subplots(n_rows, COLUMNS, figsize=(3.2 * COLUMNS, 2.9 * n_rows), squeeze=False)
    for place in axes.flat:
        place.axis("off")
    with tempfile.TemporaryDirectory() as folder:
        for number, (entry, run) in enumerate(chosen):
            file = render.render(run, entry.get("field", "area_ratio"), entry["shear_time"], pathlib.Path(folder) / f"{number}.png")
            picture = matplotlib.image.imread(file)
            height, width = picture.shape[:2]
            place = axes.flat[number]
            place.imshow(picture[: int(height * (1 - CROP / 2)), int(width * CROP) : int(width * (1 - CROP))])
            place.set_title(f"{entry['label']}, shear time {entry['shear_time']:g}", fontsize=10)
    figure.tight_layout()
    file = pathlib.Path(output) / "snapshots.png"
    figure.savefig(file, dpi=110)
    pyplot.close(figure)
    return file
