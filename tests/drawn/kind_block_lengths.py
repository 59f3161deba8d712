"""Channels of other lengths in one .npz or .mat, each with a vector of time stamps of its own, or without one."""

import h5py
import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record

NAMES = [("tq", "q", "ttau", "tau"), ("t_pos", "position", "t_trq", "torque"),
         ("time_q", "q_rad", "time_tau", "tau_Nm"),
         ("T_q", "q", "T_tau", "tau"), ("time1", "pos", "time2", "effort")]


def write(path, signals):
    if path.suffix == ".npz":
        return np.savez(path, **signals)
    with h5py.File(path, "w") as file:
        for name, values in signals.items():
            file[name] = values


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=rng.uniform(20, 40), noise=0.005)
    share = float(rng.choice([0.5, 0.8, 2.0]))
    start = rng.uniform(0, 0.3)
    slow = np.arange(start, recording.time[-1] - rng.uniform(0, 0.3), 1 / (share * recording.rate))
    torque = np.interp(slow, recording.time, recording.torque)
    tq, q, ttau, tau = NAMES[int(rng.integers(len(NAMES)))]
    has_clock = rng.random() < 0.75
    signals = {tq: recording.time, q: recording.position, tau: torque}
    if has_clock:
        signals[ttau] = slow
    signals["gain"] = np.array([rng.uniform(1, 5)])
    order = list(signals)
    file = folder / ("data" + str(rng.choice([".npz", ".mat"])))
    write(file, {order[k]: signals[order[k]] for k in rng.permutation(len(order))})

    def judge(call):
        answer, job = draft(call, folder, file.name)
        if not has_clock:
            text = " ".join(answer.text.split())
            said = answer.code in (65, 78) and str(len(torque)) in text and str(len(recording.time)) in text
            return None if said else f"no clock of {len(torque)}: {answer.code}: {text[-500:]}"
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-500:]}"
        wrong = wrong_columns(job, {"time": tq, "position": q, "torque": tau})
        if wrong or job["recording"].get("clocks") != {"torque": ttau}:
            return wrong or f"clocks {job['recording'].get('clocks')}"
        return wrong_run(call, joint)

    return judge
