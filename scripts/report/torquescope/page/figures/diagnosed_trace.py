"""The motion of a recording, its torque measured and predicted before and after, and what is left: aligned rows."""

import numpy as np

from .. import diagnosed, quantities, style, traces
from . import Case

WITHIN = ("velocity", "position", "time")  # axes whose value a trace holds sample by sample


def draw(time, position, torque, before, after, window, regions, effort, symbol, unit, width=style.WIDE):
    """Arrays [n]; position: (values, unit), None where it is not known; before, after: residuals; after: None without
    one; regions [k][2]: times between which the motion is inside a located region."""
    measured = traces.Line("measured", torque, style.LIGHT["measured"], thickness=4, label="measured")
    when = {"before": " before", "after": " after"} if after is not None else {"before": ""}
    predicted = [traces.Line(f"measured-{part}", torque - values, style.LIGHT[colour], thickness=thickness,
                             label=f"predicted{when[part]}")
                 for part, values, colour, thickness in (("before", before, "baseline", 1.9),
                                                         ("after", after, "augmented", 1.2)) if values is not None]
    rows = [traces.Row(f"{effort} ({unit})", symbol, unit, [measured, *predicted], 170, *traces.scale(torque))]
    limit = 1.05 * float(np.nanmax(np.abs(before)))
    for part, values, colour in (("before", before, "baseline"), ("after", after, "augmented")):
        if values is not None:
            words = f"residual{when[part]}"
            line = traces.Line(part, values, style.LIGHT[colour], thickness=1.1, label=words)
            rows.append(traces.Row(f"{words} ({unit})", symbol, unit, [line], 84, -limit, limit))
    if position is not None:
        values, of = position
        line = traces.Line("position", values, style.LIGHT["ink"], thickness=1.1)
        rows.append(traces.Row(f"position ({of})", "q", of, [line], 64, *traces.scale(values)))
    return traces.draw(time, rows, window, traces.Line("measured", torque, style.LIGHT["ink"]), width, regions)


def window_of_most_gain(time, before, after, length=traces.OPENED_S):
    """(start, stop) of the `length` seconds in which the residual's energy falls most, or is largest without an
    after."""
    first, last = float(time[0]), float(time[-1])
    if last - first <= 1.3 * length:
        return first, last
    gain = np.nan_to_num(before) ** 2 - (np.nan_to_num(after) ** 2 if after is not None else 0.0)
    summed = np.concatenate([[0.0], np.cumsum(gain)])
    ends = np.searchsorted(time, time + length, "right")
    starts = np.arange(len(time))[time <= last - length]
    start = max(round(float(time[starts[np.argmax(summed[ends[starts]] - summed[starts])]]), 1), first)
    return start, start + length


def times_inside(trace, intervals):
    """[k][2]: when the motion is inside one of the intervals (of axes in WITHIN)."""
    inside = np.zeros(len(trace.time), dtype=bool)
    for interval in intervals:
        values = getattr(trace, interval.axis)
        if len(values):
            inside |= (values >= interval.start) & (values <= interval.stop)
    turns = np.flatnonzero(np.diff(np.concatenate([[False], inside, [False]]).astype(int))).reshape(-1, 2)
    return [(float(trace.time[begin]), float(trace.time[end - 1])) for begin, end in turns if end - begin > 1]


def cases(study):
    found = {}
    for joint in study.diagnosis.joints:
        regions = [e.region for e in joint.effects] + [where for where, _ in joint.unexplained]
        regions = [region for region in regions if region.axis in WITHIN]
        for number, trace in enumerate(joint.traces, start=1):
            if not len(trace.time) or not np.isfinite(trace.before).any():
                continue
            name = diagnosed.figure_name(study, joint, f"trace_{number}")
            found[name] = _case(study, joint, trace, regions)
    return found


def _case(study, joint, trace, regions):
    after = trace.after if diagnosed.has_after(joint) and np.isfinite(trace.after).any() else None
    has_position = len(trace.position) == len(trace.time) and np.isfinite(trace.position).any()
    position = (trace.position, quantities.unit(joint.unit_position)) if has_position else None
    window = window_of_most_gain(trace.time, trace.before, after)
    arguments = {
        "time": trace.time,
        "position": position,
        "torque": trace.torque,
        "before": trace.before,
        "after": after,
        "window": window,
        "regions": times_inside(trace, regions),
        "effort": study.effort,
        "symbol": study.symbol,
        "unit": quantities.unit(joint.unit_torque),
    }
    whole = window[1] - window[0] >= trace.time[-1] - trace.time[0]
    opened = "" if whole else (" Opened on the six seconds that gain most." if after is not None
                               else " Opened on the six seconds with most residual.")
    gaps = " Gaps: rows that are left out, where the joint turns round." if np.isnan(trace.before).any() else ""
    sentence = f"Grey: measured. Below: what is left, on one scale.{gaps}{opened}"
    if regions:
        shaded = quantities.listed(dict.fromkeys(diagnosed.axis_title(r.axis) for r in regions))
        sentence += f" Shaded: {shaded} in the located region."
    # the page's script subtracts: "measured-before" is what the model predicts
    series = {"measured": trace.torque, "before": trace.before} | ({"after": after} if after is not None else {})
    if has_position:
        series["position"] = trace.position
    return Case(draw, arguments, f"{study.effort.capitalize()} of {trace.recording}", sentence, wide=True,
                traces={"time": trace.time, "series": series, "guide": trace.before, "guided_by": "residual"})
