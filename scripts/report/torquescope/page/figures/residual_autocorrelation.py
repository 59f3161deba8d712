"""Is the residual white? Its autocorrelation over the lag, with the band that white noise would keep to."""

import numpy as np

from .. import readings, residuals, style
from . import Case


def draw(residual, stretch, step_s, colour=style.LIGHT["ink"], width=style.SMALL):
    """residual [n] of samples step_s apart; stretch [n]: products do not reach across a seam."""
    lags = min(60, len(residual) // 4)
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 14, 196)
    centred = residual - residual.mean()
    power = float(centred @ centred)
    values = np.array(
        [1.0]
        + [
            float((centred[lag:] * centred[:-lag])[stretch[lag:] == stretch[:-lag]].sum()) / power
            for lag in range(1, lags + 1)
        ]
    )
    white = 1.96 / np.sqrt(len(residual))
    axes.axhspan(-white, white, color=style.LIGHT["floor"], linewidth=0, zorder=0.5, label="white noise, 95 %")
    at = np.arange(lags + 1) * step_s
    axes.vlines(at, 0, values, color=colour, linewidth=2, label="residual")
    axes.set(xlim=(-0.5 * step_s, at[-1] + 0.5 * step_s), ylim=(min(-0.1, 1.1 * values.min()), 1.02), xlabel="lag (s)")
    readings.of(axes, ("lag", "s"), ("autocorrelation", ""))
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 4)
    style.few_ticks(axes.yaxis, 5)
    canvas.text(0, 16, "autocorrelation (1)")
    return canvas.figure


def cases(study):
    found = residuals.of_training(study)
    if found is None or not np.isfinite(found.step_s):
        return {}
    arguments = {"residual": found.left, "stretch": found.stretch, "step_s": found.step_s, "colour": style.LIGHT["ink"]}
    return {
        "residual_autocorrelation": Case(
            draw,
            arguments,
            "Is the residual white?",
            f"Autocorrelation of {found.words}. Grey: what white noise would stay in, 95 %."
            + ("" if found.is_simulated else " Above it, naive intervals are too narrow."),
        )
    }
