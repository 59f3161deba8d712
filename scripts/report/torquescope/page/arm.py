"""What the page of an arm needs beside a Study: its joints, their rows and their errors, in plain arrays.

Source     engine/store/RESULT_FORMAT.md, /robot and /arm
"""

import numpy as np


class JointRows:
    """Rows of a joint that move one way, in /data/train/joint_J or /data/validate/joint_J."""

    def __init__(self, group, own, kept_rate_hz):
        self.torque, self.velocity = np.asarray(group.torque), np.asarray(group.velocity)
        self.unit, self.velocity_unit = group.unit("torque"), group.unit("velocity")
        self._group, self._own, self._step_s = group, own, 1 / kept_rate_hz

    def prediction(self, parameters):
        return self._group.regressor @ np.asarray(parameters)[self._own]

    def with_gaps(self, *signals):
        """Time [m] in s, recordings laid end to end, and the signals [m], with a NaN wherever rows were left out."""
        time, recording = np.array(self._group.time, dtype=float), np.asarray(self._group.recording)
        offset = 0.0
        for number in np.unique(recording):
            rows = recording == number
            first, last = time[rows][0], time[rows][-1]
            time[rows] += offset - first
            offset += last - first + self._step_s
        after = np.flatnonzero(np.diff(time) > 1.5 * self._step_s) + 1
        filled = np.insert(time, after, time[after - 1] + self._step_s) if len(after) else time
        return (filled, *(np.insert(np.asarray(signal, dtype=float), after, np.nan) for signal in signals))


class Joint:
    def __init__(self, result, index, name):
        self.number, self.name = index + 1, name
        own = result.arm[f"joint_{self.number}"]["parameters"][()]
        group = f"joint_{self.number}"

        def rows_of(data):
            if data is None or group not in data or not len(getattr(data, group).time):
                return None  # it stands still
            return JointRows(getattr(data, group), own, data.kept_rate_hz)

        self.train, self.validate = rows_of(result.train), rows_of(result.validate)

    @property
    def title(self):
        return self.name if str(self.number) in self.name else f"{self.number} {self.name}"

    @property
    def heading(self):
        return self.name[:1].upper() + self.name[1:] if str(self.number) in self.name else f"Joint {self.title}"

    @property
    def validation_or_train(self):
        """(rows, which): what the picture of its torque shows."""
        return (self.validate, "validation") if self.validate is not None else (self.train, "training")


class Arm:
    """/robot and /arm."""

    def __init__(self, result):
        robot = result.robot
        self.name = robot.name
        self.base_parameters, self.gathers = list(robot.base_parameters), list(robot.gathers)
        self.seen = result.arm.get("seen")  # [R] "alone", "group", "no"; None of an earlier version
        self.file_values = robot.get("file_values")  # [B], of the robot file's inertias; None when it gives none
        self.joints = [Joint(result, index, name) for index, name in enumerate(robot.joints)]

    def known_values(self, study):
        """([R] values to compare with, NaN where there is none; what they are), or (None, "")."""
        if study.model.truth is not None and np.isfinite(study.model.truth).any():
            return np.asarray(study.model.truth), "truth"
        if self.file_values is None or not np.isfinite(self.file_values).any():
            return None, ""
        others = len(study.model.names) - len(self.file_values)
        return np.concatenate([self.file_values, np.full(others, np.nan)]), "robot file"

    @staticmethod
    def reference(study):
        """The estimator the page speaks of: weighted least squares, to which a small joint counts as much as a large
        one; else the first."""
        return next((e for e in study.estimators if e.kind == "wls"), study.estimators[0])
