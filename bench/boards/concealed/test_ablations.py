"""The runner of the ablations with a stand-in for the engine: each sees the same recordings and its own job, and is
scored by itself.

    test_ablations.py MAKE_CASE

The stand-in invents an effect where the job allows no delay, and says "none" otherwise.
"""

import contextlib
import io
import json
import os
import pathlib
import stat
import sys
import tempfile
import tomllib
import unittest

import ablations

MAKE_CASE = None
STAND_IN = """#!{python}
import hashlib, json, os, sys, tomllib
job = tomllib.load(open("job.toml", "rb"))
with open("{calls}", "a") as calls:
    train = hashlib.sha256(open("train.csv", "rb").read()).hexdigest()
    calls.write(json.dumps([job, train, sorted(os.listdir("."))]) + "\\n")
no_delay = "longest_delay" in job["diagnose"].get("levels", {{}})
effects = [{{"name": "spring", "family": "static_position"}}] if no_delay else []
joint = {{"joint": 1, "effects": effects, "baseline": {{"validation_relerr": 0.1}}}}
json.dump({{"schema": 1, "verdict": "named" if effects else "none", "joints": [joint]}}, open(sys.argv[4], "w"))
"""
JOB = """[recording]
columns = {time = "t_s", reference = "q_ref_rad", position = "q_rad"}

[diagnose]
effects = "all"
twins = 200
"""


class Edits(unittest.TestCase):
    def test_every_edit_changes_one_thing_and_leaves_toml(self):
        before = tomllib.loads(JOB)
        for name, edit in ablations.ABLATIONS.items():
            with self.subTest(name):
                after = tomllib.loads(edit(JOB))
                if name == "controller_unknown":
                    self.assertEqual(after["recording"]["columns"], {"time": "t_s", "position": "q_rad"})
                    self.assertEqual(after["diagnose"], before["diagnose"])
                    continue
                self.assertEqual(after["recording"], before["recording"])
                self.assertEqual(len(after["diagnose"]), len(before["diagnose"]) + 1)
                self.assertEqual({**after["diagnose"], **before["diagnose"]}, after["diagnose"])

    def test_an_edit_replaces_a_key_that_is_there(self):
        edit = ablations.with_key("twins", "60")
        self.assertEqual(tomllib.loads(edit(JOB))["diagnose"], {"effects": "all", "twins": 60})

    def test_a_reference_at_any_place_goes_and_a_missing_one_is_told(self):
        last = JOB.replace('reference = "q_ref_rad", position = "q_rad"', 'position = "q_rad", reference = "q_ref_rad"')
        self.assertEqual(tomllib.loads(ablations.without_reference(last))["recording"]["columns"],
                         {"time": "t_s", "position": "q_rad"})
        with self.assertRaises(ValueError):
            ablations.without_reference(ablations.without_reference(JOB))
        with self.assertRaises(ValueError):
            ablations.with_key("delta", "0")("[recording]\n")
        with self.assertRaises(ValueError):
            ablations.with_level("beam", "1")("[recording]\n")


class Runner(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.calls, self.out = self.folder / "calls.txt", self.folder / "out"

    def run_ablations(self, *options):
        program = self.folder / "stand_in"
        program.write_text(STAND_IN.format(python=sys.executable, calls=self.calls))
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = ablations.main([str(program), MAKE_CASE, str(self.out), *options])
        return code, out.getvalue(), err.getvalue()

    def called(self):
        return [json.loads(line) for line in self.calls.read_text().splitlines()]

    def test_runs_each_on_the_same_recordings_and_scores_each(self):
        code, text, error = self.run_ablations("--drawn", "T0:3", "--only", "no_delay,beam_of_one")
        self.assertEqual(code, 0, text + error)
        (whole, first), (free, second), (greedy, third) = [
            (job["diagnose"], recording) for job, recording, _ in self.called()
        ]
        self.assertEqual({first}, {second, third})
        self.assertNotIn("levels", whole)
        self.assertEqual((free["levels"], greedy["levels"]), ({"longest_delay": 0}, {"beam": 1}))
        for _, _, seen in self.called():
            self.assertEqual(seen, ["job.toml", "train.csv", "validate.csv"])
        board = json.loads((self.out / "ablations" / "board.json").read_text())
        invented = {name: row["clean: any false name"] for name, row in board.items()}
        self.assertEqual(invented, {"torquescope": [0, 1], "no_delay": [1, 1], "beam_of_one": [0, 1]})
        self.assertEqual(board["no_delay"]["false share of names"], 1.0)
        self.assertIsNone(board["torquescope"]["false share of names"])
        self.assertIn("no_delay", text)
        # where the scorer looks for other methods
        published = json.loads(next((self.out / "rivals" / "ablation_no_delay").iterdir()).read_text())
        self.assertEqual(published["verdict"], "named")
        self.assertGreaterEqual(published["seconds"], 0.0)

        self.run_ablations("--drawn", "T0:3", "--only", "no_delay,beam_of_one")
        self.assertEqual(len(self.called()), 3)
        self.run_ablations("--drawn", "T0:3", "--only", "one_refined")
        self.assertEqual(len(self.called()), 4)

    def test_words_it_does_not_understand(self):
        code, _, error = self.run_ablations("--drawn", "T0:3", "--only", "no_twins")
        self.assertEqual(code, 64)
        self.assertIn("one_sticking", error)


if __name__ == "__main__":
    MAKE_CASE = os.path.abspath(sys.argv.pop())
    sys.exit(unittest.main())
