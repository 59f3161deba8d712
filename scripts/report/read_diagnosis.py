"""What a diagnosis found, as plain Python: the records of engine/diagnose/diagnosis.hpp under the same names.

    from read_result import Result
    found = Result("R.h5").diagnosis                   None when the file holds no diagnosis
    found.verdict, found.reason                        'named', 'Joint 1 loses 0.35 N m extra ...'
    joint = found.joints[0]
    joint.augmented["viscous"].value                   0.64
    joint.map["velocity"].z                            numpy array, one number per cell
    [one.name for one in joint.effects]                in the order of acceptance

Shapes     one array entry per cell of a map row, per sample of a trace; lists in the order of the file
Units      SI; each record names its own. Shares are fractions of 1
Unknown    numbers that were not measured are NaN, lists without entries empty
Source     engine/store/RESULT_FORMAT.md, section /diagnosis
"""

import math
from dataclasses import dataclass, field

import numpy as np

UNKNOWN = math.nan


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
    """Where the residual is not what clean twins have; energy_share of the residual, repeatable_share of the region."""

    where: Interval
    time_share: float
    energy_share: float
    repeatable_share: float


@dataclass
class MapRow:
    """One axis of the mismatch map; arrays [cell]. Of a spectrum the cells hold amplitudes, z is that of the log power."""

    axis: str
    unit: str
    is_spectrum: bool
    energy_share: float  # of the residual, beyond the twins
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
    p: float
    q: float
    gain: float
    cv_gain: float
    chance_z: float  # what 95 % of the twins stay below


@dataclass
class Curve:
    """An effect over its principal axis; arrays [cell]."""

    range: Interval
    at: np.ndarray
    partial: np.ndarray  # effect and what is left
    modelled: np.ndarray
    spread: np.ndarray  # of one twin's mean


@dataclass
class NamedEffect:
    name: str
    family: str
    title: str
    equation: str
    acts_on: str
    equivalent: list
    p: float
    p_is_bound: bool
    q: float
    z: float
    gain_train: float
    gain_cv: float
    gain_validation: float
    region: Interval
    rms: float
    peak: float
    sentence: str
    parameters: dict
    curve: Curve  # None when there is nothing to draw


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


@dataclass
class Joint:
    joint: int
    unit_position: str
    unit_torque: str
    train_relerr: float
    validation_relerr: float
    cv_relerr: float
    augmented_train_relerr: float
    augmented_validation_relerr: float
    augmented_cv_relerr: float
    floor_relerr: float
    train_floor_relerr: float
    budget_parameter_error: float
    budget_missing_physics: float
    budget_unexplained: float
    budget_noise: float
    loop_source: str
    loop_remark: str
    torque_noise: float
    disturbance: float
    twins: int
    omnibus_z: float
    omnibus_p: float
    mismatch_rms: float
    left_rms: float
    power_sentence: str
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


@dataclass
class Diagnosis:
    verdict: str  # "none", "named", "class", "unexplained", "insufficient", "data_fault"
    reason: str
    finding: str
    way_out: str
    seed: int
    q: float
    verdict_json: str  # the document of diagnose --json
    joints: list


def read_diagnosis(group):
    """The Diagnosis from the group /diagnosis (a read_result.Group)."""
    joints = [_joint(getattr(group, f"joint_{number}")) for number in range(1, group.joints + 1)]
    texts = {key: group.get(key, "") for key in ("verdict", "reason", "finding", "way_out")}
    json = str(group.verdict_json[0]) if "verdict_json" in group else ""
    return Diagnosis(**texts, seed=group.seed, q=group.q, verdict_json=json, joints=joints)


def _joint(group):
    kinds = {"int": 0, "float": UNKNOWN, "str": ""}
    said = {name: group.get(name, kinds[f.type.__name__]) for name, f in Joint.__dataclass_fields__.items()
            if f.type in (int, float, str)}
    return Joint(**said, nuisances=group.get("nuisances", []), baseline=_parameters(group.get("baseline")),
                 augmented=_parameters(group.get("augmented")), map=_map(group.get("map")),
                 candidates=_rows(group.get("candidates"), Candidate, _CANDIDATE_COLUMNS),
                 effects=[_effect(one) for one in _numbered(group.get("effects"), "effect")],
                 unexplained=_unexplained(group.get("unexplained")),
                 advice=[Advice(one.lacks, one.get("would_separate", [])) for one in _numbered(group.get("excitation"), "advice")],
                 traces=[_trace(one) for one in _numbered(group.get("traces"), "trace")],
                 forward=_rows(group.get("forward"), Forward, {"recording": "recordings"}),
                 twin_energy=group.get("twin_energy", np.empty(0)))


_CANDIDATE_COLUMNS = {"name": "names", "family": "families", "decision": "decisions", "reason": "reasons"}


def _numbered(group, name):
    """Groups name_1, name_2, ... in this order."""
    number = 1
    while group is not None and f"{name}_{number}" in group:
        yield getattr(group, f"{name}_{number}")
        number += 1


def _rows(group, record, columns):
    """A group of columns as records; `columns` names those whose dataset is called otherwise."""
    if group is None:
        return []
    arrays = [getattr(group, columns.get(name, name)).tolist() for name in record.__dataclass_fields__]
    return [record(*values) for values in zip(*arrays)]


def _parameters(group):
    if group is None or "names" not in group:
        return {}
    rows = zip(group.names.tolist(), group.units.tolist(), group.values.tolist(), group.ci95.tolist())
    return {name: Parameter(name, unit, value, low, high) for name, unit, value, (low, high) in rows}


def _map(group):
    # "order" is an attribute of the map and may be one of its rows
    order = group.attributes().get("order", []) if group is not None else []
    return {axis: _map_row(axis, getattr(group, axis)) for axis in order}


def _map_row(axis, group):
    names = {"start": "from", "stop": "to"}
    cells = {name: group.get(names.get(name, name), np.empty(0)) for name in
             ("start", "stop", "centre", "samples", "mean_residual", "twin_mean", "twin_std", "z", "after_residual", "after_z")}
    regions = []
    if "regions" in group:
        found = group.regions
        regions = [Region(Interval(axis, start, stop, group.unit), *shares) for start, stop, *shares in
                   zip(*(getattr(found, key).tolist() for key in ("from", "to", "time_share", "energy_share", "repeatable_share")))]
    # "unit" of the group is that of the axis, not of a dataset
    return MapRow(axis, group.attributes()["unit"], bool(group.is_spectrum), group.energy_share, group.p, **cells, regions=regions)


def _interval(group, name):
    return Interval(*(group.attributes()[f"{name}_{part}"] for part in ("axis", "from", "to", "unit")))


def _effect(group):
    plain = {name: group.get(name, "") for name in ("name", "family", "title", "equation", "acts_on", "sentence")}
    numbers = {name: group.get(name, UNKNOWN) for name in
               ("p", "q", "z", "gain_train", "gain_cv", "gain_validation", "rms", "peak")}
    curve = None
    if "curve" in group:
        drawn = group.curve
        curve = Curve(_interval(drawn, "range"), drawn.at, drawn.partial, drawn.modelled, drawn.spread)
    return NamedEffect(**plain, **numbers, equivalent=group.get("equivalent", []), p_is_bound=bool(group.get("p_is_bound", 0)),
                       region=_interval(group, "region"), parameters=_parameters(group.get("parameters")), curve=curve)


def _unexplained(group):
    if group is None:
        return []
    columns = (getattr(group, key).tolist() for key in ("axes", "from", "to", "units", "energy_share"))
    return [(Interval(*where), share) for *where, share in zip(*columns)]


def _trace(group):
    none = np.empty(0)
    arrays = {name: group.get(name, none) for name in ("time", "torque", "before", "after", "velocity", "position")}
    return Trace(group.recording, group.rate_hz, **arrays)
