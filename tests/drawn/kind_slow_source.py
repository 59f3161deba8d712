"""A log that is faster than the source of the position or the torque: rows come in runs of equal values.

Periods, phases, jitter and channels are drawn; the command is logged at the full rate. `check` must name each slow
channel with its rate, and `run` must give what was put in, or refuse with the cut-off to write, which then works.
"""

import re

import numpy as np

from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
TOLERANCE = {"inertia": 0.1, "viscous": 0.2, "coulomb": 0.15}  # a jump of the friction lasts a whole period
RATE_TOLERANCE = 0.03


def held(rng, time, values, period, jitter):
    """The values as a source shows them that reads them every `period` seconds, not quite evenly."""
    n = int(time[-1] / period) + 3
    reads = (np.arange(n) - rng.uniform(0, 1) + jitter * rng.uniform(-0.5, 0.5, n)) * period
    last = np.searchsorted(reads, time - time[0], side="right") - 1
    return np.interp(np.maximum(reads, 0), time - time[0], values)[np.maximum(last, 0)]


def draw_periods(rng, rate):
    """Rows from one value to the next of position and torque; None is every row."""
    one = rng.uniform(2, max(2.5, rate / 60)) if rng.random() < 0.5 else int(rng.integers(2, max(3, rate // 60)))
    other = rng.uniform(2, max(2.5, rate / 60))
    return [(one, one), (one, other), (one, None), (None, one)][int(rng.choice(4, p=[0.5, 0.3, 0.1, 0.1]))]


def draw(rng, folder):
    joint = draw_joint(rng)
    rate = float(rng.choice([500, 800, 1000, 2000]))
    recording = record(rng, joint, rate=rate, seconds=24.0)
    jitter = float(rng.choice([0.0, 0.0, 0.2, 0.5]))
    periods = dict(zip(("position", "torque"), draw_periods(rng, rate)))
    clock = rng.bit_generator.state  # equal periods are one source
    for channel, rows in periods.items():
        if rows is None:
            continue
        if periods["position"] == periods["torque"]:
            rng.bit_generator.state = clock
        values = held(rng, recording.time, getattr(recording, channel), rows / rate, jitter)
        if channel == "position":
            values = np.round(values / 1e-5) * 1e-5
        setattr(recording, channel, values)
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    job = write_job(folder, "data.csv", ROLES)

    def judge(call):
        check = call("check", "job.toml")
        said = " ".join(line["text"] for line in check.document.get("lines", []) if line["topic"] == "slow_source")
        for channel, rows in periods.items():
            if (rows is not None) != (ROLES[channel] in said):
                return f"{channel} every {rows} rows, jitter {jitter}: slow_source says: {said or 'nothing'}"
            if rows is None:
                continue
            hertz = float(re.search(rf"{ROLES[channel]}\"? is renewed at ([0-9.]+) Hz", said).group(1))
            if abs(hertz - rate / rows) > RATE_TOLERANCE * rate / rows:
                return f"{channel}: {hertz} Hz, true {rate / rows:.4g}"
        run = call("run", "job.toml", "--out", "r.h5")
        if run.code:
            advised = re.search(r"(parallel_cutoff_hz|cutoff_hz) = ([0-9.]+)", run.text.split("help:")[-1])
            if not advised:
                return f"run ends with {run.code} and advises nothing: {run.text[-300:]}"
            key, value = advised.groups()
            job.write_text(re.sub(rf"^{key} = .*$", f"{key} = {value}", job.read_text(), flags=re.MULTILINE))
            run = call("run", "job.toml", "--out", "r.h5")
        wrong = run.wrong_parameters(joint, TOLERANCE)
        return f"{wrong}; rows {periods}, jitter {jitter}, {rate:g} Hz" if wrong else None

    return judge
