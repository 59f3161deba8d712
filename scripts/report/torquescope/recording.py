"""A recording as arrays: what a joint, or every joint of an arm, was seen to do."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import DataError, UsageError
from .native import compiled

if TYPE_CHECKING:
    import pandas
    from numpy.typing import ArrayLike


WITHOUT = {
    "position": "position=q, in rad or m",
    "torque": "torque=tau in N m or N, or a motor current with torque_per_unit=<N m per A>; of a servo without either "
              "the program takes many recordings of the position: torquescope init --servo FILES"}


class Recording:
    """Signals [n] of one joint, or [n][joints] of an arm; time [n] is shared. A column [n][1] is a signal [n].

    Example    motion = ts.Recording(time=t, position=q, torque=tau, reference=q_ref, name="elbow")
    Units      s; rad or m; rad/s, rad/s2; N m or N. In other units give what one of theirs is, with the keys of a
               job's [recording]: Recording(..., torque_per_unit=0.105), position_per_unit, time_per_unit, ...
    Missing    NaN, or masked (numpy.ma, as netCDF4 reads); gaps="fill" fills up to five in a row
    Without    time: rate_hz=. Without a reference (the commanded position) small effects are not found
    joint      what sentences call it: "the joint of elbow"
    Has        len(motion), motion.joints, motion.position and the other signals, motion.to_frame()
    Errors     UsageError: neither time nor rate_hz; DataError: shapes that differ, no position, what is no number
    """

    def __init__(self, *, position: ArrayLike, torque: ArrayLike | None = None, time: ArrayLike | None = None,
                 reference: ArrayLike | None = None, velocity: ArrayLike | None = None,
                 acceleration: ArrayLike | None = None, simulated_torque: ArrayLike | None = None,
                 name: str = "recording", joint: str | None = None, **options: Any):
        given = {"time": time, "position": position, "torque": torque, "reference": reference, "velocity": velocity,
                 "acceleration": acceleration, "simulated_torque": simulated_torque}
        self.name, self.joint, self.options, self.remarks = str(name), joint, options, []
        self.signals: dict[str, np.ndarray] = {
            channel: _array(channel, values) for channel, values in given.items() if values is not None}
        for channel, way_out in WITHOUT.items():
            if channel not in self.signals:
                raise DataError(f"error: a recording has no {channel}\n  help: {way_out}")
        self._check_shapes()

    @classmethod
    def from_file(cls, path: str | os.PathLike[str], joint: int | str = "", **options: Any) -> Recording:
        """A file of any format that the program reads; columns and units are guessed as `torquescope init` does, and
        .remarks says how. joint: of a file with several, its name, or its number from 1. Further options are keys of
        [recording]. Values are as in the file: torque_per_unit and its kin come with them.

        Example    ts.Recording.from_file("mine.csv", columns={"torque": "current_A"}, torque_per_unit=0.105)
        Errors     DataError: no such file or column, no position or torque found
        """
        _engine = compiled()
        text, guesses, warnings = _engine.draft_job(os.fspath(path), str(joint) if joint else "")
        drafted = _toml(text)["recording"]
        guessed = drafted.pop("columns", {})
        guessed.pop("enabled", None)  # of rollouts: no signal of this class
        columns = {**guessed, **options.pop("columns", {})}
        missing = [channel for channel in ("position", "torque") if channel not in columns]
        if missing:
            raise DataError(f"error: no {' and no '.join(missing)} was found in {path}\n"
                            "  help: name the columns: columns={\"position\": ..., \"torque\": ...}")
        values = _engine.columns_of_file(os.fspath(path))
        absent = [column for column in columns.values() if column not in values]
        if absent:
            raise DataError(f"error: no column {absent[0]!r} in {path}\n  the file has: {', '.join(values)}")
        for key in ("train", "validate"):
            drafted.pop(key, None)
        recording = cls(**{channel: values[column] for channel, column in columns.items()},
                        name=os.path.basename(path), joint=columns["position"], **{**drafted, **options})
        recording.remarks = [*guesses, *warnings]
        return recording

    from_csv = from_file

    @property
    def joints(self) -> int:
        """How many: 1 for signals [n]."""
        position = self.signals["position"]
        return 1 if position.ndim == 1 else position.shape[1]

    def __len__(self) -> int:
        return len(self.signals["position"])

    def __getattr__(self, name: str) -> np.ndarray:
        signals = self.__dict__.get("signals", {})
        if name in signals:
            return signals[name]
        raise AttributeError(f"{self.__class__.__name__} has no {name!r}; it has: {', '.join(signals)}")

    def __repr__(self):
        joints = "" if self.joints == 1 else f", {self.joints} joints"
        return f"<Recording {self.name!r}: {len(self)} samples{self._length()}{joints}; {', '.join(self.signals)}>"

    def to_frame(self) -> pandas.DataFrame:
        """A pandas DataFrame of all signals, as they were given, over time where there is one."""
        import pandas
        frame = pandas.DataFrame(dict(self.table()))
        return frame.set_index("time") if "time" in frame else frame

    def table(self, joint=None):
        """[(column, values [n])]: as the engine is given them. joint: the name of the position's column."""
        columns = []
        for channel, values in self.signals.items():
            if values.ndim == 1:
                column = joint if joint and channel == "position" else channel
                columns.append((column, np.ascontiguousarray(values)))
            else:
                columns += [(f"{channel}_{j + 1}", np.ascontiguousarray(values[:, j])) for j in range(values.shape[1])]
        return columns

    def section(self, joint=None):
        """What a job's [recording] says of these signals."""
        named = {channel: channel if values.ndim == 1 else channel + "_{j}" for channel, values in self.signals.items()}
        if joint and self.joints == 1:
            named["position"] = joint
        simulated = named.pop("simulated_torque", None)
        return {"columns": named, **({"simulated_torque": simulated} if simulated else {}), **self.options}

    def _length(self):
        if "time" not in self.signals or len(self) < 2:
            return ""
        seconds = (self.signals["time"][-1] - self.signals["time"][0]) * self.options.get("time_per_unit", 1.0)
        return f", {seconds:.4g} s" if np.isfinite(seconds) else ""

    def _check_shapes(self):
        if "time" not in self.signals and "rate_hz" not in self.options:
            raise UsageError("error: a recording has neither time stamps nor a sampling rate\n"
                             "  help: Recording(time=t, ...) or Recording(rate_hz=1000, ...)")
        rows = len(self)
        shape = self.signals["position"].shape
        for channel, values in self.signals.items():
            if len(values) != rows:
                raise DataError(f"error: {channel} has {len(values)} values where position has {rows}")
            if channel != "time" and values.shape != shape:
                raise DataError(f"error: {channel} has shape {values.shape} where position has {shape}")
        if self.signals.get("time", np.empty(0)).ndim != 1:
            raise DataError("error: time is shared by all joints: an array [n]")


def common_section(recordings):
    """What one job says of all of these; they must agree. The joint is called as in the first."""
    joint = recordings[0].joint
    first = recordings[0].section(joint)
    for other in recordings[1:]:
        section = other.section(joint)
        # a channel that not every recording has is not asked for
        if set(section["columns"]) != set(first["columns"]):
            raise UsageError(f"error: {recordings[0].name!r} has {', '.join(first['columns'])}, and {other.name!r} has "
                             f"{', '.join(section['columns'])}\n  help: give all recordings of a job the same signals")
        for key in {*first, *section}:
            if first.get(key) != section.get(key):
                raise UsageError(f"error: {key} = {first.get(key)!r} of {recordings[0].name!r} is "
                                 f"{section.get(key)!r} of {other.name!r}; a job has one\n"
                                 "  help: bring both to SI units first")
    return first


def _array(channel, values):
    if np.iscomplexobj(values):  # numpy would drop the imaginary part
        raise DataError(f"error: {channel} holds complex numbers\n  help: give real ones: {channel}=values.real")
    try:
        array = np.ma.asarray(values, dtype=float).filled(np.nan)  # not the fill value of what is masked
    except (TypeError, ValueError) as error:
        raise DataError(f"error: {channel} holds what is no number: {error}\n"
                        "  help: give floats, and NaN for what is missing; of pandas: pandas.to_numeric(column, "
                        "errors=\"coerce\")") from error
    if array.ndim == 2 and array.shape[1] == 1:  # a column vector, a data frame of one column
        array = array[:, 0]
    if array.ndim not in (1, 2):
        raise DataError(f"error: {channel} has {array.ndim} dimensions; signals are [n] or [n][joints]")
    if array.ndim == 2 and array.shape[0] == 1 and array.shape[1] > 1:
        raise DataError(f"error: {channel} has one row of {array.shape[1]} values: one sample of as many joints\n"
                        f"  help: rows are samples: {channel}=values.T, or values.ravel() of one joint")
    return array


def _toml(text):
    try:
        import tomllib
    except ImportError:  # before Python 3.11
        import tomli as tomllib
    return tomllib.loads(text)
