"""What a diagnosis found, as plain Python (diagnosis_records.py), out of the group /diagnosis of a result file.

    from torquescope.reader import Result
    found = Result("R.h5").diagnosis                   None when the file holds no diagnosis
    found.verdict, found.reason                        'named', 'Joint 1 loses 0.35 N m extra ...'
    joint = found.joints[0]
    joint.augmented["viscous"].value                   0.64
    joint.map["velocity"].z                            numpy array, one number per cell
    [one.name for one in joint.effects]                in the order of acceptance

Errors     ResultError: a diagnosis of Torquescope 0.1, whose errors are of other rows
Source     engine/store/RESULT_FORMAT.md, section /diagnosis
"""

import math

import numpy as np

from ..errors import ResultError
from .diagnosis_records import (Advice, Candidate, Curve, Diagnosis, Forward, Interval, Joint, MapRow, NamedEffect,
                               Parameter, Region, Trace, WholeArm)

UNKNOWN = math.nan


def read_diagnosis(group):
    """The Diagnosis from the group /diagnosis (a read_result.Group)."""
    joints = [_joint(getattr(group, f"joint_{number}")) for number in range(1, group.joints + 1)]
    texts = {key: group.get(key, "") for key in ("verdict", "headline", "reason", "finding", "way_out")}
    if len(joints) == 1 and not joints[0].verdict:  # the file says it once
        joints[0].verdict, joints[0].reason = texts["verdict"], texts["reason"]
    json = str(group.verdict_json[0]) if "verdict_json" in group else ""
    return Diagnosis(**texts, seed=group.seed, q=group.q, verdict_json=json, joints=joints, arm=_arm(group.get("arm")))


def _arm(group):
    if group is None:
        return None
    effects = [_effect(one, 0) for one in _numbered(group.get("effects"), "effect")]
    return WholeArm(effects, _candidates(group.get("candidates"), 0))


def _refuse_other_rows(group):
    """Version 0.1 had errors of other rows: they would be told as those of all samples. A joint without an error (given
    up before its first fit) has none of other rows, whatever its word."""
    rows = group.get("rows", "")
    if rows != "all" and math.isfinite(group.get("train_relerr", UNKNOWN)):
        raise ResultError(f"the errors of {group.file_name()} are of rows {rows or 'moving one way'}: it was made by "
                          "Torquescope 0.1; delete it and run torquescope diagnose again with the job")


def _joint(group):
    _refuse_other_rows(group)
    kinds = {"int": 0, "float": UNKNOWN, "str": ""}
    said = {name: group.get(name, kinds[f.type.__name__]) for name, f in Joint.__dataclass_fields__.items()
            if f.type in (int, float, str)}
    return Joint(
        **said,
        nuisances=group.get("nuisances", []),
        baseline=_parameters(group.get("baseline")),
        augmented=_parameters(group.get("augmented")),
        map=_map(group.get("map")),
        candidates=_candidates(group.get("candidates"), said["twins"]),
        effects=[_effect(one, said["twins"]) for one in _numbered(group.get("effects"), "effect")],
        unexplained=_unexplained(group.get("unexplained")),
        advice=[
            Advice(one.lacks, one.get("would_separate", [])) for one in _numbered(group.get("excitation"), "advice")
        ],
        traces=[_trace(one) for one in _numbered(group.get("traces"), "trace")],
        forward=_rows(group.get("forward"), Forward, {"recording": "recordings"}),
        twin_energy=group.get("twin_energy", np.empty(0)),
    )


_CANDIDATE_COLUMNS = {"name": "names", "family": "families", "decision": "decisions", "reason": "reasons"}


def least_p(replicates):
    """The smallest p that counting this many replicates can give; 0 without."""
    return 1 / (replicates + 1) if replicates else 0.0


def _counted(p, replicates):
    """p, p_is_bound, p_extrapolated: as the JSON of the diagnosis has them."""
    least = least_p(replicates)
    return {"p": max(p, least), "p_is_bound": bool(p <= least * (1 + 1e-9)), "p_extrapolated": p}


def _candidates(group, replicates):
    if group is None:
        return []
    names = [name for name in Candidate.__dataclass_fields__ if name not in ("p_is_bound", "p_extrapolated")]
    arrays = (getattr(group, _CANDIDATE_COLUMNS.get(name, name)).tolist() for name in names)
    rows = (dict(zip(names, values)) for values in zip(*arrays))
    return [Candidate(**{**row, **_counted(row["p"], replicates)}) for row in rows]


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
    cells = {
        name: group.get(names.get(name, name), np.empty(0))
        for name in (
            "start",
            "stop",
            "centre",
            "samples",
            "mean_residual",
            "twin_mean",
            "twin_std",
            "z",
            "after_residual",
            "after_z",
        )
    }
    regions = []
    if "regions" in group:
        found = group.regions
        regions = [
            Region(Interval(axis, start, stop, group.unit), *shares)
            for start, stop, *shares in zip(
                *(
                    getattr(found, key).tolist()
                    for key in ("from", "to", "time_share", "energy_share", "repeatable_share")
                )
            )
        ]
    # "unit" of the group is that of the axis, not of a dataset
    return MapRow(
        axis, group.attributes()["unit"], bool(group.is_spectrum), group.energy_share, group.p, **cells, regions=regions
    )


def _interval(group, name):
    return Interval(*(group.attributes()[f"{name}_{part}"] for part in ("axis", "from", "to", "unit")))


def _effect(group, replicates):
    plain = {name: group.get(name, "") for name in ("name", "family", "title", "equation", "acts_on", "sentence")}
    numbers = {name: group.get(name, UNKNOWN) for name in
               ("q", "z", "gain_train", "gain_cv", "rms", "peak")}
    region, curve = _interval(group, "region"), None
    places = [region]
    if "places" in group:
        ends = (getattr(group.places, key).tolist() for key in ("from", "to"))
        places = [Interval(region.axis, start, stop, region.unit) for start, stop in zip(*ends)]
    if "curve" in group:
        drawn = group.curve
        curve = Curve(_interval(drawn, "range"), drawn.at, drawn.partial, drawn.modelled, drawn.spread)
    return NamedEffect(
        **plain,
        **numbers,
        equivalent=group.get("equivalent", []),
        **_counted(group.get("p", UNKNOWN), replicates),
        region=region,
        places=places,
        parameters=_parameters(group.get("parameters")),
        curve=curve,
        is_fault=bool(group.get("is_fault", plain["acts_on"] not in ("", "joint"))),
    )


def _unexplained(group):
    if group is None:
        return []
    columns = (getattr(group, key).tolist() for key in ("axes", "from", "to", "units", "energy_share"))
    return [(Interval(*where), share) for *where, share in zip(*columns)]


def _trace(group):
    none = np.empty(0)
    arrays = {name: group.get(name, none) for name in ("time", "torque", "before", "after", "velocity", "position")}
    return Trace(group.recording, group.rate_hz, **arrays)
