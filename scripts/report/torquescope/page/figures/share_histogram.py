"""How cases spread between nothing and all: overlap of regions, gap closed; with the median and the pass level."""

import numpy as np

from .. import quantities, style
from . import Case


def draw(values, pass_level, label, low, width=style.SMALL):
    """values [n] as fractions; those below `low` are drawn in its cell."""
    canvas = style.Canvas(width, 246)
    axes = canvas.axes(44, 30, width - 14, 200)
    shares = 100 * np.clip(np.asarray(values, dtype=float), low, 1.0)
    axes.hist(shares, bins=np.linspace(100 * low, 100, 21), color=style.LIGHT["measured"])
    axes.axvline(100 * pass_level, color=style.LIGHT["muted"], linewidth=1.4, linestyle=(0, (4, 3)))
    axes.axvline(100 * float(np.clip(np.median(values), low, 1.0)), color=style.LIGHT["fade"], linewidth=2.4)
    axes.set(xlim=(100 * low, 100), xlabel=label)
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 5)
    style.few_ticks(axes.yaxis, 4)
    axes.yaxis.get_major_locator().set_params(integer=True)
    canvas.text(0, 16, "cases")
    return canvas.figure


def cases(board):
    found, ours = {}, board.ours
    if ours["iou"]:
        said = (f"{quantities.count(len(ours['iou']), 'effect')} found: rows both regions hold over rows either holds. "
                "Line: median; dashed: pass level, 60 %.")
        found["region_iou"] = Case(
            draw,
            {"values": ours["iou"], "pass_level": 0.60, "label": "overlap of the regions (%)", "low": 0.0},
            "Was the place right?",
            said,
        )
    if ours["gap_closed"]:
        said = (
            f"Validation recording, {quantities.count(len(ours['gap_closed']), 'case')} of SNR 1 or more, 100 %: as "
            "good as the true "
            "model. What is not found closes nothing; what is worse than −20 % stands there. Line: median; dashed: "
            "pass level, 80 %."
        )
        found["gap_closed"] = Case(
            draw,
            {"values": ours["gap_closed"], "pass_level": 0.80, "label": "gap to the oracle closed (%)", "low": -0.2},
            "Is the model better where it counts?",
            said,
        )
    return found
