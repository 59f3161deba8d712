"""Signals of a bag, each with the stamps of its own messages."""

from __future__ import annotations

from dataclasses import dataclass, field

import numpy as np

from .fields import numbers_of
from .words import is_commanded

HEADER, RECEIVED = "header stamps", "receive time"
# between two messages: a line; the last value; a line however long, and the last value behind the end
LINE, HOLD, PATH = "line", "hold", "path"


@dataclass(frozen=True)
class Series:
    """stamps [n], ns, rising; values [n]. Of two messages with one stamp the first counts."""

    stamps: np.ndarray
    values: np.ndarray
    between: str = LINE


@dataclass(frozen=True)
class Topic:
    name: str
    kind: str                 # sensor_msgs/msg/JointState
    messages: int
    clock: str                # HEADER or RECEIVED
    series: dict[str, Series]

    @property
    def is_command(self):
        """Its name says so, or its kind: what it holds was asked for, not measured."""
        return is_commanded(self.name) or self.kind.endswith("/JointTrajectory")

    @property
    def has_joint_states(self):
        return self.kind.endswith("/JointState") and not self.is_command


@dataclass
class Gathering:
    """A topic while its messages come in."""

    name: str
    kind: str
    header: list[int] = field(default_factory=list)
    received: list[int] = field(default_factory=list)
    values: dict[str, tuple[list[int], list[float]]] = field(default_factory=dict)  # message, number
    switches: set[str] = field(default_factory=set)
    too_long: dict[str, int] = field(default_factory=dict)

    def add(self, received, header, numbers, too_long):
        for name, number in numbers.items():
            at, values = self.values.setdefault(name, ([], []))
            at.append(len(self.received))
            values.append(float(number))
            if isinstance(number, (bool, np.bool_)):
                self.switches.add(name)
        self.too_long.update(too_long)
        self.received.append(received)
        if header is not None:
            self.header.append(header)

    def add_message(self, received, header, message):
        self.add(received, header, *numbers_of(message))

    def finished(self, receive_time):
        """The topic. Header stamps serve where every message has one. A command holds until the next."""
        has_header = len(self.header) == len(self.received) and not receive_time
        clock = np.array(self.header if has_header else self.received, dtype=np.int64)
        series = {}
        for name, (at, values) in self.values.items():
            stamps, first = np.unique(clock[at], return_index=True)
            holds = name in self.switches or is_commanded(self.name)
            series[name] = Series(stamps, np.array(values)[first], HOLD if holds else LINE)
        return Topic(self.name, self.kind, len(self.received), HEADER if has_header else RECEIVED, series)
