"""A slow source behind a fast log, a coarse encoder and a short recording: what `diagnose` says of it must not mislead.

The replicates move in a loop that was fitted between the readings of the drive. Where that loop holds no joint, nothing
is wrong with the columns: the verdict is that nothing is missing, or that noise hides it, with cut-offs as the way out.
"""

import numpy as np

from joint import draw_joint, record, write_csv, write_job
from kind_slow_source import ROLES, held

ALLOWED = ("none", "insufficient")
MISLEADING = ("runs away", "another signal", "wrong sign")


def draw(rng, folder):
    joint = draw_joint(rng)
    rate = float(rng.choice([500, 1000, 2000]))
    recording = record(rng, joint, rate=rate, seconds=rng.uniform(10, 20), noise=rng.uniform(0.05, 0.3),
                       counts=2 ** int(rng.integers(11, 14)))
    rows = int(rng.integers(5, max(6, rate // 55)))
    clock = rng.bit_generator.state  # one drive reads both
    for channel in ("position", "torque"):
        rng.bit_generator.state = clock
        setattr(recording, channel, held(rng, recording.time, getattr(recording, channel), rows / rate, 0.0))
    step = 2 * np.pi / 2 ** int(rng.integers(11, 14))
    recording.position = np.round(recording.position / step) * step
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    job = write_job(folder, "data.csv", ROLES)
    job.write_text(job.read_text().replace("decimate_to_hz = 50", "decimate_to_hz = 20").replace(
        "parallel_cutoff_hz = 10", "parallel_cutoff_hz = 6").replace("cutoff_hz = 20", "cutoff_hz = 12")
        + "\n[diagnose]\ntwins = 60\n")

    def judge(call):
        diagnosis = call("diagnose", "job.toml", "--out", "d.h5")
        if diagnosis.code:
            return f"diagnose ends with {diagnosis.code}: {diagnosis.text[-300:]}"
        verdict = diagnosis.document.get("verdict")
        said = " ".join(diagnosis.text.split())
        if verdict not in ALLOWED or any(words in said for words in MISLEADING):
            return f"{verdict}, {rows} rows of {rate:g} Hz: {said[-500:]}"
        return None

    return judge
