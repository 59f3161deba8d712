"""An arm whose torque channel of one joint comes late, or early: `check` and `diagnose` say which and by how much, the
pasted line mends it, and `diagnose` names no physics for it.
"""

import re

import numpy as np
from arm_files import draw_case


def draw(rng, folder):
    case = draw_case(rng)
    late = rng.uniform(0.012, 0.045) * (1 if rng.random() < 0.85 else -1)
    joint = int(rng.integers(len(case.joints)))
    rate = 1 / np.diff(case.train.motion.time).mean()
    late = np.sign(late) * max(abs(late), 2.0 / rate)
    for taken in (case.train, case.validation):
        time = taken.motion.time
        taken.torque = taken.torque.copy()
        taken.torque[:, joint] = np.interp(time - late, time, taken.torque[:, joint])
    case.write(rng, folder)
    label = f"joint {joint + 1} of {len(case.joints)}, {1e3 * late:.1f} ms at {rate:.0f} Hz"

    def judge(call):
        said = [line["text"] for line in call("check", "job.toml").document.get("lines", [])
                if line["topic"] == "arm_setup"]
        if len(said) != 1 or "delay_s = " not in said[0]:
            return f"{label}: {said}"
        line = re.search(r"delay_s = \[(.*?)\]", said[0])
        told = -np.array([float(text) for text in line[1].split(",")])
        told[joint] -= late
        if abs(told).max() > 0.2 * abs(late) + 0.5 / rate:
            return f"{label}: {said}"
        diagnosis = call("diagnose", "job.toml", "--out", "told.h5")
        if diagnosis.document.get("verdict") != "data_fault" or "delay_s" not in " ".join(diagnosis.text.split()):
            return f"{label}: {diagnosis.text[-400:]}"
        text = (folder / "job.toml").read_text()
        (folder / "mended.toml").write_text(text.replace("[recording]", f"[recording]\n{line[0]}"))
        again = [one["text"] for one in call("check", "mended.toml").document.get("lines", [])
                 if one["topic"] == "arm_setup"]
        return f"{label}: after the line {again}" if again else None

    return judge
