"""Reads result files (engine/store/RESULT_FORMAT.md) with h5py and numpy alone: nothing of the engine is needed."""

from ..errors import ResultError
from .read_replay import Replay, ReplayChannel, ReplayRecording
from .read_result import Group, Result, summary

__all__ = ["Group", "Replay", "ReplayChannel", "ReplayRecording", "Result", "ResultError", "summary"]
