"""What a comparison needs of each result, in plain values: one Side per file, one Row per parameter."""

import math
from dataclasses import dataclass
from pathlib import Path

from . import diagnosed, quantities as q, style, words_of_diagnosis
from ..errors import ResultError
from ..reader.diagnosis_records import Parameter
from ..reader.read_result import Result, rolls_out

REFERENCES = ("ols", "wls")  # whose estimates a run is compared by, in this order; else the first estimator's


@dataclass
class Row:
    """A parameter: name, unit, one Parameter or None of each side."""

    name: str
    unit: str
    values: list

    @property
    def differs(self):
        """Whether two 95 % intervals lie apart; None where fewer than two are known."""
        known = [one for one in self.values if one is not None and math.isfinite(one.half_interval)]
        if len(known) < 2:
            return None
        return max(one.lower for one in known) > min(one.upper for one in known)


class Side:
    """One result."""

    def __init__(self, path, label, colour):
        self.label, self.colour = label, colour
        with Result(path) as result:
            self.job = q.shortened(result.job.name)
            finished = result.provenance.get("finished", "") if "provenance" in result else ""
            self.finished = finished[:10] or "–"
            self.diagnosis = result.diagnosis
            if not self.diagnosis and not result.estimators:
                what = "a set of recordings of servos" if result.servo() else "a replay alone"
                raise ResultError(f"{path} has no estimates to compare: it is {what}")
            self.is_arm = "arm" in result
            estimator = None if self.diagnosis else _reference(result)
            self.parameters = _of_joints(self.diagnosis.joints) if self.diagnosis else _of_estimator(result, estimator)
            self.train, self.validation = _errors(self.diagnosis, estimator)
            self.of = _of_what(result, self.diagnosis)
            self.estimator = estimator.get("title", "") if estimator else ""
            self.errors_of = "all samples, simulated" if estimator and rolls_out(estimator) else "rows"

    @property
    def verdict(self):
        if not self.diagnosis:
            return f"identified ({self.estimator})" if self.estimator else "identified"
        mark, word, _ = words_of_diagnosis.VERDICTS.get(self.diagnosis.verdict, ("◌", self.diagnosis.verdict, ""))
        return f"{mark} " + word.format(count="several")

    @property
    def named(self):
        """[(joint, name)] of what is named; joint 0 where there is only one."""
        joints = self.diagnosis.joints if self.diagnosis else []
        return [(joint.joint if len(joints) > 1 else 0, effect.name) for joint in joints for effect in joint.effects]

    def said_of(self, key):
        number, name = key
        for joint in self.diagnosis.joints if self.diagnosis else []:
            if number in (0, joint.joint):
                return _said(joint, name)
        return "–"


def _of_what(result, diagnosis):
    """What was moved, in words: two results that differ here are of different joints or robots."""
    if "robot" in result:
        return f"{result.robot.name}, {q.count(len(result.robot.joints), 'joint')}"
    kind = f"a {result.model.joint} joint"
    called = diagnosed.which_joint(diagnosis.joints[0]) if diagnosis and len(diagnosis.joints) == 1 else ""
    return f"{called}, {kind}" if called and called != "joint 1" else kind


def sides(paths):
    """[Side] with labels that tell the files apart."""
    paths = [Path(path) for path in paths]
    colours = [name for name in dict.fromkeys(style.KIND_COLOUR.values())]
    names = [path.stem for path in paths]
    labels = [name if names.count(name) == 1 else str(path.with_suffix("")) for name, path in zip(names, paths)]
    return [Side(path, label if labels.count(label) == 1 else f"{label} ({at + 1})", colours[at % len(colours)])
            for at, (path, label) in enumerate(zip(paths, labels))]


def parameter_rows(all_sides):
    """[Row] of every parameter, in the order in which the results have them."""
    keys = dict.fromkeys((name, one.unit) for side in all_sides for name, one in side.parameters.items())
    return [Row(name, unit, [side.parameters[name] if getattr(side.parameters.get(name), "unit", None) == unit else None
                             for side in all_sides]) for name, unit in keys]


def effect_title(key):
    number, name = key
    return (f"joint {number}: " if number else "") + diagnosed.effect_name(name)


def _said(joint, name):
    """'● named, z 8.1', or what the table of candidates says."""
    for effect in joint.effects:
        if effect.name == name:
            with_others = f" or {q.listed(map(diagnosed.effect_name, effect.equivalent))}" if effect.equivalent else ""
            return f"{'◍' if effect.equivalent else '●'} named{with_others}, z {q.fixed(effect.z, 1)}"
    for one in joint.candidates:
        if one.name == name:
            return f"○ {one.reason or diagnosed.plain(one.decision)}"
    return "– not tested"


def _reference(result):
    """The estimator that stands for a run."""
    found = result.estimators
    for kind in REFERENCES if "arm" not in result else reversed(REFERENCES):
        for one in found.values():
            if one.get("kind") == kind:
                return one
    return next(iter(found.values()))


def _of_estimator(result, estimator):
    run = int(estimator.get("median_run", 0) or 0)
    values = estimator.parameters[run]
    ends = estimator.ci95[run] if "ci95" in estimator else [(math.nan, math.nan)] * len(values)
    return {str(name): Parameter(str(name), str(unit), float(value), float(low), float(high))
            for name, unit, value, (low, high) in zip(result.model.names, result.units, values, ends)}


def _of_joints(joints):
    found = {}
    for joint in joints:
        model = joint.augmented if diagnosed.has_after(joint) and joint.augmented else joint.baseline
        lead = f"joint {joint.joint} " if len(joints) > 1 else ""
        found.update({lead + name: one for name, one in model.items()})
    return found


def _errors(diagnosis, estimator):
    """(training, validation) as fractions; NaN where unknown, and of several joints, which have errors of their own."""
    if estimator is not None:
        validation = estimator.get("validation_relerr_median", math.nan)
        return float(estimator.relerr_median), float(math.nan if validation is None else validation)
    if len(diagnosis.joints) != 1:
        return math.nan, math.nan
    joint, = diagnosis.joints
    changed = diagnosed.has_after(joint)
    return ((joint.augmented_train_relerr, joint.augmented_validation_relerr) if changed
            else (joint.train_relerr, joint.validation_relerr))
