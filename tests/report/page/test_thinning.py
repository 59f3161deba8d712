"""M4 and min/max pairs: nothing that could be seen is lost; packed samples come back."""

import base64
import json
import unittest
import zlib

import support
import numpy as np
from torquescope.page import thin, traces


def columns_covered(x, y, columns, start, stop):
    """Per pixel column: first, lowest, highest, last value."""
    column = np.floor((x - start) / (stop - start) * columns).astype(int)
    return {c: (y[column == c][0], y[column == c].min(), y[column == c].max(), y[column == c][-1])
            for c in range(columns) if (column == c).any()}


class Thinning(unittest.TestCase):
    def setUp(self):
        random = np.random.default_rng(1)
        self.x = np.arange(50000) / 1000
        self.y = np.sin(self.x) + 0.1 * random.normal(size=len(self.x))
        self.y[31234] = 9.0  # one spike of one sample: a reversal

    def test_m4_draws_every_pixel_column_as_all_samples_would(self):
        kept = thin.m4(self.x, self.y, 300, 10.0, 40.0)
        inside = (self.x >= 10) & (self.x < 40)
        drawn = kept[(self.x[kept] >= 10) & (self.x[kept] < 40)]
        self.assertEqual(columns_covered(self.x[inside], self.y[inside], 300, 10, 40),
                         columns_covered(self.x[drawn], self.y[drawn], 300, 10, 40))
        self.assertLess(len(kept), 4 * 302)

    def test_m4_keeps_a_spike_of_one_sample(self):
        self.assertIn(31234, thin.m4(self.x, self.y, 300))

    def test_m4_runs_on_to_the_frame(self):
        kept = thin.m4(self.x, self.y, 300, 10.0, 10.05)
        self.assertLess(self.x[kept[0]], 10.0)
        self.assertGreater(self.x[kept[-1]], 10.05)

    def test_min_max_pairs_keep_the_extremes_of_every_bucket(self):
        kept = thin.min_max_pairs(self.y, 5000)
        self.assertLessEqual(len(kept), 5000)
        buckets = self.y.reshape(2500, 20)
        which = kept // 20
        np.testing.assert_array_equal([self.y[kept[which == b]].max() for b in range(2500)], buckets.max(axis=1))
        np.testing.assert_array_equal([self.y[kept[which == b]].min() for b in range(2500)], buckets.min(axis=1))

    def test_packed_samples_come_back_to_half_a_step(self):
        packed = json.loads(traces.packed(self.x, {"measured": self.y}, self.y, 50000))
        for stored, kind, origin, expected in ((packed["t"], "<i4", packed["t"]["origin"], self.x),
                                               (packed["series"]["measured"], "<i2", 0.0, self.y)):
            steps = np.frombuffer(zlib.decompress(base64.b64decode(stored["data"])), dtype=kind)
            values = origin + stored["scale"] * np.cumsum(steps, dtype=kind)
            self.assertLessEqual(np.abs(values - expected).max(), 0.5001 * stored["scale"])

    def test_the_opened_window_holds_the_most_events(self):
        events = [1000, 30000, 31000, 32000, 33000]
        start, stop = traces.window_with_most(events, self.x)
        self.assertAlmostEqual(stop - start, traces.OPENED_S)
        self.assertTrue(start <= 30.0 and stop >= 33.0)

    def test_a_short_recording_is_opened_whole(self):
        self.assertEqual(traces.window_with_most([5], self.x[:5000]), (0.0, self.x[4999]))


if __name__ == "__main__":
    support.main()
