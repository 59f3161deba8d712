"""The figures of the page, one by one: matplotlib figures that show themselves in a notebook."""

import re

from .errors import UsageError
from .page import style
from .page.diagnosed import figure_name
from .page.figures import all_cases
from .page.study import Study


class Plots:
    """result.plot: names() of what can be drawn, and `plot(name)`; map() and trace() for what is asked for most."""

    def __init__(self, result):
        self._study = Study(result)
        self._cases = all_cases(self._study)

    def __call__(self, name, narrow=False):
        """narrow: in the width of a column."""
        if name not in self._cases:
            raise UsageError(f"error: this result has no figure {name!r}\n  it has: {', '.join(self._cases)}")
        case = self._cases[name]
        return case.figure(style.WIDE if case.wide and not narrow else style.SMALL)

    def names(self):
        """{name: title}"""
        return {name: case.title for name, case in self._cases.items()}

    def map(self, joint=1, narrow=False):
        """Of a diagnosis: where the residual is not what replicates have, along every axis."""
        return self(self._of_joint(joint, "mismatch_map"), narrow)

    def trace(self, number=None, joint=1, narrow=False):
        """Torque over time, and what models leave of it: of a diagnosis of its number-th recording (the last, where
        none is given), of a run of the validation recording, or the training one, beside its simulation where nothing
        else was fitted."""
        if self._study.diagnosis:
            traces = self._study_joint(joint).traces
            return self(self._of_joint(joint, f"trace_{number or len(traces)}"), narrow)
        found = [name for name in self._cases if name.startswith(("torque_trace", "joint_torque"))]
        found = found or [name for name in self._cases if re.fullmatch(r"replay_\d+", name)]
        return self(found[(number or 1) - 1] if found else "torque_trace", narrow)

    def _study_joint(self, joint):
        for one in self._study.diagnosis.joints if self._study.diagnosis else ():
            if one.joint == joint:
                return one
        raise UsageError(f"error: this result is no diagnosis of a joint {joint}")

    def _of_joint(self, joint, base):
        return figure_name(self._study, self._study_joint(joint), base)
