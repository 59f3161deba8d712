"""The torque that was missing, as it is in the recording and as the named effect models it."""

import numpy as np

from .. import diagnosed, quantities, readings, style
from . import Case


def draw(axis_words, unit, at, partial, modelled, spread, regions, value_unit, width=style.SMALL):
    """Arrays [cell]: the effect and what is left, the effect, the spread of one replicate's mean; regions: [(from,
    to)]."""
    canvas = style.Canvas(width, 238)
    axes = canvas.axes(54, 8, width - 14, 188)
    for region in diagnosed.partial_regions(regions, at[0], at[-1]):
        axes.axvspan(
            max(region[0], at[0]), min(region[1], at[-1]), color=style.LIGHT["region"], linewidth=0, zorder=0.2,
            label="located region"
        )
    axes.fill_between(
        at,
        modelled - diagnosed.Z95 * spread,
        modelled + diagnosed.Z95 * spread,
        color=style.LIGHT["floor"],
        linewidth=0,
        zorder=0.5,
        label="one replicate, 95 %",
    )
    axes.axhline(0, color=style.LIGHT["muted"], linewidth=1, zorder=1)
    axes.plot(at, modelled, color=style.LIGHT["augmented"], linewidth=2.2, label="as modelled")
    axes.plot(at, partial, linestyle="none", marker="o", markersize=4.2, color=style.LIGHT["ink"],
              label="in the recording")
    drawn = np.concatenate([partial, modelled])
    low, high = min(float(np.nanmin(drawn)), 0.0), max(float(np.nanmax(drawn)), 0.0)
    room = 0.08 * (high - low) or 1.0
    axes.set(xlim=(at[0], at[-1]), ylim=(low - room, high + room))
    readings.of(axes, (axis_words, unit), ("", value_unit))
    axes.set_xlabel(f"{axis_words} ({unit})" if unit else axis_words, labelpad=3)
    style.few_ticks(axes.xaxis, 4)
    style.few_ticks(axes.yaxis, 5)
    return canvas.figure


def cases(study):
    found = {}
    for joint in study.diagnosis.joints:
        for number, effect in enumerate(joint.effects, start=1):
            curve = effect.curve
            if curve is None:
                continue
            regions = diagnosed.regions_on(effect, curve.range.axis)
            arguments = {
                "axis_words": diagnosed.axis_title(curve.range.axis),
                "unit": diagnosed.axis_unit(curve.range),
                "at": curve.at,
                "partial": curve.partial,
                "modelled": curve.modelled,
                "spread": curve.spread,
                "regions": regions,
                "value_unit": quantities.unit(joint.unit_torque),
            }
            sentence = (f"Dots: {diagnosed.effect_words(effect)} and what is left, in "
                        f"{quantities.unit(joint.unit_torque)}; line: as modelled.")
            name = diagnosed.figure_name(study, joint, f"effect_{number}_missing")
            found[name] = Case(draw, arguments, f"The missing {study.effort}, as modelled", sentence)
    return found
