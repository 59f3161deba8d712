"""An arm that is pushed at its tip, and a sensor of the wrench: with its columns errors on validation rows are those of
the noise, without them they are not. A wrench of the wrong sign or along other axes is told with the line that mends
it."""

import copy
import dataclasses

import numpy as np
from arm import Push, full_torque, link_torque
from arm_files import draw_case, tip_of, write_job


def drawn_push(rng, case, motion, tip, along_base, size):
    """Contacts that come and go; of a force plate without moments."""
    def waves():
        angles = np.outer(motion.time, 2 * np.pi * rng.uniform(0.1, 0.9, 3)) + rng.uniform(0, 6.3, 3)
        return np.sin(angles) @ rng.uniform(0.3, 1.0, 3)

    force, moment = (np.column_stack([waves() for _ in range(3)]) for _ in range(2))
    contact = 1 / (1 + np.exp(-20 * (waves() - rng.uniform(-0.5, 0.3))))
    return Push(size / 0.4 * force * contact[:, None], size * rng.choice([0.0, 0.3]) * moment * contact[:, None], *tip,
                along_base)


def draw(rng, folder):
    case = draw_case(rng)
    case.write(rng, folder)  # of its tip
    tip = tip_of(case, folder)
    along_base, on_arm = bool(rng.random() < 0.4), bool(rng.random() < 0.6)
    size = rng.uniform(0.3, 1.0) * np.median(case.train.torque.std(0))
    names = [str(name) for name in rng.choice([["fx", "fy", "fz", "mx", "my", "mz"],
                                               [f"/wrench/{what}/{axis}" for what in ("force", "torque")
                                                for axis in "xyz"], [f"ft{k}" for k in range(6)]])]
    noises = []
    for name, taken in (("train", case.train), ("unseen", case.validation)):
        pushed = drawn_push(rng, case, taken.motion, tip, along_base, size)
        free = link_torque(case.joints, taken.motion, case.gravity)
        outside = free - link_torque(case.joints, taken.motion, case.gravity, pushed)  # of the push on the joints
        noise = taken.torque - full_torque(case.joints, taken.motion, case.friction, case.gravity)
        whole = np.sqrt((taken.torque**2).mean(0))
        taken.torque = taken.torque - outside
        case.write_recording(folder / f"{name}.csv", taken)
        hiss = 0.002 * abs(pushed.force).max() * rng.standard_normal((2, *pushed.force.shape)) * [[[1]], [[0.3]]]
        felt = free - link_torque(case.joints, taken.motion, case.gravity, dataclasses.replace(
            pushed, force=hiss[0], moment=hiss[1]))
        noises.append(np.sqrt((noise + felt).var(0)) / whole)
        wrench = np.column_stack([pushed.force + hiss[0], pushed.moment + hiss[1]]) * (1 if on_arm else -1)
        lines = (folder / f"{name}.csv").read_text(encoding="utf-8").splitlines()
        rows = [",".join(names), *(",".join(f"{x:.7g}" for x in row) for row in wrench)]
        (folder / f"{name}.csv").write_text("\n".join(f"{a},{b}" for a, b in zip(lines, rows)) + "\n")
    job = case.job()
    frame, side = ("base" if along_base else "tip"), ("arm" if on_arm else "surroundings")
    told = copy.deepcopy(job)
    told["recording"].update({"wrench": str(names).replace("'", '"'), "wrench_frame": f'"{frame}"',
                              "wrench_on": f'"{side}"'})
    wrong = copy.deepcopy(told)
    mistakes = [key for key in ("wrench_frame", "wrench_on") if rng.random() < 0.6] or ["wrench_on"]
    other = {'"base"': '"tip"', '"tip"': '"base"', '"arm"': '"surroundings"', '"surroundings"': '"arm"'}
    for key in mistakes:
        wrong["recording"][key] = other[wrong["recording"][key]]
    write_job(folder / "told.toml", told)
    write_job(folder / "wrong.toml", wrong)
    write_job(folder / "job.toml", job)
    label = f"{len(case.joints)} joints, wrench of the {frame} on the {side}, {'urdf' if case.is_urdf else 'toml'}"

    def judge(call):
        checked = call("check", "told.toml")
        if checked.topics("warn", "fault") & {"arm_setup"} or "wrench" not in checked.topics("ok"):
            return f"{label}: check {checked.text[-400:]}"
        errors = {}
        for name in ("job", "told"):
            run = call("run", f"{name}.toml", "--out", f"{name}.h5")
            if run.code and name == "told":
                return f"{label}: run {name}: {run.text[-400:]}"
            errors[name] = (np.full(len(case.joints), np.inf) if run.code else
                            np.array(run.document["estimators"][0]["arm"]["validation_joint_relerr"], float))
        figures = f"{np.round(100 * errors['job'], 2)} to {np.round(100 * errors['told'], 2)} %"
        if (errors["told"] > 1.6 * noises[1] + 0.005).any():
            return f"{label}: {figures}, noise {np.round(100 * noises[1], 2)} %"
        if not (errors["told"] < 0.5 * errors["job"]).any():
            return f"{label}: no gain, {figures}"
        said = [line["text"] for line in call("check", "wrong.toml").document["lines"] if line["topic"] == "arm_setup"]
        for key in mistakes:
            if not said or f"{key} = {told['recording'][key]}" not in said[0]:
                return f"{label}: wrong {mistakes}, says {said}"
        return None if said[0].count(" = ") == len(mistakes) else f"{label}: wrong {mistakes}, says {said}"

    return judge
