"""How long does a diagnosis take?"""

import numpy as np

from .. import quantities, style
from . import Case


def draw(seconds, width=style.SMALL):
    """seconds [n]."""
    canvas = style.Canvas(width, 246)
    axes = canvas.axes(44, 30, width - 14, 200)
    # durations differ by their ratio: equal cells of the logarithm
    low, high = np.log10(max(min(seconds), 1e-3)) - 0.05, np.log10(max(seconds)) + 0.05
    axes.hist(np.log10(np.maximum(seconds, 1e-3)), bins=np.linspace(low, high, 25), color=style.LIGHT["measured"])
    axes.axvline(np.log10(max(np.median(seconds), 1e-3)), color=style.LIGHT["fade"], linewidth=2.4)
    ticks = [value for value in (0.1, 0.3, 1, 3, 10, 30, 100, 300, 1000) if low <= np.log10(value) <= high]
    axes.set_xticks(np.log10(ticks) if ticks else [], [quantities.tick(value) for value in ticks])
    axes.set(xlim=(low, high), xlabel="time of a diagnosis (s)")
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.yaxis, 4)
    canvas.text(0, 16, "cases")
    return canvas.figure


def cases(board):
    seconds = board.ours["runtime"]["seconds"]
    if not seconds:
        return {}
    return {
        "diagnosis_seconds": Case(
            draw,
            {"seconds": seconds},
            "How long does it take?",
            f"{quantities.count(len(seconds), 'diagnosis', 'diagnoses')}, {quantities.seconds(sum(seconds))} together; "
            "line: median. Wall time, beside whatever else the machine was doing.",
        )
    }
