"""Rows of traces over one time axis with aligned left edges, and their samples for zooming in the page.

The first picture is drawn here, thinned by M4, so the page lives without scripts, in mail previews and on paper.
page.js finds `data-part` lines and rewrites their paths from the samples when somebody zooms.
"""

import base64
import json
import zlib
from dataclasses import dataclass

import numpy as np
from matplotlib.patches import PathPatch
from matplotlib.path import Path

from . import quantities, style, thin

MOST_SAMPLES = 50000  # per trace, in the page
ALL_SAMPLES = 700000  # of all traces of a page together: it stays below 3 MB
OPENED_S = 6.0
LEFT, RIGHT = 50, 12
ABSENT = -32768  # the int16 that stands for NaN: the line has a gap there


@dataclass
class Line:
    part: str  # name of the samples in the page; "measured-ols" is their difference
    values: np.ndarray
    colour: str
    dashes: object = "solid"
    thickness: float = 1.4
    on_top: bool = False
    label: str = ""  # in the legend, and read under the pointer


@dataclass
class Row:
    words: str  # above the row
    symbol: str  # of the quantity, for measuring
    unit: str
    lines: list
    height: int
    low: float
    high: float
    band: float = 0.0  # half height of a shaded band about zero
    times: float = 1.0  # how many of `unit` make one of the values': 1000 for mrad


def draw(time, rows, window, overview, width, regions=()):
    """rows: [Row]; window: (start, stop) in s; overview: the Line drawn whole in the strip below; regions: [(start,
    stop)] in s, shaded in every row."""
    heading = 24
    height = sum(heading + row.height for row in rows) + 34 + (44 if overview else 0)
    canvas = style.Canvas(width, height)
    right = width - RIGHT
    start, stop = window
    layout = {"left": LEFT, "right": right, "start": round(float(start), 6), "stop": round(float(stop), 6), "rows": []}
    if len(regions):
        layout["regions"] = [[round(begin, 3), round(end, 3)] for begin, end in regions]
    top = 0
    for index, row in enumerate(rows):
        top += heading
        axes = canvas.axes(LEFT, top, right, top + row.height)
        if len(regions):
            _shade(axes, regions, (start, stop))
        if row.band:
            band = axes.axhspan(-row.band, row.band, color=style.LIGHT["floor"], linewidth=0, zorder=0.5)
            band.set_gid("part:band")
        for line in row.lines:
            _line(axes, time, line, (start, stop), right - LEFT)
        axes.set(xlim=(start, stop), ylim=(row.low, row.high))
        style.few_ticks(axes.xaxis, 8 if width >= style.WIDE else 4)
        style.few_ticks(axes.yaxis, 4 if row.height > 100 else 2)
        if row.times != 1.0:
            axes.yaxis.set_major_formatter(lambda value, _, times=row.times: quantities.tick(value * times))
        axes.xaxis.set_gid("part:x-axis")
        axes.yaxis.set_gid("part:y-axis")
        if index < len(rows) - 1:
            axes.tick_params(labelbottom=False)
        canvas.text(LEFT, top - 8, style.fit(row.words, width - LEFT))
        layout["rows"].append({"top": top, "bottom": top + row.height, "low": row.low, "high": row.high,
                               "symbol": row.symbol, "unit": row.unit, "band": row.band, "times": row.times,
                               "lines": [line.part for line in row.lines],
                               "colours": [style.name_of(line.colour) for line in row.lines],
                               "labels": [line.label or row.symbol for line in row.lines]})
        top += row.height
    canvas.text((LEFT + right) / 2, top + 34, "time (s)", ha="center")
    if overview:
        _strip(canvas, time, overview, window, top + 44, right, layout)
    canvas.figure.trace_legend = _legend(rows)
    canvas.figure.trace_layout = json.dumps(layout, separators=(",", ":"))
    return canvas.figure


def _legend(rows):
    """As readings.legend: one entry for lines of one label, in whichever rows they are."""
    found = {}
    for line in (line for row in rows for line in row.lines if line.label):
        dashes = "" if line.dashes == "solid" else " ".join(f"{length:g}" for length in line.dashes[1])
        entry = found.setdefault(line.label, {"label": line.label, "parts": [], "shape": "line", "dashes": dashes,
                                              "colour": style.name_of(line.colour)})
        entry["parts"].append(line.part)
    return [{**entry, "part": " ".join(dict.fromkeys(entry.pop("parts")))} for entry in found.values()]


def _shade(axes, regions, window):
    vertices, codes = [], []
    for begin, end in regions:
        if end > window[0] and begin < window[1]:
            begin, end = max(begin, window[0]), min(end, window[1])
            vertices += [(begin, 0), (end, 0), (end, 1), (begin, 1), (begin, 0)]
            codes += [Path.MOVETO, Path.LINETO, Path.LINETO, Path.LINETO, Path.CLOSEPOLY]
    # an empty first view keeps a point, so that zooming has a path to rewrite
    shape = Path(vertices or [(window[0], 0)], codes or [Path.MOVETO])
    shaded = axes.add_patch(
        PathPatch(shape, color=style.LIGHT["region"], linewidth=0, zorder=0.3, transform=axes.get_xaxis_transform())
    )
    shaded.set_gid("part:regions")


def _line(axes, time, line, window, columns):
    kept = thin.m4(time, line.values, columns, *window)
    (drawn,) = axes.plot(
        time[kept],
        line.values[kept],
        color=line.colour,
        linestyle=line.dashes,
        linewidth=line.thickness,
        solid_joinstyle="round",
        zorder=3 if line.on_top else 2,
    )
    drawn.set_gid(f"part:{line.part}")


def _strip(canvas, time, line, window, top, right, layout):
    axes = canvas.axes(LEFT, top, right, top + 32)
    axes.grid(False)
    axes.set_facecolor("none")
    low, high = np.nanmin(line.values), np.nanmax(line.values)
    seen = axes.axvspan(*window, color=style.LIGHT["floor"], linewidth=0, zorder=0.5)
    seen.set_gid("part:window")
    kept = thin.m4(time, line.values, right - LEFT)
    axes.plot(time[kept], line.values[kept], color=style.LIGHT["muted"], linewidth=0.8)
    axes.set(xlim=(time[0], time[-1]), ylim=(low, high), xticks=[], yticks=[])
    canvas.text(0, top + 20, "whole")
    layout["overview"] = {"top": top, "bottom": top + 32}


def scale(values, margin=0.06):
    """Limits that hold all the values."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    room = margin * (high - low) or 1.0
    return low - room, high + room


def window_with_most(events, time, length=OPENED_S):
    """(start, stop) of the `length` seconds that hold most of the events (indices); everything when it is short."""
    first, last = float(time[0]), float(time[-1])
    if last - first <= 1.3 * length:
        return first, last
    at = np.sort(time[np.asarray(events, dtype=int)]) if len(events) else np.array([first])
    inside = np.searchsorted(at, at + length) - np.arange(len(at))
    start = min(at[int(np.argmax(inside))] - 0.05 * length, last - length)
    start = max(round(start, 1), first)
    return start, start + length


def packed(time, series, guide, most):
    """Samples as JSON for the page: int16 (time int32), differences, deflate, base64; ABSENT where a value is NaN.

    Above `most` samples those stay that are lowest or highest in `guide` [n] over a short stretch: its spikes survive.
    """
    kept = thin.min_max_pairs(guide, most)
    shown = time[kept]
    tick = float(shown[-1] - shown[0]) / 2**30 or 1.0
    document = {"t": {"origin": float(shown[0]), "scale": tick,
                      "data": _deflated(np.rint((shown - shown[0]) / tick).astype(np.int64), np.int32)}, "series": {}}
    for name, values in series.items():
        values = np.asarray(values, dtype=float)[kept]
        absent = ~np.isfinite(values)
        step = float(np.abs(values[~absent]).max(initial=0.0)) / 32767 or 1.0
        steps = np.where(absent, ABSENT, np.rint(np.where(absent, 0.0, values) / step)).astype(np.int64)
        document["series"][name] = {"scale": step, "data": _deflated(steps, np.int16)}
    return json.dumps(document, separators=(",", ":"))


def _deflated(integers, kind):
    # differences wrap round as the integers of the page do when it sums them up again
    steps = np.diff(integers, prepend=0).astype(kind)
    return base64.b64encode(zlib.compress(steps.astype(np.dtype(kind).newbyteorder("<")).tobytes(), 9)).decode()
