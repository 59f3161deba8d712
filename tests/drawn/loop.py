"""A simulated joint in its position loop, for recordings of commands that the motion does not quite follow.

A proportional-derivative controller with a share of a model's feedforward follows a sum of five sines; it sees an
encoder, and derives the speed from it. Ten steps of Euler's method a row. Shares no code with the engine.
Units: s, rad, rad/s, N m.
"""

import dataclasses

import numpy as np
from joint import Joint, Recording


@dataclasses.dataclass
class Followed:
    recording: Recording  # with the torque that moved the joint
    model: np.ndarray  # torque of the model for the commanded motion

    def tracking_error(self):
        error, position = self.recording.reference - self.recording.position, self.recording.position
        return error.std() / position.std()


def draw_model(rng, joint):
    """What a controller knows of the joint: masses wrong by a third, friction perhaps not at all."""
    friction = rng.uniform(0.5, 1.2) if rng.random() < 0.6 else 0.0
    mass = rng.uniform(0.65, 1.4)
    return Joint(inertia=joint.inertia * mass, viscous=joint.viscous * friction, coulomb=joint.coulomb * friction,
                 offset=0.0, gravity=joint.gravity * mass)


def follow(rng, joint, model, feedforward, bandwidth_hz, counts, seconds=25.0, rate=None, noise=0.0, extra=None):
    """`feedforward`: share of the model's torque that is applied; `extra(time, position, velocity)`: what else brakes;
    `noise`: of a torque sensor, as a share."""
    rate = rate or float(rng.choice([200, 250, 400, 500]))
    substeps = 10
    time = np.arange(int(seconds * rate)) / rate
    amplitudes, angular = rng.uniform(0.1, 0.4, 5), 2 * np.pi * rng.uniform(0.1, 1.2, 5)
    angles = np.outer(time, angular) + rng.uniform(0, 2 * np.pi, 5)
    reference, speed = np.sin(angles) @ amplitudes, np.cos(angles) @ (amplitudes * angular)
    of_model = model.torque(reference, speed, -np.sin(angles) @ (amplitudes * angular**2))
    frequency = 2 * np.pi * bandwidth_hz
    stiffness, damping = joint.inertia * frequency**2, 1.4 * joint.inertia * frequency
    count, smoothing = 2 * np.pi / counts, np.exp(-2 * np.pi * min(50.0, 0.2 * rate) / rate)
    shown, applied, true_speed = (np.empty(len(time)) for _ in range(3))
    q, dq, slow, step, derived = reference[0], speed[0], 0.005 * np.abs(speed).max(), 1 / (rate * substeps), speed[0]
    for k in range(len(time)):
        shown[k], true_speed[k] = round(q / count) * count, dq
        if k:
            derived = smoothing * derived + (1 - smoothing) * (shown[k] - shown[k - 1]) * rate
        torque = stiffness * (reference[k] - shown[k]) + damping * (speed[k] - derived) + feedforward * of_model[k]
        applied[k] = torque
        more = extra(time[k], q, dq) if extra else 0.0
        for _ in range(substeps):
            friction = joint.viscous * dq + joint.coulomb * np.tanh(dq / slow)
            dq += step * (torque - friction - joint.gravity * np.sin(q) - joint.offset - more) / joint.inertia
            q += step * dq
    applied = applied + noise * applied.std() * rng.standard_normal(len(time))
    return Followed(Recording(time, reference, shown, true_speed, applied, rate), of_model)
