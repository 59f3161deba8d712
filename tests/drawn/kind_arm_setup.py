"""An arm whose set-up has one mistake: `check` names it, and with its lines pasted everything is as with a sound one.

Where neither the motion nor the robot file can tell (the zero of a vertical first joint, the sign of a round last
link), silence is right: the errors on validation rows and those of the file's own masses are then those of the sound
arm."""

import json
import os

import numpy as np
from arm import GRAVITY, Motion, about, link_torque
from arm_files import Taken, draw_case, file_error, pasted, taken_as, toml_text, write_job

KINDS = ["joints_exchanged", "torques_exchanged", "positions_exchanged", "reversed", "torque_sign", "degrees",
         "convention", "zero_quarter", "zero", "motor_side", "no_gravity", "one_unit", "mounting"]
WORDS = {"joints_exchanged": "columns of", "torques_exchanged": "torques of", "positions_exchanged": "positions of",
         "reversed": "other way round", "torque_sign": "other sign", "degrees": "another unit",
         "convention": "convention", "zero_quarter": "zero of", "zero": "zero of", "motor_side": "motors",
         "no_gravity": "not in this torque", "one_unit": "times too", "mounting": "points another way"}


def swapped(array, i, j):
    order = list(range(array.shape[1]))
    order[i], order[j] = order[j], order[i]
    return array[:, order]


def mistaken(kind, taken, i, j, size, case):
    """The columns with the mistake."""
    n = len(case.joints)
    old, torque = taken.motion, taken.torque
    factor, zero = np.ones(n), np.zeros(n)
    parts = [old.q, old.dq, old.ddq]
    if kind in ("joints_exchanged", "positions_exchanged"):
        parts = [swapped(part, i, j) for part in parts]
    if kind in ("joints_exchanged", "torques_exchanged"):
        torque = swapped(torque, i, j)
    if kind == "reversed":
        factor[i] = -1.0
    if kind in ("reversed", "torque_sign"):
        torque = torque * np.where(np.arange(n) == i, -1.0, 1.0)
    if kind == "degrees":
        factor[:] = 180 / np.pi
    if kind in ("zero", "zero_quarter"):
        zero[i] = size
    if kind == "motor_side":
        torque = torque / np.array([joint.gear for joint in case.joints])
    if kind == "one_unit":
        torque = torque / np.where(np.arange(n) == i, size, 1.0)
    if kind == "no_gravity":
        still = Motion(old.time, old.q, 0 * old.q, 0 * old.q)
        torque = torque - link_torque(case.joints, still, case.gravity)
    return Taken(Motion(old.time, parts[0] * factor + zero, parts[1] * factor, parts[2] * factor), torque)


def validation_errors(call, job):
    run = call("run", job, "--out", job.replace(".toml", ".h5"))
    if run.code:
        return None, f"run ends with {run.code}: {run.text[-300:]}"
    return np.array(run.document["estimators"][0]["arm"]["validation_joint_relerr"], float), None


def worse(errors, least):
    return bool((errors > 1.3 * least + 0.005).any())


def draw(rng, folder):
    kinds = os.environ.get("ARM_KINDS", ",".join(KINDS)).split(",")
    kind = kinds[int(rng.integers(len(kinds)))]
    turn = None
    if kind == "mounting":
        axis, angle = int(rng.integers(2)), rng.choice([np.pi / 2, -np.pi / 2, np.pi])
        turn = about(axis, angle)
    of_structure = "wrist" if kind == "degrees" and rng.random() < 0.5 else "planar" if kind == "degrees" else None
    is_urdf = False if kind in ("convention", "motor_side") else None
    inertias = True if kind in ("motor_side", "no_gravity") and rng.random() < 0.9 else None
    off = rng.uniform(0.05, 0.2) if rng.random() < 0.4 else 0.0
    case = draw_case(rng, kind=of_structure, is_urdf=is_urdf, inertias=inertias, off=off,
                     gravity=GRAVITY if turn is None else turn @ GRAVITY)
    n = len(case.joints)
    i, j = (int(x) for x in rng.permutation(n)[:2])
    turning = [k for k in range(n) if not case.joints[k].slides]
    if kind.startswith("zero"):
        i = int(rng.choice(turning))
    if kind.endswith("exchanged") and case.joints[i].slides != case.joints[j].slides and kind != "torques_exchanged":
        i, j = turning[0], turning[-1]
    size = {"zero_quarter": float(rng.choice([np.pi / 2, -np.pi / 2, np.pi])),
            "zero": rng.uniform(0.1, 0.5) * rng.choice([-1, 1]),
            "one_unit": float(np.exp(rng.uniform(3, 4.6)))}.get(kind)
    case.write(rng, folder)
    sound = [case.train, case.validation]
    case.train, case.validation = (mistaken(kind, one, i, j, size, case) for one in sound)
    sound_gravity = case.gravity
    if kind == "no_gravity":  # a torque without it is right where it is said
        sound, sound_gravity = [case.train, case.validation], np.zeros(3)
    for name, one in zip(("s_train", "s_unseen"), sound):
        case.write_recording(folder / f"{name}.csv", one)
    job = case.job()
    write_job(folder / "sound.toml", {**job, "recording": {**job["recording"], "train": '"s_train.csv"',
                                                          "validate": '"s_unseen.csv"'},
                                      "model": {**job["model"], **({"gravity": str(list(sound_gravity))})}})
    if not case.is_urdf:
        (folder / "sound.robot.toml").write_text(toml_text(case.in_file, case.names, case.inertias, case.convention))
        text = (folder / "sound.toml").read_text().replace('"arm.toml"', '"sound.robot.toml"')
        (folder / "sound.toml").write_text(text)
    if kind == "convention":
        case.said = {"modified_dh": "standard_dh", "standard_dh": "modified_dh"}[case.convention]
    case.write(rng, folder)
    label = (f"{kind}({i + 1}, {j + 1}{f', {size:.3g}' if size else ''}) {n} joints "
             f"{'urdf' if case.is_urdf else 'toml'} "
             f"{f'masses off {off:.2g}' if case.inertias else 'no masses'}")

    def judge(call):
        least, wrong = validation_errors(call, "sound.toml")
        if wrong:
            return f"{label}: sound: {wrong}"
        masses_sound = file_error(case.in_file, sound[0], sound_gravity)
        check = call("check", "job.toml")
        if "lines" not in check.document:
            return f"{label}: {check.text[-300:]}"
        said = [line["text"] for line in check.document.get("lines", []) if line["topic"] == "arm_setup"]
        if not said:
            errors, wrong = validation_errors(call, "job.toml")
            if wrong:
                return f"{label}: silent, {wrong}"
            if worse(errors, least):
                return f"{label}: silent, unseen {np.round(100 * errors, 1)}, sound {np.round(100 * least, 1)} %"
            if case.inertias and kind != "convention":
                masses = file_error(case.in_file, case.train, GRAVITY)
                if (masses > np.maximum(3 * masses_sound, 0.3)).any() or (not off and (masses > 0.06).any()):
                    return f"{label}: silent, masses of the file {np.round(100 * masses, 1)} %"
            return None
        advised = pasted(case.job(), check, case)
        if advised is None:
            return f"{label}: nothing to paste: {said[0]}"
        write_job(folder / "pasted.toml", advised[0])
        if not case.is_urdf:
            (folder / "arm.toml").write_text(
                toml_text(case.in_file, case.names, case.inertias, case.convention, advised[1]))
        again = call("check", "pasted.toml")
        if "arm_setup" in again.topics() or "lines" not in again.document:
            return f"{label}: pasted, still: {again.text[-600:]}; before: {said[0]}"
        errors, wrong = validation_errors(call, "pasted.toml")
        if wrong:
            return f"{label}: pasted, {wrong}"
        if worse(errors, least):
            return f"{label}: pasted, unseen {np.round(100 * errors, 1)}, sound {np.round(100 * least, 1)} %: {said[0]}"
        if case.inertias and (advised[1] == case.convention):
            gravity = np.array(json.loads(advised[0]["model"].get("gravity", str(list(GRAVITY)))))
            masses = file_error(case.in_file, taken_as(case.train, advised[0]), gravity)
            if (masses > 1.3 * masses_sound + 0.03).any():
                return (f"{label}: pasted, masses of the file {np.round(100 * masses, 1)}, "
                        f"sound {np.round(100 * masses_sound, 1)} %: {said[0]}")
            return None
        return None if WORDS[kind] in said[0] else f"{label}: names {said[0]}"

    return judge
