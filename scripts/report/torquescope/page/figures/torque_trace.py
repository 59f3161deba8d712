"""Measured and predicted torque with what is left of it below, one row per estimator on one scale: Fig. 6 of the
seed."""

import numpy as np

from .. import quantities, style, traces
from . import Case


def draw(time, measured, predictions, band, window, effort, symbol, unit, width=style.WIDE):
    """predictions: [(label, part, values [n], colour, dashes, residual std)]; band: half height of the grey band."""
    line = traces.Line("measured", measured, style.LIGHT["measured"], thickness=4, label="measured")
    # lines that coincide are still seen: each is thinner than the one below it, and dashed ones lie on top
    over = [
        traces.Line(
            part,
            values,
            colour,
            dashes,
            1.5 if dashes != "solid" else 1.4 + 0.5 * min(len(predictions) - 1 - at, 3),
            dashes != "solid",
            label,
        )
        for at, (label, part, values, colour, dashes, _) in enumerate(predictions)
    ]
    rows = [traces.Row(f"{effort} ({unit})", symbol, unit, [line] + over, 170, *traces.scale(measured))]
    largest = max(np.nanmax(np.abs(measured - values)) for _, _, values, *_ in predictions)
    for label, part, values, colour, _, deviation in predictions:
        words = f"{label}: measured minus predicted ({unit})" if width >= style.WIDE else f"{label}: residual ({unit})"
        if np.isfinite(deviation):
            words += f", std {quantities.number(deviation)}"
        rows.append(
            traces.Row(
                words,
                symbol,
                unit,
                [traces.Line(f"measured-{part}", measured - values, colour, thickness=1.1, label=label)],
                64,
                -1.05 * largest,
                1.05 * largest,
                band,
            )
        )
    return traces.draw(time, rows, window, traces.Line("measured", measured, style.LIGHT["measured"]), width)


def cases(study):
    found = {}
    of_rows = [(index, e) for index, e in enumerate(study.estimators) if not e.rolls_out]
    for part, data in (("validate", study.validate), ("train", study.train)):
        if data is None or not of_rows:  # simulations are drawn by replay_trace.py
            continue
        time = data.laid_end_to_end
        reversals = np.flatnonzero(np.diff(np.sign(data.velocity)))
        predictions, series = [], {"measured": data.torque}
        for index, e in of_rows:
            values = data.prediction(e.chosen)
            deviation = e.residual_std[int(e.median_run or 0)] if part == "train" else np.nan
            predictions.append((e.short, f"e{index}", values, e.ink, e.dashes, deviation))
            series[f"e{index}"] = values
        arguments = {
            "time": time,
            "measured": data.torque,
            "predictions": predictions,
            "band": 2 * float(study.lead.residual_std_median),
            "window": traces.window_with_most(reversals, time),
            "effort": study.effort,
            "symbol": study.symbol,
            "unit": quantities.unit(study.effort_unit),
        }
        which = "the validation recording" if part == "validate" else "the training recording"
        start, stop = arguments["window"]
        opened = "" if stop - start >= time[-1] - time[0] else " Opened on the six seconds with most reversals."
        sentence = (f"Grey: measured. Below, what each estimate leaves; band: ±2 standard deviations of the "
                    f"{study.lead.short} residual in training.{opened}")
        found[f"torque_trace_{part}"] = Case(
            draw,
            arguments,
            f"{study.effort.capitalize()} of {which}",
            sentence,
            wide=True,
            traces={"time": time, "series": series, "guide": data.torque - predictions[0][2], "guided_by": "residual"},
        )
    return found
