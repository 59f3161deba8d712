"""The records of a diagnosis: those of engine/infer/verdict/diagnosis.hpp under the same names, as plain Python.

Made by    read_diagnosis.py, which shows how to come by one
Shapes     one array entry per cell of a map row, per sample of a trace; lists in the order of the file
Units      SI; each record names its own. Shares are fractions of 1
Unknown    numbers that were not measured are NaN, lists without entries empty
"""

import math
from dataclasses import dataclass, field

import numpy as np


def _percents(before, after):
    has_after = math.isfinite(after) and after != before
    return f"{100 * before:.3g} -> {100 * after:.3g} %" if has_after else f"{100 * before:.3g} %"


@dataclass
class Interval:
    """A stretch of one axis."""

    axis: str
    start: float
    stop: float
    unit: str


@dataclass
class Parameter:
    name: str
    unit: str
    value: float
    lower: float  # 95 %
    upper: float

    @property
    def half_interval(self):
        return (self.upper - self.lower) / 2


@dataclass
class Region:
    """Where the residual is not what replicates have; energy_share of the residual, repeatable_share of the region."""

    where: Interval
    time_share: float
    energy_share: float
    repeatable_share: float


@dataclass
class MapRow:
    """One axis of the mismatch map; arrays [cell]. Of a spectrum the cells hold amplitudes, z is that of the log
    power."""

    axis: str
    unit: str
    is_spectrum: bool
    energy_share: float  # of the residual, beyond the replicates
    p: float
    start: np.ndarray
    stop: np.ndarray
    centre: np.ndarray
    samples: np.ndarray
    mean_residual: np.ndarray
    twin_mean: np.ndarray
    twin_std: np.ndarray
    z: np.ndarray
    after_residual: np.ndarray
    after_z: np.ndarray
    regions: list


@dataclass
class Candidate:
    name: str
    family: str
    decision: str  # "named", "class", "measurement", "no", "not tested"
    reason: str
    z: float
    p: float  # at least what this many replicates can count
    p_is_bound: bool  # no replicate reached it
    p_extrapolated: float  # the tail of the replicates, continued below that
    q: float
    gain: float
    cv_gain: float


@dataclass
class Curve:
    """An effect over its principal axis; arrays [cell]."""

    range: Interval
    at: np.ndarray
    partial: np.ndarray  # effect and what is left
    modelled: np.ndarray
    spread: np.ndarray  # of one replicate's mean


@dataclass
class NamedEffect:
    name: str
    family: str
    title: str
    equation: str
    acts_on: str
    equivalent: list
    p: float  # as of a Candidate
    p_is_bound: bool
    p_extrapolated: float
    q: float
    z: float
    gain_train: float
    gain_cv: float
    region: Interval
    places: list  # [Interval] of the region's axis: one, or two where one would not do
    rms: float
    peak: float
    sentence: str
    parameters: dict
    curve: Curve  # None when there is nothing to draw
    is_fault: bool  # of a recorded channel; no physics of the joint would explain it as well


@dataclass
class Advice:
    lacks: str
    would_separate: list


@dataclass
class Trace:
    """Arrays [sample]; before and after are residuals, NaN where the joint turns round."""

    recording: str
    rate_hz: float
    time: np.ndarray
    torque: np.ndarray
    before: np.ndarray
    after: np.ndarray
    velocity: np.ndarray
    position: np.ndarray


@dataclass
class Forward:
    """Closed loop from the reference of a recording: rms of simulated minus measured position."""

    recording: str
    before_rms: float
    after_rms: float
    motion_rms: float
    encoder_step: float


@dataclass(repr=False)
class Joint:
    joint: int
    name: str  # of its position column; "" unknown
    verdict: str  # with its reason; of a single joint that of the diagnosis
    reason: str
    unit_position: str
    unit_torque: str
    train_relerr: float
    validation_relerr: float
    cv_relerr: float
    augmented_train_relerr: float
    augmented_validation_relerr: float
    augmented_cv_relerr: float
    explained_share: float  # of the mismatch's energy on held-out rows, by what is named
    budget_parameter_error: float
    budget_missing_physics: float
    budget_unexplained: float
    budget_noise: float
    twins: int
    omnibus_p: float
    mismatch_rms: float
    left_rms: float
    power_sentence: str
    friction_sign_forward: float  # what effects took from the fitted baseline; NaN: not in the file
    friction_sign_backward: float
    baseline_inertia: float
    model_c: str  # the model as code; "": there is none
    model_mjcf: str
    nuisances: list = field(default_factory=list)
    baseline: dict = field(default_factory=dict)  # {name: Parameter}, in the order of the file
    augmented: dict = field(default_factory=dict)
    map: dict = field(default_factory=dict)  # {axis: MapRow}, in the order of the page
    candidates: list = field(default_factory=list)  # strongest first
    effects: list = field(default_factory=list)
    unexplained: list = field(default_factory=list)  # [(Interval, share of the residual's energy)]
    advice: list = field(default_factory=list)
    traces: list = field(default_factory=list)
    forward: list = field(default_factory=list)
    twin_energy: np.ndarray = field(default_factory=lambda: np.empty(0))

    def __repr__(self):
        names = ", ".join(effect.name for effect in self.effects)
        called = f"{self.joint} ({self.name})" if self.name else str(self.joint)
        return f"<Joint {called}: {self.verdict}{f': {names}' if names else ''}>"

    def __str__(self):
        """A screen: what was named, errors before and after, parameters before and after."""
        lines = [repr(self)]
        for where, kind in (("training", "train"), ("validation", "validation")):
            before, after = (getattr(self, f"{prefix}{kind}_relerr") for prefix in ("", "augmented_"))
            if math.isfinite(before):
                lines.append(f"  error in {where}, all samples: {_percents(before, after)}")
        for name, one in (self.augmented or self.baseline).items():
            old = self.baseline.get(name)
            was = f"   was {old.value:.4g}" if self.augmented and old else ""
            lines.append(f"  {name:<22} {one.value:>10.4g} [{one.lower:.4g}, {one.upper:.4g}] {one.unit}{was}")
        lines.append(f"  also: map ({len(self.map)} axes), candidates ({len(self.candidates)}), traces, advice")
        return "\n".join(lines)


@dataclass
class WholeArm:
    """Effects that act on several joints at once."""
    effects: list  # [NamedEffect] in the order of acceptance
    candidates: list  # [Candidate] strongest first


@dataclass(repr=False)
class Diagnosis:
    verdict: str  # "none", "named", "class", "partly", "unexplained", "insufficient", "data_fault"
    headline: str  # what is missing with its numbers, in one line; "" in files before 28 Nov 2026
    reason: str
    finding: str
    way_out: str
    seed: int
    q: float
    verdict_json: str  # the document of diagnose --json
    joints: list
    arm: "WholeArm | None" = None  # of an arm

    def __repr__(self):
        return f"<Diagnosis: {self.verdict}: {self.headline or self.reason}>"

    def __str__(self):
        return "\n".join([repr(self), *map(str if len(self.joints) == 1 else repr, self.joints)])
