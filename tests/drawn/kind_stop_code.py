"""The commanded position holds a stop code: in every row, or in a stretch of them."""

import numpy as np
from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
TOLERANCE = 0.1  # of a parameter, as in kind_sound.py
CODES = [2.146e9, 16000, 32767, -32768, 1e9, 65535, 2147483647, -1, 0, 999.999, "NaN", "nan", ""]


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, noise=rng.uniform(0.005, 0.02))
    columns = {ROLES[role]: values for role, values in recording.columns().items()}
    code = CODES[int(rng.integers(len(CODES)))]
    everywhere = rng.random() < 0.6 or isinstance(code, str) or abs(code) < 100
    n = len(recording.time)
    held = np.ones(n, bool)
    if not everywhere:
        first = int(rng.uniform(0.1, 0.6) * n)
        held = (np.arange(n) >= first) & (np.arange(n) < first + rng.uniform(0.05, 0.35) * n)
    reference = [code if now else one for now, one in zip(held, columns["q_ref_rad"])]
    columns["q_ref_rad"] = [one if isinstance(one, str) else "%.10g" % one for one in reference]
    write_csv(folder / "data.csv", columns)
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        check = call("check", "job.toml")
        said = check.topics("warn", "fault")
        if "encoding" in check.text or check.topics("fault"):
            return f"{code}: check finds {said}"
        if not said:
            return f"{code}: check says nothing"
        wrong = call("run", "job.toml", "--out", "r.h5").wrong_parameters(joint, TOLERANCE)
        return f"{code}: {wrong}" if wrong else None

    return judge
