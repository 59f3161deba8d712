"""A sound arm, with or without concealed physics, whose file may know its masses badly: no word about its set-up."""

import dataclasses

import numpy as np
from arm import GRAVITY, about
from arm_files import draw_case

HOW = ["plain", "file_off", "no_masses", "stribeck", "load", "tilted", "coupled"]


def conceal(rng, how):
    """Other friction than the plain one."""
    def changed(friction, torque, motion):
        n = torque.shape[1]
        if how == "stribeck":
            return dataclasses.replace(friction, stribeck=friction.coulomb * rng.uniform(0.3, 1.0, n),
                                       stribeck_speed=0.05 * abs(motion.dq).max())
        if how == "load":
            return dataclasses.replace(friction, load=rng.uniform(0.02, 0.15, n))
        if how == "coupled":
            one = int(rng.integers(n - 1))
            coupled = np.zeros((n, n))
            coupled[one, one + 1] = coupled[one + 1, one] = friction.viscous[one : one + 2].mean() * rng.uniform(-1, 1)
            return dataclasses.replace(friction, coupled=coupled)
        return friction
    return changed


def draw(rng, folder):
    how = HOW[int(rng.integers(len(HOW)))]
    gravity = GRAVITY
    if how == "tilted":
        gravity = about(int(rng.integers(2)), np.radians(rng.uniform(3, 15)) * rng.choice([-1, 1])) @ GRAVITY
    case = draw_case(rng, inertias=how != "no_masses" and (True if how == "file_off" else None), gravity=gravity,
                     off=rng.uniform(0.1, 0.4) if how == "file_off" or rng.random() < 0.5 else 0.0,
                     changed=conceal(rng, how))
    case.write(rng, folder)

    def judge(call):
        check = call("check", "job.toml")
        if "lines" not in check.document:
            return f"{how}: {check.text[-300:]}"
        said = [line["text"] for line in check.document["lines"]
                if line["topic"] in ("arm_setup", "arm_touched", "beyond_limits") or line["level"] == "fault"]
        return f"{how}, {len(case.joints)} joints: {said}" if said else None

    return judge
