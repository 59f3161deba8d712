"""Identifies robot dynamics from recordings and names the physics a model lacks.

    import torquescope as ts

    motion = ts.Recording(time=t, position=q, torque=tau, reference=q_ref)          # arrays, SI units
    found = ts.diagnose(motion, validate=other, model={"terms": ["inertia", "viscous", "coulomb", "offset"]})
    found.verdict, found.reason, found.effects[0].name
    found.plot.map()

Options are the keys of a job file: ts.describe("filter") tells those of a section.
"""

from importlib import metadata as _metadata

from .engine import RecordingWarning, check, describe, diagnose, identify, simulate
from .errors import DataError, Error, JobError, Problem, ResultError, UsageError
from .recording import Recording
from .result import Result
from .robot import Robot
from .ros import convert

__all__ = ["DataError", "Error", "JobError", "Problem", "Recording", "RecordingWarning", "Result", "ResultError",
           "Robot", "UsageError", "check", "convert", "describe", "diagnose", "identify", "open", "simulate"]


try:
    __version__ = _metadata.version("torquescope")
except _metadata.PackageNotFoundError:  # in the source tree
    __version__ = "0"


def open(path) -> Result:  # noqa: A001: as ts.open("r.h5")
    """A result file of torquescope run or diagnose. Errors: ResultError."""
    return Result(path)
