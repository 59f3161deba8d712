"""usage: test_bag_roles.py PACKAGE

Which numbers of a bag are whose commanded position and effort, and data sets of LeRobot; without rosbags and pyarrow.
PACKAGE: the folder that holds `torquescope`. numpy and h5py are enough.
"""

import json
import pathlib
import sys
import tempfile
import unittest
from unittest import mock

import numpy as np

sys.path.insert(0, sys.argv.pop(1))

from torquescope import DataError, convert  # noqa: E402
from torquescope.ros import lerobot, merge, words  # noqa: E402
from torquescope.ros.follow import following, is_shifted_copy  # noqa: E402
from torquescope.ros.roles import roles_of  # noqa: E402
from torquescope.ros.series import HEADER, HOLD, Series, Topic  # noqa: E402

STATE, FLOATS = "sensor_msgs/msg/JointState", "std_msgs/msg/Float64MultiArray"
CONTROLLER = "control_msgs/msg/JointTrajectoryControllerState"
STEP = 0.002
ROWS = 2000
STAMPS = (np.arange(ROWS) * STEP * 1e9).astype(np.int64)
JOINTS = ("wrist", "elbow", "base")  # in the messages' order, which is not that of the alphabet
LATER = 8  # rows that the position comes after its command


class Arm:
    """Three joints that follow their commands by LATER rows, sagging a little."""

    def __init__(self, seed=1, at_rest=()):
        rng = np.random.default_rng(seed)
        t = np.arange(-LATER, ROWS) * STEP
        self.position, self.command, self.effort = {}, {}, {}
        for joint in JOINTS:
            sizes, speeds, phases = rng.uniform(0.1, 0.5, 4), rng.uniform(1, 6, 4), rng.uniform(0, 6, 4)
            path = np.sin(np.outer(t, speeds) + phases) @ sizes * (joint not in at_rest)
            self.command[joint], self.position[joint] = path[LATER:], path[:-LATER] - 0.02
            self.effort[joint] = rng.normal(size=ROWS)

    def states(self, effort=True):
        fields = {f"{joint}/position": self.position[joint] for joint in JOINTS}
        return topic("/joint_states", STATE, {**fields, **({f"{joint}/effort": self.effort[joint] for joint in JOINTS}
                                                           if effort else {})})


def topic(name, kind, series, between=HOLD):
    return Topic(name, kind, ROWS, HEADER, {key: Series(STAMPS, values, between) for key, values in series.items()})


def roles(*topics, **asked):
    columns, _ = merge.merged(topics, merge.densest(topics))
    return roles_of(columns, STEP, **asked)


REFERENCES = {f"joint_states/{joint}/reference_position" for joint in JOINTS}


class Words(unittest.TestCase):
    def test_say_whether_it_was_commanded(self):
        for name in ("/joint_commands", "/command", "q_des", "desired.positions", "reference.positions", "goal_pos",
                     "target", "/arm/setpoint", "set_point", "cmdPosition", "/tgt"):
            self.assertTrue(words.is_commanded(name), name)
        for name in ("/joint_states", "feedback.positions", "actual.positions", "/settings", "/reset"):
            self.assertFalse(words.is_commanded(name), name)

    def test_say_the_quantity(self):
        for name, quantity in (("desired.positions", "position"), ("/joint_group_effort_controller/commands", "effort"),
                               ("cmd_vel", "velocity"), ("/motor_currents", "effort"), ("/commands", None)):
            self.assertEqual(words.quantity_of(name), quantity, name)
        self.assertEqual(words.drive_word("/motor_currents data"), "current")
        self.assertEqual(words.drive_word("/efforts data"), "effort")


class Following(unittest.TestCase):
    def test_a_position_follows_its_command_and_no_other(self):
        arm = Arm()
        told = following(arm.command["elbow"], arm.position["elbow"], STEP)
        self.assertTrue(told.is_good)
        self.assertAlmostEqual(told.lag_s, LATER * STEP, delta=4 * STEP)
        self.assertFalse(following(arm.command["wrist"], arm.position["elbow"], STEP).is_good)
        self.assertFalse(following(57.3 * arm.command["elbow"], arm.position["elbow"], STEP).is_good)

    def test_the_position_once_more_is_no_command(self):
        position = Arm().position["elbow"]
        self.assertTrue(following(position.copy(), position, STEP).is_copy)
        between = np.arange(ROWS) % 5 == 0
        self.assertTrue(following(np.where(between, position, position + 1e-9), position, STEP, between).is_copy)

    def test_the_next_state_is_told(self):
        position = Arm().position["elbow"]
        self.assertTrue(is_shifted_copy(np.append(position[1:], position[-1]), position, 1))
        self.assertFalse(is_shifted_copy(Arm().command["elbow"], position, 1))


class TheReference(unittest.TestCase):
    def test_is_found_under_every_name_of_a_command(self):
        arm = Arm()
        named = {f"{joint}/position": arm.command[joint] for joint in JOINTS}
        for name, kind, series in (
                ("/joint_commands", STATE, named), ("/target_joint_states", STATE, named),
                ("/arm_controller/joint_trajectory", "trajectory_msgs/msg/JointTrajectory", named),
                ("/arm_controller/state", CONTROLLER, {f"{joint}/desired.positions": arm.command[joint]
                                                       for joint in JOINTS}),
                ("/arm_controller/state", CONTROLLER, {f"{joint}/reference.positions": arm.command[joint]
                                                       for joint in JOINTS}),
                ("/joint_group_position_controller/commands", FLOATS,
                 {f"data[{k}]": arm.command[joint] for k, joint in enumerate(JOINTS)}),
                ("/q_des", FLOATS, {f"data[{k}]": arm.command[joint] for k, joint in enumerate(JOINTS)})):
            with self.subTest(name=name):
                self.assertEqual(set(roles(arm.states(), topic(name, kind, series)).moved.values()), REFERENCES)

    def test_of_a_topic_for_each_joint(self):
        arm = Arm()
        topics = [topic(f"/{joint}_position_controller/command", "std_msgs/msg/Float64", {"data": arm.command[joint]})
                  for joint in JOINTS]
        found = roles(arm.states(), *topics)
        self.assertEqual(found.moved["elbow_position_controller/command/data"], "joint_states/elbow/reference_position")
        self.assertEqual(set(found.moved.values()), REFERENCES)

    def test_of_numbers_in_another_order_goes_to_the_joint_that_follows(self):
        arm = Arm()
        series = {f"data[{k}]": arm.command[joint] for k, joint in enumerate(("base", "wrist", "elbow"))}
        found = roles(arm.states(), topic("/commands", FLOATS, series))
        self.assertEqual(found.moved["commands/data[1]"], "joint_states/wrist/reference_position")
        self.assertEqual(set(found.moved.values()), REFERENCES)

    def test_of_a_joint_at_rest_goes_by_the_order(self):
        arm = Arm(at_rest=("elbow",))
        series = {f"data[{k}]": arm.command[joint] for k, joint in enumerate(JOINTS)}
        found = roles(arm.states(), topic("/commands", FLOATS, series))
        self.assertEqual(found.moved["commands/data[1]"], "joint_states/elbow/reference_position")

    def test_is_no_effort_no_velocity_and_nothing_that_nobody_follows(self):
        arm = Arm()
        numbers = {f"data[{k}]": arm.command[joint] for k, joint in enumerate(JOINTS)}
        for name in ("/joint_group_effort_controller/commands", "/joint_group_velocity_controller/commands"):
            found = roles(arm.states(), topic(name, FLOATS, numbers))
            self.assertEqual(found.moved, {})
            self.assertIn("reference none of wrist, elbow, base", "\n".join(found.lines))
        other = {f"{joint}/position": Arm(seed=9).command[joint] for joint in JOINTS}
        found = roles(arm.states(), topic("/joint_commands", STATE, other))
        self.assertEqual(found.moved, {})
        self.assertIn("does not follow", "\n".join(found.lines))

    def test_is_not_the_position_once_more(self):
        arm = Arm()
        found = roles(arm.states(), topic("/arm/state", CONTROLLER, {f"{joint}/desired.positions": arm.position[joint]
                                                                     for joint in JOINTS}))
        self.assertEqual(found.moved, {})
        self.assertIn("it is the measured position once more", "\n".join(found.lines))

    def test_is_offered_where_nothing_calls_it_a_command(self):
        arm = Arm()
        leader = topic("/leader", FLOATS, {f"data[{k}]": arm.command[joint] for k, joint in enumerate(JOINTS)})
        found = roles(arm.states(), leader)
        self.assertEqual(found.moved, {})
        self.assertIn("--reference /leader takes it", "\n".join(found.lines))
        self.assertEqual(set(roles(arm.states(), leader, reference="/leader").moved.values()), REFERENCES)

    def test_of_the_controller_itself_comes_first(self):
        arm = Arm()
        found = roles(arm.states(),
                      topic("/joint_commands", STATE, {f"{joint}/position": arm.command[joint] for joint in JOINTS}),
                      topic("/arm/state", CONTROLLER, {f"{joint}/desired.positions": arm.command[joint] + 1e-3
                                                       for joint in JOINTS}))
        self.assertEqual({path.partition("/")[0] for path in found.moved}, {"arm"})

    def test_a_command_is_never_the_base(self):
        arm = Arm()
        commands = topic("/joint_commands", STATE, {f"{joint}/position": arm.command[joint] for joint in JOINTS})
        self.assertEqual(merge.densest([commands, arm.states()]).topic.name, "/joint_states")


class TheEffort(unittest.TestCase):
    def currents(self, arm, name="/motor_currents"):
        return topic(name, FLOATS, {f"data[{k}]": arm.effort[joint] for k, joint in enumerate(JOINTS)})

    def test_of_another_topic_is_offered_and_taken_when_asked_for(self):
        arm = Arm()
        offered = roles(arm.states(effort=False), self.currents(arm))
        self.assertEqual(offered.moved, {})
        self.assertIn(f"may be /motor_currents ({FLOATS}), {ROWS} messages of 3 numbers; --effort /motor_currents",
                      "\n".join(offered.lines))
        taken = roles(arm.states(effort=False), self.currents(arm), effort="motor_currents")
        self.assertEqual(taken.moved, {f"motor_currents/data[{k}]": f"joint_states/{joint}/current"
                                       for k, joint in enumerate(JOINTS)})

    def test_that_never_changes_is_none(self):
        arm = Arm()
        arm.effort = {joint: np.zeros(ROWS) for joint in JOINTS}
        self.assertIn("it never changes", "\n".join(roles(arm.states()).lines))

    def test_that_is_not_there_is_an_error(self):
        with self.assertRaisesRegex(DataError, "--effort /nope"):
            roles(Arm().states(), effort="/nope")


class ADataSetOfLeRobot(unittest.TestCase):
    FPS = 50.0

    def converted(self, action, names=None, more=(), number=0):
        arm = Arm()
        state = np.column_stack([arm.position[joint] for joint in JOINTS])
        action = np.column_stack([arm.command[joint] for joint in JOINTS]) if action is None else action(state)
        names = names or [f"{joint}.pos" for joint in JOINTS]
        feature = {"dtype": "float32", "shape": [3], "names": names}
        table = {"observation.state": state.tolist(), "action": action.tolist(),
                 "timestamp": (np.arange(ROWS) / self.FPS).tolist(), "frame_index": list(range(ROWS)),
                 "episode_index": [0] * (ROWS - 100) + [1] * 100}
        info = {"fps": self.FPS, "total_episodes": 2, "features": {
            "observation.state": feature, "action": feature, "observation.images.top": {"dtype": "video"}}}
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "meta").mkdir()
            (folder / "meta" / "info.json").write_text(json.dumps(info))
            (folder / "data" / "chunk-000").mkdir(parents=True)
            (folder / "data" / "chunk-000" / "file-000.parquet").touch()
            with mock.patch.object(lerobot, "_read", return_value=table):
                return str(convert(folder, folder / "rec.csv", episode=number)), (folder / "rec.csv").read_text()

    def header(self, text):
        return next(line for line in text.splitlines() if not line.startswith("#")).split(",")

    def test_has_a_column_for_each_joint(self):
        told, text = self.converted(None)
        self.assertEqual(self.header(text), ["t_s", *(f"{joint}/position" for joint in JOINTS),
                                             *(f"{joint}/reference_position" for joint in JOINTS)])
        self.assertIn(f"{ROWS - 100} rows", told)
        self.assertIn("observation.images.top: video", told)
        self.assertIn("episode   0 of 2", told)
        self.assertIn("100 rows", self.converted(None, names={"motors": list(JOINTS)}, number=1)[0])

    def test_whose_action_is_the_next_state_has_no_reference(self):
        told, text = self.converted(lambda state: np.vstack([state[1:], state[-1:]]))
        self.assertIn("action[t] = observation.state[t+1]", told)
        self.assertNotIn("reference_position", text)
        self.assertIn("the state once more", self.converted(lambda state: state)[0])

    def test_without_such_an_episode_is_refused(self):
        with self.assertRaisesRegex(DataError, "no episode 7\n  its episodes: 0 to 1"):
            self.converted(None, number=7)

    def test_names_what_is_to_be_installed(self):
        with mock.patch.dict(sys.modules, {"pyarrow": None, "pandas": None}):
            with self.assertRaisesRegex(ImportError, "pip install pyarrow"):
                lerobot._read(pathlib.Path("a.parquet"), {})


if __name__ == "__main__":
    unittest.main(verbosity=1)
