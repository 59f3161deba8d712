"""usage: test_recordings.py PACKAGE

What a Recording takes and refuses, without the compiled engine. PACKAGE: the folder that holds `torquescope`.
"""

import concurrent.futures
import inspect
import pickle
import re
import sys
import unittest

import numpy as np

sys.path.insert(0, sys.argv.pop(1))

import torquescope as ts  # noqa: E402

T = np.arange(100) * 0.01
Q, TAU = np.sin(T), np.cos(T)


class Frame:
    """As pandas gives a data frame of one column to numpy."""

    def __array__(self, dtype=None, copy=None):
        return np.array(Q[:, None], dtype=dtype)


class ARecording(unittest.TestCase):
    def refused(self, **signals):
        with self.assertRaises(ts.DataError) as caught:
            ts.Recording(**{"time": T, "position": Q, "torque": TAU, **signals})
        self.assertEqual(caught.exception.exit_code, 65)
        self.assertIn("help:", str(caught.exception))
        return str(caught.exception)

    def test_takes_columns_and_frames_of_one_column(self):
        made = ts.Recording(time=T[:, None], position=Frame(), torque=TAU.reshape(-1, 1), reference=list(Q))
        self.assertEqual(made.joints, 1)
        for channel, values in (("time", T), ("position", Q), ("torque", TAU), ("reference", Q)):
            np.testing.assert_array_equal(made.signals[channel], values)
        self.assertEqual(ts.Recording(time=T[:, None], position=np.column_stack([Q, Q]),
                                      torque=np.column_stack([TAU, TAU])).joints, 2)

    def test_without_a_torque_is_refused_with_the_way_out(self):
        self.assertIn("has no torque", self.refused(torque=None))
        self.assertIn("torque_per_unit", self.refused(torque=None))
        self.assertIn("has no position", self.refused(position=None))

    def test_of_a_row_or_of_no_numbers_is_refused(self):
        self.assertIn("values.T", self.refused(torque=TAU[None, :]))
        self.assertIn("no number", self.refused(position=np.array([{}] * 100, dtype=object)))
        self.assertIn("no number", self.refused(position=["a"] * 100))

    def test_of_any_layout_has_the_numbers_that_were_given(self):
        table = np.column_stack([Q, TAU])
        read_only = Q.copy()
        read_only.flags.writeable = False
        padded = np.zeros(len(Q), dtype=[("other", "i2"), ("q", "f8")])  # values that lie at odd addresses
        padded["q"] = Q
        layouts = {"Fortran": np.asfortranarray(table)[:, 0], "every second": np.repeat(Q, 2)[::2],
                   "backwards": Q[::-1].copy()[::-1], "high byte first": Q.astype(">f8"), "read-only": read_only,
                   "within records": padded["q"]}
        for what, values in layouts.items():
            with self.subTest(what):
                made = ts.Recording(time=T, position=values, torque=TAU)
                column = dict(made.table())["position"]
                np.testing.assert_array_equal(column, Q)
                self.assertTrue(column.flags.c_contiguous and column.dtype == np.float64 and column.dtype.isnative)
        arm = ts.Recording(time=T, position=np.asfortranarray(table), torque=table)
        np.testing.assert_array_equal(dict(arm.table())["position_2"], TAU)
        single = ts.Recording(time=T.astype(np.float32), position=Q.astype(np.float32), torque=TAU)
        np.testing.assert_array_equal(single.position, Q.astype(np.float32).astype(float))
        np.testing.assert_array_equal(read_only, Q)

    def test_of_masked_and_absent_values_has_nan_there(self):
        masked = np.ma.masked_array(Q, mask=T > 0.5, fill_value=1e20)
        made = ts.Recording(time=T, position=masked, torque=np.where(T > 0.7, np.nan, TAU))
        np.testing.assert_array_equal(np.isnan(made.position), T > 0.5)
        np.testing.assert_array_equal(np.isnan(made.torque), T > 0.7)
        np.testing.assert_array_equal(Q, np.sin(T), "the caller's own stay as they are")

    def test_of_complex_numbers_is_refused(self):
        self.assertIn("complex", self.refused(position=Q + 1j))

    def test_of_ten_million_samples_is_made_without_a_copy(self):
        values = np.zeros(10_000_000)
        made = ts.Recording(rate_hz=1000, position=values, torque=values)
        self.assertTrue(np.shares_memory(made.position, values))
        self.assertEqual(len(made), len(values))

    def test_is_made_by_threads_of_the_caller_side_by_side(self):
        with concurrent.futures.ThreadPoolExecutor(8) as threads:
            made = list(threads.map(lambda k: ts.Recording(time=T, position=Q + k, torque=TAU), range(64)))
        for k, recording in enumerate(made):
            np.testing.assert_array_equal(recording.position, Q + k)

    def test_can_be_pickled(self):
        made = ts.Recording(time=T, position=Q, torque=TAU, name="motion", torque_per_unit=0.1)
        again = pickle.loads(pickle.dumps(made))
        self.assertEqual((again.name, again.options), ("motion", {"torque_per_unit": 0.1}))
        np.testing.assert_array_equal(again.position, Q)


class Help(unittest.TestCase):
    def test_says_units_errors_and_one_example(self):
        for thing in (ts.Recording, ts.Robot, ts.diagnose, ts.identify):
            text = inspect.getdoc(thing)
            for word in ("Example", "rrors", "nits"):
                self.assertIn(word, text, thing.__name__)

    def test_the_example_of_a_recording_is_one(self):
        line = re.search(r"Example +(.*)", inspect.getdoc(ts.Recording))[1]
        names = {"ts": ts, "t": T, "q": Q, "tau": TAU, "q_ref": Q}
        exec(line, names)
        self.assertEqual((len(names["motion"]), names["motion"].joint or names["motion"].name), (100, "elbow"))


if __name__ == "__main__":
    unittest.main(verbosity=1)
