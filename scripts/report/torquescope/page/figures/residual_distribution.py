"""How large are the errors? Histogram of the residual with the normal curve of the same standard deviation."""

import numpy as np

from .. import quantities, readings, residuals, style
from . import Case


def draw(residual, unit, width=style.SMALL):
    """residual [n]."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 14, 196)
    deviation = float(residual.std()) or 1.0
    limit = min(float(np.abs(residual).max()), 5 * deviation) or 1.0
    heights, edges = np.histogram(residual, bins=41, range=(-limit, limit))
    share = 100 * heights / len(residual)
    axes.stairs(share, edges, fill=True, color=style.LIGHT["measured"], label="residual")
    x = np.linspace(-limit, limit, 121)
    normal = np.exp(-((x - residual.mean()) ** 2) / (2 * deviation**2)) / (deviation * np.sqrt(2 * np.pi))
    axes.plot(x, 100 * normal * (edges[1] - edges[0]), color=style.LIGHT["ink"], linewidth=2,
              label="normal curve")
    axes.set(xlim=(-limit, limit), ylim=(0, None), xlabel=f"residual ({unit})")
    readings.of(axes, ("residual", unit), ("share of the samples", "%"))
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 5)
    style.few_ticks(axes.yaxis, 4)
    canvas.text(0, 16, "share of the samples (%)")
    return canvas.figure


def cases(study):
    found = residuals.of_training(study)
    if found is None:
        return {}
    return {
        "residual_distribution": Case(
            draw,
            {"residual": found.left, "unit": quantities.unit(study.effort_unit)},
            "How large are the errors?",
            f"Histogram of {found.words}; the line is the normal curve of the same standard deviation."
            + ("" if found.is_simulated else " Heavy tails ask for a robust loss."),
        )
    }
