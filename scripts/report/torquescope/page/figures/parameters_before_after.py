"""Forest plot: every parameter before and after, as a difference from the truth or from the baseline's value."""

import math

import numpy as np

from .. import diagnosed, quantities, readings, style
from . import Case

WHEN = {"baseline": "before", "augmented": "after"}
MOST = 100.0  # %: beyond it an arrow says "further out"


def draw(names, before, after, origin, values, width=style.WIDE):
    """before, after: [(difference, half interval) in %], NaN where there is none; origin: what the differences are
    taken from; values: words at the right."""
    narrow = width < style.WIDE
    row, room = (58, 18) if narrow else (40, 0)
    top = 8
    bottom = top + row * len(names)
    canvas = style.Canvas(width, bottom + 48)
    left, right = (16, width - 16) if narrow else (190, width - 260)
    axes = canvas.axes(left, top, right, bottom)
    reach = _reach(before, after)
    readings.of(axes, (f"difference from {origin}", "%"), ("", ""), zoom="x")
    for index in range(len(names)):
        middle = row * index + room + (row - room) / 2
        both = np.isfinite(before[index][0]) and np.isfinite(after[index][0])
        for (at, half), colour, shift in ((before[index], "baseline", -6), (after[index], "augmented", 6)):
            y, when = middle + (shift if both else 0), WHEN[colour]
            _interval(axes, at, half, y, reach, colour)
            if np.isfinite(at):
                words = quantities.fixed(at, 1) + (f" ± {quantities.fixed(half, 1)}" if np.isfinite(half) else "")
                readings.note(axes, f"{names[index]}, {when}: {words} % from {origin}",
                              at=(float(np.clip(at, -reach, reach)), y))
    axes.axvline(0, color=style.LIGHT["muted"], linewidth=1.2, zorder=1)
    axes.set(xlim=(-1.05 * reach, 1.05 * reach), ylim=(row * len(names), 0), yticks=[])
    axes.set_xlabel(f"difference from {origin} (%)", labelpad=4)
    axes.grid(axis="y", visible=False)
    style.few_ticks(axes.xaxis, 5 if narrow else 9)
    for index, (name, value) in enumerate(zip(names, values)):
        line = top + row * index + (14 if narrow else row / 2 + 4)
        canvas.text(0, line, style.fit(name, 150 if narrow else 180), color=style.LIGHT["ink"])
        canvas.text(width, line, value, ha="right", color=style.LIGHT["ink"], fontweight="bold")
    for index in range(1, len(names)):
        axes.axhline(row * index, color=style.LIGHT["grid"], linewidth=1)
    return canvas.figure


def _reach(before, after):
    ends = [abs(at) + (half if np.isfinite(half) else 0.0) for at, half in [*before, *after] if np.isfinite(at)]
    return min(max([*ends, 1e-6]), MOST)


def _interval(axes, at, half, y, reach, colour):
    if not np.isfinite(at):
        return
    colour, label = style.LIGHT[colour], f"_{WHEN[colour]}"
    low, high = (at - half, at + half) if np.isfinite(half) else (at, at)
    axes.plot([max(low, -reach), min(high, reach)], [y, y], color=colour, linewidth=2.6, solid_capstyle="butt",
              label=label)
    for beyond, end, marker in ((low < -1.001 * reach, -reach, "<"), (high > 1.001 * reach, reach, ">")):
        if beyond:
            axes.plot(end, y, marker=marker, markersize=7, color=colour, linestyle="none", label=label)
    if abs(at) <= reach:
        axes.plot(at, y, marker="o", markersize=7, color=colour, linestyle="none", label=label)


def value_words(one):
    """'0.354 ± 0.012 N m'."""
    half = one.half_interval
    decimals = quantities.decimals_for(half, one.value)
    text = quantities.fixed(one.value, decimals) + (
        f" ± {quantities.fixed(half, decimals)}" if math.isfinite(half) else ""
    )
    return quantities.with_unit(text, one.unit)


def differences(joint, truth):
    """(names, before, after) in % of the truth where it is known, else of the baseline's value, else of the parameter
    itself."""
    changed = diagnosed.has_after(joint)
    names = list({**joint.baseline, **(joint.augmented if changed else {})})
    before, after = [], []
    for name in names:
        old, new = joint.baseline.get(name), joint.augmented.get(name) if changed else None
        known = truth.get(name, math.nan)
        origin = known if math.isfinite(known) else (old or new).value
        size = abs(origin) / 100 or math.nan
        for side, one in ((before, old), (after, new)):
            side.append(((one.value - origin) / size, one.half_interval / size) if one else (math.nan, math.nan))
    return names, before, after


def cases(study):
    truth = dict(zip(study.model.names, study.model.truth)) if study.truth_known else {}
    found = {}
    for joint in study.diagnosis.joints:
        names, before, after = differences(joint, truth)
        if not names:
            continue
        words = [
            value_words(
                (joint.augmented if diagnosed.has_after(joint) and name in joint.augmented else joint.baseline)[name]
            )
            for name in names
        ]
        arguments = {"names": [diagnosed.plain(name) for name in names], "before": before, "after": after,
                     "origin": "the truth" if truth else "the baseline", "values": words}
        sentence = "Bars: 95 % intervals"
        if any(name not in joint.baseline for name in names):
            sentence += "; a parameter that the baseline lacks stands at its own value"
        ends = [abs(at) + half for at, half in [*before, *after] if np.isfinite(at + half)]
        sentence += f"; an arrow: beyond {MOST:.0f} %." if ends and max(ends) > MOST else "."
        found[diagnosed.figure_name(study, joint, "parameters_before_after")] = Case(
            draw,
            arguments,
            "Parameters before and after" if diagnosed.has_after(joint) else "Parameters of the baseline",
            sentence,
            wide=True,
        )
    return found
