"""From a bag to a table: which topics, on whose time stamps, whose joint's they are, and what of it to tell."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np

from ..errors import DataError, UsageError
from . import merge, table
from .lerobot import is_data_set, read_episode
from .reading import read_topics
from .roles import roles_of
from .series import Topic

MOST_ROWS_CUT = 0.05  # of all: a recorder starts and stops its topics within moments of each other
FORMATS = {".h5": table.write_hdf5, ".hdf5": table.write_hdf5, ".csv": table.write_csv}


@dataclass(frozen=True)
class Conversion:
    """What was made of a bag, or of a data set of LeRobot; str() tells it in lines."""

    source: str
    path: str
    rows: int
    seconds: float
    base: str                                      # the topic on whose stamps all others are
    clock: str                                     # "header stamps" or "receive time"
    columns: list[str]
    topics: list[Topic] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)
    roles: list[str] = field(default_factory=list)  # which column is whose reference or effort, and what is missing

    def __str__(self):
        width = max((len(topic.name) for topic in self.topics), default=0)
        lines = [f"read      {topic.name:<{width}}  {topic.messages} messages of {topic.kind}, {topic.clock}"
                 for topic in self.topics]
        lines += [f"left out  {one}" for one in self.left_out]
        lines += self.roles
        others = ", all other topics are put onto them" if len(self.topics) > 1 else ""
        lines += [f"time      the {self.clock} of {self.base}{others}",
                  f"wrote     {self.path}: {self.rows} rows over {self.seconds:.4g} s, {len(self.columns)} columns",
                  f"next      torquescope init {self.path}"]
        return "\n".join(lines)


def convert(bag: str | os.PathLike[str], out: str | os.PathLike[str], topics: Sequence[str] = (),
            receive_time: bool = False, reference: str = "", effort: str = "", episode: int = 0) -> Conversion:
    """Write the numbers of a bag as a table: HDF5 (.h5) or CSV (.csv), by the ending of `out`.

    bag           a folder or .db3 of ROS 2, an .mcap, a .bag of ROS 1; the folder of a data set of LeRobot
    topics        those to read; none named: every topic of plain numbers
    receive_time  stamps of the recorder for all topics; else header stamps where messages have them
    reference     the topic, or TOPIC/FIELD, of the commanded positions; none named: what is called so and followed
    effort        the topic, or TOPIC/FIELD, of the efforts or motor currents; none named: those beside the positions
    episode       of a data set of LeRobot
    Columns       t_s (s since the first row); TOPIC/JOINT/position, velocity, effort, reference_position;
                  TOPIC/FIELD.FIELD
    Errors        ImportError without rosbags or pyarrow; DataError, UsageError
    """
    out, bag = pathlib.Path(out), pathlib.Path(bag)
    write = FORMATS.get(out.suffix.lower())
    if write is None:
        raise UsageError(f"error: {out} is to be a table, and its ending is none of {', '.join(FORMATS)}\n"
                         f"  help: write {out}.h5")
    if is_data_set(bag):
        return _data_set(bag, out, write, episode)
    found, left_out = read_topics(bag, topics, receive_time, [one for one in (reference, effort) if one])
    if not found:
        raise DataError(f"error: {bag} has nothing numeric\n  its topics: {'; '.join(left_out) or 'none'}")
    base = merge.densest(found)
    columns, empty = merge.merged(found, base)
    left_out += [f"{name}: no value while {base.topic.name} was recorded; --receive-time takes one clock for all topics"
                 for name in empty]
    seconds = merge.seconds_since_first(base.stamps)
    step_s = float(np.median(np.diff(seconds))) if len(seconds) > 1 else 0.0
    roles = roles_of(columns, step_s, reference, effort)
    values, sources = _named(columns, roles.moved)
    begin, end = _commanded_rows([values[name] for name in sources], len(seconds))
    if begin > 0 or end < len(seconds):
        left_out.append(f"{begin + len(seconds) - end} rows at the ends, before the first command or behind the last")
        values = {name: numbers[begin:end] for name, numbers in values.items()}
        base = merge.Base(base.topic, base.stamps[begin:end])
        seconds = merge.seconds_since_first(base.stamps)
    write(out, seconds, values, {"source": bag.name, "time_of_topic": base.topic.name, "clock": base.topic.clock,
                                 "first_stamp_ns": int(base.stamps[0])}, sources)
    return Conversion(str(bag), str(out), len(seconds), float(seconds[-1]), base.topic.name, base.topic.clock,
                      ["t_s", *values], [topic for topic in found if topic.name not in empty], left_out, roles.lines)


def _named(columns, moved):
    """({path: values}, {path: where it was}): what was moved stands behind all others, which say the joints' order."""
    values = {path: column.values for path, column in columns.items() if path not in moved}
    sources = {}
    for path, name in moved.items():
        name = merge.free_path(name, {**values, **columns})
        values[name] = columns[path].values
        sources[name] = f"{columns[path].name} of {columns[path].topic.name}, {columns[path].topic.kind}"
    return values, sources


def _commanded_rows(columns, count):
    """[begin, end) of the rows in which all of these have numbers, but for gaps; all rows where it would cost many."""
    known = [np.flatnonzero(np.isfinite(values)) for values in columns]
    begin = max((int(rows[0]) for rows in known), default=0)
    end = min((int(rows[-1]) + 1 for rows in known), default=count)
    return (begin, end) if begin + count - end <= MOST_ROWS_CUT * count else (0, count)


def _data_set(folder, out, write, episode):
    found = read_episode(folder, episode)
    write(out, found.seconds, found.columns, {"source": folder.resolve().name, "time_of_topic": "timestamp",
                                              "clock": found.clock, "episode": episode})
    return Conversion(str(folder), str(out), len(found.seconds), float(found.seconds[-1]), f"episode {episode}",
                      found.clock, ["t_s", *found.columns], [], found.left_out, found.lines)
