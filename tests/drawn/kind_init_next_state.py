"""A data set for imitation: the action is the position of a later row. Or it is a real command, which must stay."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record, write_csv

NAMES = [("observation.state", "observation.effort", "action"), ("q_rad", "tau_Nm", "q_ref_rad"),
         ("observation.state.elbow", "observation.effort.elbow", "action.elbow"), ("pos", "torque", "goal")]


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=60, rate=float(rng.choice([30, 50, 60, 100, 200])))
    position, torque, reference = NAMES[int(rng.integers(len(NAMES)))]
    is_next = rng.random() < 0.7
    ahead = int(rng.choice([1, 1, 1, 2, 3, 5]))
    n = len(recording.time)
    action = recording.position[np.minimum(np.arange(n) + ahead, n - 1)] if is_next else recording.reference
    if rng.random() < 0.5:
        action = action.astype(np.float32).astype(float)
    write_csv(folder / "data.csv", {"timestamp": recording.time, position: recording.position,
                                    torque: recording.torque, reference: action})

    def judge(call):
        answer, job = draft(call, folder, "data.csv")
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-300:]}"
        wrong = wrong_columns(job, {"time": "timestamp", "position": position, "torque": torque,
                                    "reference": None if is_next else reference})
        if wrong:
            return wrong
        if is_next and f"the position {ahead} row" not in " ".join(answer.text.split()):
            return f"it does not say so: {answer.text[-300:]}"
        # the same said by check of a job that names it
        text = (folder / "drafted.toml").read_text()
        if is_next:
            text = text.replace("[recording.columns]\n", f'[recording.columns]\nreference = "{reference}"\n')
            (folder / "drafted.toml").write_text(text)
        found = call("check", "drafted.toml").topics()
        if ("reference_is_position" in found) != is_next:
            return f"check says {found}"
        # below 100 Hz the reversals of so fast a motion are a few rows
        return wrong_run(call, joint, () if recording.rate < 100 else ("inertia", "viscous", "coulomb"))

    return judge
