"""What the model leaves over the speed: a wrong friction model shows as a shape here."""

import numpy as np

from .. import quantities, readings, residuals, style
from . import Case

BINS = 24


def draw(velocity, residual, velocity_unit, unit, colour=style.LIGHT["ink"], width=style.SMALL):
    """velocity, residual [n]; drawn: mean and mean square spread of equally filled bins."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 14, 196)
    edges = np.unique(np.quantile(velocity, np.linspace(0, 1, BINS + 1)))
    which = np.clip(np.searchsorted(edges, velocity, "right") - 1, 0, len(edges) - 2)
    number = np.maximum(np.bincount(which, minlength=len(edges) - 1), 1)
    mean = np.bincount(which, residual, len(edges) - 1) / number
    spread = np.sqrt(np.maximum(np.bincount(which, residual**2, len(edges) - 1) / number - mean**2, 0))
    centre = np.bincount(which, velocity, len(edges) - 1) / number
    axes.fill_between(centre, mean - spread, mean + spread, color=style.LIGHT["floor"], linewidth=0,
                      label="±1 standard deviation")
    axes.axhline(0, color=style.LIGHT["muted"], linewidth=1)
    axes.plot(centre, mean, color=colour, linewidth=1.4, marker="o", markersize=4.5, label="mean")
    limit = 1.1 * float((np.abs(mean) + spread).max()) or 1.0
    axes.set(xlim=(velocity.min(), velocity.max()), ylim=(-limit, limit), xlabel=f"velocity ({velocity_unit})")
    readings.of(axes, ("velocity", velocity_unit), ("residual", unit))
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 4)
    style.few_ticks(axes.yaxis, 5)
    canvas.text(0, 16, f"residual ({unit})")
    return canvas.figure


def cases(study):
    found = residuals.of_training(study)
    if found is None or found.velocity is None:
        return {}
    arguments = {"velocity": found.velocity, "residual": found.left, "unit": quantities.unit(study.effort_unit),
                 "velocity_unit": quantities.unit(study.train.unit_of("velocity"))}
    return {
        "residual_by_speed": Case(
            draw,
            arguments,
            "Does the residual depend on speed?",
            f"Mean of {found.words}, in bins of equally many samples; grey: ±1 standard deviation. A shape here is "
            "friction the model lacks.",
        )
    }
