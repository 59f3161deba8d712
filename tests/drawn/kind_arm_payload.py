"""One recording of an arm without and one with a load that nobody has weighed: `wls` finds its mass and its centre, and
their intervals hold them. A load in every recording is refused.
"""

import re

import numpy as np
from arm import GRAVITY, draw_friction, draw_joints, draw_motion, full_torque, link_torque, loaded
from arm_files import NAMES, Case, measured, tip_of

INTERVAL = 1.96  # standard errors
SMALL, SMALL_M = 0.02, 0.005  # beside the interval, of the mass and of a coordinate: errors of the model, not noise


def draw(rng, folder):
    joints = draw_joints(rng, "wrist", int(rng.integers(4, 7)))
    n = len(joints)
    mass = float(np.exp(rng.uniform(np.log(0.05), np.log(0.4)))) * sum(joint.mass for joint in joints)
    place = joints[-1].centre + rng.uniform(-0.05, 0.1, 3)
    heavy = loaded(joints, mass, place)
    rate, noise = float(rng.choice([100, 125, 200, 250])), rng.uniform(0.003, 0.03)
    motions = [draw_motion(rng, joints, rng.uniform(25, 40), rate, rng.uniform(0.6, 0.9)) for _ in range(2)]
    friction = draw_friction(rng, link_torque(joints, motions[0]), motions[0])
    arms = [joints, heavy]
    order = rng.permutation(2)
    taken = [measured(rng, arms[k], motions[k], full_torque(arms[k], motions[k], friction), noise, 2**17)
             for k in order]
    case = Case(joints, joints, friction, GRAVITY, *taken, [f"j{j + 1}" for j in range(n)],
                NAMES[int(rng.integers(len(NAMES)))], False, bool(rng.random() < 0.5),
                str(rng.choice(["modified_dh", "standard_dh"])))
    case.write(rng, folder)
    turn, shift = tip_of(case, folder)
    centre = turn.T @ (place - shift)
    carried = [["0", '"unknown"'][k] for k in order]
    text = (folder / "job.toml").read_text(encoding="utf-8")
    for name, loads in (("job", carried), ("both", ['"unknown"', '"unknown"'])):
        (folder / f"{name}.toml").write_text(text.replace(
            'train = "train.csv"\nvalidate = "unseen.csv"',
            f'train = ["train.csv", "unseen.csv"]\npayload_kg = [{", ".join(loads)}]'), encoding="utf-8")
    label = f"{n} joints, load {mass:.3g} kg, {mass / sum(joint.mass for joint in joints):.2g} of the arm"

    def judge(call):
        if call("check", "both.toml").code != 78:
            return f"{label}: a load in every recording is not refused"
        answer = call("run", "job.toml")
        if answer.code:
            return f"{label}: {answer.text[-300:]}"
        found = {one["name"]: one for one in answer.document["estimators"][0]["parameters"]}
        one = found.get(f"payload1_m{n}")
        if one is None:
            return f"{label}: no mass among {list(found)[-12:]}"
        if abs(one["value"] - mass) > INTERVAL * one["standard_error"] + SMALL * mass:
            return f"{label}: {one['value']:.4g} +- {one['standard_error']:.2g} kg"
        words = " ".join(answer.text.split())
        said = re.search(r"payload 1: (\S+) \+- (\S+) kg, centre at (.*?) m in the frame", words)
        if not said:
            return f"{label}: says no centre: {words[-600:]}"
        for told, true in zip(said[3].split(","), centre):
            value, error = (float(number) for number in told.split("+-"))
            if abs(value - true) > error + SMALL_M:
                return f"{label}: centre {said[3]}, true {np.round(centre, 3)}"
        return None

    return judge
