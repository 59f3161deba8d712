"""What an arm's joints lack, on recordings of a planar arm whose Lagrangian is written out by hand (arm_cli.py).

Use: TORQUESCOPE=build/dev/bin/torquescope /usr/bin/python3 tests/jobs/arm_diagnosis_cli.py
"""

import json
import math
import os
import random
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import arm_cli  # noqa: E402

JOB = arm_cli.JOB.split("[[estimator]]", maxsplit=1)[0] + """
[diagnose]
effects = ["spring", "load_dependent_friction", "power_law_viscous", "friction_of_previous_joint"]
twins = 60
"""


def recording(law=None, joint=2, seconds=40.0, rate_hz=200.0, other=None):
    """law: (q, dq, torque that the rigid joint needs) -> torque in addition; other: of the other joint's speed."""
    noise = random.Random(7)
    lines = ["t_s,q1_rad,q2_rad,i1_A,i2_A"]
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        moves = (arm_cli.two_sines(t, 0.9, 1.7, 0.3, 4.1, 0.4), arm_cli.two_sines(t, 1.1, 2.3, 0.25, 5.3, 1.9))
        tau = list(arm_cli.torques(*moves))
        if law:
            q, dq, _ = moves[joint - 1]
            truth = arm_cli.TRUTH
            rub = (truth[f"viscous_{joint}"] * dq + truth[f"coulomb_{joint}"] * math.copysign(1.0, dq)
                   + truth[f"offset_{joint}"])
            tau[joint - 1] += law(q, dq, tau[joint - 1] - rub)
        if other:
            tau[joint - 1] += other(moves[2 - joint][1])
        current = [value / gain + noise.gauss(0.0, 0.02) for value, gain in zip(tau, arm_cli.GAIN)]
        lines.append(f"{t:.4f},{moves[0][0]:.9f},{moves[1][0]:.9f},{current[0]:.7f},{current[1]:.7f}")
    return "\n".join(lines) + "\n"


class ArmDiagnosis(arm_cli.Arm):
    text = ""

    def said_of(self, text):
        self.write("arm.csv", text)
        self.write("arm.toml", JOB)
        done = self.here("diagnose", "arm.toml", "--out", "told.h5", "--json", "told.json")
        self.assertEqual(done.code, 0, done.err)
        with open(os.path.join(self.folder, "told.json"), encoding="utf-8") as file:
            return done, json.load(file)

    def test_a_complete_arm_misses_nothing(self):
        done, told = self.said_of(recording())
        self.assertEqual(told["verdict"], "none", told["reason"])
        self.assertEqual([joint["verdict"] for joint in told["joints"]], ["none", "none"])
        self.assertIn("joint 2: NOTHING MISSING", done.out)

    def test_a_law_is_named_at_its_own_joint_and_the_arm_predicts_better(self):
        laws = {"spring": lambda q, _dq, _load: 1.5 * q,
                "load_dependent_friction": lambda _q, dq, load: 0.15 * abs(load) * math.copysign(1.0, dq)}
        for name, law in laws.items():
            with self.subTest(name):
                _, told = self.said_of(recording(law))
                first, second = told["joints"]
                self.assertEqual(first["effects"], [], told["reason"])
                self.assertEqual([one["name"] for one in second["effects"]], [name], told["reason"])
                self.assertIn(f"joint 2 ({name.replace('_', ' ')}", told["reason"])
                self.assertLess(second["augmented"]["validation_relerr"], 0.5 * second["baseline"]["validation_relerr"])
                os.remove(os.path.join(self.folder, "told.h5"))

    def test_friction_of_a_neighbour_is_named_where_it_is_felt(self):
        _, told = self.said_of(recording(other=lambda dq: 0.3 * dq + 0.4 * math.copysign(1.0, dq)))
        first, second = told["joints"]
        self.assertEqual(first["effects"], [], told["reason"])
        self.assertEqual([one["name"] for one in second["effects"]], ["friction_of_previous_joint"], told["reason"])
        values = {one["name"]: one["value"] for one in second["effects"][0]["parameters"]}
        self.assertAlmostEqual(values["previous_viscous"], 0.3, delta=0.03)
        self.assertAlmostEqual(values["previous_coulomb"], 0.4, delta=0.04)

    def test_a_law_of_several_joints_is_no_term_of_one(self):
        self.write("arm.csv", recording(seconds=1.0))
        self.write("arm.toml", JOB.replace('friction = ["', 'friction = ["friction_of_next_joint", "'))
        done = self.here("diagnose", "arm.toml")
        self.assertEqual(done.code, 78)
        self.assertIn("friction_of_next_joint", done.err)

    def test_the_result_keeps_the_verdict_of_each_joint(self):
        _, told = self.said_of(recording(lambda q, _dq, _load: 1.5 * q))
        with h5py.File(os.path.join(self.folder, "told.h5"), "r", locking=False) as result:
            for joint in told["joints"]:
                kept = result[f"diagnosis/joint_{joint['joint']}"].attrs
                self.assertEqual(kept["verdict"].decode(), joint["verdict"])
                self.assertEqual(kept["reason"].decode(), joint["reason"])
        again = self.here("show", "told.h5")
        self.assertEqual(again.code, 0, again.err)
        self.assertIn("joint 1: NOTHING MISSING", again.out)


def load_tests(loader, _tests, _pattern):
    """These alone: those of the other file are inherited with its folder."""
    own = [name for name in vars(ArmDiagnosis) if name.startswith("test_")]
    return unittest.TestSuite(ArmDiagnosis(name) for name in own)


if __name__ == "__main__":
    unittest.main()
