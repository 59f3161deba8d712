"""One wrong row that moves a parameter by more than its error: found and filled, or `run` says where it stands."""

import re

import numpy as np

from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
TOLERANCE = 0.1


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=float(rng.uniform(8, 20)))
    n = len(recording.time)
    row = int(rng.uniform(0.2, 0.8) * n)
    channel = str(rng.choice(["torque", "position"]))
    values = getattr(recording, channel)
    # between what a filter takes away and what is found row by row
    size = np.ptp(values) * (rng.uniform(1, 4) if channel == "torque" else rng.uniform(0.02, 1.0))
    values[row] += rng.choice([-1, 1]) * size
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        case = f"{size:.3g} in one row of {channel}"
        run = call("run", "job.toml", "--out", "r.h5")
        if run.code:
            return f"{case}: run ends with {run.code}: {run.text[-300:]}"
        text = " ".join(run.text.split())
        place = re.search(r"line ([0-9]+) at [0-9.]+ s, is far from its neighbours", text)
        if place:
            return None if int(place.group(1)) == row + 2 else f"{case}: {place.group(0)}, and it is line {row + 2}"
        if "single wrong rows" in text or "spikes" in text:
            return None
        wrong = run.wrong_parameters(joint, TOLERANCE)
        return f"{case}: {wrong}, and not a word" if wrong else None

    return judge
