"""A value that is no data (9999, -1, ...) in some rows of one column, singly or several in a row.

`check` must say which value, and `run` must give what was put in; what is away for long is left out.
"""

import numpy as np

from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
TOLERANCE = 0.1


def drawn_value(rng, values):
    """Far outside of the range, or at any distance that no motion makes in a row."""
    if rng.random() < 0.7:
        return float(rng.choice([9999, -9999, 999.0, 32767, -32768, 65535, 1e6, -1e30, 3.4028235e38]))
    middle, half = (values.max() + values.min()) / 2, np.ptp(values) / 2
    return round(middle + rng.choice([-1, 1]) * rng.uniform(1.5, 10) * half, 2)


def drawn_rows(rng, n):
    """Every so many rows, at random, or a few stretches of up to five."""
    kind = rng.integers(3)
    if kind == 0:
        return np.arange(int(rng.integers(5, 100)), n, int(rng.integers(25, 400)))
    if kind == 1:
        return np.sort(rng.choice(np.arange(5, n - 5), int(rng.integers(4, n // 50)), replace=False))
    starts = rng.choice(np.arange(5, n - 20, 12), int(rng.integers(3, 12)), replace=False)
    return np.sort(np.concatenate([one + np.arange(int(rng.integers(1, 6))) for one in starts]))


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint)
    channel = str(rng.choice(["torque", "position"]))
    values = getattr(recording, channel).copy()
    value, rows = drawn_value(rng, values), drawn_rows(rng, len(values))
    values[rows] = value
    setattr(recording, channel, values)
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        case = f"{value:g} in {len(rows)} rows of {channel}"
        check = call("check", "job.toml")
        said = " ".join(line["text"] for line in check.document.get("lines", [])
                        if line["topic"] in ("sentinel", "single_wrong_rows", "torque_spikes"))
        if ROLES[channel] not in said or f"{value:.10g}" not in said and f"{value:g}" not in said:
            return f"{case}: check says {said or check.text[-300:]}"
        if check.topics("fault"):
            return f"{case}: check finds {check.topics('fault')}"
        wrong = call("run", "job.toml", "--out", "r.h5").wrong_parameters(joint, TOLERANCE)
        return f"{case}: {wrong}" if wrong else None

    return judge
