"""Bags of ROS 1 and ROS 2, and MCAP files, as one table over time that the program reads as a recording."""

from .conversion import Conversion, convert

__all__ = ["Conversion", "convert"]
