"""The training recording as it went into the fit: position, velocity, torque over one time axis."""

import numpy as np

from .. import quantities, style, traces
from . import Case


def draw(time, rows, seams, width=style.WIDE):
    """rows: [(name, symbol, unit, part, values [n])]; seams: times where another recording begins."""
    drawn = [
        traces.Row(
            f"{name} ({unit})",
            symbol,
            unit,
            [traces.Line(part, values, style.LIGHT["ink"], thickness=1.1, label=name)],
            92,
            *traces.scale(values),
        )
        for name, symbol, unit, part, values in rows
    ]
    figure = traces.draw(time, drawn, (time[0], time[-1]), None, width)
    for axes in figure.axes:
        for seam in seams:
            axes.axvline(seam, color=style.LIGHT["muted"], linewidth=1, linestyle=(0, (2, 3)))
    return figure


def cases(study):
    data = study.train
    time = data.laid_end_to_end
    rows = [(name, symbol, quantities.unit(data.unit_of(key)), key, np.asarray(getattr(data, key)))
            for key, name, symbol in (("position", "position", "q"), ("velocity", "velocity", "q\u0307"),
                                      ("torque", study.effort, study.symbol))]
    seams = time[data.seams]
    sentence = "The rows after filtering." if study.rolled else "The samples the fit has used, after filtering."
    if len(seams):
        sentence += " Recordings are laid end to end, dotted lines between them."
    return {
        "recording_trace": Case(
            draw,
            {"time": time, "rows": rows, "seams": seams},
            "Position, velocity, " + study.effort,
            sentence,
            wide=True,
            traces={
                "time": time,
                "series": {key: values for *_, key, values in rows},
                "guide": data.torque,
                "guided_by": study.effort,
            },
        )
    }
