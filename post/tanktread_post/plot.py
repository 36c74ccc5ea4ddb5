"""PNG plots: observables against shear time with the reference drawn in; and the form that all plots have."""

import pathlib

import matplotlib

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402  (the backend must be chosen first)

from .observables import InputError, Observables  # noqa: E402
from .reference import read_comparison  # noqa: E402
from .run_folder import is_run  # noqa: E402

PLOTS = {
    "deformation": ("deformation.png", "Taylor deformation  $D$"),
    "inclination_deg": ("inclination.png", "inclination  (degrees)"),
}
SMALLEST_DEFORMATION = 1e-5
# Distinguishable with every common form of colour blindness (Okabe and Ito).
COLOURS = ("#0072b2", "#d55e00", "#009e73", "#cc79a7", "#56b4e9", "#e69f00", "#000000")
LINES = ("solid", "dashed", "dotted", "dashdot")  # when the colours have run out


def new_axes(x_label, y_label):
    """A figure with one pair of axes, in the form that all plots have."""
    figure, axes = pyplot.subplots(figsize=(7.2, 4.5), layout="constrained")
    _style(axes, x_label, y_label)
    return figure, axes


def new_panels(x_labels, y_labels):
    """A figure with a row of axes for each label of y and a column for each of x, (figure, array of axes), in the form that all plots have."""
    n_rows, n_columns = len(y_labels), len(x_labels)
    figure, panels = pyplot.subplots(n_rows, n_columns, figsize=(5.4 * n_columns, 3.6 * n_rows), layout="constrained", squeeze=False)
    for row, y_label in zip(panels, y_labels):
        for axes, x_label in zip(row, x_labels):
            _style(axes, x_label, y_label)
    return figure, panels


def _style(axes, x_label, y_label):
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.grid(alpha=0.25, linewidth=0.8)
    axes.spines[["top", "right"]].set_visible(False)
    axes.tick_params(length=3)


def save(figure, file):
    """Writes a figure as PNG. Returns the file."""
    figure.savefig(file, dpi=160)
    pyplot.close(figure)
    return file


def run_folders(output):
    """{label: folder}: the output of one run, or the runs below a folder of many."""
    output = pathlib.Path(output)
    if is_run(output):
        return {"tanktread": output}
    found = {path.name: path for path in sorted(output.iterdir()) if is_run(path)} if output.is_dir() else {}
    if not found:
        raise InputError(f"{output}: neither the output of a run nor a folder of such")
    return found


def _plot_quantity(name, runs, values, source, file):
    """One quantity of runs against shear time, and the references of `values` that are of it. Returns the file."""
    figure, axes = new_axes(r"shear time  $\dot\gamma t$", PLOTS[name][1])
    for k, (run, observables) in enumerate(runs.items()):
        # The inclination of a sphere has no meaning: what is hardly deformed is left out.
        drawn = observables["deformation"] > SMALLEST_DEFORMATION if name == "inclination_deg" else slice(None)
        x, y = observables["shear_time"][drawn], observables[name][drawn]
        axes.plot(x, y, color=COLOURS[k % len(COLOURS)], linestyle=LINES[k // len(COLOURS) % len(LINES)], label=run)
    # The reference of a mean is drawn at the end of its stretch of time.
    points = sorted({(v.get("shear_time") or v["mean_over"][1], v["reference"]) for v in values if v["name"] == name})
    if points:
        axes.plot(*zip(*points), "o", color="black", markerfacecolor="white", markersize=7, label=source, zorder=3)
    axes.set_xlim(left=0)
    axes.legend(frameon=False, fontsize="small" if len(runs) > 6 else None)
    return save(figure, file)


def plot_observables(output, case=None):
    """Writes one PNG for each of D and inclination into the folder, or those that the case has. Returns the files."""
    output = pathlib.Path(output)
    runs = {label: Observables(folder) for label, folder in run_folders(output).items()}
    wanted = read_comparison(case) if case else {"value": [], "picture": [], "source": "reference"}
    pictures = [picture for picture in wanted["picture"] if set(picture["runs"]) & set(runs)]
    if not pictures:
        return [_plot_quantity(name, runs, wanted["value"], wanted["source"], output / file) for name, (file, _) in PLOTS.items()]
    files = []
    for picture in pictures:
        chosen = {run: runs[run] for run in picture["runs"] if run in runs}
        values = [value for value in wanted["value"] if value["run"] in chosen]
        files.append(_plot_quantity(picture["name"], chosen, values, wanted["source"], output / picture["file"]))
    return files
