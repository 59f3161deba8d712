"""Records or columns of JSON, nested, for one joint or several, with numbers that are none."""

import json

import numpy as np

from drafted import draft, wrong_run
from joint import draw_joint, record


def nested(rng, signals, k):
    """One record, as programs nest it."""
    time, position, torque = signals["time"][k], signals["position"][k], signals["torque"][k]
    style = signals["style"]
    if style == "flat":
        return {"t": time, "q_rad": position[0], "tau_Nm": torque[0]}
    if style == "groups":
        return {"stamp": time, "joint": {"position": position[0], "torque": torque[0]}, "mode": "run"}
    return {"time": time, "state": {"position": position, "effort": torque}}


def draw(rng, folder):
    style = str(rng.choice(["flat", "groups", "lists"]))
    n = int(rng.integers(2, 7)) if style == "lists" else 1
    rate = float(rng.choice([100, 200, 250, 500]))
    joints = [draw_joint(rng) for _ in range(n)]
    recordings = [record(rng, joint, seconds=20, rate=rate) for joint in joints]
    signals = {"style": style, "time": [round(float(t), 6) for t in recordings[0].time]}
    for name in ("position", "torque"):
        rows = np.column_stack([getattr(one, name) for one in recordings])
        signals[name] = [[float(f"{value:.8g}") for value in row] for row in rows]
    if rng.random() < 0.3:
        for k in rng.choice(len(signals["time"]) - 2, 3, replace=False) + 1:
            signals["torque"][int(k)][0] = float("nan")
    records = [nested(rng, signals, k) for k in range(len(signals["time"]))]
    written = str(rng.choice(["records", "lines", "inside", "columns"]))
    if written == "lines":
        text = "\n".join(json.dumps(one) for one in records)
        if rng.random() < 0.5:
            text += "\n" + json.dumps(records[-1])[:-8]  # the last line was cut short
    elif written == "columns":
        text = json.dumps({"robot": {"name": "r"}, "time": signals["time"], "position": signals["position"],
                           "torque": signals["torque"]}, indent=int(rng.integers(0, 3)) or None)
    else:
        whole = {"meta": {"robot": "r", "rate": rate}, "samples": records} if written == "inside" else records
        text = json.dumps(whole, indent=int(rng.integers(0, 3)) or None)
    (folder / "data.json").write_text(text + ("\n" if rng.random() < 0.5 else ""))
    chosen = int(rng.integers(n))

    def judge(call):
        answer, job = draft(call, folder, "data.json", *(["--joint", chosen + 1] if n > 1 else []))
        if answer.code:
            return f"{style} {written}: init ends with {answer.code}: {answer.text[-400:]}"
        return wrong_run(call, joints[chosen])

    return judge
