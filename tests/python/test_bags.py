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
import unittest.mock

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


COMMANDS, FLOATS = "/joint_group_position_controller/commands", "std_msgs/msg/Float64MultiArray"
CONTROL, PATH = "control_msgs/msg/JointTrajectoryControllerState", "trajectory_msgs/msg/JointTrajectory"
POINT = "trajectory_msgs/JointTrajectoryPoint"
STIFFNESS = 20.0  # N m per rad
JOB = """
[experiment]
name = "simulated"
seed = {seed}
[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb", "offset"]
[simulate]
mode = "closed_loop"
rate_hz = 500
duration_s = 20
plant = {{inertia = 0.09, viscous = 0.35, coulomb = 0.6, stribeck = 0.3, stribeck_speed = 0.1, stribeck_exponent = 1}}
reference = {{kind = "multisine", max_speed = 2.0}}
controller = {{kind = "pd", rate_hz = 500}}
encoder = {{counts_per_revolution = 131072}}
noise = {{torque_std = 0.02}}
"""


class Motion:
    """Two joints, and the torque that moves them."""

    def __init__(self):
        self.stamps = BEGIN + STEP * np.arange(round(SECONDS * 1e9 / STEP))
        t = self.seconds = (self.stamps - BEGIN) * 1e-9
        self.position = np.column_stack([np.sin(2 * t) + 0.4 * np.sin(5 * t), np.cos(3 * t)])
        self.velocity = np.column_stack([2 * np.cos(2 * t) + 2 * np.cos(5 * t), -3 * np.sin(3 * t)])
        self.effort = 0.3 * self.velocity + 0.5 * np.tanh(self.velocity / 0.01)
        # of a proportional controller: no later row of the position is equal to it
        self.command = self.position + self.effort / STIFFNESS


MOTION = Motion()


def floats(types, values):
    return types[FLOATS](types["std_msgs/msg/MultiArrayLayout"]([], 0), np.array(values))


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
            yield COMMANDS, FLOATS, stamp - 1000, floats(types, MOTION.command[k, ::-1])
            if k % SLOW == 0:
                yield "/load", FLOAT, stamp, types[FLOAT](float(MOTION.seconds[k]))
                yield "/controller/state", CONTROLLER, stamp, types[CONTROLLER](
                    self.header(stamp), JOINTS,
                    types["lab_msgs/msg/Point"](MOTION.position[k], np.array([], dtype=float)), 1.0)
        yield "/camera", IMAGE, stamp, types[IMAGE](self.header(stamp), 2, 2, "mono8", 0, 2,
                                                    np.zeros(4, dtype=np.uint8))


class CommandMessages(Messages):
    """Joint states, and their commands in one of the ways in which drivers publish them."""

    def __init__(self, way, state, command, effort=True):
        super().__init__(Stores.ROS2_HUMBLE)
        self.way, self.state, self.command, self.effort = way, state, command, effort
        points = {"old": ("desired", "actual", "error"), "new": ("reference", "feedback", "error", "output")}
        if way in points:
            text = "std_msgs/Header header\nstring[] joint_names\n" + "".join(
                f"{POINT} {name}\n" for name in points[way])
            self.store.register(get_types_from_msg(text, CONTROL))

    def point(self, positions):
        none = np.array([], dtype=float)
        duration = self.store.types["builtin_interfaces/msg/Duration"](0, 0)
        return self.store.types[POINT.replace("/", "/msg/")](np.array(positions), none, none, none, duration)

    def __iter__(self):
        types, none = self.store.types, np.array([], dtype=float)
        for stamp, (position, effort), wanted in zip(MOTION.stamps, self.state, self.command):
            names = JOINTS[:len(position)]
            yield "/joint_states", STATE, stamp, types[STATE](self.header(stamp), names, position, none,
                                                              effort if self.effort else none)
            if not self.effort:
                yield "/motor_currents", FLOATS, stamp, floats(types, effort)
            if self.way == "states":
                yield "/joint_commands", STATE, stamp, types[STATE](self.header(stamp), names, wanted, none, none)
            elif self.way == "floats":
                yield "/cmd", FLOATS, stamp, floats(types, wanted)
            elif self.way == "path":
                yield "/arm/joint_trajectory", PATH, stamp, types[PATH](self.header(0), names, [self.point(wanted)])
            elif self.way:
                more = [self.point(none)] if self.way == "new" else []
                yield "/arm/state", CONTROL, stamp, types[CONTROL](
                    self.header(stamp), names, self.point(wanted), self.point(position), self.point(wanted - position),
                    *more)


def write_ros2(path, plugin, messages=None):
    messages, connections = messages or Messages(Stores.ROS2_HUMBLE), {}
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
        self.assertIn("/camera: sensor_msgs/msg/Image holds bytes (1 message)", told.left_out)
        self.assertIn("the header stamps of /joint_states, all other topics are put onto them", str(told))

    def test_has_the_commands_beside_the_joints_that_follow_them(self):
        for bag in self.bags:
            with self.subTest(bag=bag.name):
                told, file = self.table(bag)
                with file:
                    for j, joint in enumerate(JOINTS):
                        np.testing.assert_array_equal(file[f"joint_states/{joint}/reference_position"][:],
                                                      MOTION.command[:, j])
                    self.assertEqual(file["joint_states/elbow/reference_position"].attrs["long_name"],
                                     f"data[1] of {COMMANDS}, {FLOATS}")
                self.assertIn(f"reference of elbow: data[1] of {COMMANDS}", str(told))

    def test_takes_one_clock_where_it_is_asked_to(self):
        told, file = self.table(self.bags[0], receive_time=True)
        with file:
            self.assertEqual(file.attrs["first_stamp_ns"], BEGIN + LATE)
        self.assertEqual(told.clock, "receive time")

    def test_is_read_by_the_program(self):
        for ending in ("h5", "csv"):
            out = self.folder / f"read.{ending}"
            out.unlink(missing_ok=True)
            convert(self.bags[0], out)
            drafted = subprocess.run([PROGRAM, "init", out.name], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(drafted.returncode, 0, drafted.stderr)
            for line in ('time = "t_s"', 'position = "joint_states/elbow/position"',
                         'torque = "joint_states/elbow/effort"',
                         'reference = "joint_states/elbow/reference_position"'):
                self.assertIn(line, drafted.stdout)
            (self.folder / "job.toml").write_text(drafted.stdout)
            checked = subprocess.run([PROGRAM, "check", "job.toml"], cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(checked.returncode, 0, checked.stderr)

    def test_the_program_names_the_line_that_converts_it(self):
        for bag in self.bags:
            done = subprocess.run([PROGRAM, "init", str(bag)], capture_output=True, text=True)
            self.assertEqual(done.returncode, 65, done.stderr)
            self.assertIn(f"python3 -m torquescope convert {bag} {bag}.h5", done.stderr)


class Commands(unittest.TestCase):
    WAYS = ("states", "floats", "path", "old", "new")

    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)

    def run_program(self, *words):
        done = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout + done.stderr

    def of_the_motion(self, way, **options):
        return CommandMessages(way, list(zip(MOTION.position, MOTION.effort)), MOTION.command, **options)

    def test_are_found_however_they_are_published(self):
        for way in self.WAYS:
            with self.subTest(way=way):
                write_ros2(self.folder / way, rosbag2.StoragePlugin.MCAP, self.of_the_motion(way))
                told = str(convert(self.folder / way, self.folder / f"{way}.h5"))
                self.assertIn("reference of elbow: ", told)
                self.assertIn("reference of wrist: ", told)
                for joint in JOINTS:
                    drafted = self.run_program("init", f"{way}.h5", "--joint", joint)
                    self.assertIn(f'position = "joint_states/{joint}/position"', drafted)
                    self.assertIn(f'reference = "joint_states/{joint}/reference_position"', drafted)

    def test_that_are_missing_are_told(self):
        write_ros2(self.folder / "bag", rosbag2.StoragePlugin.SQLITE3, self.of_the_motion(""))
        self.assertIn("reference none of elbow, wrist", str(convert(self.folder / "bag", self.folder / "a.h5")))

    def test_are_no_positions_where_the_states_have_no_effort(self):
        write_ros2(self.folder / "bag", rosbag2.StoragePlugin.MCAP, self.of_the_motion("states", effort=False))
        told = str(convert(self.folder / "bag", self.folder / "a.h5"))
        self.assertIn("--effort /motor_currents takes it", told)
        self.assertIn('position = "joint_states/elbow/position"', self.run_program("init", "a.h5"))
        convert(self.folder / "bag", self.folder / "b.csv", effort="/motor_currents")
        drafted = subprocess.run([PROGRAM, "init", "b.csv"], cwd=self.folder, capture_output=True, text=True).stdout
        self.assertIn('torque = "joint_states/elbow/current"', drafted)

    def test_of_a_joint_with_something_concealed_lead_to_its_name(self):
        files = []
        for seed in (11, 12):
            (self.folder / "sim.toml").write_text(JOB.format(seed=seed))
            self.run_program("simulate", "sim.toml", "--out", f"{seed}.csv")
            lines = (self.folder / f"{seed}.csv").read_text().splitlines()
            rows = np.genfromtxt([line for line in lines if not line.startswith("#")], delimiter=",", names=True)
            states = [(np.array([q]), np.array([tau])) for q, tau in zip(rows["q_rad"], rows["tau_Nm"])]
            messages = CommandMessages("floats", states, rows["q_ref_rad"][:, None])
            with unittest.mock.patch.object(MOTION, "stamps", BEGIN + STEP * np.arange(len(rows))):
                write_ros2(self.folder / str(seed), rosbag2.StoragePlugin.MCAP, messages)
            convert(self.folder / str(seed), self.folder / f"{seed}.h5")
            files.append(f"{seed}.h5")
        self.run_program("init", *files, "--out", "job.toml")
        self.run_program("check", "job.toml")
        found = self.run_program("diagnose", "job.toml", "--out", "r.h5")
        self.assertIn("Stribeck", found)
        self.assertIn("Stribeck", self.run_program("show", "r.h5"))


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
