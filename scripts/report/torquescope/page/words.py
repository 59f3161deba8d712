"""What the page says in sentences. Every number in them is stored in the file; the rules below only choose the
words."""

import math
from collections import Counter

import numpy as np

from . import quantities as q

ARRIVED = 1e-3  # of the MSE: a search this close has the optimum to three digits
CLOSE_CORRELATION = 0.95  # worth a remark (engine/problem/regressor_health.cpp)
Z95 = 1.959964  # normal quantile of the stored ci95


def verdict(study):
    """mark, word, tone ("ink" or "ochre"), sentence, evidence: what was found, in one look."""
    words = study.health.words or ""
    late = [e for e in study.searches if not has_arrived(e)]
    mark, word, tone, words = standing(_less_than_none(study), words, late)
    sentence = _search_sentence(study.searches, late) if study.searches else _fit_sentence(study)
    return {
        "mark": mark,
        "word": word,
        "tone": tone,
        "sentence": sentence,
        "headlines": [sentence],
        "evidence": _evidence(study, words),
    }


def standing(negative, words, late):
    """mark, word, tone, words: of parameters that are surely negative, of a warning about the regressor, of searches
    that have not arrived."""
    if negative:
        return "▽", "Not physical", "ochre", f"Less than none is fitted of {q.listed(negative)}. {words}".strip()
    if words:
        return "▽", "Identified, but poorly separable", "ochre", words
    if late:
        return "◌", "Not converged", "ochre", words
    return "●", "Identified", "ink", words


def _less_than_none(study):
    """Masses and frictions whose 95 % interval of least squares lies below zero."""
    fit = study.ols
    if fit is None or fit.ci95 is None:
        return []
    return [name for name, (_, upper) in zip(study.model.names, fit.ci95[0])
            if name in ("inertia", "viscous", "coulomb") and upper < 0]


def has_arrived(e):
    return e.gap_median <= ARRIVED * e.mse_median


def _search_sentence(searches, late):
    arrived = [e for e in searches if e not in late]
    parts = []
    if arrived:
        both = " both" if len(arrived) == 2 else " all" if len(arrived) > 2 else ""
        verb = "arrives" if len(arrived) == 1 else f"{both.strip()} arrive".strip()
        parts.append(f"{q.listed(e.short for e in arrived)} {verb} at the least-squares optimum")
    if len(arrived) > 1:
        ranked = sorted(arrived, key=lambda e: e.gap_median)
        decades = round(math.log10(max(ranked[-1].gap_median, 1e-300) / max(ranked[0].gap_median, 1e-300)))
        if ranked[0].gap_median > 0 and decades >= 1:
            by = f"{q.count_word(decades)} {'decade' if decades == 1 else 'decades'}"
            parts.append(f"{ranked[0].short} is closer by {by}" if len(ranked) == 2
                         else f"{ranked[0].short} comes closest, {by} before {ranked[-1].short}")
    for e in late:
        parts.append(f"{e.short} stops {q.percent(e.gap_median / (e.mse_median - e.gap_median))} above "
                     f"{'it' if arrived else 'the least-squares optimum'}")
    return "; ".join(parts) + "."


def _fit_sentence(study):
    e = study.estimators[0]
    count = q.count_word(len(study.model.names)).capitalize()
    seen = e.validation_relerr_median if study.validate is not None else e.relerr_median
    where = f"an unseen {study.effort}" if study.validate is not None else f"the {study.effort}"
    if seen < 0.5:
        return f"{count} parameters reproduce {where} to within {q.percent(seen)}."
    return f"{count} parameters are found; {q.percent(seen)} of {where} remains unexplained."


def _evidence(study, words):
    said = []
    if words:
        said.append(words[0].upper() + words[1:].rstrip(".") + ".")
    runs = max((int(e.runs) for e in study.searches), default=0)
    if runs:
        gaps = [f"{q.number(e.gap_median, 2)} ({e.short})" for e in study.searches[:3]]
        said.append(f"Mean square error above the floor, median of {q.count(runs, 'run')}: {q.listed(gaps)} "
                    f"{q.square(study.effort_unit)}.")
    e = study.ols or study.estimators[0]
    said.append(
        f"{e.short} leaves {q.with_unit(q.number(e.residual_std_median), study.effort_unit)} (standard deviation) on "
        f"{q.count(study.train.rows, 'sample')}."
    )
    return " ".join(said)


def big_numbers(study):
    """The first four of: [(number, unit, caption)]."""
    e = study.ols or study.estimators[0]
    found = []
    if study.validate is not None:
        found.append((q.percent(e.validation_relerr_median), "",
                      f"error of {e.short} on the unseen recording; {q.percent(e.relerr_median)} in training"))
    else:
        found.append((q.percent(e.relerr_median), "", f"error of {e.short} in training; nothing unseen was given"))
    if study.ols is not None:
        found.append((q.number(e.mse_median), q.square(study.effort_unit), "mean square error of OLS: the floor"))
    for s in study.searches[:2]:
        found.append((q.number(s.gap_median, 2), q.square(study.effort_unit), f"{s.short} above the floor, median of "
                      f"{q.count(int(s.runs), 'run')}"))
    found.append((q.number(study.health.condition_number), "", "condition number of the regressor"))
    found.append((q.number(e.residual_std_median), q.unit(study.effort_unit), "standard deviation of the residual"))
    return found[:4]


def remarks(study):
    """What closed forms have to say of themselves: "ESSENTIAL: 29 of 47 parameters are kept. "."""
    return "".join(f"{e.short}: {e.remark}. " for e in study.estimators if e.remark)


def parameters_answer(study):
    """Which parameters are known, which are not: from the stored intervals."""
    e = study.ols or next((e for e in study.estimators if e.ci95 is not None), None)
    if e is None:
        return "No least squares in this job, so there are no intervals; the spread is that of the runs."
    low, high = e.ci95[0][:, 0], e.ci95[0][:, 1]
    open_ones = [name.replace("_", " ") for name, a, b in zip(study.model.names, low, high) if a <= 0 <= b]
    if not open_ones:
        return f"Every 95 % interval of {e.short} excludes zero: this recording shows each of the parameters."
    if len(open_ones) == 1:
        return f"The 95 % interval of {open_ones[0]} includes zero: this recording does not prove it."
    return f"The 95 % intervals of {q.listed(open_ones)} include zero: this recording does not prove them."


def health_answer(study):
    correlation = np.abs(np.array(study.health.correlation, dtype=float))
    np.fill_diagonal(correlation, 0)
    i, j = np.unravel_index(int(np.argmax(correlation)), correlation.shape)
    names = [name.replace("_", " ") for name in study.model.names]
    said = f"Condition number of the regressor {q.number(study.health.condition_number)}"
    if len(names) > 1:
        said += (f"; strongest correlation of two columns {q.fixed(study.health.correlation[i][j], 2)} "
                 f"({names[i]} with {names[j]})")
    words = study.health.words
    if words:
        return f"{said}. {words[0].upper()}{words[1:].rstrip('.')}."
    if correlation.max() >= CLOSE_CORRELATION:
        return said + ": what both make together is known better than either value."
    return said + ". Nothing to warn of."


def fit_answer(study):
    if study.validate is None:
        return "Only training data: whether the model holds on another motion, this file cannot say."
    e = study.ols or study.estimators[0]
    return (f"{e.short}: {q.percent(e.relerr_median)} relative error in training, "
            f"{q.percent(e.validation_relerr_median)} on {q.seconds(study.validate.duration_s)} of another motion. "
            "Data that no fit has seen, so no fit can have learnt its noise.")


def search_answer(study):
    if not study.searches:
        return "Every estimator of this job solves its equations directly; there is nothing to search."
    total = sum(int(e.evaluations_total) for e in study.searches)
    return (
        f"{q.count(max(int(e.runs) for e in study.searches), 'run')} of each search, {q.count(total, 'evaluation')} "
        "in all. "
        "The problem is linear, so the exact optimum is known: each search is measured by its distance from it."
    )


def recording_answer(study):
    data = study.train
    made = "simulated" if data.simulated else "recorded"
    said = (
        f"{q.seconds(data.duration_s)} {made} at {q.tick(data.rate_hz)} Hz, "
        f"{q.count(data.rows, 'sample')} kept at {q.tick(data.kept_rate_hz)} Hz, {q.count(data.reversals, 'reversal')}."
    )
    warnings = len(data.warned)
    return said + (f" {q.count(warnings, 'warning')}, listed at the top." if warnings else " No warnings.")


def stop_reasons(e):
    """'generations 28, target 2'."""
    return ", ".join(f"{reason} {count}" if len(e.stop_reason) > 1 else reason
                     for reason, count in Counter(e.stop_reason).most_common())


def warnings(study):
    """[(recording, topic, text)]."""
    found = []
    for which, data in (("training", study.train), ("unseen", study.validate)):
        for text in data.warned if data is not None else []:
            topic, _, rest = text.partition(": ")
            found.append((which, topic, rest) if rest else (which, "", topic))
    return found


def head(study):
    return head_of_recordings(study, f"{study.model.joint} joint")


def head_of_recordings(study, kind):
    """The one line at the top: job, kind of joint, lengths and rate of the recordings, date."""
    parts = [study.job.name, kind,
             f"train {q.seconds(study.train.duration_s)}" + (f", unseen {q.seconds(study.validate.duration_s)}"
                                                             if study.validate is not None else "")
             + f", {q.tick(study.train.kept_rate_hz)} Hz"]
    if study.provenance.finished:
        parts.append(_date(study.provenance.finished))
    return parts


def _date(text):
    months = "Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec".split()
    try:
        year, month, day = (int(part) for part in text[:10].split("-"))
        return f"{day} {months[month - 1]} {year}"
    except (ValueError, IndexError):
        return text
