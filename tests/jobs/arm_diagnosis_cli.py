"""What an arm's joints lack, on recordings of a planar arm whose Lagrangian is written out by hand (arm_cli.py).

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/arm_diagnosis_cli.py
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


def recording(law=None, joint=2, seconds=40.0, rate_hz=200.0, other=None, simulator=None, everywhere=None,
              seed=7):
    """law: (q, dq, torque that the rigid joint needs) -> torque in addition; other: of the other joint's speed.
    simulator: (both motions) -> both torques, in two more columns; everywhere: the same at a time, in
    addition to the truth."""
    noise = random.Random(seed)
    lines = ["t_s,q1_rad,q2_rad,i1_A,i2_A" + (",s1_Nm,s2_Nm" if simulator else "")]
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
        if everywhere:
            tau = [value + more for value, more in zip(tau, everywhere(moves, t))]
        current = [value / gain + noise.gauss(0.0, 0.02) for value, gain in zip(tau, arm_cli.GAIN)]
        simulated = "".join(f",{value:.7f}" for value in simulator(moves)) if simulator else ""
        lines.append(f"{t:.4f},{moves[0][0]:.9f},{moves[1][0]:.9f},{current[0]:.7f},{current[1]:.7f}{simulated}")
    return "\n".join(lines) + "\n"


def shoulder_spring(moves, _t=None):
    """An effect of the machine that its user knows: a counterbalance at the shoulder."""
    return 6.0 * moves[0][0], 0.0


def picked_up(moves, t, mass=1.2, at=0.35, when=9.0):
    """A point mass on the second link, from an instant on."""
    if t < when:
        return 0.0, 0.0
    truth, length = arm_cli.TRUTH, arm_cli.LENGTH
    heavier = dict(truth, zzr1=truth["zzr1"] + mass * length**2, mxr1=truth["mxr1"] + mass * length,
                   zz2=truth["zz2"] + mass * at**2, mx2=truth["mx2"] + mass * at)
    return [with_it - without for with_it, without in zip(arm_cli.torques(*moves, heavier), arm_cli.torques(*moves))]


def users_simulator(moves):
    """Knows the counterbalance, and has some parameters of the arm wrong."""
    (q1, _, ddq1), (_, dq2, ddq2) = moves
    elbow = 0.05 * (ddq1 + ddq2)  # an inertia about its own axis
    wrong = (0.3 * ddq1 + 0.4 * 9.81 * math.cos(q1) + elbow, 0.1 * dq2 + elbow)
    return [tau + known + error for tau, known, error in zip(arm_cli.torques(*moves), shoulder_spring(moves), wrong)]


class ArmDiagnosis(arm_cli.Arm):
    text = ""

    def said_of(self, text, job=JOB):
        self.write("arm.csv", text)
        self.write("arm.toml", job)
        done = self.here("diagnose", "arm.toml", "--out", "told.h5", "--json", "told.json", "--progress", "lines")
        self.assertEqual(done.code, 0, done.err)
        with open(os.path.join(self.folder, "told.json"), encoding="utf-8") as file:
            return done, json.load(file)

    def test_a_complete_arm_misses_nothing(self):
        done, told = self.said_of(recording())
        self.assertEqual(told["verdict"], "none", told["reason"])
        self.assertEqual([joint["verdict"] for joint in told["joints"]], ["none", "none"])
        self.assertIn("joint 2  NOTHING MISSING", done.out)
        for joint in (1, 2):
            self.assertIn(f"progress stage=joint{joint}:search ", done.err)

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

    def test_every_joint_says_what_decided(self):
        _, told = self.said_of(recording(lambda _q, dq, load: 0.15 * abs(load) * math.copysign(1.0, dq)))
        first, second = told["joints"]
        self.assertEqual([told["verdict"], first["verdict"], second["verdict"]], ["named", "none", "named"],
                         told["reason"])
        self.assertEqual([one["name"] for one in second["effects"]], ["load_dependent_friction"])
        self.assertEqual(first["decision"]["accepted"], [])
        self.assertEqual([law["name"] for law in second["decision"]["accepted"]], ["load_dependent_friction"])
        self.assertLess(second["augmented"]["validation_relerr"], 0.5 * second["baseline"]["validation_relerr"])
        # combinations of masses are no parameters of a joint
        self.assertEqual([one["name"] for one in first["baseline"]["parameters"]],
                         ["inertia", "viscous", "coulomb", "offset"])
        os.remove(os.path.join(self.folder, "told.h5"))

    def test_friction_of_a_neighbour_is_named_where_it_is_felt(self):
        _, told = self.said_of(recording(other=lambda dq: 0.3 * dq + 0.4 * math.copysign(1.0, dq)))
        first, second = told["joints"]
        self.assertEqual(first["effects"], [], told["reason"])
        self.assertEqual([one["name"] for one in second["effects"]], ["friction_of_previous_joint"], told["reason"])
        values = {one["name"]: one["value"] for one in second["effects"][0]["parameters"]}
        self.assertAlmostEqual(values["previous_viscous"], 0.3, delta=0.03)
        self.assertAlmostEqual(values["previous_coulomb"], 0.4, delta=0.04)

    def test_a_law_that_the_rigid_arm_had_hidden_is_named(self):
        _, told = self.said_of(recording(everywhere=shoulder_spring))
        first, second = told["joints"]
        self.assertEqual([one["name"] for one in first["effects"]], ["spring"], told["reason"])
        self.assertEqual(second["effects"], [], told["reason"])
        # before: the rigid arm as it is fitted without the effect, which is not far off
        self.assertLess(first["baseline"]["validation_relerr"], 0.012)
        self.assertLess(first["augmented"]["validation_relerr"], 0.7 * first["baseline"]["validation_relerr"])
        os.remove(os.path.join(self.folder, "told.h5"))

    def test_what_the_users_simulator_knows_is_not_missing(self):
        # the recording is of instants: half a sample before a torque that is held from its row on
        simulated = JOB.replace("torque_per_unit",
                                'simulated_torque = "s{j}_Nm"\ndelay_s = -0.0025\ntorque_per_unit')
        _, told = self.said_of(recording(everywhere=shoulder_spring, simulator=users_simulator), simulated)
        self.assertEqual([joint["verdict"] for joint in told["joints"]], ["none", "none"], told["reason"])
        # nearly all that differs from the simulator are wrong parameters
        for joint in told["joints"]:
            self.assertGreater(joint["budget"]["parameter_error"], 0.9)
        os.remove(os.path.join(self.folder, "told.h5"))

        def load_friction(_q, dq, load):
            return 0.15 * abs(load) * math.copysign(1.0, dq)

        _, told = self.said_of(recording(load_friction, everywhere=shoulder_spring, simulator=users_simulator),
                               simulated)
        first, second = told["joints"]
        self.assertEqual(first["effects"], [], told["reason"])
        self.assertEqual([one["name"] for one in second["effects"]], ["load_dependent_friction"], told["reason"])
        self.assertLess(second["budget"]["parameter_error"], 0.9)

    def test_a_payload_picked_up_is_named_with_its_instant(self):
        """Both joints feel it at once: its numbers are of the arm, and no joint gets a name for it."""
        job = JOB.replace('"spring", ', '"spring", "payload_change", "payload_picked_up", "gravity_direction", ')
        job = job.replace("train_share = 0.6", 'validate = "bare.csv"\ndelay_s = -0.0025')
        self.write("bare.csv", recording(seconds=16.0, seed=8))
        _, told = self.said_of(recording(everywhere=picked_up, seconds=24.0), job)
        self.assertEqual([joint["effects"] for joint in told["joints"]], [[], []], told["reason"])
        [payload] = told["arm"]["effects"]
        self.assertEqual([payload["name"], payload["equivalent"]], ["payload_picked_up", []])
        values = {one["name"]: one["value"] for one in payload["parameters"]}
        self.assertAlmostEqual(values["payload_mass"], 1.2, delta=0.03)
        self.assertAlmostEqual(values["payload_mx"], 1.2 * 0.35, delta=0.01)
        self.assertAlmostEqual(values["payload_from"], 9.0, delta=0.1)
        self.assertNotIn("payload_until", values)
        self.assertEqual(told["verdict"], "named")
        self.assertIn("of arm.csv on all joints feel a payload", told["reason"])
        looked_at = {one["name"]: one["decision"] for one in told["arm"]["candidates"]}
        self.assertEqual(looked_at, {"payload_picked_up": "named", "gravity_direction": "no"})
        self.assertIn("payload picked up 1.2 kg", self.here("show", "told.h5").out)
        self.assertIn("payload_picked_up", self.here("show", "told.h5", "--all").out)
        with h5py.File(os.path.join(self.folder, "told.h5"), "r", locking=False) as result:
            kept = result["diagnosis/arm/effects/effect_1"].attrs
            self.assertEqual(kept["name"].decode(), "payload_picked_up")

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
        self.assertIn("joint 1  NOTHING MISSING", again.out)


def load_tests(loader, _tests, _pattern):
    """These alone: those of the other file are inherited with its folder."""
    own = [name for name in vars(ArmDiagnosis) if name.startswith("test_")]
    return unittest.TestSuite(ArmDiagnosis(name) for name in own)


if __name__ == "__main__":
    unittest.main()
