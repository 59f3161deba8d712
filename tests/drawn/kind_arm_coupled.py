"""An arm with a motor that turns with two joints: with its row of the transmission errors on validation rows fall to
those of the noise and its parameters lie in their intervals; without it they do not. Half of them record torques of
motors."""

import copy

import numpy as np
from arm import full_torque, link_torque
from arm_files import draw_case, write_job


def transmission(rng, joints):
    """Two or three kinds: a wrist's last motor, a motor that turns with the joint behind it, a parallelogram."""
    n = len(joints)
    matrix = np.eye(n)
    motor = int(rng.integers(2, n))
    other = motor - 1 if motor == n - 1 or rng.random() < 0.7 else motor + 1
    size = float(rng.choice([1.0, -1.0, 0.5, -0.5, round(rng.uniform(0.2, 1.5), 3)]))
    # the inertia of a motor that turns by the sum of two parallel axes is that of the link
    if abs(joints[max(motor, other)].alpha) < 1e-9 and size == 1.0:
        size = 0.8
    matrix[motor, other] = size
    return matrix, motor, other


def torque_of(case, motion, friction, matrix):
    links = link_torque(case.joints, motion, case.gravity)
    drives = np.array([joint.drive for joint in case.joints])
    return links + (drives * (motion.ddq @ matrix.T) + friction.torque(motion.dq @ matrix.T, links)) @ matrix


def draw(rng, folder):
    case = draw_case(rng, kind=str(rng.choice(["wrist", "planar"])))
    n = len(case.joints)
    matrix, motor, other = transmission(rng, case.joints)
    noises = []
    for taken in (case.train, case.validation):  # the sensors' noise stays
        noise = taken.torque - full_torque(case.joints, taken.motion, case.friction, case.gravity)
        whole = torque_of(case, taken.motion, case.friction, matrix)
        noises.append(noise.std(0) / np.sqrt((whole**2).mean(0)))
        taken.torque = whole + noise
    at_motors = bool(rng.random() < 0.5)  # what is recorded: tau_joint = T' tau_motor
    if at_motors:
        for taken in (case.train, case.validation):
            taken.torque = taken.torque @ np.linalg.inv(matrix)
    case.write(rng, folder)
    job = case.job()
    row = "[" + ", ".join(f"{x:g}" for x in matrix[motor]) + "]"
    told = copy.deepcopy(job)
    told[f"model.joint_{motor + 1}"] = {"motor_turns_by": row}
    if at_motors:
        told["recording"]["torque_at"] = '"motors"'
    write_job(folder / "told.toml", told)
    label = f"{n} joints, motor {motor + 1} turns by {row}{', torques of motors' if at_motors else ''}"

    def judge(call):
        checked = call("check", "told.toml")
        if checked.topics("warn", "fault") & {"arm_setup", "arm_changes_at"}:
            return f"{label}: check {checked.text[-400:]}"
        errors = {}
        for name in ("job", "told"):
            run = call("run", f"{name}.toml", "--out", f"{name}.h5")
            if run.code and name == "job" and at_motors:  # as those of joints they may be no arm's
                errors[name] = np.full(n, np.inf)
                continue
            if run.code:
                return f"{label}: run {name}: {run.text[-400:]}"
            errors[name] = np.array(run.document["estimators"][0]["arm"]["validation_joint_relerr"], float)
        found = run.document["estimators"][0]["parameters"]
        truth = {f"viscous_{motor + 1}": case.friction.viscous[motor], f"coulomb_{motor + 1}":
                 case.friction.coulomb[motor]}
        outside = [f"{one['name']} {one['value']:.4g} for {truth[one['name']]:.4g}" for one in found
                   if one["name"] in truth and
                   abs(one["value"] - truth[one["name"]]) > 3 * one["standard_error"] + 0.02 * truth[one["name"]]]
        figures = f"{np.round(100 * errors['job'], 2)} to {np.round(100 * errors['told'], 2)} %"
        if (errors["told"] > 1.6 * noises[1] + 0.005).any():
            return f"{label}: {figures}, noise {np.round(100 * noises[1], 2)} %"
        if not errors["told"].sum() < 0.95 * errors["job"].sum():
            return f"{label}: no gain, {figures}"
        return f"{label}: {outside}" if outside else None

    return judge
