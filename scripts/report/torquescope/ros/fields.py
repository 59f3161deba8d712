"""The numbers of a message of ROS, under names: fields by dotted path, lists of joints by the joint's name.

A message whose `name` or `joint_names` lists joints (sensor_msgs/JointState, control_msgs) gives "elbow/position" for
a list with as many numbers, wherever in the message, and of control_msgs/DynamicJointState, which has a message of
named interfaces for each joint, "elbow/effort"; other lists give "data[0]". Messages are what rosbags makes of
them: dataclasses. Headers and stamps are no signals.
"""

import dataclasses

import numpy as np

LONGEST_LIST = 64  # a list of more numbers is a picture or a scan, no signals
JOINTS = ("name", "joint_names")
NO_SIGNALS = ("header", "stamp", "layout", "time_from_start")
NUMBER = (bool, int, float, np.number, np.bool_)


def header_stamp(message):
    """ns, or None where the message has none; a stamp of zero was never set."""
    stamp = getattr(getattr(message, "header", message), "stamp", None)
    if not hasattr(stamp, "nanosec"):
        return None
    return int(stamp.sec) * 10**9 + int(stamp.nanosec) or None


def joints_of(message):
    """The joints that it lists by name, or ()."""
    for key in JOINTS:
        names = getattr(message, key, None)
        if isinstance(names, (list, tuple)) and names and all(isinstance(one, str) and one for one in names) \
                and len(set(names)) == len(names):
            return tuple(names)
    return ()


def numbers_of(message):
    """({name: number}, {name of a list that is too long: its length})."""
    numbers, too_long = {}, {}
    _walk(message, "", joints_of(message), numbers, too_long)
    return numbers, too_long


def _walk(message, path, joints, numbers, too_long):
    for one in dataclasses.fields(message):
        value, here = getattr(message, one.name), f"{path}.{one.name}" if path else one.name
        if one.name in NO_SIGNALS:
            continue
        if isinstance(value, NUMBER):
            numbers[here] = value
        elif dataclasses.is_dataclass(value):
            _walk(value, here, joints, numbers, too_long)
        elif joints and isinstance(value, list) and len(value) == len(joints) and dataclasses.is_dataclass(value[0]):
            for joint, message_of_joint in zip(joints, value):
                _interfaces(message_of_joint, joint, numbers)
        elif isinstance(value, np.ndarray) or (isinstance(value, list) and all(isinstance(v, NUMBER) for v in value)):
            _list(value, here, joints, numbers, too_long)


def _interfaces(message, joint, numbers):
    names, values = getattr(message, "interface_names", []), getattr(message, "values", [])
    if len(names) == len(values):
        numbers.update({f"{joint}/{name}": value for name, value in zip(names, values)})


def _list(values, here, joints, numbers, too_long):
    if joints and len(values) == len(joints):
        numbers.update({f"{joint}/{here}": value for joint, value in zip(joints, values)})
    elif len(values) > LONGEST_LIST:
        too_long[here] = len(values)
    else:
        numbers.update({f"{here}[{k}]": value for k, value in enumerate(values)})
