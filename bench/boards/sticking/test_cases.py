#!/usr/bin/python3
"""One clean and one single case of a fixed seed: files that parse, a size in its range, the same bytes twice, and the
joint's own parameters from its recording.

    test_cases.py MAKE_STICKING_CASE
"""

import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

SEED = 5
FILES = ("train.csv", "validate.csv", "job.toml", "truth.json")
SMALLEST, LARGEST = 0.003, 0.05
PERIODS = 14             # of the log, in one average of the momentum balance
CLOSEST_INERTIA = 0.1    # relative error of a plain fit, beside a hidden effect and a coarse encoder


def read(path):
    text = path.read_text()
    assert text.startswith("time_s,q,tau,q_ref\n"), text[:40]
    return np.loadtxt(text.splitlines()[1:], delimiter=",")


def fitted_inertia(rows, truth):
    """Momentum balance between rows that are PERIODS apart, of those that only move one way: no derivative of noise."""
    period = rows[1, 0] - rows[0, 0]
    speed = np.gradient(np.convolve(rows[:, 1], np.ones(PERIODS) / PERIODS, "same"), period)
    ends = np.arange(PERIODS, len(rows) - PERIODS, PERIODS)
    slow = 0.03 * np.max(np.abs(speed[ends]))
    columns, torque = [], []
    for start, end in zip(ends[:-1], ends[1:]):
        here = slice(start, end)
        if np.min(np.abs(speed[start:end + 1])) < slow:
            continue
        length = period * PERIODS
        column = [(speed[end] - speed[start]) / length, (rows[end, 1] - rows[start, 1]) / length,
                  np.sign(speed[start]), 1.0]
        if "gravity_sin" in truth["joint"]:
            column += [np.mean(np.sin(rows[here, 1])), np.mean(np.cos(rows[here, 1]))]
        columns.append(column)
        torque.append(np.mean(rows[here, 2]))
    assert len(columns) > 50, f"only {len(columns)} stretches move one way"
    return np.linalg.lstsq(np.array(columns), np.array(torque), rcond=None)[0][0]


def check(program, kind, folder):
    for time in ("first", "again"):
        subprocess.run([program, str(SEED), "0", kind, folder / time], check=True)
    for name in FILES:
        assert (folder / "first" / name).read_bytes() == (folder / "again" / name).read_bytes(), f"{name} changes"
    truth = json.loads((folder / "first/truth.json").read_text())
    assert truth["kind"] == kind and len(truth["effects"]) == (kind == "single"), truth
    for effect in truth["effects"]:
        assert SMALLEST <= effect["relative_size"] <= LARGEST, effect
    job = tomllib.loads((folder / "first/job.toml").read_text())
    assert job["diagnose"] == {"twins": 60}, job
    assert ("gravity" in job["model"]["terms"]) == ("gravity_sin" in truth["joint"]), job
    for name in ("train", "validate"):
        rows = read(folder / "first" / job["recording"][name])
        assert rows.shape == (40 * truth["reading"]["log_hz"], 4) and np.all(np.isfinite(rows)), rows.shape
        assert np.allclose(np.diff(rows[:, 0]), 1 / truth["reading"]["log_hz"]), "rows are not evenly spaced"
        step = 2 * np.pi / 2 ** truth["reading"]["encoder_bits"]
        assert np.allclose(rows[:, 1] / step, np.round(rows[:, 1] / step), atol=1e-4), "positions between counts"
        error = abs(fitted_inertia(rows, truth) / truth["joint"]["inertia"] - 1)
        assert error < CLOSEST_INERTIA, f"{kind}, {name}: inertia off by {100 * error:.1f} %"
    print(f"{kind}: {truth['sticking']['law']}, {[e['name'] for e in truth['effects']]}, inertia within "
          f"{100 * error:.1f} %")


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        for kind in ("clean", "single"):
            check(program, kind, Path(folder) / kind)
    refused = subprocess.run([program, "5", "0", "dirty", "nowhere"], capture_output=True, text=True, check=False)
    assert refused.returncode == 64 and "no kind is called dirty" in refused.stderr, refused


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
