"""A diagnosis of each kind that costs next to nothing ends in its verdict: a recording at fault, one that is too poor,
a sound one, and one that no single effect explains. (One effect named: structure/readme_commands.py.)"""

import csv
import json
import math
import os
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["TORQUESCOPE"]
SIMULATED = """
[experiment]
name = "verdicts"
[simulate]
rate_hz = 200
duration_s = 10
validate = false
[simulate.plant]
inertia = 0.09
viscous = 0.35
coulomb = 0.6
[simulate.reference]
kind = "multisine"
max_speed = 3.0
[simulate.encoder]
counts_per_revolution = 131072
[simulate.noise]
torque_std = 0.02
"""
JOB = """
[recording]
train = "recorded.csv"
columns = {time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "tau_Nm"}
[filter]
cutoff_hz = 20
decimate_to_hz = 50
[model]
terms = ["inertia", "viscous", "coulomb"]
[diagnose]
twins = 60
effects = ["spring"]
"""


class Verdicts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        (cls.folder / "simulated.toml").write_text(SIMULATED)
        cls.run_program("simulate", "simulated.toml", "--out", "sound.csv")
        cls.head, *cls.rows = cls.logged("sound.csv")
        (cls.folder / "another.toml").write_text(SIMULATED.replace('name = "verdicts"', 'name = "another"\nseed = 2'))
        cls.run_program("simulate", "another.toml", "--out", "another.csv")
        cls.other_rows = cls.logged("another.csv")[1:]
        # a spring in the joint itself, which its loop feels
        too = SIMULATED.replace('name = "verdicts"', 'name = "too"\nseed = 2')
        for name, job in (("sprung", SIMULATED), ("sprung_too", too)):
            (cls.folder / f"{name}.toml").write_text(job.replace("coulomb = 0.6\n", "coulomb = 0.6\nspring = 0.5\n"))
            cls.run_program("simulate", f"{name}.toml", "--out", f"{name}.csv")
        cls.sprung, cls.sprung_too = cls.logged("sprung.csv")[1:], cls.logged("sprung_too.csv")[1:]

    @classmethod
    def logged(cls, name):
        """What a robot would have logged."""
        with open(cls.folder / name, encoding="utf-8") as file:
            return [row[:4] for row in csv.reader(line for line in file if not line.startswith("#"))]

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def run_program(cls, *words):
        ended = subprocess.run([PROGRAM, *words], cwd=cls.folder, capture_output=True, text=True)
        assert ended.returncode == 0, ended.stderr
        return ended.stdout

    def write(self, name, rows):
        with open(self.folder / name, "w", encoding="utf-8", newline="") as file:
            csv.writer(file).writerows([self.head, *rows])

    def said_of(self, rows, further=None, effects='["spring"]', validation=None, filters="", further_options=""):
        self.write("recorded.csv", rows)
        job = JOB.replace('["spring"]', effects).replace("[model]", filters + "[model]") + further_options
        if further:
            self.write("further.csv", further)
            job = job.replace('"recorded.csv"', '["recorded.csv", "further.csv"]')
        if validation:
            self.write("unseen.csv", validation)
            job = job.replace('"recorded.csv"', '"recorded.csv"\nvalidate = "unseen.csv"')
        (self.folder / "job.toml").write_text(job)
        (self.folder / "verdicts.h5").unlink(missing_ok=True)
        return json.loads(self.run_program("diagnose", "job.toml", "--out", "verdicts.h5", "--json", "-", "--quiet"))

    def verdict_of(self, rows):
        return self.said_of(rows)["verdict"]

    @staticmethod
    def with_spring(rows):
        return [[time, reference, position, str(float(torque) + 0.5 * float(position))]
                for time, reference, position, torque in rows]

    def test_a_sound_joint_misses_nothing(self):
        self.assertEqual(self.verdict_of(self.rows), "none")

    def test_a_law_must_serve_every_training_recording(self):
        both = self.said_of(self.with_spring(self.rows), self.with_spring(self.other_rows))
        self.assertEqual(both["verdict"], "named", both["reason"])
        self.assertEqual(both["joints"][0]["effects"][0]["name"], "spring")
        self.assertIn("fitted to recorded.csv and further.csv together", both["reason"])
        # each predicted by the fit to the other
        self.assertLess(both["joints"][0]["augmented"]["cv_relerr"], 0.5 * both["joints"][0]["baseline"]["cv_relerr"])
        first = self.said_of(self.with_spring(self.rows), self.other_rows)
        second = self.said_of(self.rows, self.with_spring(self.other_rows))
        for one in first, second:
            self.assertEqual(one["joints"][0]["effects"], [], one["reason"])
        self.assertEqual(first["verdict"], "unexplained", "what one has and the other has not is no clean joint")

    def test_the_decision_stands_in_the_result_with_its_numbers(self):
        alone = self.said_of(self.sprung, validation=self.sprung_too)
        decision = alone["joints"][0]["decision"]
        self.assertEqual(alone["verdict"], decision["verdict"])
        self.assertEqual([law["name"] for law in decision["accepted"]], ["spring"])
        self.assertLess(decision["final"]["validation"], 0.5 * decision["baseline"]["validation"])
        self.assertEqual(alone["joints"][0]["effects"][0]["name"], "spring")
        low, high = alone["joints"][0]["effects"][0]["parameters"][0]["ci95"]
        self.assertLess(low, 0.5)
        self.assertGreater(high, 0.5)
        self.assertAlmostEqual(0.5 * (low + high), 0.5, delta=0.02)

    def test_a_sound_joint_misses_nothing_and_recordings_are_fitted_together(self):
        sound = self.said_of(self.rows, validation=self.other_rows)["joints"][0]
        self.assertEqual(sound["decision"]["accepted"], [])
        both = self.said_of(self.sprung, self.sprung_too)
        self.assertEqual([law["name"] for law in both["joints"][0]["decision"]["accepted"]], ["spring"])

    def test_a_slow_filter_leaves_no_row_out(self):
        """The slower the filter, the longer the stretch round each reversal that it blurs."""
        slow = "parallel_cutoff_hz = 5\n"
        short, sound = self.with_spring(self.rows)[:1000], self.rows[:1000]
        sprung = self.said_of(short, filters=slow)
        self.assertEqual(sprung["verdict"], "named", sprung["reason"])
        self.assertEqual([one["name"] for one in sprung["joints"][0]["effects"]], ["spring"])
        self.assertNotEqual(self.said_of(sound, filters=slow)["verdict"], "named")

    def test_a_short_validation_recording_counts_with_its_samples(self):
        said = self.said_of(self.sprung, validation=self.sprung_too[:len(self.sprung_too) // 5])
        self.assertEqual(said["verdict"], "named", said["reason"])
        joint = said["joints"][0]
        self.assertLess(joint["augmented"]["validation_relerr"], 0.5 * joint["baseline"]["validation_relerr"])

    def test_a_wave_of_the_clock_is_not_carried_to_another_recording(self):
        """Its phase belongs to the clock of the training recording: there it is kept, elsewhere it says nothing."""
        sprung = self.with_spring(self.rows)
        waved = [[*motion, str(float(torque) + 0.4 * math.sin(2 * math.pi * 1.7 * float(motion[0])))]
                 for *motion, torque in sprung]
        said = self.said_of(waved, effects='["spring", "periodic_disturbance"]',
                            validation=self.with_spring(self.other_rows))
        joint = said["joints"][0]
        self.assertEqual([effect["name"] for effect in joint["effects"]], ["spring", "periodic_disturbance"])
        self.assertLess(joint["augmented"]["validation_relerr"], 0.3 * joint["baseline"]["validation_relerr"])

    def test_a_torque_of_the_other_sign_is_a_fault(self):
        turned = [[*motion, str(-float(torque))] for *motion, torque in self.rows]
        self.assertEqual(self.verdict_of(turned), "data_fault")

    def test_one_constant_speed_is_insufficient(self):
        """Nothing of it can tell friction from mass."""
        steady = [[time, str(0.5 * float(time)), str(0.5 * float(time)), str(0.7 + 0.02 * math.sin(37.0 * k * k))]
                  for k, (time, *_) in enumerate(self.rows)]
        self.assertEqual(self.verdict_of(steady), "insufficient")


if __name__ == "__main__":
    unittest.main(verbosity=2)
