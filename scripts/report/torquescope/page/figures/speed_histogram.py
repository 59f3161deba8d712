"""Which speeds does the recording hold? Empty places are speeds of which the fit knows nothing."""

import numpy as np

from .. import quantities, readings, style
from . import Case


def draw(velocity, unit, width=style.SMALL):
    """velocity [n]."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 14, 196)
    limit = float(np.abs(velocity).max()) or 1.0
    heights, edges = np.histogram(velocity, bins=41, range=(-limit, limit))
    axes.stairs(100 * heights / len(velocity), edges, fill=True, color=style.LIGHT["measured"], label="samples")
    axes.axvline(0, color=style.LIGHT["muted"], linewidth=1)
    axes.set(xlim=(-limit, limit), ylim=(0, None), xlabel=f"velocity ({unit})")
    readings.of(axes, ("velocity", unit), ("share of the samples", "%"))
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 5)
    style.few_ticks(axes.yaxis, 4)
    canvas.text(0, 16, "share of the samples (%)")
    return canvas.figure


def cases(study):
    data = study.train
    return {
        "speed_histogram": Case(
            draw,
            {"velocity": np.asarray(data.velocity), "unit": quantities.unit(data.unit_of("velocity"))},
            "Which speeds were recorded?",
            "Empty places are speeds of which the fit knows nothing.",
        )
    }
