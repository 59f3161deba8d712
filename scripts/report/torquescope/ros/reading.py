"""Topics of a bag through rosbags: which of them are signals, and their numbers with stamps."""

from __future__ import annotations

import contextlib

from ..errors import DataError
from .fields import LONGEST_LIST, NO_SIGNALS, header_stamp
from .path import PathGathering
from .series import Gathering

MAGICS = {b"\x89MCAP0\r\n": ".mcap", b"#ROSBAG V2.0": ".bag", b"SQLite format 3\0": ".db3"}
NO_MEASUREMENTS = ("Log", "ParameterEvent", "TFMessage", "Clock")
BYTES = ("uint8", "int8", "byte", "char", "octet")
LISTS_THAT_ARE_READ = ("JointTrajectory", "DynamicJointState")  # of messages: points, interfaces of joints
INSTALL = "pip install rosbags (in a clone of Torquescope: pip install '.[ros]')"
ENOUGH_SHOWN = 300  # letters of somebody else's message


def _rosbags():
    try:
        from rosbags import highlevel, typesys
    except ImportError as error:
        raise ImportError(f"error: bags are read by rosbags, which is not there ({error})\n"
                          f"  help: {INSTALL}") from error
    return highlevel, typesys


def _check(path):
    """What rosbags tells apart by the ending is what the bytes say it is."""
    if not path.exists():
        raise FileNotFoundError(f"error: no such file: {path}")
    if path.is_dir():
        if not (path / "metadata.yaml").exists():
            raise DataError(f"error: {path} is a folder without metadata.yaml: no bag of ROS 2\n"
                            "  help: name the .mcap or .db3 in it, or write the file: ros2 bag reindex FOLDER")
        return
    with path.open("rb") as file:
        head = file.read(max(map(len, MAGICS)))
    ending = next((ending for magic, ending in MAGICS.items() if head.startswith(magic)), None)
    if ending is None:
        raise DataError(f"error: {path} is no bag: neither MCAP nor a bag of ROS 1 or ROS 2\n"
                        "  help: tables and arrays are read as they are: torquescope init FILE")
    if path.suffix != ending:
        raise DataError(f"error: {path} is told by its ending, and holds another kind of bag\n"
                        f"  help: rename it to {path.with_suffix(ending).name}")


@contextlib.contextmanager
def _told(path):
    """What rosbags and its parsers raise over a damaged file, which is anything, as DataError."""
    try:
        yield
    except DataError:
        raise
    except Exception as error:  # noqa: BLE001: a parser of foreign bytes
        what = str(error)[:ENOUGH_SHOWN] or type(error).__name__
        raise DataError(f"error: {path} cannot be read as a bag: {what}\n"
                        "  help: was the recorder killed? `mcap recover`, `ros2 bag reindex` or `rosbag reindex` mend "
                        "what it left") from error


def read_topics(path, wanted=(), receive_time=False, also=()):
    """([Topic], ["NAME: why it was left out"]). wanted: topics by name; none: all that look like signals. also: beside
    those wanted, TOPIC or TOPIC/FIELD."""
    highlevel, typesys = _rosbags()
    _check(path)
    with _told(path):
        reader = highlevel.AnyReader([path], default_typestore=typesys.get_typestore(typesys.Stores.LATEST))
        with reader:
            if wanted:
                wanted = [*wanted, *_topics_of(also, {one.topic for one in reader.connections})]
            chosen, left_out = _choose(reader, path, wanted)
            gathered = {}
            # asked for none, it would read all
            messages = reader.messages(connections=chosen) if chosen else ()
            for connection, received, raw in messages:
                if connection.topic not in gathered:
                    make = PathGathering if connection.msgtype.endswith("/JointTrajectory") else Gathering
                    gathered[connection.topic] = make(connection.topic, connection.msgtype)
                message = reader.deserialize(raw, connection.msgtype)
                gathered[connection.topic].add_message(received, header_stamp(message), message)
            silent = {(one.topic, one.msgtype) for one in chosen if one.topic not in gathered}
    left_out += [f"{name}: {kind}, no messages" for name, kind in sorted(silent)]
    for one in gathered.values():
        left_out += [f"{one.name}.{field}: {length} numbers a message" for field, length in one.too_long.items()]
        if not one.values:
            left_out.append(f"{one.name}: {one.kind} without a number")
    return [one.finished(receive_time) for one in gathered.values() if one.values], left_out


def _topics_of(fields, there):
    asked = ["/" + name.strip("/") for name in fields]
    return [topic for name in asked for topic in (name, name.rpartition("/")[0]) if topic in there]


def _choose(reader, path, wanted):
    """(connections to read, what was left out)."""
    there = {connection.topic: connection for connection in reader.connections}
    names = {name if name in there else "/" + name.strip("/") for name in wanted}
    unknown = [name for name in sorted(names) if name not in there]
    if unknown:
        listed = "\n    ".join(f"{name}  {there[name].msgtype}" for name in sorted(there)) or "nothing"
        raise DataError(f"error: no topic {', '.join(unknown)} in {path}\n  it has\n    {listed}")
    left_out = {}
    for name, connection in there.items():
        reason = _objection(reader.typestore.fielddefs, connection.msgtype, bool(names))
        if names and name not in names:
            continue
        if reason:
            count = sum(one.msgcount for one in reader.connections if one.topic == name)
            left_out[name] = f"{reason} ({count} message{'' if count == 1 else 's'})"
    chosen = [one for one in reader.connections
              if one.topic not in left_out and (not names or one.topic in names)]
    return chosen, [f"{name}: {reason}" for name, reason in sorted(left_out.items())]


def _objection(definitions, kind, is_asked_for):
    """Why a topic is no signal, or None."""
    if kind not in definitions:
        return f"{kind}, whose definition is not in the bag"
    if is_asked_for:
        return None
    if kind.rsplit("/", 1)[-1] in NO_MEASUREMENTS:
        return kind
    if kind.rsplit("/", 1)[-1] in LISTS_THAT_ARE_READ:
        return None
    leaves = list(_leaves(definitions, kind))
    if any(is_list and base in BYTES for base, is_list in leaves):
        return f"{kind} holds bytes"
    if any(is_list and base == "message" for base, is_list in leaves):
        return f"{kind} holds lists of messages; name it to read it all the same"
    if not any(base not in ("message", "string", "wstring") for base, _ in leaves):
        return f"{kind} has no number"
    return None


def _leaves(definitions, kind):
    """(type, whether it is a list) of every field outside of headers; a list of messages is ("message", True)."""
    for name, (node, more) in definitions[kind][1]:
        if name in NO_SIGNALS:
            continue
        tag = node.name
        if tag == "BASE":
            yield more[0], False
        elif tag == "NAME":
            yield from _leaves(definitions, more)
        else:  # ARRAY, SEQUENCE
            (inner, item), length = more
            is_short = tag == "ARRAY" and length <= LONGEST_LIST  # as an identifier of 16 bytes
            yield ("message", True) if inner.name == "NAME" else (item[0], not is_short)
