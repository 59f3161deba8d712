"""Friction of single joints and payloads of an arm's job: what a run makes of them, and what is refused, with place.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/arm_sections_cli.py
"""

import json
import os
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import arm_cli  # noqa: E402

JOB = arm_cli.JOB.split("[[estimator]]", maxsplit=1)[0] + '[[estimator]]\nname = "wls"\n'
LOADED = JOB.replace('train = "arm.csv"\ntrain_share = 0.6', 'train = ["arm.csv", "two.csv"]\npayload_kg = [0, 5.06]')
GAINS = LOADED.replace("friction = [", "drive_gains = true\nfriction = [")
MASSES = "payload_kg = [0, 5.06]"


class Sections(arm_cli.Arm):
    text = arm_cli.recording(seconds=8.0)

    def setUp(self):
        super().setUp()
        self.write("two.csv", self.text)

    def refused(self, text, key, *words):
        """The message has its file, the line that begins with `key`, and a way out."""
        self.write("bad.toml", text)
        done = self.here("check", "bad.toml")
        self.assertEqual(done.code, 78, done.err)
        told = " ".join(done.err.split())
        for word in words:
            self.assertIn(word, told)
        line = next(n for n, words_of_line in enumerate(text.splitlines(), 1) if words_of_line.startswith(key))
        self.assertIn(f"bad.toml:{line}:", told)
        return told

    def parameters(self, text):
        self.write("arm.toml", text)
        self.runs = getattr(self, "runs", 0) + 1  # a finished result is not computed anew
        done = self.here("run", "arm.toml", "--out", f"arm_{self.runs}.h5", "--json", "told.json")
        self.assertEqual(done.code, 0, done.err)
        with open(os.path.join(self.folder, "told.json"), encoding="utf-8") as file:
            return [one["name"] for one in json.load(file)["estimators"][0]["parameters"]]

    def test_a_joint_has_the_friction_of_its_section_and_the_others_keep_theirs(self):
        plain = self.parameters(JOB)
        found = self.parameters(JOB + '[model.joint_2]\nfriction = ["viscous", "coulomb_positive", '
                                      '"coulomb_negative"]\n')
        without = [name for name in plain if name not in ("coulomb_2", "offset_2")]
        self.assertEqual(found, without + ["coulomb_positive_2", "coulomb_negative_2"])
        self.assertEqual(self.parameters(JOB + "[model.joint_1]\nfriction = []\n"),
                         [name for name in plain if name not in ("viscous_1", "coulomb_1", "offset_1")])

    def test_a_wrong_friction_of_a_joint_is_said_where_it_stands(self):
        def section(friction, joint=2):
            return JOB + f"[model.joint_{joint}]\n{friction}\n"
        self.refused(section('friction = ["viscous"]', 3), "[model.joint_3]", "the arm has 2 joints",
                     "help: joints are")
        key = 'friction = ["viscos"'
        self.refused(section(key + "]"), key, 'no effect "viscos"', 'did you mean "viscous"?')
        key = 'friction = ["viscous", "viscous"'
        self.refused(section(key + "]"), key, "listed twice", "help: remove one")
        key = 'friction = ["stribeck"'
        self.refused(section(key + "]"), key, "cannot be a term of the model", "help: remove it")
        key = 'friction = ["gravity"'
        self.refused(section(key + "]"), key, '"gravity" is part of the rigid arm already', "help: remove it")
        self.refused(section('frictoin = ["viscous"]'), "frictoin", 'unknown key "frictoin"',
                     'did you mean "friction"?')
        key = 'friction = ["viscous", "coulomb", "offzet"'
        self.refused(JOB.replace('"offset"', '"offzet"'), key, 'did you mean "offset"?')

    def test_wrong_payloads_are_said_with_place_and_way_out(self):
        def masses(text):
            return GAINS.replace(MASSES, text)
        self.refused(masses("payload_kg = [5.06]"), "payload_kg", "1 number, for 2 recordings",
                     "help: write one number")
        self.refused(masses("payload_kg = [0, -5.06]"), "payload_kg", "below 0", "help: write what the scales show")
        self.refused(masses('payload_kg = [0, "5.06"]'), "payload_kg", "mixes numbers and texts")
        for same in ("payload_kg = [0, 0]", "payload_kg = [5.06, 5.06]"):
            self.refused(masses(same), "drive_gains", "different payloads", "help: record once without")
        moments = "payload_first_moments_kgm"
        self.refused(masses(f"{MASSES}\n{moments} = [0, 0, 0]"), moments, "3 numbers, for 2 recordings", "x, y, z")
        self.refused(masses(f"{MASSES}\n{moments} = [0, 0.1, 0, 0.1, 0, 0.4]"), moments, "recording 1 carries nothing",
                     "help: write its mass")
        self.refused(LOADED.replace(MASSES, f"{moments} = [0, 0, 0, 0.1, 0, 0.4]"), moments, "without payload_kg")

    def test_wrong_payloads_of_validation_recordings_are_said(self):
        def validation(masses):
            return LOADED.replace(MASSES, f'{MASSES}\nvalidate = "arm.csv"\nvalidate_payload_kg = {masses}')
        self.refused(validation("[3]"), "validate_payload_kg", "no training recording carries 3 kg",
                     "carry it there too")
        self.refused(validation("[0, 5.06]"), "validate_payload_kg", "2 numbers, for 1 recording",
                     "help: write one number")

    def test_what_is_of_an_arm_is_refused_for_one_joint(self):
        arm = 'robot = "arm_robot.toml"\nfriction = ["viscous", "coulomb", "offset"]'
        job = JOB.replace(arm, 'terms = ["inertia"]').replace("{j}", "1").replace("[10.0, 8.0]", "10.0")
        self.refused(job.replace("train_share", "payload_kg = [5.0]\ntrain_share"), "payload_kg", "no model.robot")
        self.refused(job + '[model.joint_2]\nfriction = ["viscous"]\n', "[model.joint_2]", "no model.robot",
                     "help: name a robot file")


def load_tests(loader, _tests, _pattern):
    """These alone: those of the other file are inherited with its folder."""
    own = [name for name in vars(Sections) if name.startswith("test_")]
    return unittest.TestSuite(Sections(name) for name in own)


if __name__ == "__main__":
    unittest.main()
