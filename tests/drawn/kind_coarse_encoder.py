"""A coarse encoder, a coarse torque and pauses: rows repeat, and no source is slow. `check` must not say so."""

import numpy as np

from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=20.0, counts=int(10 ** rng.uniform(2.5, 4.3)))
    n = len(recording.time)
    if rng.random() < 0.5:  # rests at a place it has come to, for up to half of the time
        at, rows = int(rng.uniform(0.2, 0.8) * n), int(rng.uniform(0.05, 0.5) * n)
        for name in ("reference", "position", "torque"):
            values = getattr(recording, name)
            setattr(recording, name, np.concatenate([values[:at], np.full(rows, values[at]), values[at:]])[:n])
    if rng.random() < 0.5:
        step = recording.torque.std() * 10 ** rng.uniform(-2, -0.7)
        recording.torque = np.round(recording.torque / step) * step
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        check = call("check", "job.toml")
        wrong = check.topics() & {"slow_source", "sentinel", "single_wrong_rows"}
        return f"check says {wrong}: {check.text[-400:]}" if wrong else None

    return judge
