"""Random MJCF files, read by the engine and by MuJoCo of PyPI itself: the same torques. Skipped without MuJoCo.

    mjcf_files.py PROGRAM        PROGRAM is the arm_dynamics of this folder

The files have what people write: angles in degrees or radians, every kind of orientation, default classes, frames,
several joints of a body beside its origin, bodies without joints, <inertial> or geoms.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
try:
    import numpy as np
    import arms
    import libraries
except ImportError as missing:
    peers = ROOT / "build" / "peers"
    python = str(peers / "bin" / "python")
    if (peers / "installed").exists() and sys.executable != python:
        os.execv(python, [python, *sys.argv])
    print(f"skipped: {missing} (scripts/install-peers fetches MuJoCo from PyPI)")
    sys.exit(77)

files, states_per_file = 60, 10
BOUND = 1e-12  # as arm_dynamics.py


class Writer:
    """One random file: a chain of bodies, with everything that its reader must follow."""

    def __init__(self, number):
        self.random = np.random.default_rng([52, number])
        self.degrees = bool(self.random.integers(2))
        self.sequence = "".join(self.random.choice(list("xyzXYZ"), 3))
        self.gravity = self.random.uniform(-10, 10, 3)
        self.joints = 0

    def angle(self, radians):
        return np.degrees(radians) if self.degrees else radians

    def vector(self, reach=0.4, size=3):
        return arms.words(self.random.uniform(-reach, reach, size))

    def orientation(self):
        kind = self.random.choice(["none", "quat", "euler", "axisangle", "xyaxes", "zaxis"])
        if kind == "none":
            return ""
        if kind == "euler":
            return f'euler="{arms.words(self.angle(self.random.uniform(-3, 3, 3)))}"'
        if kind == "axisangle":
            return f'axisangle="{self.vector(1)} {float(self.angle(self.random.uniform(-3, 3)))!r}"'
        return f'{kind}="{self.vector(1, {"quat": 4, "xyaxes": 6, "zaxis": 3}[kind])}"'

    def joint(self):
        self.joints += 1
        slides = self.random.integers(4) == 0
        reference = self.random.uniform(-1, 1) if self.random.integers(3) == 0 else 0.0
        written = [f'name="j{self.joints}"', self.random.choice(["", 'class="heavy"', 'class="light"'])]
        if slides:
            written.append('type="slide"')
        if self.random.integers(2):
            written.append(f'pos="{self.vector()}"')
        if self.random.integers(4):
            written.append(f'axis="{self.vector(1)}"')
        if reference:
            written.append(f'ref="{float(reference if slides else self.angle(reference))!r}"')
        return f'<joint {" ".join(written)}/>'

    def inertial(self):
        body = arms.Body.drawn(self.random)
        if self.random.integers(2):
            xx, xy, xz, yy, yz, zz = body.six()
            return (f'<inertial pos="{arms.words(body.centre)}" mass="{float(body.mass)!r}" '
                    f'fullinertia="{arms.words((xx, yy, zz, xy, xz, yz))}"/>')
        moments = np.linalg.eigvalsh(body.inertia)
        return (f'<inertial pos="{arms.words(body.centre)}" mass="{float(body.mass)!r}" {self.orientation()} '
                f'diaginertia="{arms.words(moments)}"/>')

    def geom(self):
        kind = self.random.choice(["sphere", "box", "capsule", "cylinder", "ellipsoid"])
        sizes = arms.words(self.random.uniform(0.03, 0.2, 3))
        place = f'pos="{self.vector()}" {self.orientation()}'
        if kind in ("capsule", "cylinder") and self.random.integers(2):
            place = f'fromto="{self.vector(0.4, 6)}"'
        mass = self.random.choice(["", 'mass="1.7"', 'density="2700"', 'class="heavy"'])
        return f'<geom type="{kind}" size="{sizes}" {place} {mass}/>'

    def matter(self):
        if self.random.integers(2):
            return self.inertial() + '<geom size="0.1"/>'
        geoms = "".join(self.geom() for _ in range(1 + self.random.integers(3)))
        inner = f'<frame pos="{self.vector()}" {self.orientation()}>{self.geom()}</frame>'
        return geoms + (inner if self.random.integers(2) else "")

    def body(self, depth):
        joints = "".join(self.joint() for _ in range(self.random.choice([0, 1, 1, 1, 2, 3]) if depth else 1))
        fixed = f'<body pos="{self.vector()}" {self.orientation()}>{self.geom()}</body>'
        inner = self.body(depth + 1) if depth < 4 else ""
        around = self.random.choice(["", 'childclass="heavy"'])
        text = (f'<body pos="{self.vector()}" {self.orientation()} {around}>{joints}{self.matter()}'
                f'{fixed if self.random.integers(2) else ""}{inner}</body>')
        if self.random.integers(3) == 0:
            return f'<frame pos="{self.vector()}" {self.orientation()}>{text}</frame>'
        return text

    def text(self):
        return (f'<mujoco model="random"><compiler angle="{"degree" if self.degrees else "radian"}" '
                f'eulerseq="{self.sequence}"/><option gravity="{arms.words(self.gravity)}"/>'
                '<default><joint armature="0.2"/><geom density="900"/>'
                '<default class="heavy"><joint armature="0.7" axis="0 1 0"/><geom density="3000"/>'
                '<default class="light"><joint armature="0.01"/></default></default></default>'
                f'<worldbody>{self.body(0)}</worldbody></mujoco>')


def ours(text, asked):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "robot.xml"
        path.write_text(text, encoding="utf-8")
        told = subprocess.run([PROGRAM, path], input=json.dumps(asked), capture_output=True, text=True, check=True)
    return json.loads(told.stdout)["states"]


class MjcfFiles(unittest.TestCase):
    def test_torques_are_those_of_mujoco(self):
        worst = 0.0
        for number in range(files):
            writer = Writer(number)
            text = writer.text()
            other = libraries.Mujoco(arms.Arm(f"file {number}", text, ".xml", writer.gravity, [], np.zeros(1)))
            random = np.random.default_rng([53, number])
            asked = [{key: random.uniform(-reach, reach, other.size()).tolist() for key, reach in
                      (("q", 3.0), ("dq", 2.0), ("ddq", 5.0), ("tau", 50.0))} for _ in range(states_per_file)]
            mine = np.array([told["torque"] for told in ours(text, asked)])
            theirs = np.array([other.torque(np.array(state["q"]), np.array(state["dq"]), np.array(state["ddq"]))
                               for state in asked])
            error = np.linalg.norm(mine - theirs) / np.linalg.norm(theirs)
            worst = max(worst, error)
            with self.subTest(number=number, text=text):
                self.assertLess(error, BOUND)
        print(f"{libraries.Mujoco.name}: {files} files, torque within {worst:.1e}")


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
