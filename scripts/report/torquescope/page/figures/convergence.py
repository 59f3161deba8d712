"""How each search approached the least-squares optimum: MSE above the floor, every run thin, the median thick. Of those
that fit simulations nobody knows the floor: their fitness."""

import numpy as np

from .. import quantities, readings, style
from . import Case
from ..study import held

TITLE = "Convergence to the least-squares floor"
FITNESS = "squared error of simulations"  # over that of the model they began with, mean of the channels
MOST_RUNS = 60  # thin lines: more only make a smear
LOWEST = 1e-18  # below this the quadratic form is rounding


def draw(histories, unit, what="MSE above the floor", width=style.SMALL):
    """histories: [(label, generations, gap [run][generation] in squared units, colour, dashes)]; what: they are."""
    canvas = style.Canvas(width, 240)
    axes = canvas.axes(50, 30, width - 14, 196, yscale="log")
    top, bottom = -np.inf, np.inf
    medians = []  # [(label, generations, median, colour)]
    for label, generations, gaps, colour, dashes in histories:
        gaps = np.maximum(held(np.where(np.isfinite(gaps), gaps, np.nan)), LOWEST)  # infinite: ran away
        for run in gaps[:MOST_RUNS]:
            axes.plot(generations, run, color=colour, linewidth=0.7, alpha=0.28, label=f"_{label}")
        known = np.isfinite(gaps).any(axis=0)
        median = np.full(len(known), np.nan)
        median[known] = np.nanmedian(gaps[:, known], axis=0)
        axes.plot(generations, median, color=colour, linestyle=dashes, linewidth=2.4, label=label)
        medians.append((label, generations, median, colour))
        top, bottom = max(top, np.nanmax(gaps)), min(bottom, np.nanmin(gaps))
    low, high = 10.0 ** np.floor(np.log10(bottom)), 10.0 ** np.ceil(np.log10(top))
    last = max(generations[-1] for _, generations, _, _ in medians)
    axes.set(xlim=(0, last), ylim=(low, high), xlabel="generation")
    readings.of(axes, ("generation", ""), (what, unit))
    axes.xaxis.labelpad = 3
    style.decades(axes.yaxis, low, high)
    style.few_ticks(axes.xaxis, 4)
    _label(axes, medians, low, high, last)
    canvas.text(0, 16, f"{what}, {unit}" if unit else f"{what} (1)")
    return canvas.figure


def _label(axes, medians, low, high, last):
    # names where the curves have parted, each beside its own curve; the steepest is named below its curve, the others
    # above
    at = int(0.62 * last)
    told = [(generations[np.isfinite(median)], median[np.isfinite(median)]) for _, generations, median, _ in medians]
    heights = [np.log10(median[min(np.searchsorted(generations, at), len(median) - 1)])
               for generations, median in told]
    decades = np.log10(high / low)
    step = 16 * decades / 166  # 16 px
    order = np.argsort(heights)
    wanted = [h + (1.1 * step if i != order[0] or len(medians) == 1 else -1.1 * step) for i, h in enumerate(heights)]
    for (label, _, _, colour), y in zip(
        medians, style.spread(wanted, step, np.log10(low) + 0.6 * step, np.log10(high) - step)
    ):
        right = y > heights[[m[0] for m in medians].index(label)]
        axes.text(at, 10.0**y, style.fit(label, 110), color=colour, fontweight="bold", va="center",
                  ha="left" if right else "right")


def cases(study):
    found = {}
    simulated = [e for e in study.searches if e.rolls_out]
    for name, searches in (("convergence", study.to_floor), ("convergence_simulated", simulated)):
        histories = [(e.short, e.generations, e.gap_history, e.ink, e.dashes) for e in searches
                     if e.draws_histories and np.isfinite(e.gap_history).any()]
        if not histories:
            continue
        runs = max(len(gaps) for _, _, gaps, _, _ in histories)
        some = f" ({MOST_RUNS} of {quantities.whole(runs)} runs are drawn)" if runs > MOST_RUNS else ""
        sentence = f"Each thin line is one run{some}, the thick line the median of all."
        if searches is simulated:
            sentence += " 1: what the model they began with leaves, or where that ran away, the whole signal."
            arguments = {"histories": histories, "unit": "", "what": FITNESS}
            found[name] = Case(draw, arguments, "Convergence of simulations", sentence)
        else:
            found[name] = Case(draw, {"histories": histories, "unit": quantities.square(study.effort_unit)}, TITLE,
                               f"{sentence} A straight fall is a rate.")
    return found
