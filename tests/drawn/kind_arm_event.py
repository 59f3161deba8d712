"""An arm that picks up a body during the training recording, and at another instant in that of validation: `diagnose`
names it with the instants of both, and errors on validation rows fall.
"""

import dataclasses

import numpy as np
from arm import full_torque
from arm_files import draw_case


def carrying(joints, mass, centre):
    """The last link with a point mass at `centre`."""
    last = joints[-1]
    whole = last.mass + mass
    middle = (last.mass * last.centre + mass * centre) / whole

    def shifted(m, offset):
        return m * (offset @ offset * np.eye(3) - np.outer(offset, offset))

    inertia = last.inertia + shifted(last.mass, last.centre - middle) + shifted(mass, centre - middle)
    return [*joints[:-1], dataclasses.replace(last, mass=whole, centre=middle, inertia=inertia)]


def draw(rng, folder):
    case = draw_case(rng, kind="planar")
    mass = case.joints[-1].mass * rng.uniform(0.5, 2.0)
    loaded = carrying(case.joints, mass, case.joints[-1].centre * rng.uniform(1.0, 2.0) + rng.uniform(-0.02, 0.02, 3))
    shares = rng.uniform(0.25, 0.75, 2)
    if abs(shares[0] - shares[1]) < 0.15:
        shares[1] = 1.0 - shares[0] if abs(1 - 2 * shares[0]) > 0.15 else 0.3
    instants = []
    for taken, share in zip((case.train, case.validation), shares):
        time = taken.motion.time
        instants.append(time[int(share * len(time))])
        more = full_torque(loaded, taken.motion, case.friction, case.gravity) - full_torque(
            case.joints, taken.motion, case.friction, case.gravity)
        taken.torque = taken.torque + np.where(time[:, None] >= instants[-1], more, 0.0)
    case.write(rng, folder)
    text = (folder / "job.toml").read_text()
    effects = '["payload_picked_up", "tip_contact", "stribeck"]'
    (folder / "job.toml").write_text(f"{text}\n[diagnose]\neffects = {effects}\n")
    label = f"{len(case.joints)} joints, {mass:.2f} kg at {instants[0]:.2f} and {instants[1]:.2f} s"

    def judge(call):
        told = call("diagnose", "job.toml", "--out", "told.h5")
        effects = told.document.get("arm", {}).get("effects", [])
        names = [one["name"] for one in effects]
        if not names or names[0] != "payload_picked_up":
            candidates = told.document.get("arm", {}).get("candidates", [])
            return f"{label}: {names} {[(one['name'], one['reason']) for one in candidates]} {told.text[-300:]}"
        found = {one["name"]: one["value"] for one in effects[0]["parameters"]}
        if abs(found.get("payload_from", -1.0) - instants[0]) > 1.0:
            return f"{label}: at {found}"
        sentence = effects[0]["sentence"]
        there = sentence.split("unseen from")[-1]
        if "unseen.csv" not in there:
            return f"{label}: {sentence}"
        second = float(there.split("(from ")[1].split(" s of")[0]) if "(from " in there else -1.0
        if abs(second - instants[1]) > 1.0:
            return f"{label}: {sentence}"
        return None

    return judge
