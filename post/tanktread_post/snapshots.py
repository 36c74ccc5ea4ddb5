"""Moments of a case's runs in one picture: the [[snapshot]] entries of compare.toml, each a run and a shear time."""

import math
import pathlib
import tempfile

import matplotlib

matplotlib.use("Agg")
import matplotlib.image
import matplotlib.pyplot as pyplot

from . import render
from .case_results import reached_snapshots
from .observables import InputError

COLUMNS = 4
CROP = 0.18  # of each side of a single picture: its legends


def draw_snapshots(output, case):
    """Writes snapshots.png into the folder of the runs; the file in a list, or nothing without snapshots."""
    chosen = reached_snapshots(output, case)
    if not chosen:
        raise InputError(f"{output}: none of the runs has come to a [[snapshot]] of {case}/compare.toml")
    n_rows = math.ceil(len(chosen) / COLUMNS)
    figure, axes = pyplot.subplots(n_rows, COLUMNS, figsize=(3.2 * COLUMNS, 2.9 * n_rows), squeeze=False)
    for place in axes.flat:
        place.axis("off")
    with tempfile.TemporaryDirectory() as folder:
        for number, (entry, run, time) in enumerate(chosen):
            file = render.render(run, entry.get("field", "area_ratio"), time, pathlib.Path(folder) / f"{number}.png")
            picture = matplotlib.image.imread(file)
            height, width = picture.shape[:2]
            place = axes.flat[number]
            place.imshow(picture[: int(height * (1 - CROP / 2)), int(width * CROP) : int(width * (1 - CROP))])
            place.set_title(f"{entry['label']}, shear time {time:.4g}", fontsize=10)
    figure.tight_layout()
    file = pathlib.Path(output) / "snapshots.png"
    figure.savefig(file, dpi=110)
    pyplot.close(figure)
    return file
