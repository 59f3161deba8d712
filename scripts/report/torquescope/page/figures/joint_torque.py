"""Measured and predicted torque of every joint of an arm, with what is left of it below."""

import numpy as np

from .. import quantities, style, traces
from . import Case


def draw(time, measured, model, label, window, symbol, unit, width=style.WIDE):
    """time, measured, model [m], NaN where rows were left out."""
    over = [traces.Line("measured", measured, style.LIGHT["measured"], thickness=4, label="measured"),
            traces.Line("model", model, style.LIGHT["ink"], thickness=1.4, label=label)]
    left = measured - model
    reach = 1.05 * float(np.nanmax(np.abs(left))) or 1.0
    rows = [traces.Row(f"torque ({unit})" if symbol == "τ" else f"force ({unit})", symbol, unit, over, 130,
                       *traces.scale(measured)),
            traces.Row(f"measured minus {label} ({unit})", symbol, unit,
                       [traces.Line("measured-model", left, style.LIGHT["ink"], thickness=1.1,
                                    label=f"measured minus {label}")], 64, -reach, reach)]
    return traces.draw(time, rows, window, traces.Line("measured", measured, style.LIGHT["measured"]), width)


def cases(study):
    e, found = study.arm.reference(study), {}
    for joint in study.arm.joints:
        rows, which = joint.validation_or_train
        if rows is None:
            continue
        time, measured, model = rows.with_gaps(rows.torque, rows.prediction(e.chosen))
        is_force = rows.unit == "N"
        arguments = {"time": time, "measured": measured, "model": model, "label": e.short,
                     "window": traces.window_with_most(np.flatnonzero(np.isnan(measured)), time),
                     "symbol": "F" if is_force else "τ", "unit": quantities.unit(rows.unit)}
        found[f"joint_torque_{joint.number}"] = Case(
            draw, arguments, f"{joint.heading}: {'force' if is_force else 'torque'}, {which} recording",
            f"Grey: measured. Black: {e.short}. Gaps: rows near a reversal, which the fit leaves out.", wide=True,
            traces={"time": time, "series": {"measured": measured, "model": model}, "guide": measured - model,
                    "guided_by": "residual"})
    return found
