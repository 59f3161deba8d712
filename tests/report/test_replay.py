"""usage: test_replay.py FOLDER_OF_read_result.py

Python reads recordings beside their simulations (/replay) as page/make_replay.py lays them out.
"""

import importlib.util
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

SCRIPTS = sys.argv[1]
sys.path[:0] = [SCRIPTS, str(pathlib.Path(__file__).resolve().parent / "page")]
import make_replay  # noqa: E402
import make_result  # noqa: E402
import torquescope as ts  # noqa: E402
from torquescope.reader import Replay, ReplayChannel, ReplayRecording, Result, summary  # noqa: E402


class ReadsReplays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        for kind, write in make_replay.ALONE.items():
            make_replay.alone(cls.folder / f"{kind}.h5", write)
        for kind in ("rolled", "rolled_several"):
            make_result.crs(cls.folder / f"{kind}.h5")
            with h5py.File(cls.folder / f"{kind}.h5", "r+") as file:
                make_replay.ROLLED[kind][1](file)

    @classmethod
    def tearDownClass(cls):
        shutil.rmtree(cls.folder)

    def replay(self, kind="replayed"):
        with ts.open(self.folder / f"{kind}.h5") as result:
            return result.replay()

    def test_models_and_which_are_compared(self):
        replay = self.replay()
        self.assertIsInstance(replay, Replay)
        self.assertEqual(replay.models, ["as identified", "with what was named", "your simulator"])
        self.assertEqual((replay.before, replay.after, replay.yours, replay.joint), (0, 1, 2, "revolute"))

    def test_recordings_are_in_the_order_of_the_file(self):
        first, second = self.replay().recordings
        self.assertIsInstance(first, ReplayRecording)
        self.assertEqual((first.name, first.purpose, first.is_validation), ("lab_1.csv", "train", False))
        self.assertEqual((second.name, second.purpose, second.is_validation), ("lab_2.csv", "validate", True))
        self.assertEqual((second.rate_hz, second.samples, second.drive, second.loop),
                         (200.0, 6000, "reference", "identified"))
        self.assertEqual((second.loop_words, second.loop_error), (make_replay.LOOP_WORDS, 0.031))
        self.assertTrue(np.isnan(first.horizon_s))
        self.assertEqual(second.horizon_s, 21.0)

    def test_arrays_are_those_of_the_file(self):
        with h5py.File(self.folder / "replayed.h5", locking=False) as file:
            for number, one in enumerate(self.replay().recordings, start=1):
                group = file[f"replay/recording_{number}"]
                np.testing.assert_array_equal(one.time, group["time"])
                for name, channel in one.channels.items():
                    for key in ("measured", "simulated", "rms", "mae", "relerr", "samples"):
                        np.testing.assert_array_equal(getattr(channel, key), group[name][key], f"{name} {key}")
                    self.assertEqual(channel.signal_rms, group[name].attrs["signal_rms"])

    def test_numbers_are_those_of_the_arrays_over_all_samples(self):
        for one in self.replay().recordings:
            for channel in one.channels.values():
                self.assertIsInstance(channel, ReplayChannel)
                for model in (0, 1):
                    error = channel.difference(model)
                    self.assertEqual(channel.samples[model], len(error))
                    self.assertAlmostEqual(channel.rms[model], np.sqrt(np.mean(error**2)))
                    self.assertAlmostEqual(channel.mae[model], np.mean(np.abs(error)))
                    self.assertAlmostEqual(channel.relerr[model], channel.rms[model] / channel.signal_rms)

    def test_units_are_those_of_the_channels(self):
        one = self.replay().recordings[0]
        self.assertEqual([channel.unit for channel in one.channels.values()], ["rad", "rad/s", "N m"])

    def test_a_model_may_say_nothing_of_a_channel(self):
        torque = self.replay().recordings[1].torque
        self.assertEqual([torque.has(model) for model in range(3)], [True, True, False])
        self.assertEqual(torque.samples[2], 0)
        self.assertTrue(np.isnan(torque.relerr[2]))

    def test_one_model_is_before_and_after(self):
        replay = self.replay("replayed_once")
        self.assertEqual((replay.before, replay.after, replay.yours), (0, 0, None))
        one, = replay.recordings
        self.assertEqual((one.drive, one.window_s, one.loop_words), ("windows", 0.5, ""))
        self.assertEqual(list(one.channels), ["position"])
        self.assertIsNone(one.torque)

    def test_a_model_that_diverged_says_so(self):
        one, = self.replay("replayed_diverged").recordings
        self.assertEqual(one.diverged.tolist(), [True, False])
        self.assertTrue(np.isnan(one.position.rms[0]))
        self.assertTrue(np.isfinite(one.position.simulated).all())

    def test_a_file_without_one_has_none(self):
        name = self.folder / "older.h5"
        shutil.copy(self.folder / "replayed.h5", name)
        with h5py.File(name, "r+") as file:
            del file["replay"]
        with ts.open(name) as result:
            self.assertIsNone(result.replay())

    def test_a_replay_alone_is_a_whole_result(self):
        with ts.open(self.folder / "replayed.h5") as result:
            self.assertEqual((result.diagnosis, result.estimators, result.parameters), (None, {}, {}))
            self.assertEqual((result.train, result.validate), (None, None))
            self.assertEqual(repr(result), "<Result 'lab_joint': replay of 2 recordings>")
            self.assertIn("lab_2.csv", result._repr_html_())

    def test_the_summary_has_the_errors_of_every_model_validation_first(self):
        with Result(self.folder / "replayed.h5") as result:
            text = "\n".join(summary(result))
        self.assertLess(text.index("lab_2.csv"), text.index("lab_1.csv"))
        error = self.replay().recordings[1].position.relerr[1]
        for word in ("with what was named", "your simulator", f"{error:.6g}"):
            self.assertIn(word, text)

    def estimators(self, kind):
        """{name: cells of its line in the summary}"""
        with Result(self.folder / f"{kind}.h5") as result:
            lines = "\n".join(summary(result)).split("estimator ")[1].splitlines()
        return {line.split()[0]: line.split() for line in lines[1:] if line}

    def test_the_summary_has_no_gap_of_what_fits_simulations(self):
        lines = self.estimators("rolled_several")
        self.assertEqual({name: " ".join(cells[-2:]) == "simulated samples" for name, cells in lines.items()},
                         {"ols": False, "de": False, "fade": True, "lm": True})
        with Result(self.folder / "rolled_several.h5") as result:
            for name, cells in lines.items():
                one = result.estimators[name]
                gap = [] if name in ("fade", "lm") else [f"{one.gap_median:.6g}"]
                self.assertEqual(cells[3:6 if not gap else 7],
                                 [f"{one.mse_median:.6g}", *gap, f"{one.relerr_median:.6g}",
                                  f"{one.validation_relerr_median:.6g}"])

    def test_parameters_may_be_more_than_the_regressor_has_columns(self):
        with ts.open(self.folder / "rolled.h5") as result:
            parameters, text = result.parameters, result.summary()
            self.assertEqual(len(parameters), 9)
            self.assertEqual(result.train.regressor.shape[1], 4)
            self.assertIn("loop_kp", result._repr_html_())
        self.assertEqual((parameters["loop_kp"].unit, parameters["loop_kp"].value), ("", 4.1e7))
        self.assertTrue(np.isnan(parameters["stribeck_exponent"].lower))
        self.assertIn("loop_torque_delay_s", text)

    @unittest.skipUnless(importlib.util.find_spec("pandas") and importlib.util.find_spec("xarray"),
                         "pandas and xarray are not here")
    def test_frames_of_them(self):
        with ts.open(self.folder / "rolled_several.h5") as result:
            table = result.to_frame("estimators")
            self.assertEqual(table["errors_of"].tolist(), ["rows", "rows", "simulated samples", "simulated samples"])
            self.assertEqual(table["gap_median"].isna().tolist(), [False, False, True, True])
        with ts.open(self.folder / "rolled.h5") as result:
            self.assertEqual(len(result.to_frame()), 9)
            self.assertEqual(result.to_xarray("train").sizes["parameter"], 4)
            self.assertEqual(result.to_xarray("lm").sizes["parameter"], 9)

    def test_command_line(self):
        script = pathlib.Path(SCRIPTS) / "read_result.py"
        told = subprocess.run([sys.executable, "-B", script, self.folder / "replayed_diverged.h5"],
                              capture_output=True, text=True)
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertIn("diverged", told.stdout)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
