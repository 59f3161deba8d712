"""PC and FC over the generations: what the fuzzy controller sees (movement of the population, not its diversity)."""

import numpy as np

from .. import readings, style
from . import Case
from ..study import held

MOST_RUNS = 60


def draw(generations, PC, FC, colour=style.LIGHT["ink"], width=style.SMALL):
    """PC, FC: [run][generation], root mean square change of the members and of their fitness; NaN where undefined."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 40, 196, yscale="log")
    low, high, ends = np.inf, -np.inf, []
    for values, name, dashes in ((PC, "PC", "solid"), (FC, "FC", (0, (5, 2)))):
        # a run that did not move in one generation has no place on a logarithmic axis
        values = held(values)
        values = np.where(values > 0, values, np.nan)
        defined = np.flatnonzero(np.isfinite(values).any(axis=0))
        values = values[:, defined]
        for run in values[:MOST_RUNS]:
            axes.plot(generations[defined], run, color=colour, linewidth=0.7, alpha=0.22, label=f"_{name}")
        median = np.nanmedian(values, axis=0)
        axes.plot(generations[defined], median, color=colour, linestyle=dashes, linewidth=2.4, label=name)
        ends.append((name, median[-1]))
        low, high = min(low, np.nanmin(values)), max(high, np.nanmax(values))
    low, high = 10.0 ** np.floor(np.log10(low)), 10.0 ** np.ceil(np.log10(high))
    axes.set(xlim=(0, generations[-1]), ylim=(low, high), xlabel="generation")
    readings.of(axes, ("generation", ""), ("change per generation", ""))
    axes.xaxis.labelpad = 3
    style.decades(axes.yaxis, low, high)
    style.few_ticks(axes.xaxis, 4)
    span = np.log10(high / low)
    places = style.spread([np.log10(max(y, low)) for _, y in ends], 16 * span / 166, np.log10(low), np.log10(high))
    for (name, _), y in zip(ends, places):
        axes.annotate(name, (1, 10.0**y), (6, 0), xycoords=("axes fraction", "data"), textcoords="offset points",
                      va="center", fontweight="bold", color=colour)
    canvas.text(0, 16, "change per generation (raw units)")
    return canvas.figure


def cases(study):
    found = {}
    for e in study.searches:
        if e.controller is None or e.PC is None or not e.draws_histories or not np.any(np.asarray(e.PC) > 0):
            continue
        sentence = ("Root mean square change of the members (PC, solid) and of their fitness (FC, dashed): "
                    "the controller's input.")
        arguments = {"generations": e.generations, "PC": e.PC, "FC": e.FC, "colour": e.ink}
        found[f"population_changes_{e.name}"] = Case(draw, arguments, f"PC and FC of {e.label}", sentence)
    return found
