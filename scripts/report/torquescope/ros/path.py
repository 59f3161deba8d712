"""Messages of trajectory_msgs/JointTrajectory as the path that they command.

Points     at the message's stamp + time_from_start, a straight line between them; the last one is held
Replaced   a message of several points ends what was planned beyond its stamp, as the controller does. Messages of one
           point (a stream of set points) replace nothing: each point is where the joint is to be by then
"""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .fields import joints_of
from .series import HEADER, PATH, RECEIVED, Series, Topic


@dataclass
class PathGathering:
    """As series.Gathering, of JointTrajectory."""

    name: str
    kind: str
    messages: list = field(default_factory=list)  # (received, header or None, {joint: position} and ns of each point)
    too_long: dict = field(default_factory=dict)

    @property
    def values(self):
        return any(points for _, _, points in self.messages)

    def add_message(self, received, header, message):
        joints = joints_of(message)
        points = [(int(one.time_from_start.sec) * 10**9 + int(one.time_from_start.nanosec), list(one.positions))
                  for one in message.points if len(one.positions) == len(joints)]
        self.messages.append((received, header, [(after, dict(zip(joints, positions))) for after, positions in points]))

    def finished(self, receive_time):
        has_header = all(header is not None for _, header, _ in self.messages) and not receive_time
        begun = [(header if has_header else received, points) for received, header, points in self.messages]
        joints = dict.fromkeys(joint for _, points in begun for _, positions in points for joint in positions)
        series = {f"{joint}/position": _path(begun, joint) for joint in joints}
        return Topic(self.name, self.kind, len(self.messages), HEADER if has_header else RECEIVED, series)


def _path(begun, joint):
    stamps, values = [], []
    for start, points in sorted(begun, key=lambda one: one[0]):
        own = [(start + max(after, 1), positions[joint]) for after, positions in points if joint in positions]
        if len(own) > 1:
            here = np.interp(start, stamps, values) if stamps else None
            while stamps and stamps[-1] >= start:
                stamps.pop(), values.pop()
            if here is not None:
                own.insert(0, (start, float(here)))
        elif own and stamps and stamps[-1] < start:
            own.insert(0, (start, values[-1]))  # held until then
        stamps += [stamp for stamp, _ in own]
        values += [value for _, value in own]
    stamps, first = np.unique(np.array(stamps, dtype=np.int64), return_index=True)
    return Series(stamps, np.array(values, dtype=float)[first], PATH)
