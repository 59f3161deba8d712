"""A data set of LeRobot: an episode of it as a table. Needs pyarrow, or pandas with an engine for Parquet.

Layout     meta/info.json (fps, features with their names), data/chunk-*/*.parquet: an episode a file (v2.0, v2.1), or
           several in one with a column episode_index (v3.0). Cells hold lists, one number for each name
Columns    "elbow/position" of observation.state, "elbow/velocity", "elbow/effort" of observation.velocity and .effort,
           "elbow/reference_position" of action; other features under their own names. Pictures are left out
Action     often the state of the next row, written by a script: that is no command, and gives no reference
Time       `timestamp`, which LeRobot makes of frame and fps: it tells no delay and no jitter
"""

from __future__ import annotations

import json
import math
import re
from dataclasses import dataclass, field

import numpy as np

from ..errors import DataError
from .follow import following, is_shifted_copy
from .words import quantity_of

INSTALL = "pip install pyarrow"
INDICES = ("timestamp", "frame_index", "episode_index", "index", "task_index", "next.done", "next.reward",
           "next.success")
PICTURES = ("image", "video")
CHANNELS = {"observation.state": "position", "observation.velocity": "velocity", "observation.effort": "effort",
            "observation.current": "current", "action": "reference_position"}


@dataclass
class Episode:
    seconds: np.ndarray
    columns: dict[str, np.ndarray]
    clock: str
    left_out: list[str] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)


def is_data_set(path):
    return (path / "meta" / "info.json").is_file()


def read_episode(folder, number):
    """An Episode. Errors: DataError; ImportError without pyarrow and pandas."""
    info = _info(folder)
    fps = float(info["fps"])
    table = _rows(folder, number, info["features"])
    rows = len(next(iter(table.values())))
    frames = np.asarray(table.get("frame_index", np.arange(rows)), dtype=float)
    stamps = np.asarray(table.get("timestamp", frames / fps), dtype=float)
    episode = Episode(stamps - stamps[0], {}, "timestamp, which LeRobot makes of frame and fps," if "timestamp" in table
                      else "frames over fps")
    parts = {}
    for name, feature in info["features"].items():
        if name in INDICES:
            continue
        values = _matrix(table[name]) if name in table else None
        if values is None:
            kind = feature.get("dtype", "unknown") if isinstance(feature, dict) else "unknown"
            episode.left_out.append(f"{name}: {kind}, no numbers in the Parquet file")
            continue
        parts[name] = dict(zip(_names(feature, values.shape[1]), values.T))
    for name, of in parts.items():
        _add(episode, name, of, parts, fps)
    count = info.get("total_episodes")
    episode.lines.insert(0, f"episode   {number} of {count if count is not None else 'unknown'}, counted from 0; "
                            "--episode N takes another")
    return episode


def _add(episode, feature, of, parts, fps):
    channel = CHANNELS.get(feature)
    if channel is None:
        episode.columns.update({f"{feature}/{name}" if len(of) > 1 else feature: values for name, values in of.items()})
        return
    state = parts.get("observation.state", {})
    if feature == "action" and not _is_command(of, state, fps, episode.lines):
        return
    episode.columns.update({f"{_joint(name)}/{channel}": values for name, values in of.items()})


def _is_command(action, state, fps, lines):
    """Whether the action may be the reference; says why not."""
    shared = [name for name in action if name in state]
    if not shared:
        lines.append("reference none: action and observation.state share no name")
        return False
    for shift, words in ((1, "the state of the next row, action[t] = observation.state[t+1]"),
                         (0, "the state once more")):
        copies = [name for name in shared if is_shifted_copy(action[name], state[name], shift)]
        if 2 * len(copies) >= len(shared):
            lines.append(f"reference none: action is {words}, in {len(copies)} of {len(shared)} joints: no command was "
                         "recorded; small effects are not found without")
            return False
    told = [following(action[name], state[name], 1 / fps) for name in shared]
    moving = [one for one in told if not np.isnan(one.share)]
    if moving and not any(one.is_good for one in moving):
        lines.append("reference none: the state does not follow the action (other units, or no positions)")
        return False
    lines.append("reference JOINT/reference_position: action, which the state follows")
    return True


def _joint(name):
    """ "shoulder_pan" of "shoulder_pan.pos"."""
    stem, _, ending = name.rpartition(".")
    return stem if stem and quantity_of(ending) else name


def _info(folder):
    try:
        info = json.loads((folder / "meta" / "info.json").read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise DataError(f"error: {folder}/meta/info.json cannot be read: {error}") from error
    fps = info.get("fps") if isinstance(info, dict) else None
    if not isinstance(fps, (int, float)) or not math.isfinite(fps) or fps <= 0 or \
            not isinstance(info.get("features"), dict):
        raise DataError(f"error: {folder}/meta/info.json has no fps or no features: no data set of LeRobot\n"
                        "  help: download the whole data set: meta and data")
    return info


def _names(feature, count):
    """Of every number of a feature: a list, or lists by group ({"motors": [...]}); else numbers."""
    names = feature.get("names") if isinstance(feature, dict) else None
    if isinstance(names, dict):
        lists = [one for one in names.values() if isinstance(one, list)]
        names = lists[0] if len(lists) == 1 else [name for one in lists for name in one] or \
            sorted(names, key=lambda name: names[name] if isinstance(names[name], int) else 0)
    if not isinstance(names, list) or len(names) != count or len(set(map(str, names))) != count:
        names = [f"joint_{k}" for k in range(count)]
    return [str(name).replace("/", "_") for name in names]


def _rows(folder, number, features):
    """{column: list} of one episode; a file of that number is looked at first."""
    files = sorted((folder / "data").glob("**/*.parquet"))
    if not files:
        raise DataError(f"error: {folder}/data has no Parquet file\n  help: download the whole data set: meta and data")
    own = [file for file in files if re.fullmatch(rf"episode_0*{number}", file.stem)]
    known = set()
    for file in own or files:
        table = _read(file, features)
        index = table.get("episode_index")
        if index is None:
            if own:
                return table
            continue
        known.update(map(int, index))
        chosen = [k for k, one in enumerate(index) if int(one) == number]
        if chosen:
            return {name: [values[k] for k in chosen] for name, values in table.items()}
    there = f"{min(known)} to {max(known)}" if known else "none"
    raise DataError(f"error: {folder} has no episode {number}\n  its episodes: {there}")


def _read(file, features):
    """{column: list}, without pictures."""
    try:
        from pyarrow import parquet
        read = lambda: parquet.read_table(  # noqa: E731
            file, columns=[name for name in parquet.read_schema(file).names if not _is_picture(features.get(name))]
        ).to_pydict()
    except ImportError:
        try:
            import pandas
            read = lambda: pandas.read_parquet(file).to_dict(orient="list")  # noqa: E731
        except ImportError as error:
            raise ImportError(f"error: data sets of LeRobot are Parquet, which pyarrow reads, and it is not there\n"
                              f"  help: {INSTALL}") from error
    try:
        return read()
    except ImportError as error:  # pandas without an engine
        raise ImportError(f"error: pandas has nothing that reads Parquet\n  help: {INSTALL}") from error
    except Exception as error:  # noqa: BLE001: a parser of foreign bytes
        raise DataError(f"error: {file} cannot be read as Parquet: {str(error)[:300]}\n"
                        "  help: download it again; a pointer of Git LFS is not the file: git lfs pull") from error


def _is_picture(feature):
    return isinstance(feature, dict) and feature.get("dtype") in PICTURES


def _matrix(cells):
    """[n][numbers], or None where the cells are no numbers or not of one length."""
    try:
        values = np.asarray(cells if isinstance(cells, list) else list(cells), dtype=float)
    except (TypeError, ValueError):
        return None
    return values.reshape(len(values), -1) if values.ndim >= 1 and values.size else None
