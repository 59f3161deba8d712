"""How many targets each search has reached with how many evaluations: an empirical distribution over runs and targets.

Source     Hansen, Auger, Ros, Mersmann, Tusar, Brockhoff: COCO, a platform for comparing continuous optimizers in a
           black-box setting, Optimization Methods and Software 36 (2021), doi:10.1080/10556788.2020.1808977
"""

from dataclasses import dataclass

import numpy as np
from matplotlib import ticker

from .. import quantities, readings, style
from . import Case

TITLE = "Targets reached"
# as COCO: 51 targets over ten decades at most
N_TARGETS = 51
MOST_DECADES = 10
LABEL_PX = 112
BOLD = 1.2  # capitals in bold are wider than style.EM
TOP, PLOT_PX, LINE_PX = 30, 166, 15


@dataclass
class Search:
    label: str
    colour: str
    dashes: object
    gaps: list  # per run [generation], never rising
    evaluations: list  # per run [generation]

    @property
    def end(self):
        """Evaluations of its longest run."""
        return max(evaluations[-1] for evaluations in self.evaluations)


def targets_of(searches):
    """Targets [N_TARGETS], falling; none where no search has got below where the searches begin."""
    start = np.median([gaps[0] for search in searches for gaps in search.gaps])
    best = min(gaps[-1] for search in searches for gaps in search.gaps)
    if not np.isfinite(start) or not best < start:
        return np.empty(0)
    deepest = max(best, start * 10.0**-MOST_DECADES)
    targets = np.geomspace(start, deepest, N_TARGETS)
    targets[-1] = deepest  # not nearly
    return targets


def span_of(searches):
    """Evaluations of the smallest initial population and of the longest run."""
    first = min(evaluations[0] for search in searches for evaluations in search.evaluations)
    return first, max(search.end for search in searches)


def first_hits(search, targets):
    """Evaluations of every pair of run and target that was reached, ascending."""
    hits = []
    for gaps, evaluations in zip(search.gaps, search.evaluations):
        generations = np.searchsorted(-gaps, -targets)  # first that is not above the target
        hits.extend(evaluations[generations[generations < len(gaps)]])
    return np.sort(hits)


def draw(searches, targets, width=style.SMALL):
    """searches: [Search]; targets: falling."""
    height = max(PLOT_PX, LINE_PX * len(searches))
    canvas = style.Canvas(width, TOP + height + 44)
    axes = canvas.axes(40, TOP, width - LABEL_PX, TOP + height, xscale="log")
    first, last = span_of(searches)
    at = np.geomspace(first, last, width)  # a point per pixel: steps are steps
    ends = []
    for search in searches:
        hits = first_hits(search, targets)

        def share(evaluations):
            return 100 * np.searchsorted(hits, evaluations, side="right") / (len(search.gaps) * len(targets))

        axes.plot(at, share(at), color=search.colour, linestyle=search.dashes, linewidth=2, label=search.label)
        axes.plot(search.end, share(search.end), color=search.colour, marker="x", markersize=7, markeredgewidth=2,
                  clip_on=False, label=f"_{search.label}")
        ends.append(share(last))
    axes.set(xlim=(first, last), ylim=(0, 100), xlabel="evaluations")
    axes.set_yticks([0, 25, 50, 75, 100])
    _ticks(axes.xaxis, first, last)
    readings.of(axes, ("evaluations", ""), ("reached", "%"))
    axes.xaxis.labelpad = 3
    for search, y in zip(searches, style.spread(ends, 100 * LINE_PX / height, 2, 98)):
        label = style.fit(search.label, (LABEL_PX - 8) / BOLD)
        canvas.text(width - LABEL_PX + 8, TOP + height * (1 - y / 100) + 4, label, color=search.colour,
                    fontweight="bold")
    canvas.text(0, 16, "targets reached (%)")
    return canvas.figure


def _ticks(axis, low, high, most=5):
    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    for steps in ((1, 2, 5), (1, 3), (1,)):
        ticks = [step * 10.0**decade for decade in decades for step in steps if low <= step * 10.0**decade <= high]
        if len(ticks) <= most:
            break
    axis.set_major_locator(ticker.FixedLocator(ticks))
    axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(ticker.FuncFormatter(quantities.tick))


def search_of(estimator):
    """Of the runs that are there; None where no history was kept, or too little of it."""
    if not estimator.draws_histories or estimator.evaluations is None:
        return None
    gaps, evaluations = [], []
    for gap, spent in zip(np.asarray(estimator.gap_history, dtype=float), np.asarray(estimator.evaluations)):
        told = np.flatnonzero(np.isfinite(gap))
        if len(told):
            gaps.append(np.minimum.accumulate(np.nan_to_num(gap[:told[-1] + 1], nan=np.inf)))
            evaluations.append(spent[:told[-1] + 1])
    return Search(estimator.short, estimator.ink, estimator.dashes, gaps, evaluations) if gaps else None


def cases(study):
    searches = [search for search in map(search_of, study.to_floor) if search]
    targets = targets_of(searches) if searches else ()
    if not len(targets) or len(set(span_of(searches))) == 1:
        return {}
    unit = quantities.square(study.effort_unit)
    start, deepest = (f"{quantities.number(target, 2)} {unit}".strip() for target in (targets[0], targets[-1]))
    deeper = any(gaps[-1] < targets[-1] for search in searches for gaps in search.gaps)
    end = f"{quantities.count_word(MOST_DECADES)} decades lower" if deeper else "the best of all runs"
    sentence = (f"Share of all pairs of run and target that is reached. The {N_TARGETS} targets are evenly spaced on a "
                f"logarithmic scale of the MSE above the floor: from {start}, the median of the initial populations’ "
                f"best, to {deepest}, {end}. Further left is faster, higher is more reliable; × marks the end of the "
                "longest run.")
    if any(e.last_generation is not None for e in study.to_floor):
        sentence += " The result stores some generations only: a target counts from the next stored one."
    return {"targets_reached": Case(draw, {"searches": searches, "targets": targets}, TITLE, sentence)}
