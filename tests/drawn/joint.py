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
