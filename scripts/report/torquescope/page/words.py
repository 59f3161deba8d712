"""What the page says in sentences. Every number in them is stored in the file; the rules below only choose the
words."""

import math
from collections import Counter

import numpy as np

from . import quantities as q, words_of_rollouts

ARRIVED = 1e-3  # of the MSE: a search this close has the optimum to three digits
CLOSE_CORRELATION = 0.95  # worth a remark (engine/fit/problem/regressor_health.cpp)
Z95 = 1.959964  # normal quantile of the stored ci95


def verdict(study):
    """mark, word, tone ("ink" or "ochre"), sentence, evidence: what was found, in one look."""
    words = study.health.words or ""
    late = [e for e in study.to_floor if not has_arrived(e)]
    mark, word, tone, words = standing(_less_than_none(study), words, late)
    sentence = _search_sentence(study.to_floor, late) if study.to_floor else _fit_sentence(study)
    if study.lead.rolls_out and words_of_rollouts.ran_away(study.lead):
        mark, word, tone, sentence = "▽", "Not simulated", "ochre", "Every simulation of the recordings ran away."
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
        said = f"What cannot be negative is fitted below zero: {q.listed(negative)}. {words}"
        return "▽", "Not physical", "ochre", said.strip()
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
    e = study.lead
    count = q.count_word(len(study.model.names)).capitalize()
    seen = e.validation_relerr_median if study.validate is not None else e.relerr_median
    what = study.error_of(e) if e.rolls_out else study.effort
    where = f"a validation {what}" if study.validate is not None else f"the {what}"
    if seen < 0.5:
        simulated = f", {words_of_rollouts.how(study)}," if e.rolls_out else ""
        return f"{count} parameters{simulated} reproduce {where} to within {q.percent(seen)}."
    return f"{count} parameters are found; {q.percent(seen)} of {where} remains unexplained."


def _evidence(study, words):
    said = []
    if words:
        said.append(words[0].upper() + words[1:].rstrip(".") + ".")
    runs = max((int(e.runs) for e in study.to_floor), default=0)
    if runs:
        gaps = [f"{q.number(e.gap_median, 2)} ({e.short})" for e in study.to_floor[:3]]
        said.append(f"Mean square error above the floor, median of {q.count(runs, 'run')}: {q.listed(gaps)} "
                    f"{q.square(study.effort_unit)}.")
    e = study.lead
    if not e.rolls_out:
        said.append(
            f"{e.short} leaves {q.with_unit(q.number(e.residual_std_median), study.effort_unit)} (standard deviation) "
            f"on {q.count(study.train.rows, 'sample')}."
        )
    return " ".join(said + [words_of_rollouts.evidence(study, one) for one in study.rolled])


def big_numbers(study):
    """The first four of: [(number, unit, caption)]."""
    e = study.lead
    found = []
    of = f" of the {study.error_of(e)}, simulated by" if e.rolls_out else " of"
    if study.validate is not None:
        found.append((q.percent(e.validation_relerr_median), "",
                      f"error{of} {e.short} on the validation recording; {q.percent(e.relerr_median)} in training"))
    else:
        found.append((q.percent(e.relerr_median), "",
                      f"error{of} {e.short} in training; no validation recording was given"))
    if study.ols is not None:
        found.append((q.number(e.mse_median), q.square(study.effort_unit), "mean square error of OLS: the floor"))
    for s in study.to_floor[:2]:
        found.append((q.number(s.gap_median, 2), q.square(study.effort_unit), f"{s.short} above the floor, median of "
                      f"{q.count(int(s.runs), 'run')}"))
    for s in study.rolled:
        if s is not e:
            found.append((q.percent(s.relerr_median), "", f"error of the {study.error_of(s)} in training, simulated by "
                          f"{s.short}"))
    found.append((q.number(study.health.condition_number), "", "condition number of the regressor"))
    found.append((q.number(e.residual_std_median), q.unit(study.error_unit(e)), "standard deviation of the residual"))
    found.append((q.number(e.mse_median), q.square(study.error_unit(e)), f"mean square error of {e.short}"))
    return found[:4]


def remarks(study):
    """What closed forms have to say of themselves: "ESSENTIAL: 29 of 47 parameters are kept. "."""
    return "".join(f"{e.short}: {e.remark}. " for e in study.estimators if e.remark and not e.rolls_out)


def parameters_answer(study):
    """Which parameters are known, which are not: from the stored intervals."""
    e = next((e for e in (study.ols, study.lead, *study.estimators) if e is not None and e.ci95 is not None), None)
    if e is None:
        return "No least squares in this job, so there are no intervals; the spread is that of the runs."
    names = [name.replace("_", " ") for name in study.model.names]
    low, high = e.ci95[0][:, 0], e.ci95[0][:, 1]
    unknown = [name for name, a, b in zip(names, low, high) if not (math.isfinite(a) and math.isfinite(b))]
    open_ones = [name for name, a, b in zip(names, low, high) if a <= 0 <= b]
    said = f"{e.short} has no interval for {q.listed(unknown)}." if unknown else ""
    if len(unknown) == len(names):
        return said
    if not open_ones:
        every, each = ("Every other", "these") if unknown else ("Every", "the parameters")
        return f"{every} 95 % interval of {e.short} excludes zero: this recording shows each of {each}. {said}".strip()
    if len(open_ones) == 1:
        return f"The 95 % interval of {open_ones[0]} includes zero: this recording does not prove it. {said}".strip()
    return (f"The 95 % intervals of {q.listed(open_ones)} include zero: this recording does not prove them. "
            f"{said}").strip()


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
    e = study.lead
    said = [words_of_rollouts.errors(study, one) for one in study.rolled]
    if not e.rolls_out:
        said.insert(0, f"{e.short}: {q.percent(e.relerr_median)} relative error in training, "
                       f"{q.percent(e.validation_relerr_median)} on {q.seconds(study.validate.duration_s)} of another "
                       "motion.")
    return " ".join([*said, "Data that no fit has seen, so no fit can have learnt its noise."])


def search_answer(study):
    one_run = [e.short for e in study.rolled if not e.is_search]
    stepped = (f"{q.listed(one_run)} goes downhill by the derivatives of the simulation: nothing proves that no other "
               "start ends lower.") if one_run else ""
    if not study.searches:
        return stepped or "Every estimator of this job solves its equations directly; there is nothing to search."
    total = sum(int(e.evaluations_total) for e in study.searches)
    if not study.to_floor:
        return (f"{q.count(max(int(e.runs) for e in study.searches), 'run')} of each search, "
                f"{q.count(total, 'evaluation')} in all, each a simulation of the recordings: nobody knows the "
                f"optimum. {stepped}").strip()
    return (
        f"{q.count(max(int(e.runs) for e in study.searches), 'run')} of each search, {q.count(total, 'evaluation')} "
        "in all. "
        f"The problem {'in rows ' if study.rolled else ''}is linear, so the exact optimum is known: each search "
        f"{'in rows ' if study.rolled else ''}is measured by its distance from it. {stepped}"
    ).strip()


def recording_answer(study):
    data = study.train
    made = "simulated" if data.simulated else "recorded"
    said = (
        f"{q.seconds(data.duration_s)} {made} at {q.tick(data.rate_hz)} Hz, "
        f"{q.count(data.rows, 'sample')} kept at {q.tick(data.kept_rate_hz)} Hz, {q.count(data.reversals, 'reversal')}."
    )
    said += words_of_rollouts.recording_note(study)
    warnings = len(data.warned)
    return said + (f" {q.count(warnings, 'warning')}, listed at the top." if warnings else " No warnings.")


def stop_reasons(e):
    """'generations 28, target 2'."""
    return ", ".join(f"{reason} {count}" if len(e.stop_reason) > 1 else reason
                     for reason, count in Counter(e.stop_reason).most_common())


def warnings(study):
    """[(recording, topic, text)]."""
    found = []
    for which, data in (("training", study.train), ("validation", study.validate)):
        for text in data.warned if data is not None else []:
            topic, _, rest = text.partition(": ")
            found.append((which, topic, rest) if rest else (which, "", topic))
    return found


def head(study):
    return head_of_recordings(study, f"{study.model.joint} joint")


def head_of_recordings(study, kind):
    """The one line at the top: job, kind of joint, lengths and rate of the recordings, date."""
    return [study.job.name, kind,
            f"train {q.seconds(study.train.duration_s)}" + (f", validation {q.seconds(study.validate.duration_s)}"
                                                             if study.validate is not None else "")
            + f", {q.tick(study.train.kept_rate_hz)} Hz", *date_of(study)]


def date_of(study):
    """[when it was made]; [] where nobody knows."""
    return [_date(study.provenance.finished)] if study.provenance.finished else []


def _date(text):
    months = "Jan Feb Mar Apr May Jun Jul Aug Sep Oct Nov Dec".split()
    try:
        year, month, day = (int(part) for part in text[:10].split("-"))
        return f"{day} {months[month - 1]} {year}"
    except (ValueError, IndexError):
        return text
