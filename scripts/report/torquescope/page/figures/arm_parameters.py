"""Every parameter of an arm as a difference from what it is known to be, in standard errors; the band holds 95 %."""

import numpy as np

from .. import quantities, readings, style, words
from . import Case

ROW = 20


def draw(names, differences, origin, label, width=style.WIDE):
    """differences [n]: estimate minus known value, in standard errors."""
    canvas = style.Canvas(width, 14 + ROW * len(names) + 46)
    left, right, bottom = 110, width - 14, 14 + ROW * len(names)
    axes = canvas.axes(left, 6, right, bottom)
    axes.axvspan(-words.Z95, words.Z95, color=style.LIGHT["floor"], linewidth=0, zorder=0.5)
    axes.axvline(0, color=style.LIGHT["muted"], linewidth=1)
    readings.of(axes, (f"minus {origin}", "standard errors"), ("", ""), zoom="x")
    at = np.arange(len(names))
    for name, difference, y in zip(names, differences, at):
        words_read = f"{name}: {quantities.fixed(difference, 2)} standard errors from {origin}"
        readings.note(axes, words_read, at=(difference, y))
    axes.hlines(at, 0, differences, color=style.LIGHT["measured"], linewidth=2)
    axes.plot(differences, at, marker="o", markersize=6, linestyle="none", color=style.LIGHT["ink"])
    reach = 1.1 * max(float(np.abs(differences).max()), 2 * words.Z95)
    axes.set(xlim=(-reach, reach), ylim=(len(names) - 0.5, -0.5), yticks=[])
    narrow = width < style.WIDE
    axes.set_xlabel(f"{label} minus {origin}, standard errors" if not narrow else f"minus {origin}, std errors",
                    labelpad=3)
    style.few_ticks(axes.xaxis, 5 if narrow else 9)
    for index, name in enumerate(names):
        canvas.text(0, 6 + (bottom - 6) * (index + 0.5) / len(names) + 4, style.fit(name, left - 8),
                    color=style.LIGHT["ink"])
    return canvas.figure


def cases(study):
    e = study.arm.reference(study)
    known, origin = study.arm.known_values(study)
    if known is None or e.standard_error is None:
        return {}
    differences = (e.chosen - known) / e.standard_error[0]
    told = np.flatnonzero(np.isfinite(differences))
    if not len(told):
        return {}
    arguments = {"names": [study.model.names[k] for k in told], "differences": differences[told],
                 "origin": f"the {origin}", "label": e.short}
    sentence = f"Grey: where 95 % of them belong if the {origin} is right and the errors are what {e.short} says."
    return {"arm_parameters": Case(draw, arguments, f"Against the {origin}", sentence, wide=True)}
