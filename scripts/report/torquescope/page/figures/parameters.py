"""Forest plot: every estimate of every parameter as a difference from the truth, in standard errors of least
squares."""

import numpy as np

from .. import quantities, readings, seed, style
from . import Case

WIDEST = 150.0  # % of a value: a bar beyond leaves the frame


def draw(names, units, groups, published, axis_words, values, widest=np.inf, width=style.WIDE):
    """groups: [(label, difference [R], half interval [R] or None, inner half interval [R] or None, low [R], high [R],
    colour)], low and high: span over the runs or None. published: [(label, difference [R], colour)], hollow diamonds.
    values: [R] words at the right. widest: a half interval beyond does not widen the frame."""
    narrow = width < style.WIDE
    lanes = len(groups) + len(published)
    row = max(46, 13 * lanes + 22) + (16 if narrow else 0)
    top = 10 if narrow else 24
    height = top + row * len(names) + 48
    canvas = style.Canvas(width, height)
    left, right = (16, width - 16) if narrow else (210, width - 250)
    axes = canvas.axes(left, top, right, top + row * len(names))
    readings.of(axes, ("difference", axis_words[1].split(", ")[-1]), ("", ""), zoom="x")
    reach = _draw_rows(axes, groups, published, row, 16 if narrow else 0, names, widest)
    axes.axvline(0, color=style.LIGHT["muted"], linewidth=1.2, zorder=1)
    axes.set(xlim=(-1.08 * reach, 1.08 * reach), ylim=(row * len(names), 0), yticks=[])
    axes.set_xlabel(axis_words[1] if narrow else axis_words[0], labelpad=4)
    style.few_ticks(axes.xaxis, 5 if narrow else 9)
    ink = style.LIGHT["ink"]
    for index, (name, unit, value) in enumerate(zip(names, units, values)):
        name = name.replace("_", " ")
        if narrow:
            line = top + row * index + 14
            canvas.text(0, line, style.fit(name, 150), color=ink)
            canvas.text(width, line, value, ha="right", color=ink, fontweight="bold")
        else:
            line = top + row * (index + 0.5) + 4
            canvas.text(0, line, style.fit(name, 200), color=ink)
            canvas.text(width, line, quantities.with_unit(value, unit), ha="right", color=ink, fontweight="bold")
    return canvas.figure


def _draw_rows(axes, groups, published, row, name_room, names, widest):
    lanes, count = len(groups) + len(published), len(names)
    reach = 1e-12
    for index in range(count):
        for lane, (label, difference, outer, inner, low, high, colour) in enumerate(groups):
            y = row * index + name_room + (row - name_room) * (lane + 1) / (lanes + 1)
            x = difference[index]
            reach = max(reach, abs(x))
            if outer is not None:
                axes.plot(
                    [x - outer[index], x + outer[index]], [y, y], color=colour, linewidth=2.6, solid_capstyle="butt",
                    label=f"_{label}"
                )
                reach = max(reach, abs(x) + min(outer[index], widest)) if np.isfinite(outer[index]) else reach
            if inner is not None:
                # the interval that white residuals would give: two small posts on the bar
                for end in (x - inner[index], x + inner[index]):
                    axes.plot([end, end], [y - 4, y + 4], color=colour, linewidth=1.4, label=f"_{label}")
            if low is not None:
                axes.plot([low[index], high[index]], [y, y], color=colour, linewidth=1.4, label=f"_{label}")
                reach = max(reach, abs(low[index]), abs(high[index]))
            axes.plot(x, y, marker="o", markersize=7, color=colour, linestyle="none", label=f"_{label}")
            half = f" ± {quantities.number(outer[index])}" if outer is not None and np.isfinite(outer[index]) else ""
            readings.note(axes, f"{names[index].replace('_', ' ')}, {label}: {quantities.number(x)}{half}", at=(x, y))
        for lane, (label, difference, colour) in enumerate(published, start=len(groups)):
            y = row * index + name_room + (row - name_room) * (lane + 1) / (lanes + 1)
            axes.plot(difference[index], y, marker="D", markersize=6.5, color=colour, markeredgewidth=1.8,
                      markerfacecolor=style.LIGHT["background"], linestyle="none", label=f"_{label}")
            readings.note(axes, f"{names[index].replace('_', ' ')}, {label}: {quantities.number(difference[index])}",
                          at=(difference[index], y))
            reach = max(reach, abs(difference[index]))
    axes.grid(axis="y", visible=False)
    for index in range(1, count):
        axes.axhline(row * index, color=style.LIGHT["grid"], linewidth=1)
    return reach


def cases(study):
    reference = study.model.truth if study.truth_known else study.lead.chosen
    ols = study.ols
    # a lone OLS measured by its own standard errors would draw the same bar for every parameter
    by_errors = ols is not None and (study.truth_known or len(study.estimators) > 1)
    if by_errors:
        size = np.asarray(ols.standard_error[0])
    else:
        size = np.where(reference != 0, np.abs(reference) / 100, 1.0)
    groups = []
    for e in study.estimators:
        difference = (e.chosen - reference) / size
        outer = 1.959964 * e.standard_error[0] / size if e.standard_error is not None else None
        inner = 1.959964 * e.standard_error_naive[0] / size if e.standard_error_naive is not None else None
        spans = len(e.parameters) > 1
        low = (e.parameters.min(axis=0) - reference) / size if spans else None
        high = (e.parameters.max(axis=0) - reference) / size if spans else None
        groups.append((e.short, difference, outer, inner, low, high, e.ink))
    published = []
    if study.is_seed_study:
        published = [(f"{name}, published", (np.array(row) - reference) / size, style.LIGHT[name.lower()])
                     for name, row in seed.TABLE_3.items() if name != "OLS"]
    origin = "the truth" if study.truth_known else study.lead.short
    unit = "in standard errors of OLS" if by_errors else "% of the value"
    axis_words = (f"difference from {origin}, {unit}", f"minus {origin}, {unit}")
    words = []
    for index in range(len(reference)):
        e = study.lead
        error = 1.959964 * e.standard_error[0][index] if e.standard_error is not None else None
        decimals = quantities.decimals_for(error, e.chosen[index])
        words.append(quantities.fixed(e.chosen[index], decimals)
                     + (f" ± {quantities.fixed(error, decimals)}" if error is not None and np.isfinite(error) else ""))
    arguments = {"names": study.model.names, "units": study.model.units, "groups": groups, "published": published,
                 "axis_words": axis_words, "values": words, "widest": np.inf if by_errors else WIDEST}
    sentence = "Dots: estimates."
    if ols is not None:
        sentence += (
            " Bars: 95 % intervals that allow for a residual with memory (HAC); posts: the same if it were white."
        )
    elif any(e.standard_error is not None for e in study.estimators):
        sentence += " Bars: 95 % intervals (HAC)."
    if not by_errors and any(outer is not None and (outer > WIDEST).any() for _, _, outer, *_ in groups):
        sentence += f" What leaves the frame is wider than ±{WIDEST:.0f} %."
    if study.searches:
        sentence += " Thin lines: the span of all runs of a search."
    if published:
        sentence += " Hollow diamonds: the values of the paper."
    return {"parameters": Case(draw, arguments, "Estimates and their intervals", sentence, wide=True)}
