"""From a bag to a table: which topics, on whose time stamps, and what of it to tell."""

from __future__ import annotations

import os
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, field

from ..errors import DataError, UsageError
from . import merge, table
from .reading import read_topics
from .series import Topic

FORMATS = {".h5": table.write_hdf5, ".hdf5": table.write_hdf5, ".csv": table.write_csv}


@dataclass(frozen=True)
class Conversion:
    """What was made of a bag; str() tells it in lines."""

    source: str
    path: str
    rows: int
    seconds: float
    base: str                                      # the topic on whose stamps all others are
    clock: str                                     # "header stamps" or "receive time"
    columns: list[str]
    topics: list[Topic] = field(default_factory=list)
    left_out: list[str] = field(default_factory=list)

    def __str__(self):
        width = max(len(topic.name) for topic in self.topics)
        lines = [f"read     {topic.name:<{width}}  {topic.messages} messages of {topic.kind}, {topic.clock}"
                 for topic in self.topics]
        lines += [f"left out {one}" for one in self.left_out]
        others = ", all other topics are interpolated onto them" if len(self.topics) > 1 else ""
        lines += [f"time     the {self.clock} of {self.base}{others}",
                  f"wrote    {self.path}: {self.rows} rows over {self.seconds:.4g} s, {len(self.columns)} columns",
                  f"next     torquescope init {self.path}"]
        return "\n".join(lines)


def convert(bag: str | os.PathLike[str], out: str | os.PathLike[str], topics: Sequence[str] = (),
            receive_time: bool = False) -> Conversion:
    """Write the numbers of a bag as a table: HDF5 (.h5) or CSV (.csv), by the ending of `out`.

    bag           a folder or .db3 of ROS 2, an .mcap, a .bag of ROS 1
    topics        those to read; none named: every topic of plain numbers
    receive_time  stamps of the recorder for all topics; else header stamps where messages have them
    Columns       t_s (s since the first row); TOPIC/JOINT/position, velocity, effort; TOPIC/FIELD.FIELD
    Errors        ImportError without the extra `ros`; DataError, UsageError
    """
    out = pathlib.Path(out)
    write = FORMATS.get(out.suffix.lower())
    if write is None:
        raise UsageError(f"error: {out} is to be a table, and its ending is none of {', '.join(FORMATS)}\n"
                         f"  help: write {out}.h5")
    found, left_out = read_topics(pathlib.Path(bag), topics, receive_time)
    if not found:
        raise DataError(f"error: {bag} has nothing numeric\n  its topics: {'; '.join(left_out) or 'none'}")
    base = merge.densest(found)
    columns, empty = merge.merged(found, base)
    left_out += [f"{name}: no value while {base.topic.name} was recorded; --receive-time takes one clock for all topics"
                 for name in empty]
    seconds = merge.seconds_since_first(base.stamps)
    write(out, seconds, columns, {"source": pathlib.Path(bag).name, "time_of_topic": base.topic.name,
                                  "clock": base.topic.clock, "first_stamp_ns": int(base.stamps[0])})
    return Conversion(str(bag), str(out), len(seconds), float(seconds[-1]), base.topic.name, base.topic.clock,
                      ["t_s", *columns], [topic for topic in found if topic.name not in empty], left_out)
