"""Something pushes the last link of an arm for a moment, at three times the torque noise or more: `check` says when,
and what to leave out.
"""

import re

import numpy as np
from arm import Push, link_torque
from arm_files import draw_case


def draw(rng, folder):
    case = draw_case(rng)
    taken = case.train
    time = taken.motion.time
    plain = link_torque(case.joints, taken.motion, case.gravity)
    begin, length = rng.uniform(0.1, 0.85) * time[-1], rng.uniform(0.3, 0.5)
    direction = rng.standard_normal(3)
    force = direction / np.linalg.norm(direction) * np.ones((len(time), 1))
    place = case.joints[-1].centre * rng.uniform(1.0, 2.0)  # from the middle of the link to its end
    push = Push(force, np.zeros((len(time), 3)), np.eye(3), place, along_base=True)
    during = (time >= begin) & (time < begin + length)
    pushed = (link_torque(case.joints, taken.motion, case.gravity, push) - plain) * during[:, None]
    noise = noise_of(taken.torque)
    felt = np.sqrt((pushed[during] ** 2).mean(0)) / noise  # of a newton, in noises
    size = 3.0 * 10 ** rng.uniform(0.0, 1.0) / np.sqrt((felt**2).mean())
    taken.torque = taken.torque + size * pushed
    case.write(rng, folder)
    label = f"{len(case.joints)} joints, {begin:.2f} to {begin + length:.2f} s, {np.round(size * felt, 1)} noises"

    def judge(call):
        said = [line for line in call("check", "job.toml").document.get("lines", [])
                if line["topic"] in ("arm_setup", "arm_touched", "arm_changes_at")]
        match = re.search(r"leave_out = \[\[(.*?), (.*?)\]\]", said[0]["text"]) if said else None
        if not match or said[0]["topic"] != "arm_touched":
            return f"{label}: {[line['text'] for line in said]}"
        first, last = float(match[1]), float(match[2])
        if first > begin + 0.1 or last < begin + length - 0.1 or last - first > length + 1.0:
            return f"{label}: {said[0]['text']}"
        return None

    return judge


def noise_of(torque):
    """[joints] of white noise: third differences hold little else."""
    return np.median(abs(np.diff(torque, 3, axis=0)), 0) / (0.6745 * np.sqrt(20.0))
