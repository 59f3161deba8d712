"""Bags of ROS 1 and ROS 2, MCAP files, and data sets of LeRobot, as one table over time that the program reads as a
recording."""

from .conversion import Conversion, convert

__all__ = ["Conversion", "convert"]
