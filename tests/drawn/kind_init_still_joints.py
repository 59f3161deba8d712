"""Several joints in one file of which only some move: init takes the first that moves, and says how to take another."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record, write_csv

NAMES = [("q{}_rad", "tau{}_Nm"), ("pos_{}", "effort_{}"), ("joint_{}/position", "joint_{}/torque"),
         ("theta{}_deg", "trq{}_Nm"), ("ActPos[{}]", "ActTorque[{}]")]
STILL = ["exactly", "tick", "noise", "torque_constant"]  # how a joint is none to be fitted


def still_joint(rng, recording, how):
    """Position and torque of a joint that nothing can be fitted to."""
    rows = len(recording.time)
    place = rng.uniform(-1.5, 1.5)
    held = rng.uniform(-3, 3) + 0.02 * rng.standard_normal(rows)
    if how == "torque_constant":
        return recording.position, np.full(rows, rng.choice([0.0, 1.0, -3.5]))
    if how == "tick":
        return place + 1e-4 * (rng.random(rows) < 0.2), held
    return (np.full(rows, place) if how == "exactly" else place + 2e-4 * rng.standard_normal(rows)), held


def draw(rng, folder):
    n = int(rng.integers(2, 8))
    first_moving = int(rng.integers(1, n))
    rate = float(rng.choice([100, 125, 200, 250, 500]))
    joints = [draw_joint(rng) for _ in range(n)]
    position, torque = NAMES[int(rng.integers(len(NAMES)))]
    first = int(rng.integers(0, 2))
    scale = 180 / np.pi if "deg" in position else 1.0
    positions, torques = {}, {}
    for k, joint in enumerate(joints):
        recording = record(rng, joint, seconds=25, rate=rate)
        q, tau = recording.position, recording.torque
        if k < first_moving or (k > first_moving and rng.random() < 0.5):
            q, tau = still_joint(rng, recording, str(rng.choice(STILL)))
        positions[position.format(first + k)] = scale * q
        torques[torque.format(first + k)] = tau
    write_csv(folder / "data.csv", {"t_s": recording.time, **positions, **torques})

    def judge(call):
        answer, job = draft(call, folder, "data.csv")
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-400:]}"
        wrong = wrong_columns(job, {"position": position.format(first + first_moving),
                                    "torque": torque.format(first + first_moving)})
        if wrong:
            return wrong
        text = " ".join(answer.text.split())
        for words in (f"joint {first_moving + 1} of {n};", "--joint N takes another", "the first that moves"):
            if words not in text:
                return f"it does not say {words!r}: {text[-600:]}"
        asked, other = draft(call, folder, "data.csv", "--joint", 1)
        wrong = wrong_columns(other, {"position": position.format(first)})
        if wrong:
            return f"--joint 1: {wrong}: {asked.text[-300:]}"
        draft(call, folder, "data.csv")
        return wrong_run(call, joints[first_moving])

    return judge
