"""A simulated joint of drawn size under position control, for recordings with a drawn mistake in them.

The motion is a closed form (five sines), so no integration errs: torque = inertia * acceleration + viscous * velocity
+ coulomb * sign(velocity) + offset, with noise, and the position is rounded as an encoder does. The reference is the
one with which a proportional-derivative controller asks for just this torque. Shares no code with the engine.
Units: s, rad, rad/s, N m.
"""

import dataclasses
import pathlib

import numpy as np


@dataclasses.dataclass(frozen=True)
class Joint:
    inertia: float
    viscous: float
    coulomb: float
    offset: float
    gravity: float = 0.0  # torque of the weight at position pi/2, N m

    def torque(self, position, velocity, acceleration):
        return (self.inertia * acceleration + self.viscous * velocity + self.coulomb * np.sign(velocity)
                + self.gravity * np.sin(position) + self.offset)


@dataclasses.dataclass
class Recording:
    """All arrays have one element a sample; `velocity` is the true one, `position` what the encoder shows."""

    time: np.ndarray
    reference: np.ndarray
    position: np.ndarray
    velocity: np.ndarray
    torque: np.ndarray
    rate: float

    def columns(self):
        return {"time": self.time, "reference": self.reference, "position": self.position, "torque": self.torque}


def draw_joint(rng, gravity=False):
    """A joint whose parts all take a visible share of the torque."""
    scale = 10 ** rng.uniform(-1, 1)
    return Joint(
        inertia=0.1 * scale * rng.uniform(0.5, 2), viscous=0.3 * scale * rng.uniform(0.5, 2),
        coulomb=0.5 * scale * rng.uniform(0.5, 2), offset=0.1 * scale * rng.uniform(-1, 1),
        gravity=scale * rng.uniform(0.5, 2) if gravity else 0.0,
    )


def record(rng, joint, seconds=30.0, rate=None, start=0.0, noise=0.01, counts=None):
    """`noise` is a share of the torque's standard deviation, `counts` the encoder's steps a turn."""
    rate = rate or float(rng.choice([200, 250, 400, 500, 1000]))
    counts = counts or 2 ** int(rng.integers(15, 19))
    time = np.arange(int(seconds * rate)) / rate
    amplitudes = rng.uniform(0.1, 0.4, 5)
    angular = 2 * np.pi * rng.uniform(0.1, 1.2, 5)
    phases = rng.uniform(0, 2 * np.pi, 5)
    angles = np.outer(time, angular) + phases
    position = np.sin(angles) @ amplitudes
    velocity = np.cos(angles) @ (amplitudes * angular)
    acceleration = -np.sin(angles) @ (amplitudes * angular**2)
    ideal = joint.torque(position, velocity, acceleration)
    torque = ideal + noise * ideal.std() * rng.standard_normal(len(time))
    stiffness = ideal.std() / 0.02
    reference = position + (ideal + 0.05 * stiffness * velocity) / stiffness
    step = 2 * np.pi / counts
    return Recording(start + time, reference, np.round(position / step) * step, velocity, torque, rate)


def simulate(rng, joint, sides, beyond, seconds=30.0, noise=0.003):
    """A joint under a drive that gives no more than a limit: (recording of the torque asked for, upper, lower limit).

    A proportional-derivative controller follows a sum of five sines; `sides` is "both" (one limit of both signs),
    "two", "upper" or "lower", `beyond` the share of rows that would ask for more without a limit.
    Ten steps of Euler's method a row, with a sign of the velocity that is smooth within a hundredth of its largest.
    """
    rate = float(rng.choice([200, 250, 400, 500]))
    substeps = 10
    time = np.arange(int(seconds * rate)) / rate
    amplitudes, angular = rng.uniform(0.1, 0.4, 5), 2 * np.pi * rng.uniform(0.1, 1.2, 5)
    phases = rng.uniform(0, 2 * np.pi, 5)
    angles = np.outer(time, angular) + phases
    reference, speed = np.sin(angles) @ amplitudes, np.cos(angles) @ (amplitudes * angular)
    ideal = joint.torque(reference, speed, -np.sin(angles) @ (amplitudes * angular**2))
    frequency = 2 * np.pi * rng.uniform(4, 7)  # of the loop, rad/s
    stiffness, damping = joint.inertia * frequency**2, 1.4 * joint.inertia * frequency
    high, low = np.quantile(ideal, [1 - beyond / (2 if sides in ("both", "two") else 1),
                                    beyond / (2 if sides in ("both", "two") else 1)])
    if sides == "both":
        high = np.quantile(np.abs(ideal), 1 - beyond)
        low = -high
    upper, lower = (high if sides != "lower" else None), (low if sides != "upper" else None)
    position, velocity = np.empty(len(time)), np.empty(len(time))
    asked = np.empty(len(time))
    q, dq, slow, step = reference[0], speed[0], 0.01 * np.abs(speed).max(), 1 / (rate * substeps)
    for k in range(len(time)):
        position[k], velocity[k] = q, dq
        asked[k] = stiffness * (reference[k] - q) + damping * (speed[k] - dq)
        given = min(asked[k], np.inf if upper is None else upper)
        given = max(given, -np.inf if lower is None else lower)
        for _ in range(substeps):
            friction = joint.viscous * dq + joint.coulomb * np.tanh(dq / slow)
            dq += step * (given - friction - joint.gravity * np.sin(q) - joint.offset) / joint.inertia
            q += step * dq
    resolution = 2 * np.pi / 2**18
    asked += noise * asked.std() * rng.standard_normal(len(time))
    shown = np.round(position / resolution) * resolution
    return Recording(time, reference, shown, velocity, asked, rate), upper, lower


def write_csv(path, columns, form="%.9g"):
    """Columns are lists or arrays of equal length, by name; text columns are written as they are."""
    names = list(columns)
    texts = [[one if isinstance(one, str) else form % one for one in columns[name]] for name in names]
    lines = [",".join(names), *(",".join(row) for row in zip(*texts))]
    pathlib.Path(path).write_text("\n".join(lines) + "\n")


def write_job(folder, train, columns, validate=None, more=""):
    """A job of one joint: inertia, viscous and Coulomb friction and an offset by least squares. Columns by role."""
    roles = ", ".join(f'{role} = "{name}"' for role, name in columns.items())
    seen = f'validate = "{validate}"\n' if validate else ""
    text = f'''[recording]
train = "{train}"
{seen}columns = {{{roles}}}

[filter]
cutoff_hz = 20
parallel_cutoff_hz = 10
decimate_to_hz = 50

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb", "offset"]

[[estimator]]
name = "ols"
{more}'''
    path = pathlib.Path(folder) / "job.toml"
    path.write_text(text)
    return path
