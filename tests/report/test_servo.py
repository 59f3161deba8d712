"""usage: test_servo.py FOLDER_OF_read_result.py PROGRAM JOBS

Python reads what was found in a set of recordings of servos (/servo): as page/make_servo.py lays it out, and as the
program writes it of two recordings of JOBS/servo_records.
"""

import importlib.util
import json
import math
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

SCRIPTS, PROGRAM, JOBS = sys.argv[1], sys.argv[2], pathlib.Path(sys.argv[3])
sys.path[:0] = [SCRIPTS, str(pathlib.Path(__file__).resolve().parent / "page")]
import make_replay  # noqa: E402
import make_servo  # noqa: E402
import torquescope as ts  # noqa: E402
from torquescope.reader import Result, Servo, summary  # noqa: E402

TWO = ("m0.5_l150_kp32_steps.csv", "m0.75_l150_kp32_steps.csv")  # of training, validation


class ReadsServos(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        for kind in ("servo", "servo_none", "servo_ran_away"):
            make_servo.KINDS[kind](cls.folder / f"{kind}.h5")

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def servo(self, kind="servo"):
        with Result(self.folder / f"{kind}.h5") as result:
            return result.servo()

    def test_the_verdict_and_errors(self):
        servo = self.servo()
        self.assertIsInstance(servo, Servo)
        self.assertEqual((servo.verdict, servo.unit, servo.command_unit), ("class", "rad", "V"))
        self.assertTrue(servo.headline.startswith("explained by Delay of the command"))
        self.assertEqual((servo.train.recordings, servo.validate.recordings), (12, 6))
        validation = [one for one in servo.recordings if one.is_validation]
        self.assertEqual(len(validation), 6)
        for side in ("before", "after"):
            self.assertAlmostEqual(getattr(servo.validate, side), np.mean([getattr(one, side) for one in validation]))

    def test_laws_have_their_numbers_and_rivals(self):
        delay, friction = self.servo().kept
        self.assertEqual((delay.name, delay.title, delay.rivals), ("command_delay", "Delay of the command", []))
        self.assertEqual(friction.rivals, ["load_stribeck_friction"])
        one = delay.parameters["command_delay_s"]
        self.assertEqual((one.unit, one.value), ("s", 0.0402))
        self.assertAlmostEqual(one.half_interval, 2e-5)
        self.assertTrue(math.isnan(friction.parameters["stribeck_speed"].lower), "no interval is known")

    def test_tables_have_rows_by_value(self):
        servo = self.servo()
        self.assertEqual(list(servo.tables), ["kp", "mass_kg", "motion"])
        self.assertEqual([row.value for row in servo.tables["mass_kg"]], ["0.5", "0.75", "1"])
        middle = servo.tables["mass_kg"][1]
        self.assertEqual((middle.train.recordings, middle.validate.recordings, middle.left_out), (0, 6, None))
        self.assertTrue(math.isnan(middle.train.after))
        self.assertEqual(list(servo.left_out), ["mass_kg", "kp"])
        self.assertEqual([row.left_out.recordings for row in servo.left_out["mass_kg"]], [6, 6])

    def test_steps_have_every_law_that_was_tried(self):
        first = self.servo().steps[0]
        self.assertEqual((first.model, first.replicates), ([], 48))
        self.assertEqual([(move.name, move.refusal) for move in first.moves],
                         [("command_delay", "none"), ("torque_lag", "not_predicted"), ("load_friction", "chance")])
        self.assertTrue(math.isnan(first.moves[2].error_after))

    def test_a_result_has_its_verdict_and_parameters(self):
        with ts.open(self.folder / "servo.h5") as result:
            servo = result.servo()
            self.assertEqual((result.verdict, result.reason), (servo.verdict, servo.headline))
            self.assertEqual(list(result.parameters), list(servo.parameters))
            self.assertIn("explained by Delay", repr(result))
            self.assertIn("load_friction", result._repr_html_())
            self.assertEqual([one.name for one in result.replay().recordings], [one.name for one in servo.recordings])

    def test_where_the_model_ran_away_there_is_no_more_than_the_headline(self):
        with ts.open(self.folder / "servo_ran_away.h5") as result:
            servo = result.servo()
            self.assertEqual((servo.verdict, servo.recordings, servo.parameters), ("insufficient", [], {}))
            self.assertTrue(math.isnan(servo.train.before))
            self.assertIsNone(result.replay())
            self.assertIn("runs away", result.summary())

    def test_nothing_missing(self):
        servo = self.servo("servo_none")
        self.assertEqual((servo.kept, servo.left_out, servo.validate.recordings), ([], {}, 0))
        self.assertEqual(list(servo.notes), ["no_validation"])

    def test_other_results_have_none(self):
        make_replay.alone(self.folder / "replayed.h5", make_replay.one_model)
        with ts.open(self.folder / "replayed.h5") as result:
            self.assertIsNone(result.servo())
            self.assertIsNone(result.verdict)

    def test_a_text_that_is_no_diagnosis_is_damage(self):
        for text in (b"{", b"[]", b"{\"kind\": \"servo\"}"):
            name = self.folder / "damaged.h5"
            shutil.copy(self.folder / "servo.h5", name)
            with h5py.File(name, "r+") as file:
                del file["servo/json"]
                make_replay.put(file["servo"], "json", [text])
            with Result(name) as result, self.assertRaisesRegex(ts.ResultError, "damaged in /servo"):
                result.servo()

    @unittest.skipUnless(importlib.util.find_spec("pandas"), "pandas is not here")
    def test_frames(self):
        with ts.open(self.folder / "servo.h5") as result:
            parameters, recordings = result.to_frame(), result.to_frame("recordings")
        self.assertEqual(parameters.loc["command_delay_s", "after"], 0.0402)
        self.assertTrue(np.isnan(parameters.loc["command_delay_s", "before"]))
        self.assertEqual(len(recordings), 18)
        self.assertEqual(recordings["kp"].unique().tolist(), [8.0, 32.0])

    def test_what_the_program_writes(self):
        jobs = self.folder / "jobs"
        (jobs / "servo_records").mkdir(parents=True)
        shutil.copy(JOBS / "servo_loads.toml", jobs)
        head, *lines = (JOBS / "servo_records/manifest.csv").read_text().splitlines()
        kept = [line for line in lines if line.startswith(TWO)]
        (jobs / "servo_records/manifest.csv").write_text("\n".join([head, *kept]) + "\n")
        for name in TWO:
            shutil.copy(JOBS / "servo_records" / name, jobs / "servo_records")
        subprocess.run([PROGRAM, "diagnose", jobs / "servo_loads.toml", "--out", jobs / "r.h5", "--json",
                        jobs / "r.json", "--threads", "2"], check=True, capture_output=True)
        told = json.loads((jobs / "r.json").read_text())
        with ts.open(jobs / "r.h5") as result:
            result.verify()
            servo, replay, text = result.servo(), result.replay(), "\n".join(summary(result))
        self.assertEqual(servo.document, told)
        self.assertEqual([one.name for one in servo.kept], [one["name"] for one in told["kept"]])
        self.assertEqual([(one.name, one.is_validation) for one in servo.recordings], [(TWO[0], False), (TWO[1], True)])
        for one, simulated in zip(servo.recordings, replay.recordings):
            self.assertEqual((one.name, one.role), (simulated.name, simulated.purpose))
            self.assertEqual(one.after, simulated.position.mae[replay.after])
        self.assertEqual(servo.tables["mass_kg"][1].validate.after, servo.validate.after)
        self.assertIn(servo.headline, text)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
