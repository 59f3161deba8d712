"""Every figure of the page, one file each.

A figure module has  TITLE     a heading of a few words
                     draw()    plain arrays -> matplotlib Figure; drawn `width` px wide (352 or 1080); labels of its
                               artists are the legend, readings.of() and note() say what a pointer reads
                     cases()   Study (or Board) -> {name: Case}: what of this file it can draw; empty when there is
                               nothing to draw
Adding one is a file here, its name in one of the lists below, and a place in the template of its kind of result.
"""

import importlib
from dataclasses import dataclass, field

from .. import style

STUDY_MODULES = ("parameters", "relative_error", "torque_trace", "residual_autocorrelation", "residual_by_speed",
           "residual_distribution", "convergence", "targets_reached", "control_parameters", "population_changes",
           "membership_functions", "decision_surface")
ARM_MODULES = ("arm_parameters", "joint_errors", "joint_torque", "joint_residual_by_speed", "convergence",
               "targets_reached", "control_parameters", "population_changes", "membership_functions",
               "decision_surface")
DIAGNOSIS_MODULES = ("mismatch_map", "residual_before_after", "missing_torque", "twin_energy", "error_before_after",
                     "diagnosed_trace", "residual_budget", "parameters_before_after")
BOARD_MODULES = ("power_curve", "family_confusion", "share_histogram", "stated_confidence", "diagnosis_seconds")
REPLAY_MODULES = ("replay_trace",)
RECORDING_MODULES = ("recording_trace", "speed_histogram", "torque_by_speed")


@dataclass
class Case:
    """One figure to draw: its module, its arguments, and what it says."""

    draw: object
    arguments: dict
    title: str
    sentence: str  # what am I looking at
    wide: bool = False  # drawn at 1080 px as well
    traces: dict = field(
        default_factory=dict
    )  # time, series, guide, guided_by for zooming (traces.packed); empty: still

    def figure(self, width):
        with style.look():
            return self.draw(**self.arguments, width=width)


def all_cases(study):
    """{name: Case} of everything this result can show, in page order."""
    if study.arm:
        return _cases(REPLAY_MODULES + (DIAGNOSIS_MODULES if study.diagnosis else ARM_MODULES), study)
    if study.is_replay_alone or study.servo:
        return _cases(REPLAY_MODULES, study)
    own = (STUDY_MODULES if study.estimators else ()) + (DIAGNOSIS_MODULES if study.diagnosis else ())
    return _cases(REPLAY_MODULES + own + RECORDING_MODULES, study)


def board_cases(board):
    """{name: Case} of everything this scoreboard can show."""
    return _cases(BOARD_MODULES, board)


def _cases(modules, source):
    cases = {}
    for module in modules:
        cases.update(importlib.import_module(f".{module}", __name__).cases(source))
    return cases
