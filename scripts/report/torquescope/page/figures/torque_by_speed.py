"""Torque over speed, how often each place was visited in nine steps, and the share of each quadrant."""

import numpy as np

from .. import quantities, readings, style
from . import Case
from .decision_surface import cells

CELLS = 44, 30


def draw(velocity, torque, velocity_unit, effort, unit, width=style.SMALL):
    """velocity, torque [n]."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 14, 196)
    x_limit, y_limit = 1.02 * float(np.abs(velocity).max()) or 1.0, 1.45 * float(np.abs(torque).max()) or 1.0
    visits, x_edges, y_edges = np.histogram2d(velocity, torque, CELLS, [(-x_limit, x_limit), (-y_limit, y_limit)])
    # logarithmic steps: a place visited once is seen beside one visited a thousand times
    level = np.ceil(np.log1p(visits) / np.log1p(visits.max()) * 8).astype(int)
    for step in range(1, 9):
        cells(axes, level == step, x_edges, y_edges, style.LIGHT[f"ramp{step}"])
    axes.axhline(0, color=style.LIGHT["muted"], linewidth=1)
    axes.axvline(0, color=style.LIGHT["muted"], linewidth=1)
    for x, side in ((0.03, velocity < 0), (0.97, velocity > 0)):
        for y, half in ((0.03, torque < 0), (0.97, torque > 0)):
            axes.text(
                x,
                y,
                f"{100 * np.mean(side & half):.0f} %",
                transform=axes.transAxes,
                fontweight="bold",
                color=style.LIGHT["ink"],
                ha="left" if x < 0.5 else "right",
                va="bottom" if y < 0.5 else "top",
            )
    axes.set(xlim=(-x_limit, x_limit), ylim=(-y_limit, y_limit), xlabel=f"velocity ({velocity_unit})")
    readings.of(axes, ("velocity", velocity_unit), (effort, unit))
    readings.grid(axes, x_edges, y_edges, np.where(visits > 0, visits, np.nan), "samples")
    axes.xaxis.labelpad = 3
    style.few_ticks(axes.xaxis, 5)
    style.few_ticks(axes.yaxis, 4)
    canvas.text(0, 16, f"{effort} ({unit})")
    return canvas.figure


def cases(study):
    data = study.train
    arguments = {"velocity": np.asarray(data.velocity), "torque": np.asarray(data.torque),
                 "velocity_unit": quantities.unit(data.unit_of("velocity")), "effort": study.effort,
                 "unit": quantities.unit(study.effort_unit)}
    return {
        "torque_by_speed": Case(
            draw,
            arguments,
            f"{study.effort.capitalize()} over speed",
            "How often each place was visited, in nine steps; the corners say the share of each quadrant.",
        )
    }
