"""An arm of two joints from its file to its parameters: run, show, JSON, check, and what is refused.

The recording comes from the Lagrangian of a planar arm, written out by hand: it shares no code with the engine.
Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/arm_cli.py
"""

import json
import math
import os
import random
import shutil
import sys
import tempfile
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402

LENGTH = 0.4  # m, between the axes
TRUTH = {"zzr1": 1.9, "mxr1": 2.6, "zz2": 0.31, "mx2": 0.8, "drive_2": 0.12, "viscous_1": 1.1, "coulomb_1": 2.0,
         "offset_1": 0.3, "viscous_2": 0.4, "coulomb_2": 0.9, "offset_2": -0.2}
GAIN = (10.0, 8.0)  # N m per A

ROBOT = """
[robot]
name = "planar arm"
convention = "modified_dh"

[[joint]]
name = "shoulder"
alpha_rad = 1.5707963267948966

[[joint]]
name = "elbow"
a_m = 0.4
"""

# the same arm on a trunk that floats, beside a neck, in two other formats
AS_MJCF = """<mujoco model="planar arm">
<compiler angle="radian"/>
<worldbody>
<body name="trunk" pos="0 0 1"><freejoint/>
<body name="upper"><joint name="shoulder" axis="0 -1 0"/>
<body name="fore" pos="0.4 0 0"><joint name="elbow" axis="0 -1 0"/></body></body>
<body name="head" pos="0 0 0.5"><joint name="neck"/></body></body>
</worldbody>
</mujoco>
"""
AS_URDF = """<robot name="planar arm">
<link name="world"/><link name="trunk"/><link name="upper"/><link name="fore"/><link name="head"/>
<joint name="free" type="floating"><parent link="world"/><child link="trunk"/></joint>
<joint name="shoulder" type="continuous"><parent link="trunk"/><child link="upper"/><axis xyz="0 -2 0"/></joint>
<joint name="elbow" type="continuous"><parent link="upper"/><child link="fore"/><axis xyz="0 -1 0"/>
<origin xyz="0.4 0 0"/></joint>
<joint name="neck" type="continuous"><parent link="trunk"/><child link="head"/><axis xyz="0 0 1"/></joint>
</robot>
"""

JOB = """
[experiment]
name = "planar"
seed = 3
runs = 2

[recording]
train = "arm.csv"
train_share = 0.6
columns = {time = "t_s", position = "q{j}_rad", torque = "i{j}_A"}
torque_per_unit = [10.0, 8.0]

[filter]
cutoff_hz = 20
parallel_cutoff_hz = 10
decimate_to_hz = 50

[model]
robot = "arm_robot.toml"
friction = ["viscous", "coulomb", "offset"]

[[estimator]]
name = "ols"

[[estimator]]
name = "wls"

[[estimator]]
name = "irls"
"""
SEARCH = """
[[estimator]]
name = "lshade"
population = 60
generations = 450
"""


def two_sines(t, a, wa, b, wb, phase):
    q = a * math.sin(wa * t + phase) + b * math.sin(wb * t)
    dq = a * wa * math.cos(wa * t + phase) + b * wb * math.cos(wb * t)
    ddq = -a * wa * wa * math.sin(wa * t + phase) - b * wb * wb * math.sin(wb * t)
    return q, dq, ddq


def torques(first, second, p=None):
    (q1, dq1, ddq1), (q2, dq2, ddq2) = first, second
    p, g = p or TRUTH, 9.81
    bend = LENGTH * p["mx2"] * math.cos(q2)
    swing = LENGTH * p["mx2"] * math.sin(q2)
    weight = g * p["mx2"] * math.cos(q1 + q2)
    tau1 = (p["zzr1"] + p["zz2"] + 2 * bend) * ddq1 + (p["zz2"] + bend) * ddq2
    tau1 += -swing * (2 * dq1 * dq2 + dq2 * dq2) + g * p["mxr1"] * math.cos(q1) + weight
    tau2 = (p["zz2"] + bend) * ddq1 + (p["zz2"] + p["drive_2"]) * ddq2 + swing * dq1 * dq1 + weight
    rubs = [p[f"viscous_{j}"] * dq + p[f"coulomb_{j}"] * math.copysign(1.0, dq) + p[f"offset_{j}"]
            for j, dq in ((1, dq1), (2, dq2))]
    return tau1 + rubs[0], tau2 + rubs[1]


def recording(seconds=30.0, rate_hz=500.0):
    noise = random.Random(5)
    lines = ["t_s,q1_rad,q2_rad,i1_A,i2_A"]
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        first = two_sines(t, 0.9, 1.7, 0.3, 4.1, 0.4)
        second = two_sines(t, 1.1, 2.3, 0.25, 5.3, 1.9)
        tau = torques(first, second)
        current = [value / gain + noise.gauss(0.0, 0.02) for value, gain in zip(tau, GAIN)]
        lines.append(f"{t:.4f},{first[0]:.9f},{second[0]:.9f},{current[0]:.7f},{current[1]:.7f}")
    return "\n".join(lines) + "\n"


class Arm(unittest.TestCase):
    text = recording()

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_arm_")
        self.addCleanup(shutil.rmtree, self.folder)
        self.write("arm.csv", self.text)
        self.write("arm_robot.toml", ROBOT)
        self.write("arm.toml", JOB)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def here(self, *arguments):
        return program.run(*arguments, folder=self.folder)

    def run_job(self, name="arm.toml"):
        done = self.here("run", name, "--json", "told.json")
        self.assertEqual(done.code, 0, done.err)
        with open(os.path.join(self.folder, "told.json"), encoding="utf-8") as file:
            return done, json.load(file)

    def refused(self, old, new, *words, command="check"):
        text = JOB.replace(old, new)
        self.assertNotEqual(text, JOB)
        self.write("bad.toml", text)
        done = self.here(command, "bad.toml")
        self.assertEqual(done.code, 78, done.err)
        for word in words:
            self.assertIn(word, done.said)
        self.assertIn("help: ", done.err)

    def test_parameters_come_out_within_their_errors(self):
        done, told = self.run_job()
        for estimator in told["estimators"]:
            found = {one["name"]: one for one in estimator["parameters"]}
            self.assertLessEqual(set(TRUTH), set(found))
            for name, one in found.items():
                # what the planar arm has not is zero: its first moments across the links
                difference = abs(one["value"] - TRUTH.get(name, 0.0))
                self.assertLess(difference, 5 * one["standard_error"] + 2e-3, f"{estimator['name']} {name}")
            self.assertLess(estimator["validation_relerr"], 0.02)
            self.assertEqual(len(estimator["arm"]["validation_joint_relerr"]), 2)
            self.assertGreaterEqual(estimator["arm"]["relerr_all_rows"], 0.0)
        self.assertEqual(told["arm"]["joints"], ["shoulder", "elbow"])
        gathers = {one["name"]: one["gathers"] for one in told["arm"]["base_parameters"]}
        self.assertIn("0.4", gathers["mxr1"])
        self.assertIn("torquescope report", done.err)
        for line in done.out.splitlines():
            self.assertLessEqual(len(line), 80, line)

    def test_a_part_of_a_robot_in_other_formats_is_the_same_arm(self):
        _, expected = self.run_job()
        for name, text in (("robot.xml", AS_MJCF), ("robot.urdf", AS_URDF)):
            self.write(name, text)
            part = f'robot = "{name}"\nroot = "trunk"\ntip = "fore"'
            self.write("arm.toml", JOB.replace('robot = "arm_robot.toml"', part).replace('"planar"', f'"{name[6:]}"'))
            _, told = self.run_job()
            for mine, other in zip(told["estimators"], expected["estimators"]):
                for one, same in zip(mine["parameters"], other["parameters"]):
                    self.assertEqual(one["name"], same["name"])
                    self.assertAlmostEqual(one["value"], same["value"], delta=1e-6 * (1 + abs(same["value"])))
            # without its root the line to write is told; what nobody reads is warned of with its line
            self.assertIn('root = "trunk" and tip = ', self.here("describe", name).err)
            described = self.here("describe", name, "--root", "trunk", "--tip", "fore")
            self.assertEqual(described.code, 0, described.err)
            self.write(name, text.replace('axis="0 -1 0"', 'axes="0 -1 0"').replace("<axis", "<axic"))
            checked = self.here("check", "arm.toml")
            self.assertIn('did you mean "axis"?', " ".join(checked.out.split()))
            self.assertIn(f"{name}:", checked.out)

    def test_the_result_holds_rows_and_products_of_each_joint(self):
        self.run_job()
        with h5py.File(os.path.join(self.folder, "planar.h5"), "r", locking=False) as result:
            names = [name.decode() for name in result["model/names"][:]]
            values = result["runs/wls/parameters"][0]
            for joint, error in enumerate(result["runs/wls/joint_relerr"][:], start=1):
                rows, own = result[f"data/train/joint_{joint}"], result[f"arm/joint_{joint}/parameters"][:]
                left = rows["torque"][:] - rows["regressor"][:] @ values[own]
                self.assertAlmostEqual(math.sqrt((left**2).sum() / (rows["torque"][:]**2).sum()), error, places=12)
                gram = result[f"arm/joint_{joint}/gram"][:]
                self.assertAlmostEqual(gram[-1, -1] / (rows["torque"][:]**2).sum(), 1.0, places=9)
            self.assertEqual(names[-1], "offset_2")

    def test_population_methods_find_the_weighted_optimum_and_go_on(self):
        self.write("arm.toml", JOB + SEARCH)
        _, told = self.run_job()
        search = told["estimators"][-1]
        self.assertLess(search["gap_median"], 1e-3)
        again = self.here("run", "arm.toml")
        self.assertIn("already complete", again.err)

    def test_show_says_errors_by_joint_and_report_makes_a_page(self):
        self.run_job()
        shown = self.here("show", "planar.h5")
        self.assertEqual(shown.code, 0)
        for word in ("1 shoulder", "2 elbow", "arm, all rows", "gap to WLS"):
            self.assertIn(word, shown.out)
        page = self.here("report", "planar.h5")
        self.assertEqual(page.code, 0, page.err)
        with open(os.path.join(self.folder, "planar.html"), encoding="utf-8") as file:
            text = file.read()
        for word in ("joint_torque_1", "joint_torque_2", "mxr1", "reproduce the torques of a validation motion"):
            self.assertIn(word, text)

    def test_check_speaks_of_every_joint(self):
        done = self.here("check", "arm.toml")
        self.assertEqual(done.code, 0, done.out)
        self.assertIn("joint 2 (elbow): speed", " ".join(done.out.split()))

    def test_another_robot_is_another_result(self):
        self.run_job()
        self.write("arm_robot.toml", ROBOT.replace("0.4", "0.41"))
        again = self.here("run", "arm.toml")
        self.assertNotIn("already complete", again.err)

    def test_what_is_wrong_is_said_with_its_cure(self):
        self.refused('torque = "i{j}_A"', 'torque = "i1_A"', 'torque = "i1_A" is one column, and the arm has 2 joints')
        self.refused("[10.0, 8.0]", "[10.0, 8.0, 7.0]", "torque_per_unit has 3 numbers, and the arm has 2 joints")
        self.refused('robot = "arm_robot.toml"', 'robot = "arm_robot.toml"\nterms = ["inertia"]',
                     "model.terms beside model.robot")
        self.refused('"offset"]', '"offzet"]', 'there is no effect "offzet"')
        self.refused("train_share = 0.6", "train_share = 1.6", "train_share = 1.6 is out of range")

    def test_a_validation_arm_that_stands_still_is_said_and_judges_nothing(self):
        rows = self.text.splitlines()
        still = [rows[0]]
        for k in range(2000):
            flicker = 1e-4 * (k % 900 == 7)
            still.append(f"{k / 500:.4f},0.1,{0.2 + flicker:.4f},{0.6 + 1e-3 * (k % 7):.4f},0.4{k % 3}")
        still[1] = "0.0000,0.1001,0.2000,0.6000,0.400"
        self.write("still.csv", "\n".join(still) + "\n")
        self.write("arm.toml", JOB.replace("train_share = 0.6", 'validate = "still.csv"'))
        self.assertIn("the joint stands still", " ".join(self.here("check", "arm.toml").out.split()))
        _, told = self.run_job()
        self.assertIsNone(told["estimators"][0]["validation_relerr"])
        self.assertIsNotNone(told["estimators"][0]["arm"]["validation_relerr_all_rows"])

    def test_a_torque_of_the_wrong_sign_is_refused(self):
        self.write("bad.toml", JOB.replace("[10.0, 8.0]", "[-10.0, -8.0]"))
        for command in ("check", "run"):
            done = self.here(command, "bad.toml")
            self.assertEqual(done.code, 65, done.err)
            told = " ".join((done.out + done.err).split())
            for words in ("inertia of joint 1 = -", "viscous_2 = -", "check columns.torque, its sign"):
                self.assertIn(words, told)

    def test_check_says_what_a_joint_at_rest_does_not_tell(self):
        told = " ".join(self.here("check", "arm.toml").out.split())
        self.assertIn("13 parameters: 13 alone, 0 only in a group, 0 not at all", told)
        noise, lines = random.Random(3), self.text.splitlines()
        for k in range(1, len(lines)):
            t = (k - 1) / 500.0
            first = two_sines(t, 0.9, 1.7, 0.3, 4.1, 0.4)
            tau = torques(first, (0.5, 0.0, 0.0))
            q2 = 0.5 + noise.gauss(0.0, 1e-6)
            lines[k] = f"{t:.4f},{first[0]:.9f},{q2:.9f}," + ",".join(
                f"{value / gain + noise.gauss(0.0, 0.02):.7f}" for value, gain in zip(tau, GAIN))
        self.write("arm.csv", "\n".join(lines) + "\n")
        told = " ".join(self.here("check", "arm.toml").out.split())
        for words in ("together: mxr1, my1, zzr1, mx2, my2, zz2", "not seen: drive_2, viscous_2, coulomb_2, offset_2",
                      "move joint 2 (elbow)"):
            self.assertIn(words, told)

    def test_one_joint_takes_one_gain(self):
        arm = 'robot = "arm_robot.toml"\nfriction = ["viscous", "coulomb", "offset"]'
        job = JOB.replace(arm, 'terms = ["inertia"]')
        self.write("bad.toml", job.replace("{j}", "1"))
        done = self.here("check", "bad.toml")
        self.assertEqual(done.code, 78)
        self.assertIn("torque_per_unit has 2 numbers, and the job is about one joint", done.said)


if __name__ == "__main__":
    unittest.main()
