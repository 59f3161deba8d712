"""An arm with an effect at one joint that no line is linear in: held by [[model.effects]], errors on validation rows
fall to the noise and its parameters are found; nothing of it stands at an arm without it.
"""

import dataclasses

import numpy as np
from arm import full_torque
from arm_files import draw_case

LAWS = {"stribeck": "stribeck", "load": "load_dependent_friction"}


def draw(rng, folder):
    law = str(rng.choice(list(LAWS)))
    place = {}

    def changed(friction, torque, motion):
        n = torque.shape[1]
        place["joint"] = joint = int(rng.integers(1, n)) if law == "load" else int(rng.integers(n))
        at = np.arange(n) == joint
        speed = abs(motion.dq[:, joint]).max() * rng.uniform(0.02, 0.12)
        if law == "stribeck":
            size = rng.uniform(0.4, 1.2) * np.sqrt((torque[:, joint] ** 2).mean()) + 2 * friction.coulomb[joint]
            return dataclasses.replace(friction, stribeck=size * at, stribeck_speed=speed)
        return dataclasses.replace(friction, load=rng.uniform(0.1, 0.4) * at)

    case = draw_case(rng, kind=str(rng.choice(["planar", "wrist"])), changed=changed)
    joint = place["joint"]
    case.write(rng, folder)
    text = (folder / "job.toml").read_text()
    (folder / "held.toml").write_text(f'{text}\n[[model.effects]]\njoint = {joint + 1}\nname = "{LAWS[law]}"\n')
    whole = full_torque(case.joints, case.validation.motion, case.friction, case.gravity)
    noise = (case.validation.torque - whole).std(0) / np.sqrt((whole**2).mean(0))
    label = f"{law} at joint {joint + 1} of {len(case.joints)}"

    def judge(call):
        errors, parameters = {}, {}
        for name in ("job", "held"):
            run = call("run", f"{name}.toml", "--out", f"{name}.h5")
            if run.code:
                return f"{label}: run {name}: {run.text[-400:]}"
            errors[name] = np.array(run.document["estimators"][0]["arm"]["validation_joint_relerr"], float)
            parameters[name] = run.parameters()
        figures = f"{100 * errors['job'][joint]:.2f} to {100 * errors['held'][joint]:.2f} %, noise " \
                  f"{100 * noise[joint]:.2f} %"
        if law == "stribeck" and f"joint {joint + 1}: stribeck_speed" not in " ".join(run.text.split()):
            return f"{label}: its speed is not printed: {run.text[-400:]}"
        if errors["held"][joint] > 1.05 * errors["job"][joint]:
            return f"{label}: worse, {figures}"
        gap = errors["job"][joint] ** 2 - noise[joint] ** 2
        left = errors["held"][joint] ** 2 - noise[joint] ** 2
        if gap > (0.3 * noise[joint]) ** 2 and left > 0.3 * gap + (0.3 * noise[joint]) ** 2:
            return f"{label}: {figures}"
        return None

    return judge
