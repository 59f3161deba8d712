"""The joints of a bag by name, and what other columns say of them: whose they are, and in which order.

A joint's home is where its measured position is: "joint_states/elbow" of "joint_states/elbow/position". What belongs to
it and stands elsewhere is put there, so that names alone say what goes together.
"""

from __future__ import annotations

import re
from dataclasses import dataclass

import numpy as np

from .merge import Column
from .words import is_commanded, is_no_signal, quantity_of

KINDS = ("/JointState", "/DynamicJointState")  # the position of a joint is taken from these first, in this order


@dataclass(frozen=True)
class Home:
    joint: str
    prefix: str         # "joint_states/elbow"
    path: str           # "joint_states/elbow/position"
    position: Column


@dataclass(frozen=True)
class Piece:
    """A column as a part of a field: of one joint, or the k-th number of a list."""

    path: str
    column: Column
    joint: str          # "" where nothing names it
    field: str          # "desired.positions", "data"
    index: int | None   # of a list without names

    @property
    def source(self):
        return f"{self.column.topic.name} ({self.column.topic.kind})"


def homes_of(columns):
    """[Home] in the messages' order; of a joint that several topics measure the first of KINDS counts."""
    found = {}
    for path, column in columns.items():
        joint, field = _joint_and_field(column.name)
        if not joint or column.topic.is_command or quantity_of(field) != "position" or is_commanded(field) \
                or is_no_signal(field):
            continue
        rank = next((k for k, kind in enumerate(KINDS) if column.topic.kind.endswith(kind)), len(KINDS))
        if joint not in found or rank < found[joint][0]:
            found[joint] = rank, Home(joint, path.rpartition("/")[0], path, column)
    return [home for _, home in found.values()]


def pieces_of(columns, homes):
    """[Piece] of all columns."""
    joints = sorted((home.joint for home in homes), key=len, reverse=True)
    pieces = []
    for path, column in columns.items():
        joint, field = _joint_and_field(column.name)
        listed = re.fullmatch(r"(.*)\[(\d+)\]", field)
        if not joint:
            joint = next((one for one in joints if _names(column.topic.name, one)), "")
        pieces.append(Piece(path, column, joint, listed[1] if listed else field, int(listed[2]) if listed else None))
    return pieces


def fields_of(pieces):
    """[[Piece]]: those of one field of one topic together."""
    groups = {}
    for piece in pieces:
        groups.setdefault((piece.column.topic.name, piece.field), []).append(piece)
    return list(groups.values())


def in_order(group, homes):
    """{joint: Piece} of a field: by name, else by the message's order where it has a number for every joint."""
    if all(piece.joint and piece.index is None for piece in group):
        return {piece.joint: piece for piece in group}
    if len(group) == len(homes):
        return {home.joint: piece for home, piece in zip(homes, group)}
    if len(group) == 1 and group[0].joint:  # "/elbow_controller/commands" with one number
        return {group[0].joint: group[0]}
    return {}


def changes(values):
    known = values[np.isfinite(values)]
    return known.size > 1 and np.ptp(known) > 0


def _joint_and_field(name):
    joint, _, field = name.rpartition("/")
    return joint, field


def _names(topic, joint):
    return re.search(rf"(?<![A-Za-z0-9]){re.escape(joint)}(?![A-Za-z0-9])", topic) is not None
