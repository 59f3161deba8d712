"""Files of a simulated arm: its robot as URDF or as TOML with Denavit-Hartenberg numbers, recordings and a job.

Shares no code with the engine. `Case` holds what is written; `pasted` follows the advice of `check`.
"""

import copy
import dataclasses
import pathlib
import re

import numpy as np
from arm import (GRAVITY, Friction, Joint, Motion, about, draw_friction, draw_joints, draw_motion, full_torque,
                 link_torque)


def roll_pitch_yaw(turn):
    pitch = np.arcsin(np.clip(-turn[2, 0], -1, 1))
    if abs(np.cos(pitch)) > 1e-9:
        return np.arctan2(turn[2, 1], turn[2, 2]), pitch, np.arctan2(turn[1, 0], turn[0, 0])
    return np.arctan2(-turn[1, 2], turn[1, 1]), pitch, 0.0


def written(numbers):
    return " ".join(f"{0.0 + number:.12g}" for number in numbers)


def six(inertia):
    return [inertia[0, 0], inertia[0, 1], inertia[0, 2], inertia[1, 1], inertia[1, 2], inertia[2, 2]]


def urdf_text(rng, joints, names, inertias):
    """Every joint's axis is x, y or z of its frame, either way."""
    frames = [np.eye(3)]
    text = ['<?xml version="1.0"?>', '<robot name="drawn">', '<link name="base"/>']
    for j, (joint, name) in enumerate(zip(joints, names)):
        along = int(rng.integers(3))
        sign = rng.choice([-1.0, 1.0])
        axis = np.zeros(3)
        axis[along] = sign
        own = {0: about(1, -np.pi / 2), 1: about(0, np.pi / 2), 2: np.eye(3)}[along]  # takes x, y or z to z
        own = own if sign > 0 else about(0, np.pi) @ own
        turn, shift = joint.place()
        turn, shift = frames[-1].T @ turn @ own, frames[-1].T @ shift
        frames.append(own)
        link = ""
        if inertias:
            xx, xy, xz, yy, yz, zz = six(own.T @ joint.inertia @ own)
            link = (f'<inertial><origin xyz="{written(own.T @ joint.centre)}"/><mass value="{joint.mass:.12g}"/>'
                    f'<inertia ixx="{xx:.12g}" ixy="{xy:.12g}" ixz="{xz:.12g}" '
                    f'iyy="{yy:.12g}" iyz="{yz:.12g}" izz="{zz:.12g}"/>'
                    "</inertial>")
        text.append(f'<link name="l{j + 1}">{link}</link>')
        text.append(
            f'<joint name="{name}" type="{"prismatic" if joint.slides else "revolute"}">'
            f'<parent link="{f"l{j}" if j else "base"}"/><child link="l{j + 1}"/>'
            f'<origin xyz="{written(shift)}" rpy="{written(roll_pitch_yaw(turn))}"/><axis xyz="{written(axis)}"/>'
            f'<limit lower="{joint.lower:.6g}" upper="{joint.upper:.6g}" effort="0" '
            f'velocity="{joint.speed:.6g}"/></joint>')
    return "\n".join([*text, "</robot>"]) + "\n"


def toml_text(joints, names, inertias, convention="modified_dh", said=None):
    """Numbers of this convention; `said`: the other word in the file."""
    text = [f'[robot]\nname = "drawn"\nconvention = "{said or convention}"']
    for j, (joint, name) in enumerate(zip(joints, names)):
        a, alpha, centre, inertia = joint.a, joint.alpha, joint.centre, joint.inertia
        if convention == "standard_dh":
            a, alpha = (joints[j + 1].a, joints[j + 1].alpha) if j + 1 < len(joints) else (0.05, np.pi / 2)
            back = about(0, -alpha)
            centre, inertia = back @ (centre - np.array([a, 0, 0])), back @ inertia @ back.T
        text.append(f'\n[[joint]]\nname = "{name}"\ntype = "{"prismatic" if joint.slides else "revolute"}"\n'
                    f"a_m = {a:.12g}\nalpha_rad = {alpha:.15g}\n"
                    f"d_m = {joint.d:.12g}\noffset_rad = {joint.offset:.15g}\n"
                    f"lower = {joint.lower:.6g}\nupper = {joint.upper:.6g}\nmax_speed = {joint.speed:.6g}\n"
                    f"gear_ratio = {joint.gear:g}")
        if joint.drive:
            text.append(f"drive_inertia = {joint.drive:.9g}")
        if inertias:
            text.append(f"mass_kg = {joint.mass:.12g}\ncentre_m = [{', '.join(f'{x:.12g}' for x in centre)}]\n"
                        f"inertia_kgm2 = [{', '.join(f'{x:.12g}' for x in six(inertia))}]")
    return "\n".join(text) + "\n"


NAMES = [("t_s", "q{j}_rad", "tau{j}_Nm"), ("time", "position_{i}", "effort_{i}"), ("t", "q{j}", "tau{j}"),
         ("stamp", "{name}_pos", "{name}_torque")]


@dataclasses.dataclass
class Taken:
    """A recording as columns: each [samples, joints]."""

    motion: Motion
    torque: np.ndarray


@dataclasses.dataclass
class Case:
    joints: list[Joint]  # the real arm
    in_file: list[Joint]  # as its file says
    friction: Friction
    gravity: np.ndarray  # the real one
    train: Taken
    validation: Taken
    names: list[str]
    columns: tuple
    inertias: bool  # in the robot file
    is_urdf: bool
    convention: str
    said: str | None = None

    def job(self):
        time, position, torque = self.columns
        return {"recording": {"train": '"train.csv"', "validate": '"unseen.csv"',
                              "columns": f'{{time = "{time}", position = "{position}", torque = "{torque}"}}'},
                "filter": {"cutoff_hz": "12", "parallel_cutoff_hz": "6", "decimate_to_hz": "25"},
                "model": {"robot": '"arm.urdf"' if self.is_urdf else '"arm.toml"',
                          "friction": '["viscous", "coulomb", "offset"]'}}

    def write(self, rng, folder):
        robot = (urdf_text(rng, self.in_file, self.names, self.inertias) if self.is_urdf else
                 toml_text(self.in_file, self.names, self.inertias, self.convention, self.said))
        (folder / ("arm.urdf" if self.is_urdf else "arm.toml")).write_text(robot)
        for name, taken in (("train", self.train), ("unseen", self.validation)):
            self.write_recording(folder / f"{name}.csv", taken)
        write_job(folder / "job.toml", self.job())

    def write_recording(self, path, taken):
        def filled(mark, j):
            return mark.format(j=j + 1, i=j, name=self.names[j])

        n = len(self.names)
        head = [self.columns[0], *[filled(mark, j) for mark in self.columns[1:] for j in range(n)]]
        table = np.column_stack([taken.motion.time, taken.motion.q, taken.torque])
        np.savetxt(path, table, "%.9g", ",", header=",".join(head), comments="")


def tip_of(case, folder):
    """The file's tip frame seen from the last joint's: turn and shift."""
    if case.is_urdf:
        text = re.findall(r'<axis xyz="([^"]*)"', (folder / "arm.urdf").read_text(encoding="utf-8"))[-1]
        axis = np.array([float(number) for number in text.split()])
        along = int(abs(axis).argmax())
        own = {0: about(1, -np.pi / 2), 1: about(0, np.pi / 2), 2: np.eye(3)}[along]
        return (own if axis[along] > 0 else about(0, np.pi) @ own), np.zeros(3)
    if case.convention == "standard_dh":
        return about(0, np.pi / 2), np.array([0.05, 0.0, 0.0])
    return np.eye(3), np.zeros(3)


def write_job(path, job):
    text = "\n".join(f"[{name}]\n" + "".join(f"{key} = {value}\n" for key, value in keys.items())
                     for name, keys in job.items())
    pathlib.Path(path).write_text(text + '\n[[estimator]]\nname = "wls"\n')


def measured(rng, joints, motion, torque, noise, counts):
    """What sensors show: an encoder's steps and a noise of the torque in proportion to its size."""
    steps = np.array([2e-6 if joint.slides else 2 * np.pi / counts for joint in joints])
    shown = dataclasses.replace(motion, q=np.round(motion.q / steps) * steps)
    return Taken(shown, torque + noise * torque.std(0) * rng.standard_normal(torque.shape))


def draw_case(rng, *, kind=None, inertias=None, is_urdf=None, off=0.0, gravity=GRAVITY, changed=None):
    """A sound arm. off: share by which the file's masses, centres and inertias are wrong; changed(friction, torque,
    motion): other friction."""
    joints = draw_joints(rng, kind)
    rate = float(rng.choice([100, 125, 200, 250, 500]))
    vigour = rng.uniform(0.6, 0.95)
    motions = [draw_motion(rng, joints, rng.uniform(25, 45), rate, vigour) for _ in range(2)]
    friction = draw_friction(rng, link_torque(joints, motions[0], gravity), motions[0])
    if changed:
        friction = changed(friction, link_torque(joints, motions[0], gravity), motions[0])
    noise, counts = rng.uniform(0.003, 0.02), 2 ** int(rng.integers(15, 20))
    taken = [measured(rng, joints, motion, full_torque(joints, motion, friction, gravity), noise, counts)
             for motion in motions]
    in_file = [dataclasses.replace(
        joint, mass=joint.mass * (1 + off * rng.uniform(-1, 1)),
        centre=joint.centre * (1 + off * rng.uniform(-1, 1, 3)),
        inertia=joint.inertia * (1 + off * rng.uniform(-1, 1))) for joint in joints]
    style = NAMES[int(rng.integers(len(NAMES)))]
    names = [f"{rng.choice(['joint_', 'j', 'axis'])}{j + 1}" for j in range(len(joints))]
    return Case(joints, in_file, friction, gravity, *taken, names, style,
                rng.random() < 0.7 if inertias is None else inertias,
                rng.random() < 0.5 if is_urdf is None else is_urdf, str(rng.choice(["modified_dh", "standard_dh"])))


# what is to be pasted: "-> key = value   key = value"; [model] and the robot file by their marks
def pasted(job, answer, case):
    """The job, and the word for the convention that the advice of `check` leads to; None: nothing to paste."""
    line = next(one for one in answer.document["lines"] if one["topic"] == "arm_setup")
    if "-> " not in line["text"]:
        return None
    job, said = copy.deepcopy(job), case.said or case.convention
    for advice in line["text"].split("-> ", 1)[1].split("   "):
        if "convention" in advice:
            said = {"modified_dh": "standard_dh", "standard_dh": "modified_dh"}[said]
            continue
        match = re.fullmatch(r"(?:\[(model)\] )?(\w+) = (.*)", advice)
        if not match:
            return None
        job[match[1] or "recording"][match[2]] = match[3]
    return job, said


def numbers(keys, name, n, otherwise):
    """[n] of a key of the job."""
    given = np.array([float(text) for text in re.findall(r"[-+.\deinf]+", keys[name])]) if name in keys else otherwise
    return np.broadcast_to(given, n).astype(float)


def taken_as(taken, job):
    """The columns as a job takes them."""
    n, keys = taken.torque.shape[1], job["recording"]
    position = numbers(keys, "position_order", n, np.arange(1, n + 1)).astype(int) - 1
    torque = numbers(keys, "torque_order", n, np.arange(1, n + 1)).astype(int) - 1
    sign = numbers(keys, "joint_sign", n, 1.0)
    unit = sign * numbers(keys, "position_per_unit", n, 1.0)
    old = taken.motion
    motion = Motion(old.time, old.q[:, position] * unit + numbers(keys, "zero", n, 0.0), old.dq[:, position] * unit,
                    old.ddq[:, position] * unit)
    return Taken(motion, taken.torque[:, torque] * sign * numbers(keys, "torque_per_unit", n, 1.0))


def file_error(joints, taken, gravity):
    """[n] rms over rms of what the file's own masses leave of the torque beside frictions and a drive's inertia."""
    left = taken.torque - link_torque(joints, taken.motion, gravity)
    errors = []
    for j in range(len(joints)):
        dq = taken.motion.dq[:, j]
        columns = np.column_stack([dq, np.sign(dq), taken.motion.ddq[:, j], np.ones(len(dq))])
        rest = left[:, j] - columns @ np.linalg.lstsq(columns, left[:, j], rcond=None)[0]
        errors.append(np.sqrt((rest**2).mean() / (taken.torque[:, j] ** 2).mean()))
    return np.array(errors)
