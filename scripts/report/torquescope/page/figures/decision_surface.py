"""One output of the fuzzy controller over its two inputs in nine steps, with the way the median run took: Fig. 4."""

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from .. import quantities, readings, style
from . import Case
from .membership_functions import MEANING

MOST_CELLS = 48  # per side: finer cells cannot be told apart at this size


def draw(surface, first, second, path, output, first_name, second_name, width=style.SMALL):
    """surface [m][m]: output over (first = row, second = column); path [G+1][2]: (first, second), NaN where
    undefined."""
    canvas = style.Canvas(width, 292)
    axes = canvas.axes(50, 30, width - 62, 244)
    axes.grid(False)
    first, second, surface = _coarser(np.asarray(first), np.asarray(second), np.asarray(surface))
    low, high = float(surface.min()), float(surface.max())
    level = np.clip(((surface - low) / max(high - low, 1e-300) * 9).astype(int), 0, 8)
    for step in range(9):
        cells(axes, level == step, _edges(first), _edges(second), style.LIGHT[f"ramp{step}"])
    axes.set(xlim=(first[0], first[-1]), ylim=(second[0], second[-1]), xlabel=first_name)
    readings.of(axes, (first_name, ""), (second_name, ""))
    readings.grid(axes, _edges(first), _edges(second), surface, output)
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 4)
    style.few_ticks(axes.yaxis, 4)
    way = np.asarray(path)[np.isfinite(path).all(axis=1)]
    if len(way):
        # a light line under the dark one: seen on every step of the ramp
        axes.plot(*way.T, color=style.LIGHT["background"], linewidth=4.2, clip_on=False, zorder=4)
        axes.plot(*way.T, color=style.LIGHT["ink"], linewidth=1.6, clip_on=False, zorder=5)
        for point, filled in ((way[0], False), (way[-1], True)):
            axes.plot(*point, marker="o", markersize=8, color=style.LIGHT["ink"], clip_on=False, zorder=6,
                      markerfacecolor=style.LIGHT["ink" if filled else "background"], markeredgewidth=1.6)
    _scale(canvas, low, high, output, width)
    canvas.text(0, 16, second_name)
    return canvas.figure


def _coarser(first, second, surface):
    take = [
        np.unique(np.linspace(0, len(axis) - 1, min(len(axis), MOST_CELLS)).round().astype(int))
        for axis in (first, second)
    ]
    return first[take[0]], second[take[1]], surface[np.ix_(*take)]


def _edges(centres):
    middle = (centres[:-1] + centres[1:]) / 2
    return np.concatenate([centres[:1], middle, centres[-1:]])


def cells(axes, mask, x_edges, y_edges, colour):
    """All cells of one step (mask [x][y]) as one path: runs along a column become one rectangle."""
    vertices, codes = [], []
    for i, column in enumerate(mask):
        turns = np.flatnonzero(np.diff(np.concatenate([[False], column, [False]]).astype(int)))
        for begin, end in turns.reshape(-1, 2):
            x0, x1, y0, y1 = x_edges[i], x_edges[i + 1], y_edges[begin], y_edges[end]
            vertices += [(x0, y0), (x1, y0), (x1, y1), (x0, y1), (x0, y0)]
            codes += [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    if vertices:
        # the thin outline of the same colour closes the hairlines between neighbours
        axes.add_patch(PathPatch(Path(vertices, codes), facecolor=colour, edgecolor=colour, linewidth=0.6))


def _scale(canvas, low, high, output, width):
    bar = canvas.axes(width - 50, 30, width - 36, 244)
    bar.grid(False)
    for step in range(9):
        bar.axhspan(step, step + 1, color=style.LIGHT[f"ramp{step}"], linewidth=0.6)
    bar.set(xlim=(0, 1), ylim=(0, 9), xticks=[], yticks=[])
    for y, value in ((38, high), (244, low)):
        canvas.text(width - 32, y, quantities.fixed(value, 2))
    canvas.text(width - 50, 16, output, fontweight="bold", color=style.LIGHT["ink"])


def cases(study):
    found = {}
    for e in study.searches:
        for output in ("F", "CR"):
            if e.controller is None or not e.controller.has(f"{output}_surface"):
                continue
            names = getattr(e.controller, f"{output}_inputs")
            arguments = {"surface": getattr(e.controller, f"{output}_surface"),
                         "first": getattr(e.controller, f"{output}_first"),
                         "second": getattr(e.controller, f"{output}_second"),
                         "path": getattr(e.controller, f"{output}_path")[int(e.median_run)],
                         "output": output, "first_name": _meaning(names[0]), "second_name": _meaning(names[1])}
            sentence = "Line: the way of the median run, from the open dot to the full one."
            found[f"decision_surface_{e.name}_{output}"] = Case(
                draw, arguments, f"{output} of {e.label} over its inputs", sentence
            )
    return found


def _meaning(name):
    return MEANING.get(name, name)
