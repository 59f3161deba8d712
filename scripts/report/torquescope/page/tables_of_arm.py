"""The tables of the page of an arm as rows of finished words."""

import numpy as np

from . import quantities as q, words

STRONGEST = 10  # pairs of columns that are listed


def parameters(study):
    """{"head": [...], "rows": [[...]]}: each parameter by the reference estimator with its interval, what it is known
    to be, the other estimators."""
    e = study.arm.reference(study)
    others = [one for one in study.estimators if one is not e]
    known, origin = study.arm.known_values(study)
    errors = e.standard_error[0] if e.standard_error is not None else np.full(len(study.model.names), np.nan)
    head = ["parameter", "unit", e.short, "± 95 %"]
    head += [origin, "difference, standard errors"] if known is not None else []
    head += [one.short for one in others]
    seen = study.arm.seen
    head += ["seen"] if seen is not None else []
    rows = []
    for k, (name, unit) in enumerate(zip(study.model.names, study.model.units)):
        half = words.Z95 * errors[k]
        decimals = max(q.decimals_for(half, e.chosen[k]), 0)
        row = [name, q.unit(unit), q.fixed(e.chosen[k], decimals), q.fixed(half, decimals)]
        if known is not None:
            row += [q.fixed(known[k], decimals), q.fixed((e.chosen[k] - known[k]) / errors[k], 1)]
        row += [q.fixed(one.chosen[k], decimals) for one in others]
        rows.append(row + ([seen[k]] if seen is not None else []))
    return {"head": head, "rows": rows}


def gathers(study):
    rows = [[name, total] for name, total in zip(study.arm.base_parameters, study.arm.gathers) if total != name]
    return {"head": ["parameter", "is the sum"], "rows": rows}


def errors(study):
    """Relative errors in % joint by joint, of every estimator: rows that move one way, and all rows."""
    head, validation = ["joint"], study.validate is not None
    kinds = [("", "joint_relerr", "relerr_median"), (", all rows", "joint_relerr_all_rows", "relerr_all_rows")]
    columns = []
    for e in study.estimators:
        for label, of_joints, of_arm in kinds:
            parts = [("train", of_joints, of_arm)]
            if validation:
                parts.append(("validation", "validation_" + of_joints, "validation_" + of_arm))
            for which, joints_key, arm_key in parts:
                head.append(f"{e.short}, {which}{label}")
                columns.append((getattr(e, joints_key), getattr(e, arm_key)))

    def cell(value):
        return q.percent(value, 3)

    rows = [[joint.title] + [cell(shares[index]) if shares is not None else "–" for shares, _ in columns]
            for index, joint in enumerate(study.arm.joints)]
    rows.append(["arm"] + [cell(total) for _, total in columns])
    return {"head": head, "rows": rows}


def strongest_correlations(study):
    """The pairs of columns that the motion tells apart worst."""
    matrix, names = np.array(study.health.correlation, dtype=float), study.model.names
    first, second = np.triu_indices(len(names), 1)
    strength = np.abs(matrix[first, second])
    order = np.argsort(-strength, kind="stable")[:STRONGEST]
    rows = [[f"{names[first[k]]}, {names[second[k]]}", q.fixed(matrix[first[k], second[k]], 2)] for k in order]
    return {"head": ["columns", "correlation"], "rows": rows}
