"""A pump shakes a joint in two recordings, each with a phase of its own: the diagnosis names its frequency.

The plant stands here and shares nothing with the engine: a rigid joint with friction, led by a controller with an
encoder, that a torque of fixed frequency acts on. Laws of the motion each explain a little of it.
"""

import json
import math
import os
import random
import subprocess
import tempfile
import unittest
from pathlib import Path

PROGRAM = os.environ["TORQUESCOPE"]
JOB = """
[experiment]
name = "pump"
[recording]
train = "train.csv"
validate = "other.csv"
columns = {time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "tau_Nm"}
[filter]
cutoff_hz = 40
parallel_cutoff_hz = 20
decimate_to_hz = 50
[model]
terms = ["inertia", "viscous", "coulomb"]
[diagnose]
twins = 60
effects = ["torque_ripple", "transmission_error", "cogging", "periodic_disturbance"]
"""
RATE_HZ, SUBSTEPS = 250, 8
INERTIA, VISCOUS, COULOMB, STEP = 0.2, 0.9, 2.0, 2 * math.pi / 2**17
PUMP, PUMP_HZ = 0.7, 3.3


def recording(seed, seconds, phase):
    """Rows of time, commanded and measured position, torque of the drive."""
    draw = random.Random(seed)
    waves = [(draw.uniform(0.4, 1.0), draw.uniform(0.08, 0.8), draw.uniform(0, 2 * math.pi)) for _ in range(5)]

    def wanted(t):
        return (1 - math.exp(-2 * t)) * sum(0.6 * a * math.sin(2 * math.pi * f * t + p) for a, f, p in waves)

    position, speed, before, slow, held = wanted(0.0), 0.0, 0.0, 0.0, 0.0
    step, rows = 1.0 / RATE_HZ / SUBSTEPS, []
    for k in range(int(seconds * RATE_HZ)):
        t = k / RATE_HZ
        seen = STEP * round(position / STEP)
        slow += 0.4 * ((seen - before) * RATE_HZ - slow)
        before = seen
        held += (wanted(t) - seen) / RATE_HZ
        wanted_speed = (wanted(t + 1e-4) - wanted(t - 1e-4)) / 2e-4
        torque = 900 * (wanted(t) - seen) + 25 * (wanted_speed - slow) + 600 * held
        rows.append((t, wanted(t), seen, torque + draw.gauss(0.0, 0.04)))
        for i in range(SUBSTEPS):
            pump = PUMP * math.sin(2 * math.pi * PUMP_HZ * (t + i * step) + phase)
            friction = VISCOUS * speed + COULOMB * math.tanh(speed / 2e-3)
            speed += step * (torque - friction - pump) / INERTIA
            position += step * speed
    return rows


class Pump(unittest.TestCase):
    def test_a_pump_that_runs_in_both_recordings_is_named(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            for file, seed, seconds, phase in (("train", 1, 24, 0.3), ("other", 2, 16, 2.1)):
                lines = [",".join(f"{value:.9g}" for value in row) for row in recording(seed, seconds, phase)]
                (folder / f"{file}.csv").write_text("\n".join(["t_s,q_ref_rad,q_rad,tau_Nm", *lines, ""]))
            (folder / "job.toml").write_text(JOB)
            ended = subprocess.run([PROGRAM, "diagnose", "job.toml", "--json", "-", "--quiet"], cwd=folder,
                                   capture_output=True, text=True)
        self.assertEqual(ended.returncode, 0, ended.stderr)
        said = json.loads(ended.stdout)
        joint = said["joints"][0]
        self.assertEqual([effect["name"] for effect in joint["effects"]], ["periodic_disturbance"], said["reason"])
        frequency = next(one for one in joint["effects"][0]["parameters"] if one["name"] == "disturbance_frequency")
        self.assertAlmostEqual(frequency["value"], PUMP_HZ, delta=0.01)
        self.assertLess(joint["augmented"]["validation_relerr"], 0.3 * joint["baseline"]["validation_relerr"])


if __name__ == "__main__":
    unittest.main(verbosity=2)
