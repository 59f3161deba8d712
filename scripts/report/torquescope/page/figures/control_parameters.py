"""F and CR over the generations, every run thin and the median thick: Fig. 5 of the seed."""

import numpy as np

from .. import readings, style
from . import Case
from ..study import held

MOST_RUNS = 60


def draw(generations, F, CR, colour=style.LIGHT["ink"], width=style.SMALL):
    """F, CR: [run][generation], NaN where undefined."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 40, 196)
    ends, highest = [], 0.0
    for values, name, dashes in ((F, "F", "solid"), (CR, "CR", (0, (5, 2)))):
        values = held(values)
        defined = np.flatnonzero(np.isfinite(values).any(axis=0))
        values = values[:, defined]
        for run in values[:MOST_RUNS]:
            axes.plot(generations[defined], run, color=colour, linewidth=0.7, alpha=0.25, label=f"_{name}")
        median = np.nanmedian(values, axis=0)
        axes.plot(generations[defined], median, color=colour, linestyle=dashes, linewidth=2.4, label=name)
        ends.append((name, median[-1]))
        highest = max(highest, np.nanmax(values))
    top = 1.0 if highest <= 1 else 2.0 if highest <= 2 else 1.05 * highest
    axes.set(xlim=(0, generations[-1]), ylim=(0, top), xlabel="generation")
    readings.of(axes, ("generation", ""), ("control parameter", ""))
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 4)
    style.few_ticks(axes.yaxis, 5)
    places = style.spread([y for _, y in ends], 16 * top / 166, 0, top)
    for (name, _), y in zip(ends, places):
        axes.annotate(name, (1, y), (6, 0), xycoords=("axes fraction", "data"), textcoords="offset points", va="center",
                      fontweight="bold", color=colour)
    canvas.text(0, 16, "control parameter (1)")
    return canvas.figure


def cases(study):
    found = {}
    for e in study.searches:
        if e.controller is None or e.F is None or not e.draws_histories:
            continue
        title = f"F and CR of {e.label}"
        sentence = "Mutation factor F (solid) and crossover rate CR (dashed) as the fuzzy controller set them."
        arguments = {"generations": e.generations, "F": e.F, "CR": e.CR, "colour": e.ink}
        found[f"control_parameters_{e.name}"] = Case(draw, arguments, title, sentence)
    return found
