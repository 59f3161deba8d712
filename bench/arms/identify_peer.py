"""Identification of real arms by others on the same rows: Pinocchio's regressor, scipy's filters, numpy's lstsq, joint
by joint beside ours; then the held-out error over all rows, those near reversals included.

    identify_peer.py PROGRAM FOLDER [ROBOT ...]

PROGRAM is torquescope, FOLDER holds panda/ and ur10e/ (jobs/README.md says where to get them). Nothing of ours makes
the peer's rows: it reads the job, the robot and the recording itself. Needs PyPI's pin, numpy, scipy and h5py.
"""
import argparse
import gzip
import json
import pathlib
import subprocess
import tempfile
import tomllib

import h5py
import numpy as np
import pinocchio
import scipy
from scipy.signal import butter, sosfiltfilt

JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"


def rotation_x(angle):
    return np.array([[1, 0, 0], [0, np.cos(angle), -np.sin(angle)], [0, np.sin(angle), np.cos(angle)]])


def chain(robot):
    """Pinocchio's model of revolute joints about z; what stands behind a standard joint goes before the next one."""
    model, before, parent = pinocchio.Model(), pinocchio.SE3.Identity(), 0
    model.gravity.linear = np.array(robot["robot"]["gravity"])
    for joint in robot["joint"]:
        turned = pinocchio.SE3(rotation_x(joint.get("alpha_rad", 0.0)), np.array([joint.get("a_m", 0.0), 0, 0]))
        raised = pinocchio.SE3(np.eye(3), np.array([0, 0, joint.get("d_m", 0.0)]))
        is_standard = robot["robot"]["convention"] == "standard_dh"
        place = before if is_standard else before * turned * raised
        before = raised * turned if is_standard else pinocchio.SE3.Identity()
        parent = model.addJoint(parent, pinocchio.JointModelRZ(), place, joint["name"])
        model.appendBodyToJoint(parent, pinocchio.Inertia.Zero(), pinocchio.SE3.Identity())
    return model, np.array([joint.get("offset_rad", 0.0) for joint in robot["joint"]])


def low_pass(values, cutoff_hz, rate_hz):
    return sosfiltfilt(butter(4, cutoff_hz, fs=rate_hz, output="sos"), values, axis=0)


def read(path, job, joints):
    """Position and torque at the rate of the usual step of the stamps."""
    columns = job["recording"]["columns"]
    with gzip.open(path, "rt") as file:
        lines = [line for line in file if not line.startswith("#")]
    names = lines[0].strip().split(",")
    table = np.array([line.split(",") for line in lines[1:]], dtype=float)
    pick = [[names.index(columns[channel].format(j=j + 1)) for j in range(joints)]
            for channel in ("position", "torque")]
    time = table[:, names.index(columns["time"])]
    rate_hz = round(1 / np.median(np.diff(time)))
    even = time[0] + np.arange(int((time[-1] - time[0]) * rate_hz) + 1) / rate_hz
    even_columns = [np.column_stack([np.interp(even, time, table[:, c]) for c in chosen]) for chosen in pick]
    gains = np.array(job["recording"].get("torque_per_unit", 1.0))
    return even_columns[0], even_columns[1] * gains, rate_hz


def still_samples(speed, rate_hz, cutoff_hz):
    """engine/infer/pipeline/reversal_mask.hpp"""
    still = np.abs(speed) < 0.005 * np.abs(speed).max()
    still[1:] |= speed[1:] * speed[:-1] < 0
    reach = int(np.ceil(1.6 / cutoff_hz * rate_hz))
    return np.convolve(still, np.ones(2 * reach + 1), mode="same") > 0.5


def pinocchio_columns(model, q, dq, ddq, job):
    """Of each joint: columns of all links, and of its own friction and drive beside zeros."""
    data, (n, joints) = model.createData(), q.shape
    links = np.array([pinocchio.computeJointTorqueRegressor(model, data, *state).copy() for state in zip(q, dq, ddq)])
    for j in range(joints):
        own = [dq[:, j], np.sign(dq[:, j]), np.ones(n)] + ([ddq[:, j]] if job["model"]["drive_inertia"] else [])
        beside = np.zeros((n, len(own) * joints))
        beside[:, j * len(own): (j + 1) * len(own)] = np.column_stack(own)
        yield np.hstack([links[:, j], beside])


def rows_of(part, model, offset, job, columns_of=pinocchio_columns):
    """Of each joint: filtered columns and torque of all samples but the ends, and which of them move one way."""
    position, torque, rate_hz = part
    wanted = job["filter"]
    q = low_pass(position, wanted["cutoff_hz"], rate_hz)
    dq = np.gradient(q, 1 / rate_hz, axis=0)
    ddq = np.gradient(dq, 1 / rate_hz, axis=0)
    step = round(rate_hz / wanted["decimate_to_hz"])
    cut = wanted["parallel_cutoff_hz"]
    edge = int(np.ceil(3 / cut * rate_hz))
    kept = np.arange(edge, len(q) - edge, step)
    rows = []
    for j, raw in enumerate(columns_of(model, q + offset, dq, ddq, job)):
        columns = low_pass(raw, cut, rate_hz)[kept]
        moving = ~still_samples(dq[:, j], rate_hz, cut)[kept]
        rows.append((columns, low_pass(torque[:, j], cut, rate_hz)[kept], moving))
    return rows


def moving_of(rows):
    return [(columns[moving], torque[moving]) for columns, torque, moving in rows]


def all_of(rows):
    return [(columns, torque) for columns, torque, _ in rows]


def joined(parts):
    return [tuple(np.concatenate(pieces) for pieces in zip(*joint)) for joint in zip(*parts)]


def solve(rows, noise):
    """lstsq of least norm: Pinocchio's columns depend on each other."""
    columns = np.vstack([phi / s for (phi, _), s in zip(rows, noise)])
    size = np.linalg.norm(columns, axis=0)
    size[size < 1e-9 * size.max()] = np.inf
    torque = np.concatenate([tau / s for (_, tau), s in zip(rows, noise)])
    return np.linalg.lstsq(columns / size, torque, rcond=1e-9)[0] / size


def errors(rows, found):
    left = np.array([np.sum((tau - phi @ found) ** 2) for phi, tau in rows])
    whole = np.array([np.sum(tau ** 2) for _, tau in rows])
    return [*np.sqrt(left / whole), np.sqrt(left.sum() / whole.sum())]


def weighted(rows, turns=30):
    noise = np.ones(len(rows))
    for _ in range(turns):
        found = solve(rows, noise)
        noise = np.array([np.sqrt(np.mean((tau - phi @ found) ** 2)) for phi, tau in rows])
    return found


def parts_of(job, folder):
    """The robot's model, and rows of each joint by whatever makes the columns: training and validation ones that move
    one way, all validation ones."""
    with open(JOBS / job["model"]["robot"], "rb") as file:
        model, offset = chain(tomllib.load(file))
    listed = lambda key: [value] if isinstance(value := job["recording"].get(key, []), str) else value
    found = {key: [read(here(folder, name), job, model.nv) for name in listed(key)] for key in ("train", "validate")}
    share = job["recording"].get("train_share", 1.0)
    if share < 1:
        cut = lambda part, first, end: (part[0][first:end], part[1][first:end], part[2])
        ends = [round(share * len(part[0])) for part in found["train"]]
        found["validate"] = [cut(part, end, None) for part, end in zip(found["train"], ends)]
        found["train"] = [cut(part, 0, end) for part, end in zip(found["train"], ends)]
    def make(columns_of):
        train, validation = (joined([rows_of(part, model, offset, job, columns_of) for part in found[key]])
                         for key in ("train", "validate"))
        return moving_of(train), moving_of(validation), all_of(validation)

    return model, make


def peer(job, folder):
    _, make = parts_of(job, folder)
    train, validation, everywhere = make(pinocchio_columns)
    count = [sum(len(torque) for _, torque in rows) for rows in (validation, everywhere)]
    return {name: (count, errors(train, x), errors(validation, x), errors(everywhere, x))
            for name, x in (("ols", solve(train, np.ones(len(train)))), ("wls", weighted(train)))}


def here(folder, name):
    return folder / pathlib.Path(*pathlib.Path(name).parts[-2:])


def ours(program, text, job, folder):
    names = job["recording"]["train"]
    for name in [*([names] if isinstance(names, str) else names), job["recording"].get("validate", "")]:
        text = text.replace(f'"{name}"', f'"{here(folder, name)}"') if name else text
    text = text.replace('"robots/', f'"{JOBS}/robots/')
    with tempfile.TemporaryDirectory() as scratch:
        place = pathlib.Path(scratch)
        (place / "job.toml").write_text(text, encoding="utf-8")
        subprocess.run([program, "run", place / "job.toml", "--out", place / "r.h5", "--quiet"], check=True,
                       capture_output=True)
        told = json.loads(subprocess.run([program, "show", place / "r.h5", "--json", "-"], check=True,
                                         capture_output=True, text=True).stdout)
        with h5py.File(place / "r.h5") as result:
            count = [int(result["data/validate"].attrs[name]) for name in ("samples", "samples_all_rows")]
    return {one["name"]: (count, [*one["arm"]["joint_relerr"], one["train_relerr"]],
                          [*one["arm"]["validation_joint_relerr"], one["validation_relerr"]],
                          [*one["arm"]["validation_joint_relerr_all_rows"], one["arm"]["validation_relerr_all_rows"]])
            for one in told["estimators"]}


def share_words(who, count):
    return f"{who}: {count[0]} of {count[1]} held-out rows of joints move one way ({100 * count[0] / count[1]:.1f} %)"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("folder", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("robots", nargs="*", default=["panda", "ur10e"])
    wanted = parser.parse_args()
    print(f"Pinocchio {pinocchio.__version__}, numpy {np.__version__}, scipy {scipy.__version__}; relative errors in %,"
          " joint by joint, then the arm")
    for robot in wanted.robots:
        if not (wanted.folder / robot).is_dir():
            print(f"{robot}: skipped, no recordings in {wanted.folder / robot}: jobs/README.md says where to get them")
            continue
        text = (JOBS / f"{robot}.toml").read_text(encoding="utf-8")
        job = tomllib.loads(text)
        theirs, mine = peer(job, wanted.folder), ours(wanted.program, text, job, wanted.folder)
        for name in ("ols", "wls"):
            for who, results in (("ours", mine), ("Pinocchio, numpy", theirs)):
                for rows, values in zip(("train", "unseen", "unseen, all rows"), results[name][1:]):
                    numbers = " | ".join(f"{100 * value:.3g}" for value in values)
                    print(f"| {robot}, {name}, {rows} | {who} | {numbers} |")
        for who, results in (("ours", mine), ("Pinocchio, numpy", theirs)):
            print(share_words(who, results["wls"][0]))


if __name__ == "__main__":
    main()
