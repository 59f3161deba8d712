"""Relative error of every estimator on the training and on the validation recording; the axis starts at zero."""

import numpy as np

from .. import quantities, readings, style
from . import Case

ROW, NARROW_ROW = 34, 44


def draw(rows, width=style.WIDE):
    """rows: [(label, train, validation, colour)] as fractions; validation NaN when there is none."""
    narrow = width < style.WIDE
    row = NARROW_ROW if narrow else ROW
    canvas = style.Canvas(width, 34 + row * len(rows) + 46)
    left = 14 if narrow else 150
    bottom = 34 + row * len(rows)
    axes = canvas.axes(left, 26, width - (14 if narrow else 150), bottom)
    readings.of(axes, ("relative error", "%"), ("", ""), zoom="x")
    largest = 100 * max(np.nanmax([train, validation]) for _, train, validation, _ in rows)
    for index, (label, train, validation, colour) in enumerate(rows):
        y = -index - (0.15 if narrow else 0)
        for value, where in ((train, "training"), (validation, "validation")):
            if np.isfinite(value):
                readings.note(axes, f"{label}, {where}: {quantities.percent(value, 3)}", at=(100 * value, y))
        if np.isfinite(validation):
            axes.plot([100 * train, 100 * validation], [y, y], color=style.LIGHT["measured"], linewidth=2.4, zorder=2)
            axes.plot(100 * validation, y, marker="o", markersize=9, color=colour, zorder=4)
        axes.plot(100 * train, y, marker="o", markersize=9, color=colour, markerfacecolor=style.LIGHT["background"],
                  markeredgewidth=2, zorder=3)
        # on a phone the words stand above their dots
        line = 26 + (bottom - 26) * (index + (0 if narrow else 0.5)) / len(rows) + (12 if narrow else 4)
        canvas.text(0, line, style.fit(label, 200 if narrow else left - 12), color=style.LIGHT["ink"])
        words = f"{quantities.percent(train, 3)}"
        if np.isfinite(validation):
            words += f" → {quantities.percent(validation, 3)}"
        canvas.text(width, line, words, ha="right", color=style.LIGHT["ink"], fontweight="bold")
    axes.set(xlim=(0, 1.06 * largest), ylim=(-len(rows) + 0.5, 0.5), yticks=[])
    axes.set_xlabel(f"relative error (% of {'the signal' if narrow else 'the measured signal'})", labelpad=3)
    style.few_ticks(axes.xaxis, 4 if narrow else 8)
    canvas.text(0 if narrow else left, 16, "○ training   ● validation")
    return canvas.figure


def cases(study):
    if study.validate is None:
        return {}
    rows = [(e.short, e.relerr_median, e.validation_relerr_median, e.ink) for e in study.estimators
            if np.isfinite(e.relerr_median)]  # a simulation may have run away
    if not rows:
        return {}
    sentence = "Norm of the residual over norm of the measured signal; the median run of each search."
    if study.rolled:
        sentence += f" Of {quantities.listed(e.short for e in study.rolled)}: of all samples, simulated."
    return {"relative_error": Case(draw, {"rows": rows}, "Training and validation", sentence, wide=True)}
