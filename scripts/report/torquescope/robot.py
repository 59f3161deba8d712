"""A robot file as the engine reads it: joints, limits, and the parameters that torques can tell."""

from __future__ import annotations

import os
from dataclasses import dataclass

from .native import compiled


@dataclass(frozen=True)
class RobotJoint:
    """NaN where the file says nothing; SI units."""

    name: str
    kind: str  # "revolute", "prismatic"
    lower: float
    upper: float
    max_speed: float
    max_acceleration: float
    max_torque: float
    gear_ratio: float
    drive_inertia: float


class Robot:
    """An arm for `model=`, of a URDF, xacro, MJCF or TOML file.

    Example     arm = ts.Robot("arm.urdf"); found = ts.diagnose(motion, model=arm); motion: signals [n][joints]
    Attributes  name, mass (kg; 0: the file gives none), joints [RobotJoint], parameters {name: (sum, unit)} (the base
                parameters, and what each gathers), remarks [sentence], path
    Units       kg, m, rad, s, N m and N, at the joint
    Errors      torquescope.errors.Error and its kinds: no such file, a file that is no robot, a tree that branches
    """

    def __init__(self, path: str | os.PathLike[str]):
        _engine = compiled()
        self.path = os.path.abspath(path)
        facts = _engine.robot_facts(self.path)
        self.name, self.mass, self.remarks = facts["name"], facts["mass"], facts["remarks"]
        self.joints = [RobotJoint(**joint) for joint in facts["joints"]]
        self.parameters = {name: (gathers, unit) for name, gathers, unit in facts["parameters"]}

    @classmethod
    def from_urdf(cls, path: str | os.PathLike[str]) -> Robot:
        return cls(path)

    @classmethod
    def from_toml(cls, path: str | os.PathLike[str]) -> Robot:
        return cls(path)

    def __fspath__(self) -> str:
        return self.path

    def __repr__(self):
        return f"<Robot {self.name!r}: {len(self.joints)} joints, {len(self.parameters)} base parameters>"
