"""A simulated arm from its file to its parameters: excite, simulate, run, and what is refused.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/arm_simulation_cli.py
"""

import csv
import json
import os
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402

SPEED, ACCELERATION, RANGE = 2.0, 9.0, 1.2

ROBOT = f"""
[robot]
name = "planar arm"
convention = "modified_dh"

[[joint]]
name = "shoulder"
alpha_rad = 1.5707963267948966
lower = -{RANGE}
upper = {RANGE}
max_speed = {SPEED}
max_acceleration = {ACCELERATION}
drive_inertia = 0.2
mass_kg = 3.0
centre_m = [0.2, 0.01, 0.0]
inertia_kgm2 = [0.01, 0.0, 0.0, 0.05, 0.0, 0.05]

[[joint]]
name = "elbow"
a_m = 0.4
lower = -{RANGE}
upper = {RANGE}
max_speed = {SPEED}
max_acceleration = {ACCELERATION}
drive_inertia = 0.1
mass_kg = 1.5
centre_m = [0.15, 0.0, 0.0]
inertia_kgm2 = [0.004, 0.0, 0.0, 0.02, 0.0, 0.02]
"""

JOB = """
[experiment]
name = "planar"
seed = 3

[model]
robot = "arm_robot.toml"
friction = ["viscous", "coulomb", "offset"]

[filter]
cutoff_hz = 20
parallel_cutoff_hz = 10
decimate_to_hz = 40

[[estimator]]
name = "wls"

[excite]
period_s = 5
evaluations = 300
rate_hz = 50

[simulate]
rate_hz = 200
duration_s = 10

[simulate.plant]
viscous = [0.8, 0.3]
coulomb = [1.0, 0.4]
offset = 0.1

[simulate.controller]
kind = "pd"
rate_hz = 1000
bandwidth_hz = 6
feedforward = true
torque_log = "averaged"

[simulate.noise]
torque_std = [0.05, 0.02]
"""


class SimulatedArm(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_arm_simulation_")
        self.addCleanup(shutil.rmtree, self.folder)
        self.write("arm_robot.toml", ROBOT)
        self.write("arm.toml", JOB)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def columns(self, name):
        rows = csv.DictReader(line for line in self.read(name).splitlines() if not line.startswith("#"))
        table = [{key: float(value) for key, value in row.items()} for row in rows]
        return {key: [row[key] for row in table] for key in table[0]}

    def here(self, *arguments, code=0):
        done = program.run(*arguments, folder=self.folder)
        self.assertEqual(done.code, code, done.err)
        return done

    def test_excite_keeps_the_limits_and_begins_and_ends_at_rest(self):
        done = self.here("excite", "arm.toml", "--out", "motion.csv", "--threads", "1")
        self.assertIn("condition", done.err)
        motion = self.columns("motion.csv")
        self.assertAlmostEqual(motion["t_s"][-1], 5.0)
        for joint in (1, 2):
            for name, limit in ((f"q{joint}_rad", RANGE), (f"dq{joint}_rad_s", SPEED),
                                (f"ddq{joint}_rad_s2", ACCELERATION)):
                self.assertLessEqual(max(map(abs, motion[name])), limit)
                self.assertEqual(motion[name][0], motion[name][-1])
            self.assertAlmostEqual(motion[f"dq{joint}_rad_s"][0], 0.0)
            self.assertGreater(max(motion[f"dq{joint}_rad_s"]), 0.3)
        self.here("excite", "arm.toml", "--out", "again.csv", "--threads", "2")
        self.assertEqual(self.read("motion.csv"), self.read("again.csv"))
        self.here("excite", "arm.toml", "--out", "motion.csv", code=73)

    def test_run_finds_the_truth_on_the_motion_of_excite(self):
        self.here("excite", "arm.toml", "--out", "motion.csv")
        self.write("arm.toml", JOB + '\n[simulate.reference]\nfile = "motion.csv"\n')
        self.here("simulate", "arm.toml", "--out", "recording.csv")
        truth = {}
        for line in self.read("recording.csv").splitlines():
            if line.startswith("# truth: "):
                name, value = line[len("# truth: "):].split(" = ")
                truth[name] = float(value)
        self.assertEqual(truth["viscous_2"], 0.3)
        self.assertEqual(truth["offset_1"], 0.1)
        recording = self.columns("recording.csv")
        self.assertEqual(len(recording["tau2_Nm"]), 2000)
        self.assertIn("q_ref1_rad", recording)

        self.here("run", "arm.toml", "--json", "told.json")
        told = json.loads(self.read("told.json"))
        for one in told["estimators"][0]["parameters"]:
            self.assertIn(one["name"], truth)
            difference = abs(one["value"] - truth[one["name"]])
            self.assertLess(difference, 6 * one["standard_error"] + 1e-3, one["name"])

    def test_an_effect_at_one_joint_changes_the_torque_of_its_coming_to_rest(self):
        self.here("simulate", "arm.toml", "--out", "without.csv")
        effect = ('\n[[simulate.effects]]\njoint = 2\nname = "stribeck"\nstribeck = 0.5\nstribeck_speed = 0.1\n'
                  "stribeck_exponent = 1.0\n")
        self.write("arm.toml", JOB + effect)
        self.here("simulate", "arm.toml", "--out", "with.csv")
        self.assertIn("# truth: stribeck_2 = 0.5", self.read("with.csv"))
        before, after = self.columns("without.csv"), self.columns("with.csv")
        # friction of a joint shows in its own torque while it creeps, in the others' nowhere near as much
        slow = [k for k, speed in enumerate(after["dq_true2_rad_s"]) if 0.0 < abs(speed) < 0.02]
        change = {joint: sum(abs(after[f"tau_true{joint}_Nm"][k] - before[f"tau_true{joint}_Nm"][k]) for k in slow)
                  for joint in (1, 2)}
        self.assertGreater(len(slow), 5)
        self.assertGreater(change[2] / len(slow), 0.2)
        self.assertLess(change[1], 0.5 * change[2])

    def test_what_is_wrong_is_said(self):
        self.write("bad.toml", JOB.replace("viscous = [0.8, 0.3]", "viscous = [0.8, 0.3, 0.1]"))
        done = self.here("simulate", "bad.toml", "--out", "bad.csv", code=78)
        self.assertIn("holds 3 numbers, but the arm has 2 joints", done.said)
        self.write("bad.toml", JOB + '\n[[simulate.effects]]\njoint = 3\nname = "stribeck"\n')
        self.assertIn("joint = 2", self.here("simulate", "bad.toml", "--out", "bad.csv", code=78).said)
        self.write("bad.toml", JOB.replace("period_s = 5", "floor_m = 3.0"))
        self.assertIn("no motion was found", self.here("excite", "bad.toml", "--out", "bad.csv", code=78).said)


if __name__ == "__main__":
    unittest.main()
