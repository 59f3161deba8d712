"""A folder with recordings and a job that is good, in which tests call the program as people do."""

import os
import shutil
import tempfile
import unittest

import program
import recordings

GOOD_JOB = """
[experiment]
name = "good"
seed = 11
runs = 3

[recording]
train = "good.csv"
validate = "good.csv"
columns = {time = "t_s", position = "q_rad", torque = "tau_Nm"}

[filter]
cutoff_hz = 20

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]

[[estimator]]
name = "ols"

[[estimator]]
name = "de"
population = 20
generations = 30

[[estimator]]
name = "fade"
population = 20
generations = 30
"""


class Folder(unittest.TestCase):
    """A folder of its own with all recordings in it."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_cli_")
        self.addCleanup(shutil.rmtree, self.folder)
        recordings.write_recordings(self.folder)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
        return name

    def run_here(self, *arguments, **more):
        return program.run(*arguments, folder=self.folder, **more)

    def assert_page(self, text):
        """The laws of everything printed into a pipe."""
        self.assertNotIn("\x1b", text)
        for line in text.splitlines():
            self.assertLessEqual(len(line), 80, line)

    def assert_refused(self, outcome, code, words):
        self.assertEqual(outcome.code, code, outcome.err)
        self.assertEqual(outcome.out, "")
        for word in words:
            self.assertIn(" ".join(word.split()), outcome.said)
        self.assertRegex(outcome.err, rf"^error: .*\[{code}\]\n")
        self.assert_page(outcome.err)
        self.assertRegex(outcome.err, r"help: |did you mean", "it says what to do")
