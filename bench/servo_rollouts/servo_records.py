"""Records of a position-controlled servo with a pendulum, from a folder, brought to ticks of one length.

A folder has a manifest.csv (file, role, mass_kg, length_m, kp, supply_v), or train/ and unseen_load/ with files named
NAME_m{mass in kg}_l{length in mm}_kp{gain}_{motion}.csv or .csv.gz. Columns: t_s, q_goal_rad, q_rad, torque_enabled;
without the last the drive is always on.
"""
import csv
import dataclasses
import gzip
import pathlib
import re

import numpy as np

SUPPLY_V = 12.0  # of records whose names do not say it
ROLES = {"train": "train", "unseen_load": "validate"}
NAME = re.compile(r"_m(?P<mass_kg>[\d.]+)_l(?P<length_mm>[\d.]+)_kp(?P<kp>[\d.]+)_.*\.csv(?:\.gz)?$")


@dataclasses.dataclass
class Record:
    file: pathlib.Path
    role: str  # train, validate
    mass_kg: float
    length_m: float
    kp: float
    supply_v: float

    def read(self):
        opened = gzip.open if self.file.suffix == ".gz" else open
        with opened(self.file, "rt") as lines:
            rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
        self.time_s, self.goal, self.position = [
            np.array([float(row[name]) for row in rows]) for name in ("t_s", "q_goal_rad", "q_rad")]
        self.enabled = np.array([float(row.get("torque_enabled") or 1) for row in rows])
        return self


def listed(folder):
    """What the manifest says, or the names of files."""
    if (folder / "manifest.csv").exists():
        with open(folder / "manifest.csv") as manifest:
            return [Record((folder / row["file"]).resolve(), row["role"] or "train", float(row["mass_kg"]),
                           float(row["length_m"]), float(row["kp"]), float(row["supply_v"]))
                    for row in csv.DictReader(manifest)]
    found = []
    for name, role in ROLES.items():
        for file in sorted((folder / name).glob("*.csv*")):
            if known := NAME.search(file.name):
                found.append(Record(file.resolve(), role, float(known["mass_kg"]), float(known["length_mm"]) / 1000,
                                    float(known["kp"]), SUPPLY_V))
    return found


def read_all(folder):
    return [record.read() for record in listed(pathlib.Path(folder))]


class Ticks:
    """Records side by side: every row stands at the nearest tick, and its goal is held until the next row's."""

    def __init__(self, records, step_s):
        self.step_s = step_s
        at = [np.rint((record.time_s - record.time_s[0]) / step_s).astype(int) for record in records]
        self.count = max(ticks[-1] for ticks in at) + 1
        self.goal, self.enabled = np.empty((2, self.count, len(records)))
        for column, (record, ticks) in enumerate(zip(records, at)):
            row = np.searchsorted(ticks, np.arange(self.count), side="right") - 1
            self.goal[:, column] = record.goal[row]
            self.enabled[:, column] = record.enabled[row] != 0
        self.sample_tick = np.concatenate(at)
        self.sample_record = np.repeat(np.arange(len(records)), [len(ticks) for ticks in at])
        self.measured = np.concatenate([record.position for record in records])
        self.start = np.array([record.position[0] for record in records])
        mass, length, kp, supply = np.array([(r.mass_kg, r.length_m, r.kp, r.supply_v) for r in records]).T
        self.weight, self.inertia = 9.80665 * mass * length, mass * length ** 2
        self.volts_per_rad, self.most_volts = 0.165 * kp * supply, 0.97 * supply
