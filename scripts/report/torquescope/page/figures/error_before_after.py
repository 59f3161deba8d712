"""The relative error before and after, in training, in blocked cross-validation and validation; from zero."""

import numpy as np

from .. import diagnosed, quantities, readings, style
from . import Case

ROW, NARROW_ROW = 34, 44


def draw(rows, width=style.WIDE):
    """rows: [(label, before, after)] as fractions, NaN where not measured."""
    narrow = width < style.WIDE
    row = NARROW_ROW if narrow else ROW
    left, right = (14 if narrow else 150), width - (14 if narrow else 170)
    bottom = 8 + row * len(rows)
    canvas = style.Canvas(width, bottom + 46)
    axes = canvas.axes(left, 4, right, bottom)
    readings.of(axes, ("relative error", "%"), ("", ""), zoom="x")
    for index, (label, before, after) in enumerate(rows):
        y = -index - (0.15 if narrow else 0)
        for value, when in ((before, "before"), (after, "after")):
            if np.isfinite(value):
                readings.note(axes, f"{label}, {when}: {quantities.percent(value, 3)}", at=(100 * value, y))
        if np.isfinite(after):
            axes.plot([100 * before, 100 * after], [y, y], color=style.LIGHT["measured"], linewidth=2.4, zorder=2)
            axes.plot(100 * after, y, marker="o", markersize=9, color=style.LIGHT["augmented"], zorder=4,
                      linestyle="none", label="_after")
        axes.plot(100 * before, y, marker="o", markersize=9, color=style.LIGHT["baseline"], zorder=3, linestyle="none",
                  label="_before")
        # on a phone the words stand above their dots
        line = 4 + (bottom - 4) * (index + (0 if narrow else 0.5)) / len(rows) + (12 if narrow else 4)
        canvas.text(0, line, label, color=style.LIGHT["ink"])
        words = quantities.percent(before, 3) + (f" → {quantities.percent(after, 3)}" if np.isfinite(after) else "")
        canvas.text(width, line, words, ha="right", color=style.LIGHT["ink"], fontweight="bold")
    largest = 100 * np.nanmax([value for _, *values in rows for value in values])
    axes.set(xlim=(0, 1.06 * largest), ylim=(-len(rows) + 0.5, 0.5), yticks=[])
    axes.set_xlabel("relative error (%)" if narrow else "relative error (% of the measured signal)", labelpad=3)
    style.few_ticks(axes.xaxis, 4 if narrow else 8)
    return canvas.figure


def rows_of(joint):
    """[(label, before, after)] of what was measured."""
    changed = diagnosed.has_after(joint)
    rows = [("train", joint.train_relerr, joint.augmented_train_relerr),
            ("blocked CV", joint.cv_relerr, joint.augmented_cv_relerr),
            ("validation", joint.validation_relerr, joint.augmented_validation_relerr)]
    return [(label, before, after if changed else np.nan) for label, before, after in rows if np.isfinite(before)]


def cases(study):
    return {diagnosed.figure_name(study, joint, "error_before_after"): _case(rows_of(joint))
            for joint in study.diagnosis.joints if rows_of(joint)}


def _case(rows):
    validation = any(label == "validation" for label, *_ in rows)
    return Case(
        draw,
        {"rows": rows},
        "Error in training and validation" if validation else "Error in training",
        "Norm of the residual over norm of the measured signal.",
        wide=True,
    )
