"""Results as pandas and xarray have them: labels, units, dimensions with names."""

import numpy as np

from .errors import UsageError
from .reader.read_result import rolls_out

# dimensions of the datasets of an estimator (engine/store/RESULT_FORMAT.md); others have one number a run
RUNS = {"parameters": ("run", "parameter"), "standard_error": ("run", "parameter"),
        "standard_error_naive": ("run", "parameter"), "ci95": ("run", "parameter", "bound"),
        "joint_form": ("run", "joint_form"), "joint_form_standard_error": ("run", "joint_form"),
        "population": ("run", "generation", "member", "parameter"), "fitness": ("run", "generation", "member"),
        **{name: ("run", "generation") for name in ("F", "CR", "PC", "FC", "best", "gap_history", "evaluations")},
        **{name: ("run",) for name in ("mse", "gap", "relerr", "validation_relerr", "residual_std", "residual_mean",
                                       "validation_residual_std", "sse", "stop_reason", "last_generation")}}
SUMMARY = ("kind", "runs", "mse_median", "gap_median", "relerr_median", "validation_relerr_median",
           "residual_std_median", "evaluations_total")


def frame(result, table):
    """See Result.to_frame()."""
    import pandas
    makers = {"parameters": _parameters_of_diagnosis, "effects": _effects, "candidates": _candidates, "map": _map} \
        if result.diagnosis else {"parameters": _parameters_of_run, "estimators": _estimators}
    if not result.diagnosis and not result.estimators:
        makers = {"parameters": _parameters_of_servo, "recordings": _recordings_of_servo} if result.servo() else {}
    if table not in makers:
        raise UsageError(f"error: this result has no table {table!r}\n  it has: {', '.join(makers) or 'none'}")
    rows, index = makers[table](result)
    made = pandas.DataFrame(rows)
    return made.set_index(index) if len(made) else made


def _parameters_of_run(result):
    truth = result.model.get("truth")
    rows = []
    for i, (name, unit) in enumerate(zip(result.model.names, result.units)):
        row = {"parameter": str(name), "unit": str(unit)}
        if truth is not None and not np.all(np.isnan(truth)):
            row["truth"] = truth[i]
        for label, one in result.estimators.items():
            run = int(one.get("median_run", 0))
            row[label] = one.parameters[run, i]
            if "ci95" in one:
                row[f"{label}_low"], row[f"{label}_high"] = one.ci95[run, i]
        rows.append(row)
    return rows, "parameter"


def _before_after(name, one, sides):
    """A row of a table; sides: [(label, {name: Parameter})]."""
    row = {"parameter": name, "unit": one.unit}
    for label, known in sides:
        found = known.get(name)
        row[label] = found.value if found else np.nan
        row[f"{label}_low"] = found.lower if found else np.nan
        row[f"{label}_high"] = found.upper if found else np.nan
    return row


def _parameters_of_servo(result):
    servo = result.servo()
    sides = (("before", servo.parameters_before), ("after", servo.parameters))
    rows = [_before_after(name, one, sides) for name, one in {**servo.parameters_before, **servo.parameters}.items()]
    return rows, "parameter"


def _recordings_of_servo(result):
    """With the quantities of the manifest; errors in `unit`."""
    servo = result.servo()
    rows = [{"recording": one.name, "role": one.role, **one.quantities, "samples": one.samples, "unit": servo.unit,
             "before": one.before, "after": one.after, "relerr_before": one.relerr_before,
             "relerr_after": one.relerr_after, "horizon_s": one.horizon_s} for one in servo.recordings]
    return rows, "recording"


def _estimators(result):
    rows = []
    for name, one in result.estimators.items():
        row = {"estimator": name, **{key: one.get(key, np.nan) for key in SUMMARY}}
        if simulates := rolls_out(one):
            row["gap_median"] = np.nan  # what the file has there is the fitness
        rows.append({**row, "errors_of": "simulated samples" if simulates else "rows"})
    return rows, "estimator"


def _parameters_of_diagnosis(result):
    rows = []
    for joint in result.joints:
        for name, one in {**joint.baseline, **joint.augmented}.items():
            sides = (("before", joint.baseline), ("after", joint.augmented))
            rows.append({"joint": joint.joint, **_before_after(name, one, sides)})
    return rows, ["joint", "parameter"]


def _effects(result):
    keys = ("family", "title", "p", "p_is_bound", "q", "z", "gain_train", "gain_cv", "rms", "peak", "is_fault",
            "sentence")
    return [{"joint": number, "effect": one.name, **{key: getattr(one, key) for key in keys},
             "equivalent": ", ".join(one.equivalent)}
            for number, of in _with_the_arm(result) for one in of.effects], ["joint", "effect"]


def _with_the_arm(result):
    """(number, what has effects and candidates): the whole arm as joint 0, then its joints."""
    arm = result.diagnosis.arm if result.diagnosis else None
    return [*([(0, arm)] if arm else []), *((joint.joint, joint) for joint in result.joints)]


def _candidates(result):
    keys = ("family", "decision", "reason", "z", "p", "p_is_bound", "q", "gain", "cv_gain")
    return [{"joint": number, "effect": one.name, **{key: getattr(one, key) for key in keys}}
            for number, of in _with_the_arm(result) for one in of.candidates], ["joint", "effect"]


def _map(result):
    keys = ("centre", "start", "stop", "samples", "mean_residual", "twin_mean", "twin_std", "z", "after_residual",
            "after_z")
    return [{"joint": joint.joint, "axis": row.axis, "cell": cell, "unit": row.unit,
             **{key: getattr(row, key)[cell] for key in keys if len(getattr(row, key)) > cell}}
            for joint in result.joints for row in joint.map.values()
            for cell in range(len(row.z))], ["joint", "axis", "cell"]


def dataset(result, part, joint):
    """See Result.to_xarray()."""
    if part in result.estimators:
        return _of_estimator(result, part)
    if part.startswith("trace_") and result.diagnosis:
        return _of_trace(result, part, joint)
    data = {"train": result.train, "validate": result.validate}.get(part)
    if data is None:
        known = [*(["train"] if result.train else []), *(["validate"] if result.validate else []), *result.estimators,
                 *(f"trace_{k + 1}" for one in result.joints[:1] for k in range(len(one.traces)))]
        raise UsageError(f"error: this result has no part {part!r}\n  it has: {', '.join(known)}")
    return _of_rows(result, data, joint)


def _variable(group, name, dims):
    return dims, getattr(group, name), {"units": group.unit(name), "long_name": group.long_name(name)}


def _of_rows(result, data, joint):
    import xarray
    names, attributes = result.model.names, data.attributes()
    if "regressor" in data:
        names = names[:data["regressor"].shape[1]]  # effects and loops that are simulated have no column
    if "arm" in result:
        number = joint or 1
        data = getattr(data, f"joint_{number}")
        names = names[getattr(result.arm, f"joint_{number}").parameters]
    if "torque" not in data:
        raise UsageError("error: this result keeps no rows: its job says [output] samples = false")
    signals = [name for name in ("position", "velocity", "acceleration", "torque") if name in data]
    variables = {name: _variable(data, name, ("sample",)) for name in signals}
    variables["regressor"] = _variable(data, "regressor", ("sample", "parameter"))
    coordinates = {"time": _variable(data, "time", ("sample",)), "parameter": [str(name) for name in names],
                   "recording": _variable(data, "recording", ("sample",))}
    plain = {key: value for key, value in attributes.items() if isinstance(value, (int, float, str))}
    return xarray.Dataset(variables, coordinates, plain)


def _of_estimator(result, name):
    import xarray
    group = result.estimators[name]
    coordinates = {"parameter": [str(one) for one in result.model.names], "bound": ["low", "high"]}
    if "generation" in group:
        coordinates["generation"] = group.generation  # which ones are stored: [output] history
    variables = {one: _variable(group, one, dims) for one, dims in RUNS.items() if one in group}
    used = {dim for dims, _, _ in variables.values() for dim in dims}
    return xarray.Dataset(variables, {key: value for key, value in coordinates.items() if key in used},
                          {"estimator": name, "kind": group.kind})


def _of_trace(result, part, joint):
    import xarray
    found = [one for one in result.joints if one.joint == (joint or 1)]
    number = part.removeprefix("trace_")
    if not found or not number.isdigit() or not 1 <= int(number) <= len(found[0].traces):
        raise UsageError(f"error: joint {joint or 1} has no {part}")
    one, trace = found[0], found[0].traces[int(number) - 1]
    units = {"torque": one.unit_torque, "before": one.unit_torque, "after": one.unit_torque,
             "velocity": f"{one.unit_position}/s", "position": one.unit_position}
    names = {"torque": "measured torque", "before": "residual of the baseline",
             "after": "residual with the effects in the model", "velocity": "velocity", "position": "position"}
    variables = {key: (("time",), getattr(trace, key), {"units": unit, "long_name": names[key]})
                 for key, unit in units.items() if len(getattr(trace, key)) == len(trace.time)}
    return xarray.Dataset(variables, {"time": (("time",), trace.time, {"units": "s", "long_name": "time"})},
                          {"recording": trace.recording, "rate_hz": trace.rate_hz})
