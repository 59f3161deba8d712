"""What the page of an arm says in sentences; the rules choose the words, the numbers are in the file."""

import numpy as np

from . import quantities as q, words


def verdict(study):
    """As words.verdict: mark, word, tone, sentence, headlines, evidence."""
    said = study.health.words or ""
    late = [e for e in study.searches if not words.has_arrived(e)]
    mark, word, tone, said = words.standing(_less_than_none(study), said, late)
    sentence = _sentence(study)
    evidence = _evidence(study)
    if said:
        evidence = f"{said[0].upper()}{said[1:].rstrip('.')}. {evidence}"
    return {"mark": mark, "word": word, "tone": tone, "sentence": sentence, "headlines": [sentence],
            "evidence": evidence}


def _less_than_none(study):
    """Drive inertias and frictions whose 95 % interval lies below zero."""
    e = study.arm.reference(study)
    if e.ci95 is None:
        return []
    return [name for name, (_, upper) in zip(study.model.names, e.ci95[0])
            if name.rpartition("_")[0] in ("drive", "viscous", "coulomb") and upper < 0]


def _error(study):
    e = study.arm.reference(study)
    validation = e.validation_relerr_median if study.validate is not None else None
    return (validation, "a validation motion") if validation is not None and np.isfinite(validation) else \
        (e.relerr_median, "the training motion")


def _sentence(study):
    error, where = _error(study)
    parameters, joints = len(study.model.names), len(study.arm.joints)
    return (f"{q.count_word(parameters).capitalize()} parameters of {q.count_word(joints)} joints reproduce the "
            f"torques of {where} to within {q.percent(error)}.")


def _evidence(study):
    e = study.arm.reference(study)
    said = (f"{e.short} on {q.count(study.train.rows, 'row')} in which a joint moves one way: near a reversal friction "
            "is more than a Coulomb step.")
    known, origin = study.arm.known_values(study)
    if known is not None and e.standard_error is not None:
        away = np.abs(e.chosen - known) / e.standard_error[0]
        inside, told = int(np.sum(away <= words.Z95)), int(np.isfinite(away).sum())
        values = "true values" if origin == "truth" else f"values of the {origin}"
        said += f" {q.whole(inside)} of {q.whole(told)} {values} lie within the 95 % intervals."
    return said


def head(study):
    return words.head_of_recordings(study, f"{study.arm.name}, {q.count(len(study.arm.joints), 'joint')}")


def big_numbers(study):
    """[(number, unit, caption)]."""
    e = study.arm.reference(study)
    validation = study.validate is not None
    prefix, where = (("validation_", "validation") if validation else
                     ("", "in training; no validation recording was given"))
    first = getattr(e, prefix + "relerr_median")
    joints = np.asarray(getattr(e, prefix + "joint_relerr"), dtype=float)
    found = [(q.percent(first), "", f"error of {e.short} over all joints, {where}"
              + (f"; {q.percent(e.relerr_median)} in training" if validation else "")),
             (q.percent(getattr(e, prefix + "relerr_all_rows")), "", "the same over all rows, reversals too")]
    if np.isfinite(joints).any():
        worst = int(np.nanargmax(joints))
        found.append((q.percent(joints[worst]), "", f"largest error of a joint: {study.arm.joints[worst].title}"))
    found.append((q.number(study.health.condition_number), "", "condition number of the regressor"))
    return found


def parameters_answer(study):
    e = study.arm.reference(study)
    base = len(study.arm.base_parameters)
    beside = len(study.model.names) - base
    said = f"{q.whole(base)} base parameters: the sums of masses, moments and inertias that torques depend on"
    kinds = "friction, payloads and gains" if "gain_error_1" in study.model.names else "friction"
    said += f"; {q.whole(beside)} of {kinds} beside them. " if beside else ". "
    said += f"torquescope export writes the values of {study.estimators[0].short}, unless --estimator names another. "
    said += words.remarks(study)
    if e.ci95 is None:
        return said + "No least squares in this job, so there are no intervals."
    seen = int(np.sum((e.ci95[0][:, 0] > 0) | (e.ci95[0][:, 1] < 0)))
    if seen == base + beside:
        return said + "All of them differ from zero by more than their 95 % interval."
    return said + (f"{q.whole(seen)} of the {q.whole(base + beside)} differ from zero by more than their 95 % "
                   "interval; the others are small, or this motion does not show them.")


def fit_answer(study):
    if study.validate is None:
        return "Only training data: whether the model holds on another motion, this file cannot say."
    return ("Relative error of each joint: norm of the residual over norm of its torque. Filled: a motion that no fit "
            "has seen.")


def separable_answer(study):
    said = (f"Condition number of the regressor {q.number(study.health.condition_number)}: 1 would be columns that "
            "have nothing in common.")
    return said + (f" {study.health.words[0].upper()}{study.health.words[1:].rstrip('.')}." if study.health.words
                   else "")
