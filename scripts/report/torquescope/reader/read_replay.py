"""Recordings beside their simulation, as plain Python, out of the group /replay of a result file.

    from torquescope.reader import Result
    replay = Result("R.h5").replay()                   None when the file holds none
    replay.models[replay.after]                        'with what was named'
    one = replay.recordings[0]
    one.time, one.position.measured                    numpy arrays [n]
    one.position.simulated[replay.after]               of this model; NaN where it says nothing of the position
    one.torque.relerr[replay.before]                   over all samples

Shapes     M models, n samples of a recording
Units      SI; each channel names its own. Shares are fractions of 1
Source     engine/store/RESULT_FORMAT.md, section /replay
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

YOURS = "your simulator"  # what the file calls a model that is not the engine's
CHANNELS = ("position", "velocity", "torque")


@dataclass
class ReplayChannel:
    """A measured signal and what each model makes of it. All numbers are over all samples, NaN of a model that
    diverged or says nothing."""

    unit: str
    measured: np.ndarray  # [n]
    simulated: np.ndarray  # [M][n]
    rms: np.ndarray  # [M], of measured minus simulated
    mae: np.ndarray  # [M], mean of its absolute value
    relerr: np.ndarray  # [M], rms / signal_rms
    samples: np.ndarray  # int [M]: compared
    signal_rms: float  # of position and velocity about their mean

    def difference(self, model: int) -> np.ndarray:
        """Measured minus simulated [n]."""
        return self.measured - self.simulated[model]

    def has(self, model: int) -> bool:
        """Whether the model says anything of this channel."""
        return bool(np.isfinite(self.simulated[model]).any())


@dataclass
class ReplayRecording:
    name: str
    purpose: str  # "train", "validate"
    rate_hz: float
    samples: int
    drive: str  # "reference", "command", "windows"
    window_s: float  # of "windows"; 0: the whole recording is one
    loop: str  # "given", "fitted", "identified", "approximated", "none"
    loop_words: str
    loop_error: float  # share of the recorded torque that the loop's controller leaves; NaN: unknown
    horizon_s: float  # time until which the simulation can be believed; NaN: to its end
    diverged: np.ndarray  # bool [M]
    time: np.ndarray  # [n]
    position: ReplayChannel | None
    velocity: ReplayChannel | None
    torque: ReplayChannel | None

    @property
    def channels(self) -> dict[str, ReplayChannel]:
        """Those the recording has, by name."""
        found = {name: getattr(self, name) for name in CHANNELS}
        return {name: channel for name, channel in found.items() if channel is not None}

    @property
    def is_validation(self) -> bool:
        return self.purpose == "validate"


@dataclass
class Replay:
    models: list[str]
    before: int  # indices into models; equal where there is one model
    after: int
    joint: str  # "revolute", "prismatic"
    recordings: list[ReplayRecording]  # in the order of the file

    @property
    def yours(self) -> int | None:
        """Index of your own simulator; None without one."""
        return self.models.index(YOURS) if YOURS in self.models else None


def read_replay(group) -> Replay:
    """The Replay from the group /replay (a read_result.Group)."""
    models = list(group.models)
    recordings, number = [], 1
    while f"recording_{number}" in group:
        recordings.append(_recording(getattr(group, f"recording_{number}"), len(models)))
        number += 1
    return Replay(models, group.before, group.after, group.get("joint", ""), recordings)


def _recording(group, models):
    kinds = {"int": 0, "float": math.nan, "str": ""}
    said = {name: group.get(name, kinds[f.type]) for name, f in ReplayRecording.__dataclass_fields__.items()
            if f.type in kinds}
    return ReplayRecording(
        **said,
        diverged=np.asarray(group.get("diverged", np.zeros(models))).astype(bool),
        time=group.time,
        **{name: _channel(group.get(name)) for name in CHANNELS},
    )


def _channel(group):
    if group is None:
        return None
    said = group.attributes()  # "unit" of the group, not of a dataset in it
    arrays = {name: getattr(group, name) for name in ("measured", "simulated", "rms", "mae", "relerr", "samples")}
    return ReplayChannel(unit=said["unit"], signal_rms=said.get("signal_rms", math.nan), **arrays)


def replay_table(replay: Replay, number) -> list[list[str]]:
    """Rows of texts, the head first: relative errors of all models, those of validation first; `number` writes them."""
    rows = [["replayed", "channel", *replay.models]]
    for one in validation_first(replay):
        for name, channel in one.channels.items():
            errors = ["diverged" if gone else number(error) for error, gone in zip(channel.relerr, one.diverged)]
            rows.append([one.name, name, *errors])
    return rows


def validation_first(replay: Replay) -> list[ReplayRecording]:
    return sorted(replay.recordings, key=lambda one: not one.is_validation)
