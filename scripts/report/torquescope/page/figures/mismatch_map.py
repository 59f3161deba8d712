"""Where the model is wrong: one row per axis, colour = mean residual over the spread of the replicates there."""

import numpy as np
from matplotlib.patches import Rectangle

from .. import diagnosed, quantities, readings, style
from . import Case
from .decision_surface import cells

LIMITS = (2.5, 5.0, 10.0, 20.0)  # spreads of the replicates from which on a step is drawn; below the first lies chance
AXIS_KEYS = {
    "since reversal": "Since reversal: how far the joint went since its motion, or its torque, last changed sign.",
    "order": "Order of angle: waves in a turn of the joint.",
}
NARROW_CELLS = 22
ROW, LABEL = 20, 16
BOLD_EM = 1.15 * style.EM


def draw(rows, width=style.WIDE):
    """rows: [(name, range, is_spectrum, edges [n+1], z [n] with NaN where nothing was measured, share or NaN, frames,
    unit)], frames: [(from, to, label or "", "effect" or "unexplained" or "region")] in the unit of the edges."""
    narrow = width < style.WIDE
    left, right = (2, width - 2) if narrow else (300, 920)
    lines = [_Line(row, narrow) for row in rows]
    canvas = style.Canvas(width, 26 + sum(line.height for line in lines) + (76 if narrow else 40))
    if not narrow:
        canvas.text(width, 14, "residual beyond the replicates", ha="right")
    top, longest = 26, max([0.01] + [line.share for line in lines if np.isfinite(line.share)])
    for line in lines:
        top += line.height
        _draw_row(canvas, line, left, right, top - 8, narrow)
        _draw_share(canvas, line, longest, top - 8, narrow)
    _legend(canvas, top + 4, narrow)
    return canvas.figure


class _Line:
    def __init__(self, row, narrow):
        self.name, self.range, self.is_spectrum, self.edges, self.z, self.share, self.frames, self.unit = row
        self.labels = any(label for _, _, label, _ in self.frames)
        self.height = ROW + 8 + (LABEL if self.labels else 0) + (18 if narrow else 0)
        self.level = _levels(self.z)
        if self.is_spectrum:
            self.level = np.where(np.isnan(self.level), np.nan, np.maximum(self.level, 0))
        self.bounds = np.arange(len(self.level) + 1)
        if narrow:
            # each cell of the phone shows the strongest of those it stands for, at their place
            self.bounds = np.unique(
                np.linspace(0, len(self.level), min(NARROW_CELLS, len(self.level)) + 1).round().astype(int)
            )
            self.level = np.array([_strongest(self.level[a:b]) for a, b in zip(self.bounds[:-1], self.bounds[1:])])


def _cell_words(line, first, stop):
    """What one drawn cell holds: the strongest of those it stands for."""
    place = diagnosed.range_words(line.edges[first], line.edges[stop], line.unit)
    z = _strongest(np.asarray(line.z[first:stop], dtype=float))
    if not np.isfinite(z):
        return f"{line.name} {place}: nothing measured"
    way = "" if line.is_spectrum or abs(z) < LIMITS[0] else f", model asks too {'little' if z > 0 else 'much'}"
    return f"{line.name} {place}: {quantities.fixed(z, 1)} spreads of the replicates{way}"


def _levels(z):
    level = np.sign(z) * np.searchsorted(LIMITS, np.abs(np.nan_to_num(z)), "right")
    return np.where(np.isfinite(z), level, np.nan)


def _strongest(levels):
    known = levels[np.isfinite(levels)]
    return known[np.argmax(np.abs(known))] if len(known) else np.nan


def _colour(level, is_spectrum):
    if level == 0:
        return style.LIGHT["quiet"]
    return style.LIGHT[f"{'weak' if is_spectrum else 'little' if level > 0 else 'much'}{int(abs(level))}"]


def _draw_row(canvas, line, left, right, bottom, narrow):
    axes = canvas.axes(left, bottom - ROW, right, bottom)
    axes.set_axis_off()
    axes.set(xlim=(0, line.bounds[-1]), ylim=(0, 1))
    readings.of(axes, ("", ""), ("", ""), zoom="")
    for first, stop in zip(line.bounds[:-1], line.bounds[1:]):
        readings.note(axes, _cell_words(line, first, stop), cell=(first, stop, 0, 1))
    for level in range(-4, 5):
        cells(axes, (line.level == level)[:, None], line.bounds, np.array([0, 1]), _colour(level, line.is_spectrum))
    place = lambda x: np.interp(x, line.edges, np.linspace(left, right, len(line.edges)))  # noqa: E731
    for start, stop, _, kind in sorted(line.frames, key=lambda frame: frame[3] == "effect"):
        _frame(canvas, place(start), place(stop), bottom, kind)
    _labels(canvas, [(place(start), place(stop), label) for start, stop, label, _ in line.frames if label],
            left, right, bottom - ROW - 6)
    if narrow:
        at = bottom - ROW - (LABEL if line.labels else 0) - 6
        canvas.text(0, at, f"{line.name}, {line.range}", color=style.LIGHT["ink"])
    else:
        canvas.text(0, bottom - 6, line.name, color=style.LIGHT["ink"])
        canvas.text(left - 12, bottom - 6, line.range, ha="right")


def _frame(canvas, left, right, bottom, kind):
    thickness = 2.2 if kind == "effect" else 1.2
    # wide enough to be seen, however narrow the region
    left, right = (left, right) if right - left >= 8 else ((left + right) / 2 - 4, (left + right) / 2 + 4)
    # a light line under the dark one: seen on every step
    for colour, width, dashes in (("background", thickness + 2, "solid"),
                                  ("ink", thickness, (0, (4, 2)) if kind == "unexplained" else "solid")):
        canvas.figure.add_artist(
            Rectangle(
                (left / canvas.width, 1 - (bottom + 2) / canvas.height),
                (right - left) / canvas.width,
                (ROW + 4) / canvas.height,
                fill=False,
                edgecolor=style.LIGHT[colour],
                linewidth=width,
                linestyle=dashes,
                transform=canvas.figure.transFigure,
            )
        )


def _labels(canvas, frames, left, right, baseline):
    """Names above their frames; neighbours without room share one line of text."""
    groups = []
    for start, stop, label in sorted(frames):
        group = _label((start + stop) / 2, [label], left, right)
        if groups and group[0] < groups[-1][1]:
            first, last, words = groups.pop()
            group = _label((first + max(last, group[1])) / 2, list(dict.fromkeys([*words, label])), left, right)
        groups.append(group)
    for start, stop, words in groups:
        canvas.text(
            (start + stop) / 2,
            baseline,
            _written(words, right - left),
            ha="center",
            fontweight="bold",
            color=style.LIGHT["ink"],
        )


def _label(centre, words, left, right):
    """(left edge, right edge, words) of a label about a place, moved inside [left, right]."""
    half = BOLD_EM * len(_written(words, right - left)) / 2 + 6
    centre = min(max(centre, left + half), right - half)
    return centre - half, centre + half, words


def _written(words, room):
    """All the names, or the first one and how many more."""
    everything = ", ".join(words)
    if BOLD_EM * len(everything) + 12 <= room or len(words) == 1:
        return style.fit(everything, room - 12)
    return f"{style.fit(words[0], room - 100)} and {len(words) - 1} more"


def _draw_share(canvas, line, longest, bottom, narrow):
    if not np.isfinite(line.share):
        return
    baseline = bottom - ROW - (LABEL if line.labels else 0) - 6 if narrow else bottom - 6
    canvas.text(
        canvas.width, baseline, quantities.percent(line.share), ha="right", color=style.LIGHT["ink"], fontweight="bold"
    )
    if not narrow:
        bar = canvas.axes(940, bottom - ROW + 5, 1020, bottom - 5)
        bar.set_axis_off()
        bar.set(xlim=(0, longest), ylim=(0, 1))
        bar.barh(0.5, line.share, 1, color=style.LIGHT["ink"])


def _legend(canvas, top, narrow):
    step = 22 if narrow else 28
    left = 76 if narrow else 430
    canvas.text(left - 8, top + 12, "too much" if narrow else "model asks too much", ha="right")
    _swatches(canvas, left, top + 1, [_colour(level, False) for level in range(-4, 5)], step)
    canvas.text(left + 9 * step + 8, top + 12, "too little")
    limits = [quantities.tick(limit) for limit in LIMITS]
    for k, limit in enumerate([*reversed(limits), *limits], start=1):
        canvas.text(left + k * step, top + 28, limit, ha="center", fontsize=10.5)
    canvas.text(left - 8, top + 28, "spreads" if narrow else "spreads of the replicates", ha="right")
    # spectra have one side only: more than the replicates
    left, top = (174, top + 38) if narrow else (938, top)
    canvas.text(left - 8, top + 12, "spectra: beyond" if narrow else "spectra: beyond the replicates", ha="right")
    _swatches(canvas, left, top + 1, [_colour(level, True) for level in range(5)], step)
    for k, limit in enumerate(limits, start=1):
        canvas.text(left + k * step, top + 28, limit, ha="center", fontsize=10.5)


def _swatches(canvas, left, top, colours, size):
    axes = canvas.axes(left, top, left + size * len(colours), top + 14)
    axes.set_axis_off()
    axes.set(xlim=(0, len(colours)), ylim=(0, 1))
    for k, colour in enumerate(colours):
        cells(axes, np.array([[True]]), np.array([k, k + 1]), np.array([0, 1]), colour)


def cases(study):
    found = {}
    for joint in study.diagnosis.joints:
        rows = [_arguments(joint, row) for row in diagnosed.rows_drawn(joint)]
        if rows:
            name = diagnosed.figure_name(study, joint, "mismatch_map")
            sentence = (
                f"Mean residual of the baseline along each axis, in spreads of {quantities.whole(joint.twins)} "
                "replicates; grey: no more than chance; blank: nothing measured; framed: located."
                + _axis_keys(rows)
            )
            found[name] = Case(draw, {"rows": rows}, "The mismatch map", sentence, wide=True)
        if study.diagnosis.verdict == "partly" and (left := _left(joint)):
            name = diagnosed.figure_name(study, joint, "mismatch_left")
            sentence = (
                "The same with everything named in the model: what the names do not explain; framed: where it stands "
                "out."
            )
            found[name] = Case(draw, {"rows": left}, "What is left", sentence, wide=True)
    return found


def _axis_keys(rows):
    """What the axes are that are no recorded channel."""
    names = [name for name, *_ in rows]
    said = [text for name, text in AXIS_KEYS.items() if any(one.startswith(name) for one in names)]
    return " " + " ".join(said) if said else ""


def _left(joint):
    """Rows of the map with the effects in the model; none where that was not measured."""
    rows = [row for row in diagnosed.rows_drawn(joint) if np.isfinite(row.after_z).any()]
    return [_row(row, row.after_z, _share_left(joint, row), _frames_left(joint, row)) for row in rows]


def _share_left(joint, row):
    return max((share for where, share in joint.unexplained if where.axis == row.axis), default=np.nan)


def _frames_left(joint, row):
    return [
        (where.start, where.stop, "unexplained", "unexplained")
        for where, _ in joint.unexplained
        if where.axis == row.axis
    ]


def _arguments(joint, row):
    frames = [(place.start, place.stop, diagnosed.effect_words(e), "effect")
              for e in joint.effects for place in e.places if place.axis == row.axis]
    frames += _frames_left(joint, row)
    known = {(start, stop) for start, stop, *_ in frames}
    frames += [
        (r.where.start, r.where.stop, "", "region") for r in row.regions if (r.where.start, r.where.stop) not in known
    ]
    return _row(row, row.z, row.energy_share, frames)


def _row(row, z, share, frames):
    """As draw() takes it."""
    z = np.where(np.asarray(row.samples) > 0, z, np.nan)
    edges = np.append(row.start, row.stop[-1])
    return (
        diagnosed.axis_title(row.axis),
        diagnosed.range_words(edges[0], edges[-1], diagnosed.axis_unit(row)),
        row.is_spectrum,
        edges,
        z,
        share,
        frames,
        diagnosed.axis_unit(row),
    )
