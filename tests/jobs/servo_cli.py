"""diagnose of many recordings of a servo, end to end: the effects that were put into jobs/servo_records come out with
their numbers, from any number of threads; what cannot be diagnosed is refused in one line.

Six of the 24 recordings are enough for that; `Shipped` takes jobs/servo_loads.toml as it is.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/servo_cli.py
"""

import csv
import json
import os
import re
import shutil
import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
import simulated_job  # noqa: E402

JOBS = Path(__file__).resolve().parent.parent.parent / "jobs"
JOB = (JOBS / "servo_loads.toml").read_text(encoding="utf-8")
# jobs/servo_records/README.md, Truth
TRUTH = {"command_delay": ("command_delay_s", 0.038), "goal_speed_limit": ("goal_speed_limit", 3.84),
         "load_friction": ("load_friction", 0.149)}
NEAR = 0.02        # of the number: the promise of these records
VALIDATION_RAD = 1e-3  # of the position, mean absolute; an encoder's step is 1.5e-3
SIX = r"kp32_(steps|lift_and_drop)"
FEW = r"m0\.5_l150_kp32_(steps|two_sines)"  # for what does not depend on what is found


def truth_of_readme():
    text = (JOBS / "servo_records" / "README.md").read_text(encoding="utf-8")
    rows = {"command_delay": r"command delay \| ([\d.]+) ms",
            "goal_speed_limit": r"speed limit of the goal \| ([\d.]+)",
            "load_friction": r"friction of the load \| ([\d.]+)"}
    numbers = {name: float(re.search(row, text).group(1)) for name, row in rows.items()}
    return numbers | {"command_delay": 1e-3 * numbers["command_delay"]}


class Sets(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="torquescope_servo_"))
        self.addCleanup(shutil.rmtree, self.folder)

    def write_job(self, which, name="job.toml", change=lambda text: text):
        """jobs/servo_loads.toml with some of its recordings."""
        with open(JOBS / "servo_records" / "manifest.csv", newline="", encoding="utf-8") as file:
            head, *rows = csv.reader(file)
        with open(self.folder / "manifest.csv", "w", newline="", encoding="utf-8") as file:
            some = [[str(JOBS / "servo_records" / row[0]), *row[1:]] for row in rows if re.search(which, row[0])]
            csv.writer(file).writerows([head, *some])
        text = JOB.replace('"servo_records/manifest.csv"', '"manifest.csv"')
        # no further rungs than the effects that are there; where nothing depends on them, one
        text = text.replace('effects = "all"', f'effects = "all"\nmax_effects = {len(TRUTH) if which == SIX else 1}')
        (self.folder / name).write_text(change(text), encoding="utf-8")
        return name

    def diagnose(self, *words, minutes=5):
        with mock.patch.object(program, "SECONDS", minutes * program.SECONDS):
            return program.run("diagnose", *words, folder=self.folder)

    def diagnosed(self, *words, minutes=5):
        done = self.diagnose(*words, "--json", "found.json", minutes=minutes)
        self.assertEqual(done.code, 0, done.err)
        return done, (self.folder / "found.json").read_bytes()

    def expect_truth(self, found):
        self.assertEqual((found["kind"], found["verdict"]), ("servo", "named"), found["headline"])
        kept = {law["name"]: law for law in found["kept"]}
        self.assertEqual(set(kept), set(TRUTH))
        for name, (parameter, truth) in TRUTH.items():
            (number,) = kept[name]["parameters"]
            self.assertEqual((number["name"], kept[name]["rivals"]), (parameter, []))
            self.assertLess(abs(number["value"] - truth), NEAR * truth, name)
        self.assertLess(found["error"]["validate"]["after"], VALIDATION_RAD)
        self.assertLess(found["error"]["validate"]["after"], 0.1 * found["error"]["validate"]["before"])


class Found(Sets):
    def test_the_truth_is_that_of_the_records(self):
        for name, value in truth_of_readme().items():
            self.assertAlmostEqual(TRUTH[name][1], value, 12, name)

    def test_laws_of_six_recordings(self):
        done, told = self.diagnosed(self.write_job(SIX), "--leave-out", "mass_kg", "--threads", "2", "--out", "r.h5")
        found = json.loads(told)
        self.expect_truth(found)
        self.assertEqual([found["error"][role]["recordings"] for role in ("train", "validate")], [4, 2])
        # people read the same
        self.assertIn("explained by", done.out)
        for words in ("mrad validation (2)", "command_delay_s", "goal_speed_limit", "load_friction", "without mass_kg"):
            self.assertIn(words, done.out)
        self.left_out(found)
        self.tables(found)

    def left_out(self, found):
        """Fitted without each load in turn, the effects hold on the one that was left out."""
        (table,) = found["left_out"]
        self.assertEqual((table["quantity"], [row["value"] for row in table["rows"]]), ("mass_kg", ["0.5", "1"]))
        for row in table["rows"]:
            self.assertEqual(row["left_out"]["recordings"], 2)
            self.assertLess(row["left_out"]["after"], 0.1 * row["left_out"]["before"])

    def tables(self, found):
        """Errors by quantity are those of the recordings."""
        self.assertEqual([table["quantity"] for table in found["tables"]], ["mass_kg", "motion"])
        for table in found["tables"]:
            for row in table["rows"]:
                for role in ("train", "validate"):
                    some = [one for one in found["recordings"]
                            if one["role"] == role and str(one["quantities"][table["quantity"]]) in
                            (row["value"], row["value"] + ".0")]
                    self.assertEqual(row[role]["recordings"], len(some))
                    if some:
                        samples = sum(one["samples"] for one in some)
                        mean = sum(one["samples"] * one["after"] for one in some) / samples
                        self.assertAlmostEqual(row[role]["after"], mean, 12)

    def test_a_later_result_is_the_same_and_takes_the_place_of_an_earlier_one_of_its_kind_alone(self):
        job = self.write_job(FEW)
        (self.folder / "other.toml").write_text(simulated_job.job([{"name": "ols"}]), encoding="utf-8")
        self.assertEqual(program.run("run", "other.toml", "--out", "other.h5", folder=self.folder).code, 0)
        before = (self.folder / "other.h5").read_bytes()
        done = self.diagnose(job, "--out", "other.h5")
        self.assertEqual(done.code, 73, done.err)
        self.assertIn("other.h5 is no earlier diagnosis of a set of recordings", done.said)
        self.assertNotIn("simulations", done.err, "refused before minutes are spent")
        self.assertEqual((self.folder / "other.h5").read_bytes(), before)
        # on any number of threads the result is the same
        told = [self.diagnosed(job, "--threads", threads, "--out", "own.h5")[1] for threads in ("1", "2")]
        self.assertEqual(*told)
        # nor does another command take the place of this one
        self.assertEqual(program.run("run", "other.toml", "--out", "own.h5", folder=self.folder).code, 73)


class Refused(Sets):
    def expect(self, code, words, *arguments):
        done = self.diagnose(*arguments)
        self.assertEqual(done.code, code, done.err)
        self.assertIn(words, done.said)
        self.assertEqual(sorted(path.name for path in self.folder.glob("*.h5")), [])
        return done.said

    def test_a_quantity_that_nobody_knows(self):
        said = self.expect(64, "--leave-out nothing: the recordings do not differ in such a quantity",
                           self.write_job(SIX), "--leave-out", "nothing")
        self.assertIn("they differ in mass_kg, motion", said)

    def test_a_quantity_that_is_the_same_in_all(self):
        self.expect(64, "they differ in mass_kg, motion", self.write_job(SIX), "--leave-out", "kp")

    def test_recordings_without_their_command(self):
        job = self.write_job(SIX, change=lambda text: text.replace(' reference = "q_goal_rad",', ""))
        self.expect(78, "a set of recordings is simulated from its commands, and none is named", job)

    def test_a_word_that_known_does_not_have(self):
        job = self.write_job(SIX, change=lambda text: text.replace("command_gain =", "comand_gain ="))
        self.assertIn("command_gain", self.expect(78, "comand_gain", job), "and says what was meant")

    def test_a_quantity_that_known_does_not_find(self):
        job = self.write_job(SIX, change=lambda text: text.replace("* mass_kg * length_m\"", "* mas_kg * length_m\""))
        self.expect(78, "mas_kg", job)

    def test_a_manifest_that_is_not_there(self):
        job = self.write_job(SIX, change=lambda text: text.replace("manifest.csv", "nowhere.csv"))
        self.expect(66, "nowhere.csv", job)

    def test_a_controller_that_no_set_has(self):
        job = self.write_job(SIX, change=lambda text: text.replace("[loop]\n", '[loop]\ncontroller = "p_pi"\nkp = 1\n'
                                                                               "kv = 1\nki = 1\n"))
        self.expect(78, 'controller = "p_pi" is none of a set of recordings', job)

    def test_what_is_about_one_joint(self):
        job = self.write_job(SIX)
        self.expect(64, "--shard and --columns are about one joint or arm", job, "--shard", "1/2")

    def test_leaving_out_of_a_job_without_recordings(self):
        (self.folder / "one.toml").write_text(simulated_job.job(), encoding="utf-8")
        self.expect(64, "--leave-out is about the recordings of [[recordings]]", "one.toml", "--leave-out", "mass_kg")


class Shipped(Sets):
    """The job as people run it: half a minute of a processor."""

    def test_all_recordings(self):
        _, said = self.diagnosed(str(JOBS / "servo_loads.toml"), "--out", "all.h5", minutes=10)
        found = json.loads(said)
        self.expect_truth(found)
        self.assertEqual(found["notes"], [])
        self.assertEqual([found["error"][role]["recordings"] for role in ("train", "validate")], [16, 8])


if __name__ == "__main__":
    unittest.main()
