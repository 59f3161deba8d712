"""What a pointer reads off a figure and what its legend can hide, gathered from the matplotlib figure that was drawn.

An artist's label names it in the legend; artists of one label are hidden together. The values of lines, steps and
vertical lines with a label are read under the pointer. "_label" belongs to `label` and is not read: single runs below
their median. Without a label an artist stays as it is.

Where the values go   charts.js, as JSON beside the svg: numbers of the figure's arrays, none taken from a drawing
"""

import json
import math

import numpy as np
from matplotlib.collections import Collection, LineCollection
from matplotlib.lines import Line2D
from matplotlib.patches import Patch, StepPatch

from . import style

DIGITS = 5  # of a value: more cannot be read off a picture


def of(axes, x, y, zoom="xy"):
    """Says what is read on these axes: x and y are (word, unit); zoom: the directions in which they zoom."""
    axes.readings = {"x": x, "y": y, "zoom": zoom, "notes": [], "grids": []}


def note(axes, words, at=None, cell=None):
    """Words read near the point `at` (x, y), or inside `cell` (x0, x1, y0, y1), in the axes' own numbers."""
    axes.readings["notes"].append({"words": words} | ({"at": _short(at)} if at else {"cell": _short(cell)}))


def grid(axes, x_edges, y_edges, values, word):
    """Values [x][y] of the cells between the edges, NaN where there is nothing to read; `word` says what they are."""
    axes.readings["grids"].append({"x": _short(x_edges), "y": _short(y_edges), "word": word,
                                   "values": [_short(column) for column in values]})


def gather(figure, labels):
    """Marks the figure's parts for the page's script, and returns what charts.js reads: one entry per axes.

    labels: {label: part}, filled here; the same for both widths of a figure.
    """
    found = []
    for index, axes in enumerate(figure.axes):
        told = getattr(axes, "readings", None)
        series = [one for artist in axes.get_children() for one in _series(artist, labels, told is not None)]
        if told is None:
            continue
        axes.set_gid(f"part:axes-{index}")
        for which in ("x", "y"):
            getattr(axes, f"{which}axis").set_gid(f"part:{which}-axis-{index}")
        found.append({"index": index, "box": _pixels(figure, axes), "zoom": told["zoom"],
                      "x": _axis(axes.get_xlim(), axes.get_xscale(), told["x"]),
                      "y": _axis(axes.get_ylim(), axes.get_yscale(), told["y"]),
                      "series": series, "notes": told["notes"], "grids": told["grids"]})
    return found


def written(found):
    return json.dumps(found, separators=(",", ":"), ensure_ascii=False)


def legend(figure, labels):
    """[{"label", "part", "shape", "colour", "dashes"}] of the labels in the order they were drawn."""
    seen, plain = {}, set()
    for axes in figure.axes:
        for artist in axes.get_children():
            label = _label(artist)
            if label in labels and label not in plain:
                seen[label] = {"label": label, "part": labels[label], **_look(artist)}
                plain |= set() if artist.get_label().startswith("_") else {label}
    return list(seen.values())


def _label(artist):
    """Without the underscore; "" where an artist has none of its own (matplotlib calls these "_child3")."""
    label = str(artist.get_label() or "") if isinstance(artist, (Line2D, Patch, Collection)) else ""
    return "" if label.startswith("_child") or label == "_nolegend_" else label.lstrip("_")


def _series(artist, labels, is_read):
    label = _label(artist)
    if not label:
        return
    part = labels.setdefault(label, f"series-{len(labels)}")
    artist.set_gid(f"part:{part}")
    values = _values(artist) if is_read and not artist.get_label().startswith("_") else None
    if values:
        yield {"part": part, "label": label, "colour": _look(artist)["colour"], **values}


def _values(artist):
    if isinstance(artist, Line2D):
        x, y = artist.get_data(orig=False)
        return {"x": _short(x), "y": _short(y)} if len(x) else None
    if isinstance(artist, StepPatch):
        heights, edges, _ = artist.get_data()
        return {"edges": _short(edges), "y": _short(heights)}
    if isinstance(artist, LineCollection):  # from the axis to a value, one line each
        ends = [segment[-1] for segment in artist.get_segments()]
        return {"x": _short([x for x, _ in ends]), "y": _short([y for _, y in ends])}
    return None


def _look(artist):
    if isinstance(artist, Line2D):
        marker = artist.get_linestyle() == "None"
        dashes = getattr(artist, "_unscaled_dash_pattern", (0, ()))[1]  # matplotlib has no getter for it
        return {"shape": "dot" if marker else "line", "colour": style.name_of(artist.get_color()),
                "dashes": " ".join(f"{length:g}" for length in dashes or ())}
    colour = artist.get_edgecolor() if isinstance(artist, LineCollection) else artist.get_facecolor()
    colour = np.atleast_2d(colour)[0]
    shape = "line" if isinstance(artist, LineCollection) else "area"
    return {"shape": shape, "colour": style.name_of(colour), "dashes": ""}


def _pixels(figure, axes):
    width, height = (72 * inches for inches in figure.get_size_inches())
    box = axes.get_position()
    return [round(value, 1) for value in (box.x0 * width, (1 - box.y1) * height, box.x1 * width, (1 - box.y0) * height)]


def _axis(limits, scale, words):
    return {"from": float(limits[0]), "to": float(limits[1]), "log": scale == "log", "word": words[0], "unit": words[1]}


def _short(values):
    return [float(f"{value:.{DIGITS}g}") if math.isfinite(value) else None for value in np.asarray(values, dtype=float)]
