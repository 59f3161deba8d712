"""One torque column of an arm is not what it seems: a command that a drive limits, a zero that steps or drifts, one
wrong row. `check` (of a row: `run`) says it with the joint; the other joints' columns get no word."""

import dataclasses
import math
import os
import re

import numpy as np
from arm import GRAVITY, Motion, full_torque, link_torque
from arm_files import Taken, draw_case

KINDS = ["limit", "step", "drift", "row"]
MOVED = 0.1  # share of a friction that one row may move without a word
OF_THE_COLUMN = {"command_beyond_limit", "torque_zero_steps", "torque_zero_drifts", "torque_computed"}


def with_joint(motion, joint, q, dq, ddq):
    parts = [motion.q.copy(), motion.dq.copy(), motion.ddq.copy()]
    for part, values in zip(parts, (q, dq, ddq)):
        part[:, joint] = values
    return Motion(motion.time, *parts)


def limited_drive(case, motion, joint, upper, lower):
    """The other joints move as planned, this one as its drive can: (motion, torque asked for of this joint).

    Inertia and forces of the links along the joint's motion of the round before, until the motion changes no more.
    """
    step, rounds = motion.time[1] - motion.time[0], 8
    planned = full_torque(case.joints, motion, case.friction, case.gravity)[:, joint]
    now = motion
    for _ in range(rounds):
        still, unit = np.zeros(len(now.time)), np.ones(len(now.time))
        q, dq = now.q[:, joint], now.dq[:, joint]
        forces = link_torque(case.joints, with_joint(now, joint, q, dq, still), case.gravity)[:, joint]
        pushed = link_torque(case.joints, with_joint(now, joint, q, dq, unit), case.gravity)[:, joint]
        inertia = pushed - forces + case.joints[joint].drive
        q, dq, asked = driven(case.friction, joint, motion, planned, forces, inertia, (lower, upper))
        changed = abs(q - now.q[:, joint]).max()
        now = with_joint(now, joint, q, dq, np.gradient(dq, step))
    return (now, asked) if changed < 1e-4 * np.ptp(motion.q[:, joint]) else None


def driven(friction, joint, motion, planned, forces, inertia, limits):
    """Position, speed and torque asked for, of one joint under a controller: ten steps of Euler's method a row."""
    substeps, step = 10, (motion.time[1] - motion.time[0]) / 10
    stiffness, damping = 900.0 * inertia.mean(), 45.0 * inertia.mean()
    asked, q, dq = (np.empty(len(motion.time)) for _ in range(3))
    now, speed = motion.q[0, joint], motion.dq[0, joint]
    slow = 0.002 * np.abs(motion.dq[:, joint]).max()
    for k in range(len(motion.time)):
        last = min(k + 1, len(motion.time) - 1)
        q[k], dq[k] = now, speed
        asked[k] = planned[k] + stiffness * (motion.q[k, joint] - now) + damping * (motion.dq[k, joint] - speed)
        given = min(max(asked[k], limits[0]), limits[1])
        for part in range(substeps):
            share = (part + 0.5) / substeps
            held = forces[k] + share * (forces[last] - forces[k])
            brake = friction.viscous[joint] * speed + friction.coulomb[joint] * math.tanh(speed / slow)
            speed += step * (given - held - brake - friction.offset[joint]) / inertia[k]
            now += step * speed
    return q, dq, asked


def limit(rng, case, joint):
    """The training recording with a limited drive, and its limits."""
    taken = case.train
    ideal = full_torque(case.joints, taken.motion, case.friction, case.gravity)[:, joint]
    beyond = rng.uniform(0.04, 0.12)
    high = np.quantile(ideal, 1 - beyond) if rng.random() < 0.5 else np.quantile(abs(ideal), 1 - beyond)
    low = -high if rng.random() < 0.5 else -np.inf
    moved = limited_drive(case, taken.motion, joint, high, low)
    if moved is None:
        return None
    motion, asked = moved
    torque = full_torque(case.joints, motion, case.friction, case.gravity)
    torque[:, joint] = asked
    torque += rng.uniform(0.003, 0.01) * torque.std(0) * rng.standard_normal(torque.shape)
    step = 2e-6 if case.joints[joint].slides else 2 * np.pi / 2**17
    shown = dataclasses.replace(motion, q=np.round(motion.q / step) * step)
    away = abs(motion.q - taken.motion.q)[:, joint].max() / np.ptp(taken.motion.q[:, joint])
    return Taken(shown, torque), high, low, away


def draw(rng, folder):
    kinds = os.environ.get("ARM_KINDS", ",".join(KINDS)).split(",")
    kind = kinds[int(rng.integers(len(kinds)))]
    while True:
        case = draw_case(rng, gravity=GRAVITY)
        n = len(case.joints)
        joint = int(rng.integers(n))
        torque = case.train.torque[:, joint]
        size = rng.choice([-1, 1]) * rng.uniform(0.15, 0.8) * torque.std()
        time = case.train.motion.time
        at = rng.uniform(0.15, 0.85) * time[-1]
        high = row = None
        if kind == "limit":
            found = limit(rng, case, joint)
            if found is None:
                continue
            case.train, high, low, away = found
            share = ((case.train.torque[:, joint] > high) | (case.train.torque[:, joint] < low)).mean()
            if away > 0.3 or not 0.02 < share < 0.25:
                continue  # it fell, or the drive has enough
        if kind == "step":
            case.train.torque[:, joint] += size * (time >= at)
        if kind == "drift":
            case.train.torque[:, joint] += size * time / time[-1]
        if kind == "row":
            row = int(np.searchsorted(time, at))
            (folder / "clean").mkdir(exist_ok=True)
            case.write(np.random.default_rng(1), folder / "clean")
            size = rng.choice([-1, 1]) * rng.uniform(0.5, 4) * np.ptp(torque)
            case.train.torque[row, joint] += size
        break
    case.write(rng, folder)
    label = f"{kind} of joint {joint + 1} of {n}, {size / torque.std():.2f}"
    name = rf"joint {joint + 1}\b|{case.names[joint]}\b"

    def judge(call):
        check = call("check", "job.toml")
        if "lines" not in check.document:
            return f"{label}: {check.text[-300:]}"
        said = [line for line in check.document["lines"] if line["topic"] in OF_THE_COLUMN]
        if kind == "row":
            run = call("run", "job.toml", "--out", "r.h5")
            text = " ".join(run.text.split())
            if said or run.code:
                return f"{label}: {said}, run ends with {run.code}: {text[-200:]}"
            if "spikes" in text or f"line {row + 2}" in text:
                return None
            clean = call("run", "clean/job.toml", "--out", "c.h5").parameters()
            keys = (f"viscous_{joint + 1}", f"coulomb_{joint + 1}")
            moved = [run.parameters()[key] / clean[key] - 1 for key in keys]
            return f"{label}: not a word, moved by {moved}" if max(map(abs, moved)) > MOVED else None
        wanted = {"limit": "command_beyond_limit", "step": "torque_zero_steps", "drift": "torque_zero_drifts"}[kind]
        if [line["topic"] for line in said] != [wanted]:
            return f"{label}: check says {said}"
        text = said[0]["text"]
        if not re.search(name, text) or "likewise" in text:
            return f"{label}: whose? {text}"
        numbers = [abs(float(word)) for word in re.findall(r"[-+]?\d+\.?\d*(?:e[-+]?\d+)?", text)]
        true = high if kind == "limit" else abs(size)
        if not any(abs(one - true) <= 0.15 * true for one in numbers):
            return f"{label}: {true:.3g} is not said: {text}"
        return None

    return judge
