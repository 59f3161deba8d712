"""The zero of the torque sensor steps once, or drifts in proportion to time; the position goes on unbroken."""

import numpy as np
from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
TOLERANCE = 0.1  # of a parameter, as in kind_sound.py
INSTANT_S = 0.5
SIZE = 0.15


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=rng.uniform(25, 50), noise=rng.uniform(0.002, 0.03))
    steps = rng.random() < 0.6
    size = rng.choice([-1, 1]) * rng.uniform(0.12, 0.8) * recording.torque.std()
    last = recording.time[-1]
    at = rng.uniform(0.15, 0.85) * last
    if steps:
        recording.torque = recording.torque + size * (recording.time >= at)
    else:
        recording.torque = recording.torque + size * recording.time / last
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        topic = "torque_zero_steps" if steps else "torque_zero_drifts"
        check = call("check", "job.toml")
        line = next((one for one in check.document.get("lines", []) if one["topic"] == topic), None)
        if line is None:
            return f"check does not say {topic} ({size / recording.torque.std():.2f} of the torque): {check.topics()}"
        words = line["text"].replace("(", " ").replace(")", " ").split()
        said = float(words[words.index("by") + 1])
        if abs(said - size) > SIZE * abs(size):
            return f"size {size:.3g}, said {said:.3g}"
        if steps and abs(float(words[words.index("at") + 1]) - at) > INSTANT_S:
            return f"at {at:.2f} s: {line['text']}"
        return call("run", "job.toml", "--out", "r.h5").wrong_parameters(joint, TOLERANCE)

    return judge
