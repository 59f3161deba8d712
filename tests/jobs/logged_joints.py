"""Joints as their drives log them: shaken by a pump, loaded on the way, and one whose log is slower than its loop.

The plant stands here and shares nothing with the engine: a rigid joint with friction, led by a controller with an
encoder, that a torque of fixed frequency may act on, and that may pick up a load. Effects of the motion each explain a
little of a pump, whose phase is another one in each recording. A load is picked up at another time in each. A row of a
slow log holds the torque of its instant, which is half a row late.
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
name = "logged"
[recording]
train = "train.csv"
validate = "other.csv"
columns = {time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "tau_Nm"}
[filter]
cutoff_hz = {cutoff}
parallel_cutoff_hz = {parallel}
decimate_to_hz = 50
[model]
terms = ["inertia", "viscous", "coulomb"]
[diagnose]
twins = 60
effects = {effects}
"""
SUBSTEPS = 8
VISCOUS, COULOMB, STEP = 0.9, 2.0, 2 * math.pi / 2**17
PUMP_HZ = 3.3
WEIGHT, CARRIED = 1.6, 0.06  # N m, kg m2: of the load


def recording(seed, seconds, pump=0.0, phase=0.0, picked_up_s=math.inf, rate_hz=250, log_every=1, inertia=0.2,
              noise=0.04, fastest=0.8):
    """Rows of time, commanded and measured position, torque of the drive."""
    draw = random.Random(seed)
    waves = [(draw.uniform(0.4, 1.0), draw.uniform(0.08, fastest), draw.uniform(0, 2 * math.pi)) for _ in range(5)]

    def wanted(t):
        return (1 - math.exp(-2 * t)) * sum(0.6 * a * math.sin(2 * math.pi * f * t + p) for a, f, p in waves)

    position, speed, before, slow, held = wanted(0.0), 0.0, 0.0, 0.0, 0.0
    step, rows = 1.0 / rate_hz / SUBSTEPS, []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        seen = STEP * round(position / STEP)
        slow += 0.4 * ((seen - before) * rate_hz - slow)
        before = seen
        held += (wanted(t) - seen) / rate_hz
        wanted_speed = (wanted(t + 1e-4) - wanted(t - 1e-4)) / 2e-4
        torque = 900 * (wanted(t) - seen) + 25 * (wanted_speed - slow) + 600 * held
        if k % log_every == 0:
            rows.append((t, wanted(t), seen, torque + draw.gauss(0.0, noise)))
        for i in range(SUBSTEPS):
            shaken = pump * math.sin(2 * math.pi * PUMP_HZ * (t + i * step) + phase)
            friction = VISCOUS * speed + COULOMB * math.tanh(speed / 2e-3)
            load = t + i * step >= picked_up_s
            weight = WEIGHT * math.sin(position) if load else 0.0
            speed += step * (torque - friction - shaken - weight) / (inertia + CARRIED * load)
            position += step * speed
    return rows


def said_of(train, other, **job):
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        for file, rows in (("train", train), ("other", other)):
            lines = [",".join(f"{value:.9g}" for value in row) for row in rows]
            (folder / f"{file}.csv").write_text("\n".join(["t_s,q_ref_rad,q_rad,tau_Nm", *lines, ""]))
        text = JOB
        for key, value in job.items():
            text = text.replace(f"{{{key}}}", str(value))
        (folder / "job.toml").write_text(text)
        ended = subprocess.run([PROGRAM, "diagnose", "job.toml", "--json", "-", "--quiet"], cwd=folder,
                               capture_output=True, text=True)
    assert ended.returncode == 0, ended.stderr
    return json.loads(ended.stdout)


class LoggedJoints(unittest.TestCase):
    def test_a_pump_that_runs_in_both_recordings_is_named(self):
        laws = '["torque_ripple", "transmission_error", "cogging", "periodic_disturbance"]'
        said = said_of(recording(1, 24, pump=0.7, phase=0.3), recording(2, 16, pump=0.7, phase=2.1), cutoff=40,
                       parallel=20, effects=laws)
        joint = said["joints"][0]
        self.assertEqual([effect["name"] for effect in joint["effects"]], ["periodic_disturbance"], said["reason"])
        frequency = next(one for one in joint["effects"][0]["parameters"] if one["name"] == "disturbance_frequency")
        self.assertAlmostEqual(frequency["value"], PUMP_HZ, delta=0.01)
        self.assertLess(joint["augmented"]["validation_relerr"], 0.3 * joint["baseline"]["validation_relerr"])

    def test_a_load_that_is_picked_up_in_both_recordings_is_named(self):
        laws = '["payload_change", "thermal_friction", "sensor_drift", "contact"]'
        said = said_of(recording(5, 24, picked_up_s=9.0), recording(6, 16, picked_up_s=4.2), cutoff=20, parallel=10,
                       effects=laws)
        joint = said["joints"][0]
        self.assertEqual([effect["name"] for effect in joint["effects"]], ["payload_change"], said["reason"])
        sizes = {one["name"]: one["value"] for one in joint["effects"][0]["parameters"]}
        self.assertAlmostEqual(sizes["payload_gravity_sin"], WEIGHT, delta=0.1 * WEIGHT)
        self.assertAlmostEqual(sizes["payload_time"], 9.0, delta=0.3)
        self.assertLess(joint["augmented"]["validation_relerr"], 0.3 * joint["baseline"]["validation_relerr"])

    def test_a_sound_joint_with_a_log_slower_than_its_loop_lacks_nothing(self):
        slow = {"rate_hz": 1000, "log_every": 10, "inertia": 0.8, "noise": 0.01, "fastest": 2.0}
        said = said_of(recording(3, 24, **slow), recording(4, 16, **slow), cutoff=20, parallel=10,
                       effects='["backlash", "friction_lag", "delay"]')
        self.assertEqual(said["verdict"], "none", said["reason"])
        self.assertRegex(said["reason"], r"The torque comes [45]\.\d* ms after its rows")


if __name__ == "__main__":
    unittest.main(verbosity=2)
