"""usage: test_bag_tables.py PACKAGE

What becomes of messages, without rosbags: their numbers under names, several topics on the stamps of one, the table.
PACKAGE: the folder that holds `torquescope`. numpy and h5py are enough.
"""

import contextlib
import csv
import dataclasses
import io
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import h5py
import numpy as np

sys.path.insert(0, sys.argv.pop(1))

from torquescope.__main__ import main  # noqa: E402
from torquescope.ros import merge, table  # noqa: E402
from torquescope.ros.fields import header_stamp, numbers_of  # noqa: E402
from torquescope.ros.path import PathGathering  # noqa: E402
from torquescope.ros.series import HEADER, HOLD, PATH, RECEIVED, Gathering, Series, Topic  # noqa: E402

MS = 10**6  # ns
BEGIN = 1768472944 * 10**9


def message(**fields):
    """As rosbags makes them: a dataclass."""
    return dataclasses.make_dataclass("Message", fields)(**fields)


def stamped(nanoseconds, **fields):
    stamp = message(sec=nanoseconds // 10**9, nanosec=nanoseconds % 10**9)
    return message(header=message(stamp=stamp, frame_id="base"), **fields)


def topic(name, kind, **series):
    return Topic(name, kind, 0, HEADER, series)


class NumbersOfAMessage(unittest.TestCase):
    def test_lists_of_joints_have_the_joints_names(self):
        numbers, _ = numbers_of(stamped(BEGIN, name=["elbow", "wrist"], position=np.array([1.0, 2.0]),
                                        velocity=np.array([]), effort=np.array([3.0, 4.0])))
        self.assertEqual(numbers, {"elbow/position": 1, "wrist/position": 2, "elbow/effort": 3, "wrist/effort": 4})

    def test_of_a_controller_too_wherever_in_the_message(self):
        numbers, _ = numbers_of(stamped(BEGIN, joint_names=["elbow", "wrist"], speed_scaling=0.5,
                                        desired=message(positions=np.array([1.0, 2.0]), other=np.array([7.0]))))
        self.assertEqual(numbers, {"speed_scaling": 0.5, "elbow/desired.positions": 1, "wrist/desired.positions": 2,
                                   "desired.other[0]": 7})

    def test_other_fields_have_their_dotted_path(self):
        numbers, too_long = numbers_of(message(data=True, twist=message(linear=message(x=1.5)), text="no",
                                               few=np.arange(2), picture=np.zeros(640, dtype=np.uint8)))
        self.assertEqual(numbers, {"data": True, "twist.linear.x": 1.5, "few[0]": 0, "few[1]": 1})
        self.assertEqual(too_long, {"picture": 640})

    def test_interfaces_of_joints_have_their_names(self):
        interfaces = [message(interface_names=["position", "effort"], values=np.array([k, 10.0 * k])) for k in (1, 2)]
        numbers, _ = numbers_of(stamped(BEGIN, joint_names=["elbow", "wrist"], interface_values=interfaces))
        self.assertEqual(numbers, {"elbow/position": 1, "elbow/effort": 10, "wrist/position": 2, "wrist/effort": 20})

    def test_a_stamp_that_was_never_set_is_none(self):
        self.assertEqual(header_stamp(stamped(BEGIN + 5)), BEGIN + 5)
        self.assertIsNone(header_stamp(stamped(0)))
        self.assertIsNone(header_stamp(message(data=1.0)))


class ATopic(unittest.TestCase):
    def gathered(self, headers, receive_time=False):
        gathering = Gathering("/a", "k")
        for k, header in enumerate(headers):
            gathering.add(BEGIN + k, header, {"data": k, "on": k > 1}, {})
        return gathering.finished(receive_time)

    def test_has_header_stamps_where_every_message_has_one(self):
        self.assertEqual(self.gathered([10, 20, 30]).clock, HEADER)
        self.assertEqual(self.gathered([10, None, 30]).clock, RECEIVED)
        self.assertEqual(self.gathered([10, 20, 30], receive_time=True).clock, RECEIVED)

    def test_stamps_rise_and_the_first_of_equals_counts(self):
        series = self.gathered([30, 10, 20, 20]).series
        np.testing.assert_array_equal(series["data"].stamps, [10, 20, 30])
        np.testing.assert_array_equal(series["data"].values, [1, 2, 0])
        self.assertEqual(series["on"].between, HOLD)


class APath(unittest.TestCase):
    def series(self, *messages):
        """messages: (stamp, {ns after it: position})."""
        gathering = PathGathering("/plan", "trajectory_msgs/msg/JointTrajectory")
        for stamp, points in messages:
            listed = [message(positions=np.array([value]), time_from_start=message(sec=0, nanosec=after))
                      for after, value in points.items()]
            gathering.add_message(stamp, None, message(joint_names=["elbow"], points=listed))
        return gathering.finished(False).series["elbow/position"]

    def at(self, series, *stamps):
        return list(merge.on_stamps(series, np.array(stamps)))

    def test_goes_from_point_to_point_and_stays(self):
        series = self.series((1000, {100: 0.0, 200: 1.0}))
        self.assertEqual(series.between, PATH)
        self.assertEqual(self.at(series, 1150, 5000), [0.5, 1.0])

    def test_of_several_points_ends_what_was_planned(self):
        series = self.series((1000, {100: 0.0, 1100: 1.0}), (1600, {100: 2.0, 200: 2.0}))
        np.testing.assert_allclose(self.at(series, 1599, 1700), [0.499, 2.0], atol=2e-3)

    def test_streams_set_points_that_hold(self):
        series = self.series((1000, {0: 1.0}), (2000, {0: 3.0}))
        self.assertEqual(self.at(series, 1500, 2500), [1.0, 3.0])


class TopicsOnTheStampsOfOne(unittest.TestCase):
    def setUp(self):
        self.stamps = BEGIN + np.arange(100) * 2 * MS

    def test_the_densest_joint_states_lead(self):
        def series(n):
            return Series(self.stamps[:n], np.zeros(n))

        slow, fast = (topic(name, "sensor_msgs/msg/JointState", x=series(n)) for name, n in (("/slow", 10),
                                                                                            ("/fast", 20)))
        load = topic("/load", "std_msgs/msg/Float64", data=series(100))
        self.assertEqual(merge.densest([load, slow, fast]).topic.name, "/fast")
        self.assertEqual(merge.densest([load]).topic.name, "/load")

    def test_its_own_values_stay_bit_for_bit(self):
        values = np.random.default_rng(1).normal(size=100)
        np.testing.assert_array_equal(merge.on_stamps(Series(self.stamps, values), self.stamps), values)

    def test_lines_between_neighbours_are_exact_and_nothing_is_known_outside(self):
        own = BEGIN + 11 * MS + np.arange(30) * 5 * MS
        found = merge.on_stamps(Series(own, (own - BEGIN) * 1e-9 * 3), self.stamps)
        inside = (self.stamps >= own[0]) & (self.stamps <= own[-1])
        np.testing.assert_allclose(found[inside], (self.stamps[inside] - BEGIN) * 1e-9 * 3, atol=1e-12)
        self.assertTrue(np.all(np.isnan(found[~inside])))

    def test_a_long_gap_stays_one(self):
        own = np.delete(self.stamps, np.arange(40, 60))
        found = merge.on_stamps(Series(own, np.ones(len(own))), self.stamps)
        np.testing.assert_array_equal(np.isnan(found), (np.arange(100) >= 40) & (np.arange(100) < 60))
        short = np.delete(self.stamps, np.arange(40, 45))
        self.assertFalse(np.any(np.isnan(merge.on_stamps(Series(short, np.ones(95)), self.stamps))))

    def test_a_switch_holds(self):
        found = merge.on_stamps(Series(self.stamps[[10, 50]], np.array([1.0, 0.0]), HOLD), self.stamps)
        np.testing.assert_array_equal(found[10:], np.arange(10, 100) < 50)
        self.assertTrue(np.all(np.isnan(found[:10])))

    def test_names_serve_as_paths_and_a_topic_of_another_time_is_told(self):
        series = Series(self.stamps, np.zeros(100))
        elsewhere = Series(self.stamps - 10**15, np.zeros(100))
        topics = [topic("/a", "sensor_msgs/msg/JointState", **{"b": series, "..//c": series}),
                  topic("/a/b", "k", data=series), topic("/old", "k", data=elsewhere)]
        columns, empty = merge.merged(topics, merge.densest(topics))
        self.assertEqual(list(columns), ["a/b/value", "a/_/c", "a/b/data"])
        self.assertEqual(empty, ["/old"])


class Tables(unittest.TestCase):
    ABOUT = {"source": "run.mcap", "time_of_topic": "/j\n", "clock": "header stamps", "first_stamp_ns": BEGIN}

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.seconds, self.columns = np.arange(3) * 0.1, {"j/elbow/position": np.array([1 / 3, np.nan, 2.0])}

    def test_hdf5_and_csv_hold_every_bit(self):
        table.write_hdf5(self.folder / "a.h5", self.seconds, self.columns, self.ABOUT)
        with h5py.File(self.folder / "a.h5") as file:
            np.testing.assert_array_equal(file["j/elbow/position"][:], self.columns["j/elbow/position"])
            self.assertEqual(file["t_s"].attrs["units"], "s")
        table.write_csv(self.folder / "a.csv", self.seconds, self.columns, self.ABOUT)
        with (self.folder / "a.csv").open(newline="") as file:
            rows = [row for row in csv.reader(file) if not row[0].startswith("#")]
        self.assertEqual(rows[0], ["t_s", "j/elbow/position"])
        self.assertEqual([float(row[1] or "nan") for row in rows[1:]][::2], [1 / 3, 2.0])
        self.assertEqual(rows[2][1], "")

    def test_nothing_is_written_over_and_nothing_half(self):
        path = self.folder / "a.h5"
        with self.assertRaises(ZeroDivisionError), table._whole(path) as part:
            part.write_text("half")
            raise ZeroDivisionError
        self.assertEqual(list(self.folder.iterdir()), [])
        path.write_text("mine")
        with self.assertRaisesRegex(FileExistsError, "exists"):
            table.write_hdf5(path, self.seconds, self.columns, self.ABOUT)
        self.assertEqual(path.read_text(), "mine")


class TheCommand(unittest.TestCase):
    def said(self, *arguments):
        with contextlib.redirect_stderr(io.StringIO()) as err, contextlib.redirect_stdout(io.StringIO()):
            code = main([*map(str, arguments)])
        return code, err.getvalue()

    def test_names_the_line_that_installs_the_extra(self):
        with mock.patch.dict(sys.modules, {"rosbags": None}):
            code, err = self.said("convert", "run.mcap", "rec.h5")
        self.assertEqual(code, 69)
        self.assertIn("pip install rosbags", err)

    def test_ends_as_the_program_does(self):
        self.assertEqual(self.said("convert", "run.mcap")[0], 64)
        code, err = self.said("convert", "run.mcap", "rec.txt")
        self.assertEqual(code, 64)
        self.assertIn("none of .h5, .hdf5, .csv", err)
        self.assertEqual(self.said("--help")[0], 0)


if __name__ == "__main__":
    unittest.main(verbosity=1)
