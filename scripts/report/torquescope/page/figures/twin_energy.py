"""The recording among its replicates: how much residual energy each of them has beside it."""

import numpy as np

from .. import diagnosed, quantities, readings, style
from . import Case


def draw(energies, width=style.SMALL):
    """energies [replicate]: residual energy of each replicate over that of the recording."""
    canvas = style.Canvas(width, 238)
    axes = canvas.axes(54, 24, width - 14, 188)
    energies = energies[np.isfinite(energies)]
    last = 1.12 * max(1.0, float(energies.max()))
    counts, edges = np.histogram(energies, bins=np.linspace(0, last, 41))
    axes.stairs(counts, edges, fill=True, color=style.LIGHT["measured"], label="replicates")
    axes.axvline(1, color=style.LIGHT["baseline"], linewidth=2.4, label="_recording")
    axes.set(xlim=(0, last), ylim=(0, None))
    readings.of(axes, ("residual energy", ""), ("replicates", ""))
    axes.set_xlabel("residual energy (recording = 1)", labelpad=3)
    style.few_ticks(axes.xaxis, 4)
    style.few_ticks(axes.yaxis, 4)
    canvas.text(0, 12, "replicates")
    return canvas.figure


def cases(study):
    return {diagnosed.figure_name(study, joint, "twin_energy"):
            Case(draw, {"energies": joint.twin_energy}, "Among its replicates",
                 f"Residual energy of {quantities.count(len(joint.twin_energy), 'replicate')}; line: the recording.")
            for joint in study.diagnosis.joints if np.isfinite(joint.twin_energy).any()}
