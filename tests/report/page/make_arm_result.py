"""A small result of an arm for the tests of the page, laid out as engine/store/RESULT_FORMAT.md says.

Two joints, four base parameters and the friction of each joint; the fit is a real one, joint by joint weighted.
"""

import hashlib

import h5py
import numpy as np

import make_result as make

BASE, BASE_UNITS = ["zzr1", "mxr1", "zz2", "mx2"], ["kg m^2", "kg m", "kg m^2", "kg m"]
NAMES = BASE + [f"{law}_{joint}" for joint in (1, 2) for law in ("viscous", "coulomb", "offset")]
UNITS = BASE_UNITS + 2 * ["N m s/rad", "N m", "N m"]
TRUTH = np.array([1.9, 2.6, 0.31, 0.8, 1.1, 2.0, 0.3, 0.4, 0.9, -0.2])
OWN = ([0, 1, 2, 3, 4, 5, 6], [2, 3, 7, 8, 9])  # parameters of each joint's rows
NOISE, RATE_HZ = (0.05, 0.02), 50.0
SLOW = 0.08  # rad/s: rows that are left out


def rows_of(seed, truth):
    """[(joint's motion at its own rows, columns, torque)] of a planar arm."""
    time, q1, dq1, ddq1 = make.motion(20, RATE_HZ, seed)
    _, q2, dq2, ddq2 = make.motion(20, RATE_HZ, seed + 1)
    random, joints = np.random.default_rng(seed + 2), []
    bend, swing, g = 0.4 * np.cos(q2), 0.4 * np.sin(q2), 9.81
    weight = g * np.cos(q1 + q2)
    rigid = ([ddq1, g * np.cos(q1), ddq1 + ddq2, bend * (2 * ddq1 + ddq2) - swing * (2 * dq1 + dq2) * dq2 + weight],
             [ddq1 + ddq2, bend * ddq1 + swing * dq1**2 + weight])
    for columns, own, noise, (q, dq, ddq) in zip(rigid, OWN, NOISE, ((q1, dq1, ddq1), (q2, dq2, ddq2))):
        phi = np.column_stack([*columns, dq, np.sign(dq), np.ones_like(dq)])
        torque = phi @ truth[own] + noise * random.normal(size=len(time))
        joints.append([signal[np.abs(dq) > SLOW] for signal in (time, q, dq, ddq, torque, phi)])
    return joints


def write_rows(group, joints, simulated):
    total = sum(len(joint[0]) for joint in joints)
    make.texts(group, "recordings", ["arm.csv"])
    make.texts(group, "sha256", [hashlib.sha256(b"arm").hexdigest()])
    group.attrs.update({"rate_hz": 500.0, "kept_rate_hz": RATE_HZ, "duration_s": 20.0, "cutoff_hz": 20.0, "order": 4,
                        "parallel_cutoff_hz": 10.0, "simulated": simulated, "reversals": 40, "samples": total,
                        "samples_all_rows": total + 100})
    for number, joint in enumerate(joints, start=1):
        one = group.create_group(f"joint_{number}")
        for key, unit, values in zip(("time", "position", "velocity", "acceleration", "torque", "regressor"),
                                     ("s", "rad", "rad/s", "rad/s2", "N m", "SI"), joint):
            make.put(one, key, values, unit)
        make.put(one, "recording", np.zeros(len(joint[0]), dtype=int))


def stacked(joints):
    """Weighted rows of all joints: columns of all parameters, and torque."""
    phi = [np.zeros((len(joint[0]), len(NAMES))) for joint in joints]
    for whole, joint, own, noise in zip(phi, joints, OWN, NOISE):
        whole[:, own] = joint[5] / noise
    return np.vstack(phi), np.concatenate([joint[4] / noise for joint, noise in zip(joints, NOISE)])


def joint_errors(joints, parameters):
    return np.array([np.linalg.norm(joint[4] - joint[5] @ parameters[own]) / np.linalg.norm(joint[4])
                     for joint, own in zip(joints, OWN)])


def arm_error(joints, parameters):
    left = [joint[4] - joint[5] @ parameters[own] for joint, own in zip(joints, OWN)]
    return np.linalg.norm(np.concatenate(left)) / np.linalg.norm(np.concatenate([joint[4] for joint in joints]))


def write_estimator(group, title, found, train, validation, rows):
    parameters, error, naive = found
    phi, torque = rows
    residual = torque - phi @ parameters
    group.attrs.update({
        "kind": title.lower(), "title": title, "runs": 1, "median_run": 0, "evaluations_total": 1,
        "mse_median": (residual**2).mean(), "mse_best": (residual**2).mean(), "mse_worst": (residual**2).mean(),
        "mse_std": 0.0, "gap_median": 0.0, "residual_std_median": residual.std(),
        "relerr_median": arm_error(train, parameters), "relerr_all_rows": 1.1 * arm_error(train, parameters),
        "validation_relerr_median": arm_error(validation, parameters),
        "validation_relerr_all_rows": 1.1 * arm_error(validation, parameters)})
    for key, value in (("parameters", parameters), ("standard_error", error), ("standard_error_naive", naive)):
        make.put(group, key, value[None], "SI")
    wide = 1.959964 * error
    make.put(group, "ci95", np.stack([parameters - wide, parameters + wide], axis=-1)[None], "SI")
    make.put(group, "stop_reason", ["closed form"])
    for prefix, joints in (("", train), ("validation_", validation)):
        make.put(group, prefix + "joint_relerr", joint_errors(joints, parameters))
        make.put(group, prefix + "joint_relerr_all_rows", 1.1 * joint_errors(joints, parameters))


def arm(path):
    """Simulated, truth known, with a validation motion; of the robot file's inertias one is another."""
    train, validation = rows_of(5, TRUTH), rows_of(15, TRUTH)
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": 2, "complete": 1, "creator": "torquescope 0.1.0",
                           "content_sha256": hashlib.sha256(b"arm").hexdigest()})
        job = file.create_group("job")
        job.attrs.update({"name": "planar", "seed": 3, "runs": 1, "sha256": hashlib.sha256(b"job").hexdigest()})
        make.put(job, "text", "[model]\nrobot = \"arm_robot.toml\"\n")
        file.create_group("provenance").attrs.update({"finished": "2026-11-26T09:12:08Z", "seconds": 0.2})
        model = file.create_group("model")
        model.attrs.update({"joint": "arm", "equation": "tau = Phi(q, dq, ddq) chi + Fv dq + Fc sign(dq) + b"})
        make.put(model, "names", NAMES)
        make.put(model, "units", UNITS)
        make.put(model, "truth", TRUTH)
        robot = file.create_group("robot")
        robot.attrs.update({"name": "planar arm", "file": "arm_robot.toml"})
        make.put(robot, "joints", ["shoulder", "elbow"])
        make.put(robot, "base_parameters", BASE)
        make.put(robot, "gathers", ["zz1 + 0.16 m2", "mx1 + 0.4 m2", "zz2", "mx2"])
        make.put(robot, "file_values", np.where(np.arange(len(BASE)) == 1, 2.2, TRUTH[:len(BASE)]), "SI")
        make.put(file, "arm/noise", np.array(NOISE), "N m")
        for number, own in enumerate(OWN, start=1):
            make.put(file, f"arm/joint_{number}/parameters", np.array(own))
        write_rows(file.create_group("data/train"), train, 1)
        write_rows(file.create_group("data/validate"), validation, 1)
        phi, torque = stacked(train)
        normed = phi / np.linalg.norm(phi, axis=0)
        health = file.create_group("data/regressor_health")
        health.attrs.update({"condition_number": np.linalg.cond(normed), "words": ""})
        make.put(health, "correlation", normed.T @ normed)
        runs = file.create_group("runs")
        make.texts(runs, "order", ["ols", "wls"])
        plain = np.concatenate([np.full(len(joint[0]), noise) for joint, noise in zip(train, NOISE)])
        for name, weights in (("ols", plain**2), ("wls", None)):
            found = make.least_squares(phi, torque, weights)
            write_estimator(runs.create_group(name), name.upper(), found, train, validation, (phi, torque))
        make.texts_of_fixed_length(file)


KINDS = {"arm": arm}
