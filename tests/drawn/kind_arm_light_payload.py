"""Drive gains of an arm and a payload that was weighed, from heavy to hardly felt: `tls` finds the gains, or says that
the payload does not tell them; it blames no sign and calls nothing negative.
"""

import numpy as np
from arm import GRAVITY, draw_friction, draw_joints, draw_motion, full_torque, link_torque, loaded
from arm_files import NAMES, Case, measured

ERRORS = 5.0  # of a gain, in its own standard errors: model errors beside noise
SMALL = 0.05


def draw(rng, folder):
    joints = draw_joints(rng, "wrist", int(rng.integers(4, 7)))
    n = len(joints)
    mass = float(np.exp(rng.uniform(np.log(0.01), np.log(0.4)))) * sum(joint.mass for joint in joints)
    heavy = loaded(joints, mass, joints[-1].centre + rng.uniform(-0.05, 0.1, 3))
    rate, noise = float(rng.choice([100, 125, 200])), rng.uniform(0.01, 0.1)
    motions = [draw_motion(rng, joints, rng.uniform(25, 40), rate, rng.uniform(0.6, 0.9)) for _ in range(2)]
    friction = draw_friction(rng, link_torque(joints, motions[0]), motions[0])
    factor = 1 + rng.uniform(-0.2, 0.2, n)  # of the gain
    taken = [measured(rng, arm, motion, full_torque(arm, motion, friction) / factor, noise, 2**17)
             for arm, motion in zip((joints, heavy), motions)]
    case = Case(joints, joints, friction, GRAVITY, *taken, [f"j{j + 1}" for j in range(n)],
                NAMES[int(rng.integers(len(NAMES)))], False, True, "modified_dh")
    case.write(rng, folder)
    job = (folder / "job.toml").read_text(encoding="utf-8")
    job = job.replace('train = "train.csv"\nvalidate = "unseen.csv"',
                      f'train = ["train.csv", "unseen.csv"]\npayload_kg = [0, {mass:.6g}]')
    (folder / "job.toml").write_text(job.replace("[model]\n", "[model]\ndrive_gains = true\n").replace(
        '"wls"', '"tls"'), encoding="utf-8")
    label = f"{n} joints, payload {mass / sum(joint.mass for joint in joints):.2g} of the arm, noise {noise:.2g}"

    def judge(call):
        answer = call("run", "job.toml")
        words = " ".join(answer.text.split())
        if "less than" in words or "other sign" in words or "torque_per_unit" in words:
            return f"{label}: {words[-300:]}"
        if answer.code:
            says = ("does not tell", "cannot tell", "load")
            return None if any(word in words for word in says) else f"{label}: {words[-300:]}"
        found = {one["name"]: one for one in answer.document["estimators"][0]["parameters"]}
        for j in range(n):
            one = found[f"gain_error_{j + 1}"]
            off = abs(one["value"] - (factor[j] - 1))
            if off > ERRORS * one["standard_error"] + SMALL:
                return f"{label}: gain {j + 1} off by {off:.3g}, error {one['standard_error']:.2g}"
        return None

    return judge
