"""The mean residual along one axis before and after the named effects, over what replicates show; below, the time
spent there."""

import math

import numpy as np

from .. import diagnosed, quantities, readings, style
from . import Case


def draw(axis_words, unit, centre, before, after, low, high, samples, outside, regions, is_spectrum, after_words,
         value_unit, width=style.SMALL):
    """Arrays [cell], NaN where nothing was measured; after: None without one; low, high: the replicates' band; outside:
    cells beyond it; regions: [(from, to)]."""
    canvas = style.Canvas(width, 238)
    axes = canvas.axes(54, 8, width - 14, 158)
    time = canvas.axes(54, 162, width - 14, 188)
    span = (centre[0], centre[-1])
    for region in diagnosed.partial_regions(regions, span[0], span[1]):
        axes.axvspan(
            max(region[0], span[0]), min(region[1], span[1]), color=style.LIGHT["region"], linewidth=0, zorder=0.2,
            label="located region"
        )
    axes.fill_between(centre, low, high, color=style.LIGHT["floor"], linewidth=0, zorder=0.5,
                      label="replicates, 95 %")
    axes.axhline(0, color=style.LIGHT["muted"], linewidth=1, zorder=1)
    axes.plot(centre, before, color=style.LIGHT["baseline"], linewidth=1.2, label="baseline")
    axes.plot(
        centre[outside], before[outside], linestyle="none", marker="o", markersize=5.5, color=style.LIGHT["baseline"],
        label="_baseline"
    )
    if after is not None:
        axes.plot(centre, after, color=style.LIGHT["augmented"], linewidth=1.6, zorder=3, label=after_words)
    drawn = np.concatenate([before, after if after is not None else before, [np.nanmedian(low), np.nanmedian(high)]])
    limit = 1.12 * float(np.nanmax(np.abs(drawn))) or 1.0
    axes.set(xlim=span, ylim=(0 if is_spectrum else -limit, limit))
    readings.of(axes, (axis_words, unit), ("residual", value_unit))
    axes.tick_params(labelbottom=False)
    style.few_ticks(axes.yaxis, 5)
    time.grid(False)
    time.bar(centre, samples, width=np.gradient(centre), color=style.LIGHT["measured"], linewidth=0)
    most = max(float(np.max(samples)), 1.0)
    time.set(xlim=span, ylim=(0, most), yticks=[])
    readings.of(time, (axis_words, unit), ("", ""), zoom="x")
    edges = np.concatenate([centre[:1], (centre[:-1] + centre[1:]) / 2, centre[-1:]])
    readings.grid(time, edges, (0, most), np.asarray(samples)[:, None], "rows")
    time.set_xlabel(f"{axis_words} ({unit})" if unit else axis_words, labelpad=3)
    for one in (axes, time):
        style.few_ticks(one.xaxis, 4)
    canvas.text(0, 186, "rows")
    return canvas.figure


def arguments(study, joint, row, regions=()):
    """What draw() needs of a row of the map; the unit of the residual goes into the caption."""
    measured = np.asarray(row.samples) > 0
    known = lambda values: np.where(measured, values, np.nan)  # noqa: E731
    low, high = (row.twin_mean + sign * diagnosed.Z95 * row.twin_std for sign in (-1, 1))
    before = known(row.mean_residual)
    after = known(row.after_residual) if diagnosed.has_after(joint) and np.isfinite(row.after_residual).any() else None
    outside = measured & ((row.mean_residual < low) | (row.mean_residual > high))
    return {
        "axis_words": diagnosed.axis_title(row.axis),
        "unit": diagnosed.axis_unit(row),
        "centre": row.centre,
        "before": before,
        "after": after,
        "low": known(np.maximum(low, 0) if row.is_spectrum else low),
        "high": known(high),
        "samples": row.samples,
        "outside": outside,
        "regions": list(regions),
        "is_spectrum": row.is_spectrum,
        "after_words": diagnosed.after_words(joint),
        "value_unit": quantities.unit(joint.unit_torque),
    }


def cases(study):
    found = {}
    for joint in study.diagnosis.joints:
        unit = quantities.unit(joint.unit_torque)
        name = lambda base: diagnosed.figure_name(study, joint, base)  # noqa: B023,E731
        shown = set()
        for number, effect in enumerate(joint.effects, start=1):
            row = diagnosed.effect_row(joint, effect)
            if row is not None:
                given = arguments(study, joint, row, diagnosed.regions_on(effect, row.axis))
                title = "Residual of the baseline" if given["after"] is None else "Residual before and after"
                found[name(f"effect_{number}_residual")] = Case(draw, given, title, _sentence(unit))
            quiet, rival = diagnosed.quiet_rival(joint, effect, shown)
            if quiet is not None:
                shown.add(quiet.axis)
                found[name(f"effect_{number}_not_here")] = _not_here(study, joint, quiet, rival, unit)
        if not joint.effects:
            found.update(
                {
                    name(f"residual_{row.axis}"): Case(
                        draw,
                        arguments(study, joint, row, [region] if region else []),
                        f"Residual over {diagnosed.axis_title(row.axis)}",
                        _sentence(unit),
                    )
                    for row, region in diagnosed.rows_without_effects(joint)
                }
            )
    return found


def _sentence(unit):
    return f"Mean residual in {unit}; dots: outside what 95 % of the replicates show."


def _not_here(study, joint, row, rival, unit):
    p = f", p {_equals(diagnosed.counted_p_cell(row.p, joint.twins))}" if math.isfinite(row.p) else ""
    where = f"Where {diagnosed.effect_name(rival.name)} would show" if rival else "The quietest axis"
    return Case(draw, arguments(study, joint, row), f"Not here: {diagnosed.axis_title(row.axis)}",
                f"{where}: nothing was located on it{p}; in {unit}.")


def _equals(cell):
    return f"< {cell[1:]}" if cell.startswith("<") else f"= {cell}"
