"""usage: test_bags.py PACKAGE

Bags as rosbags and mcap write them, converted, and read by the program (TORQUESCOPE). PACKAGE: the folder that holds
`torquescope`.
"""

import contextlib
import io
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np
from mcap.writer import CompressionType
from mcap.writer import Writer as McapWriter
from rosbags import rosbag1, rosbag2
from rosbags.typesys import Stores, get_types_from_msg, get_typestore

PACKAGE = sys.argv.pop(1)
sys.path.insert(0, PACKAGE)

from torquescope.__main__ import main  # noqa: E402
from torquescope.ros import convert  # noqa: E402

PROGRAM = os.environ.get("TORQUESCOPE", "torquescope")
BEGIN = 1768472944_123456789  # ns
STEP, LATE, SLOW = 2_000_000, 1_500_000, 5  # ns; ns between a stamp and its recording; steps of the slow topic
SECONDS = 6.0
JOINTS = ["elbow", "wrist"]
STATE, FLOAT, IMAGE = "sensor_msgs/msg/JointState", "std_msgs/msg/Float64", "sensor_msgs/msg/Image"
CONTROLLER = "lab_msgs/msg/ControllerState"
CONTROLLER_TEXT = """std_msgs/Header header
string[] joint_names
lab_msgs/Point desired
float64 speed_scaling
================================================================================
MSG: lab_msgs/Point
float64[] positions
float64[] effort
"""


class Motion:
    """Two joints, and the torque that moves them."""

    def __init__(self):
        self.stamps = BEGIN + STEP * np.arange(round(SECONDS * 1e9 / STEP))
        t = self.seconds = (self.stamps - BEGIN) * 1e-9
        self.position = np.column_stack([np.sin(2 * t) + 0.4 * np.sin(5 * t), np.cos(3 * t)])
        self.velocity = np.column_stack([2 * np.cos(2 * t) + 2 * np.cos(5 * t), -3 * np.sin(3 * t)])
        self.effort = 0.3 * self.velocity + 0.5 * np.tanh(self.velocity / 0.01)


MOTION = Motion()


class Messages:
    """What a recorder receives: (topic, type, ns, message)."""

    def __init__(self, store):
        self.store = get_typestore(store)
        self.store.register(get_types_from_msg(CONTROLLER_TEXT, CONTROLLER))
        self.is_ros1 = store == Stores.ROS1_NOETIC

    def header(self, stamp):
        time = self.store.types["builtin_interfaces/msg/Time"](int(stamp) // 10**9, int(stamp) % 10**9)
        return self.store.types["std_msgs/msg/Header"](*([0] if self.is_ros1 else []), time, "base")

    def __iter__(self):
        types = self.store.types
        for k, stamp in enumerate(MOTION.stamps):
            order = [1, 0] if k % 2 else [0, 1]  # a driver may change it
            yield "/joint_states", STATE, stamp + LATE, types[STATE](
                self.header(stamp), [JOINTS[j] for j in order], MOTION.position[k, order],
                MOTION.velocity[k, order], MOTION.effort[k, order])
            if k % SLOW == 0:
                yield "/load", FLOAT, stamp, types[FLOAT](float(MOTION.seconds[k]))
                yield "/controller/state", CONTROLLER, stamp, types[CONTROLLER](
                    self.header(stamp), JOINTS,
                    types["lab_msgs/msg/Point"](MOTION.position[k], np.array([], dtype=float)), 1.0)
        yield "/camera", IMAGE, stamp, types[IMAGE](self.header(stamp), 2, 2, "mono8", 0, 2,
                                                    np.zeros(4, dtype=np.uint8))


def write_ros2(path, plugin):
    messages, connections = Messages(Stores.ROS2_HUMBLE), {}
    with rosbag2.Writer(path, version=9, storage_plugin=plugin) as writer:
        for topic, kind, stamp, message in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=messages.store)
            writer.write(connections[topic], int(stamp), messages.store.serialize_cdr(message, kind))


def write_ros1(path):
    messages, connections = Messages(Stores.ROS1_NOETIC), {}
    with rosbag1.Writer(path) as writer:
        for topic, kind, stamp, message in messages:
            if topic not in connections:
                connections[topic] = writer.add_connection(topic, kind, typestore=messages.store)
            writer.write(connections[topic], int(stamp), messages.store.serialize_ros1(message, kind))


def write_mcap(path, compression):
    messages, channels = Messages(Stores.ROS2_HUMBLE), {}
    with path.open("wb") as file:
        writer = McapWriter(file, compression=compression)
        writer.start(profile="ros2", library="test")
        for topic, kind, stamp, message in messages:
            if topic not in channels:
                definition, _ = messages.store.generate_msgdef(kind, ros_version=2)
                schema = writer.register_schema(kind, "ros2msg", definition.encode())
                channels[topic] = writer.register_channel(topic, "cdr", schema)
            writer.add_message(channels[topic], int(stamp), bytes(messages.store.serialize_cdr(message, kind)),
                               int(stamp))
        writer.finish()


class Folder(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.folder = pathlib.Path(folder.name)
        write_ros2(cls.folder / "mcap", rosbag2.StoragePlugin.MCAP)
        write_ros2(cls.folder / "sqlite", rosbag2.StoragePlugin.SQLITE3)
        write_ros1(cls.folder / "one.bag")
        for compression in CompressionType:
            write_mcap(cls.folder / f"{compression.name}.mcap", compression)
        cls.bags = [cls.folder / "mcap", cls.folder / "mcap" / "mcap.mcap", cls.folder / "sqlite",
                    cls.folder / "sqlite" / "sqlite.db3", cls.folder / "one.bag",
                    *(cls.folder / f"{compression.name}.mcap" for compression in CompressionType)]

    def table(self, bag, **options):
        out = self.folder / f"{self.id()}.h5"
        out.unlink(missing_ok=True)
        return convert(bag, out, **options), h5py.File(out)

    def refused(self, *arguments):
        with contextlib.redirect_stderr(io.StringIO()) as err, contextlib.redirect_stdout(io.StringIO()):
            code = main(["convert", *map(str, arguments)])
        self.assertFalse((self.folder / "refused.h5").exists())
        return code, err.getvalue()


class EveryBag(Folder):
    def test_holds_every_joint_at_its_header_stamps(self):
        for bag in self.bags:
            with self.subTest(bag=bag.name):
                told, file = self.table(bag)
                with file:
                    np.testing.assert_array_equal(file["t_s"][:], MOTION.seconds)
                    self.assertEqual(file.attrs["first_stamp_ns"], BEGIN)
                    for j, joint in enumerate(JOINTS):
                        for field in ("position", "velocity", "effort"):
                            np.testing.assert_array_equal(file[f"joint_states/{joint}/{field}"][:],
                                                          getattr(MOTION, field)[:, j])
                self.assertEqual((told.base, told.clock), ("/joint_states", "header stamps"))

    def test_has_other_topics_on_these_stamps(self):
        told, file = self.table(self.bags[0])
        with file:
            load, until = file["load/data"][:], len(MOTION.stamps) - SLOW + 1
            # its receive time is the stamp of that joint state; a line is interpolated exactly
            np.testing.assert_allclose(load[:until], MOTION.seconds[:until], atol=1e-9)
            self.assertTrue(np.all(np.isnan(load[until:])))
            np.testing.assert_array_equal(file["controller/state/wrist/desired.positions"][::SLOW],
                                          MOTION.position[::SLOW, 1])
            self.assertNotIn("camera", file)
        self.assertIn("/camera: sensor_msgs/msg/Image holds bytes", told.left_out)
        self.assertIn("the header stamps of /joint_states, all other topics are interpolated onto them", str(told))

    def test_takes_one_clock_where_it_is_asked_to(self):
        told, file = self.table(self.bags[0], receive_time=True)
        with file:
            self.assertEqual(file.attrs["first_stamp_ns"], BEGIN + LATE)
        self.assertEqual(told.clock, "receive time")

    def test_is_read_by_the_program(self):
        for ending in ("h5", "csv"):
            out = self.folder / f"read.{ending}"
            convert(self.bags[0], out, topics=["joint_states"])
            drafted = subprocess.run([PROGRAM, "init", out.name], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(drafted.returncode, 0, drafted.stderr)
            for line in ('time = "t_s"', 'position = "joint_states/elbow/position"',
                         'torque = "joint_states/elbow/effort"'):
                self.assertIn(line, drafted.stdout)
            (self.folder / "job.toml").write_text(drafted.stdout)
            checked = subprocess.run([PROGRAM, "check", "job.toml"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_the_program_names_the_line_that_converts_it(self):
        for bag in self.bags:
            done = subprocess.run([PROGRAM, "init", str(bag)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 65, done.stderr)
            self.assertIn(f"python3 -m torquescope convert {bag} {bag}.h5", done.stderr)


class Refused(Folder):
    def test_a_topic_that_is_not_there(self):
        code, err = self.refused(self.bags[0], self.folder / "refused.h5", "--topic", "/nope")
        self.assertEqual(code, 65)
        self.assertIn("no topic /nope", err)
        self.assertIn("/joint_states  sensor_msgs/msg/JointState", err)

    def test_nothing_numeric(self):
        store = get_typestore(Stores.ROS2_HUMBLE)
        with rosbag2.Writer(self.folder / "text", version=9) as writer:
            connection = writer.add_connection("/say", "std_msgs/msg/String", typestore=store)
            text = store.types["std_msgs/msg/String"]("hello")
            writer.write(connection, BEGIN, store.serialize_cdr(text, "std_msgs/msg/String"))
        code, err = self.refused(self.folder / "text", self.folder / "refused.h5")
        self.assertEqual(code, 65)
        self.assertIn("has nothing numeric", err)
        self.assertIn("/say: std_msgs/msg/String has no number", err)

    def test_what_is_no_bag_or_is_damaged(self):
        (self.folder / "plain.bag").write_text("t_s,q_rad\n")
        for bag, code in ((self.folder / "plain.bag", 65), (self.folder / "absent.bag", 66), (self.folder, 65)):
            self.assertEqual(self.refused(bag, self.folder / "refused.h5")[0], code)
        for bag in self.bags:
            if bag.is_dir():
                continue
            whole = bag.read_bytes()
            for share in (0.02, 0.5, 0.98):
                cut = self.folder / f"cut{bag.suffix}"
                cut.write_bytes(whole[:int(share * len(whole))])
                with self.subTest(bag=bag.name, share=share):
                    code, err = self.refused(cut, self.folder / "refused.h5")
                    self.assertEqual(code, 65, err)
                    self.assertIn("help:", err)


if __name__ == "__main__":
    unittest.main(verbosity=1)
