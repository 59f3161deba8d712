"""Reads result files (engine/store/RESULT_FORMAT.md) with h5py and numpy alone: nothing of the engine is needed."""

from ..errors import ResultError
from .read_replay import Replay, ReplayChannel, ReplayRecording
from .read_result import Group, Result, summary
from .read_servo import KeptLaw, Servo, ServoRecording

__all__ = ["Group", "KeptLaw", "Replay", "ReplayChannel", "ReplayRecording", "Result", "ResultError", "Servo",
           "ServoRecording", "summary"]
