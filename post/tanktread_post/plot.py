"""PNG plots of the observables against shear time, with the reference drawn in."""

import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend must be chosen first)

from .observables import Observables, read_comparison  # noqa: E402

PLOTS = {
    "deformation": ("deformation.png", "Taylor deformation  D"),
    "inclination_deg": ("inclination.png", "inclination (degrees)"),
}


def plot_observables(output, case=None):
    """Writes one PNG for each of D and inclination into the output directory."""
    observables = Observables(output)
    values = read_comparison(case)["value"] if case else []
    for name, (file, label) in PLOTS.items():
        figure, axes = pyplot.subplots(figsize=(7, 4.5), constrained_layout=True)
        # The inclination of the undeformed sphere has no meaning: leave out the first row.
        axes.plot(observables["shear_time"][1:], observables[name][1:], color="#1f5a93", linewidth=2, label="tanktread")
        points = [value for value in values if value["name"] == name]
        if points:
            axes.plot(
                [value["shear_time"] for value in points],
                [value["reference"] for value in points],
                "o",
                color="#c44e2b",
                markersize=8,
                label="reference",
            )
        axes.set_xlabel("shear time")
        axes.set_ylabel(label)
        axes.grid(alpha=0.3)
        axes.spines[["top", "right"]].set_visible(False)
        axes.legend(frameon=False)
        figure.savefig(pathlib.Path(output) / file, dpi=150)
        pyplot.close(figure)
