"""Where the model is wrong: one row per axis, colour = mean residual over the spread of the clean twins there."""

import numpy as np
from matplotlib.patches import Rectangle

import diagnosed
import quantities
import style
from figures import Case
from figures.decision_surface import cells

LIMITS = (2.5, 5.0, 10.0, 20.0)  # spreads of the twins from which on a step is drawn; below the first lies chance
NARROW_CELLS = 22
ROW, LABEL = 20, 16


def draw(rows, width=style.WIDE):
    """rows: [(name, range, is_spectrum, edges [n+1], z [n] with NaN where nothing was measured, share or NaN, frames)],
    frames: [(from, to, label or "", "effect" or "unexplained" or "region")] in the unit of the edges."""
    narrow = width < style.WIDE
    left, right = (2, width - 2) if narrow else (300, 920)
    lines = [_Line(row, narrow) for row in rows]
    canvas = style.Canvas(width, 26 + sum(line.height for line in lines) + (74 if narrow else 50))
    if not narrow:
        canvas.text(width, 14, "share of the residual", ha="right")
    top, longest = 26, max([0.01] + [line.share for line in lines if np.isfinite(line.share)])
    for line in lines:
        top += line.height
        _draw_row(canvas, line, left, right, top - 8, narrow)
        _draw_share(canvas, line.share, longest, top - 8, narrow)
    _legend(canvas, top + 4, narrow)
    return canvas.figure


class _Line:
    def __init__(self, row, narrow):
        self.name, self.range, self.is_spectrum, self.edges, self.z, self.share, self.frames = row
        self.labels = any(label for _, _, label, _ in self.frames)
        self.height = ROW + 8 + (LABEL if self.labels else 0) + (18 if narrow else 0)
        self.level = _levels(self.z)
        if self.is_spectrum:
            self.level = np.where(np.isnan(self.level), np.nan, np.maximum(self.level, 0))
        if narrow:
            self.level = np.array([_strongest(part) for part in np.array_split(self.level, min(NARROW_CELLS, len(self.level)))])


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
    n = len(line.level)
    axes.set(xlim=(0, n), ylim=(0, 1))
    for level in range(-4, 5):
        cells(axes, (line.level == level)[:, None], np.arange(n + 1), np.array([0, 1]), _colour(level, line.is_spectrum))
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
    box = Rectangle((left / canvas.width, 1 - (bottom + 2) / canvas.height), (right - left) / canvas.width, (ROW + 4) / canvas.height,
                    fill=False, edgecolor=style.LIGHT["ink"], linewidth=thickness,
                    linestyle=(0, (4, 2)) if kind == "unexplained" else "solid", transform=canvas.figure.transFigure)
    canvas.figure.add_artist(box)


def _labels(canvas, frames, left, right, baseline):
    """Names above their frames; neighbours without room share one line of text."""
    groups = []
    for start, stop, label in sorted(frames):
        half = style.EM * len(label) / 2 + 8
        centre = min(max((start + stop) / 2, left + half), right - half)
        if groups and centre - half < groups[-1][1]:
            first, _, words = groups.pop()
            words = words if label in words else [*words, label]
            half = style.EM * len(", ".join(words)) / 2 + 8
            centre = min(max((first + centre + half) / 2, left + half), right - half)
            groups.append((centre - half, centre + half, words))
        else:
            groups.append((centre - half, centre + half, [label]))
    for start, stop, words in groups:
        canvas.text((start + stop) / 2, baseline, style.fit(", ".join(words), right - left), ha="center", fontweight="bold",
                    color=style.LIGHT["ink"])


def _draw_share(canvas, share, longest, bottom, narrow):
    if not np.isfinite(share):
        return
    line = bottom - 6 if not narrow else bottom - ROW - 6
    if narrow:
        # above the cells, at the right of the name; rows with a label keep it on the name's line
        return
    bar = canvas.axes(940, bottom - ROW + 5, 1020, bottom - 5)
    bar.set_axis_off()
    bar.set(xlim=(0, longest), ylim=(0, 1))
    bar.barh(0.5, share, 1, color=style.LIGHT["ink"])
    canvas.text(canvas.width, line, quantities.percent(share), ha="right", color=style.LIGHT["ink"], fontweight="bold")


def _legend(canvas, top, narrow):
    swatch = 18
    steps = [-4, -3, -2, -1, 0, 1, 2, 3, 4]
    at, first = (0, "too much") if narrow else (300, "model asks too much")
    words_width = style.EM * len(first)
    canvas.text(at, top + 12, first)
    _swatches(canvas, at + words_width, top + 1, [(_colour(step, False)) for step in steps], swatch)
    canvas.text(at + words_width + 9 * swatch + 8, top + 12, "too little" if narrow else "too little")
    numbers = ["20", "10", "5", "2.5", "2.5", "5", "10", "20"]
    for k, number in enumerate(numbers, start=1):
        canvas.text(at + words_width + k * swatch, top + 28, number, ha="center", fontsize=10.5)
    if narrow:
        at, line = 0, top + 40
    else:
        canvas.text(at + words_width + 9 * swatch + 8, top + 28, "spreads of the clean twins")
        at, line = at + words_width + 9 * swatch + 8 + 30 * style.EM, top
    words = "spectra: more than the twins"
    canvas.text(at, line + 12, words)
    _swatches(canvas, at + style.EM * len(words) - 6, line + 1, [_colour(step, True) for step in range(5)], swatch)


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
            sentence = (f"Mean residual of the baseline along each axis, in spreads of {quantities.whole(joint.twins)} clean twins; "
                        "grey: no more than chance; blank: nothing measured; framed: located.")
            found[name] = Case(draw, {"rows": rows}, "The mismatch map", sentence, wide=True)
    return found


def _arguments(joint, row):
    frames = [(e.region.start, e.region.stop, diagnosed.plain(e.name), "effect") for e in joint.effects if e.region.axis == row.axis]
    frames += [(where.start, where.stop, "unexplained", "unexplained") for where, _ in joint.unexplained if where.axis == row.axis]
    known = {(start, stop) for start, stop, *_ in frames}
    frames += [(r.where.start, r.where.stop, "", "region") for r in row.regions if (r.where.start, r.where.stop) not in known]
    z = np.where(np.asarray(row.samples) > 0, row.z, np.nan)
    edges = np.append(row.start, row.stop[-1])
    return (diagnosed.axis_title(row.axis), diagnosed.range_words(edges[0], edges[-1], diagnosed.axis_unit(row)), row.is_spectrum,
            edges, z, row.energy_share, frames)
