"""Several topics on the stamps of one: interpolated over time, never beyond what was recorded."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .series import HOLD, PATH, Series, Topic

# as of the program (engine/data/gaps.hpp): so many missing samples are filled, over longer stretches nothing is known
LONGEST_FILLED_GAP = 5


@dataclass(frozen=True)
class Base:
    """The topic, and those of its stamps, on which the others are put."""

    topic: Topic
    stamps: np.ndarray


@dataclass(frozen=True)
class Column:
    """One series on the stamps of all."""

    topic: Topic
    name: str           # of the series in its topic
    values: np.ndarray
    is_own: np.ndarray  # rows with a message of its own, not a value between two


def densest(topics):
    """Of the joint states, else of what is no command, else of all topics, the signal with the most samples."""
    candidates = [topic for topic in topics if topic.has_joint_states] or \
        [topic for topic in topics if not topic.is_command] or topics
    topic = max(candidates, key=lambda one: max(len(series.stamps) for series in one.series.values()))
    longest = max(topic.series.values(), key=lambda series: len(series.stamps))
    return Base(topic, longest.stamps)


def seconds_since_first(stamps):
    """s: differences of ns are exact, seconds since 1970 would not be."""
    return (stamps - stamps[0]) * 1e-9


def on_stamps(series: Series, stamps):
    """Values at these stamps (ns): a line between neighbours, NaN outside and in gaps; commands and switches hold."""
    if np.array_equal(series.stamps, stamps):
        return series.values
    own, asked = (series.stamps - stamps[0]) * 1e-9, (stamps - stamps[0]) * 1e-9
    if series.between == PATH:
        return np.interp(asked, own, series.values, left=np.nan)
    if series.between == HOLD:
        last = np.searchsorted(own, asked, side="right") - 1
        return np.where(last >= 0, series.values[np.maximum(last, 0)], np.nan)
    if len(own) < 2:
        return np.where(asked == own[0], series.values[0], np.nan)
    values = np.interp(asked, own, series.values, left=np.nan, right=np.nan)
    steps = np.diff(own)
    after = np.clip(np.searchsorted(own, asked, side="left"), 1, len(own) - 1)
    is_far = (steps[after - 1] > (LONGEST_FILLED_GAP + 1.5) * np.median(steps)) & ~np.isin(stamps, series.stamps)
    return np.where(is_far, np.nan, values)


def merged(topics, base: Base):
    """({path: Column}, [names of topics of which nothing is left])."""
    found, empty = {}, []
    for topic in topics:
        columns = {name: on_stamps(series, base.stamps) for name, series in topic.series.items()}
        known = {name: values for name, values in columns.items() if not np.all(np.isnan(values))}
        if not known:
            empty.append(topic.name)
        for name, values in known.items():
            found[free_path(f"{topic.name}/{name}", found)] = Column(
                topic, name, values, np.isin(base.stamps, topic.series[name].stamps))
    return {_leaf(path, found): column for path, column in found.items()}, empty


def free_path(name, taken):
    """As HDF5 can name it, and nothing else is called: "/joint_states/elbow/position" -> "joint_states/elbow/position".
    """
    path = "/".join("_" if part in (".", "..") else part for part in name.replace("\0", "_").split("/") if part)
    while path in taken:
        path += "_"
    return path


def _leaf(path, paths):
    """A name cannot be a group and a signal at once."""
    return f"{path}/value" if any(other.startswith(path + "/") for other in paths) else path
