"""Makes the recording that all programs get, by fine steps of its own, and reads it.

    recording.py FILE [SECONDS]

Columns: t_s, q_ref_rad, q_rad (rounded by the encoder), tau_Nm (held from the sample on, with noise). The controller
reads the joint itself, not the encoder. A step is 20 us: Heun's method while the joint moves; a step that would reverse
the motion stops it, and it rests until the torque exceeds the dry friction.
"""
import csv
import dataclasses
import math
import random
import sys

import joint

STEPS_PER_TICK = 50


@dataclasses.dataclass
class Recording:
    reference: object  # arrays of one number a tick
    position: object
    torque: object

    def weighted(self, position, torque):
        """Residuals in units of the noise; last axis: ticks, of the torque and then of the position."""
        import numpy as np

        return np.concatenate([(torque - self.torque) / joint.TORQUE_NOISE_NM,
                               (position - self.position) / joint.POSITION_NOISE_RAD], axis=-1)


def read(path):
    import numpy as np

    _, reference, position, torque = np.loadtxt(path, delimiter=",", skiprows=1).T
    return Recording(*[np.ascontiguousarray(column) for column in (reference, position, torque)])


def moved(q, dq, u, step):
    """Position and velocity one fine step later."""
    inertia, viscous, coulomb, offset, gravity_sin, gravity_cos, _, _ = joint.TRUTH

    def drive(q, dq):  # all but dry friction
        return u - viscous * dq - offset - gravity_sin * math.sin(q) - gravity_cos * math.cos(q)

    if dq == 0.0:
        pushed = drive(q, 0.0)
        if abs(pushed) <= coulomb:
            return q, 0.0
        direction = math.copysign(1.0, pushed)
    else:
        direction = math.copysign(1.0, dq)
    first = (drive(q, dq) - coulomb * direction) / inertia
    ahead = dq + step * first
    second = (drive(q + step * dq, ahead) - coulomb * direction) / inertia
    after = dq + step * (first + second) / 2
    if after * direction <= 0.0:
        return q + step * dq / 2, 0.0
    return q + step * (dq + after) / 2, after


def samples(seconds):
    """Time, reference, position and torque at every tick, without noise."""
    kp, kd = joint.TRUTH[6:]
    step = joint.TICK_S / STEPS_PER_TICK
    q = dq = 0.0
    for k in range(round(seconds / joint.TICK_S)):
        t = k * joint.TICK_S
        r = round(joint.reference(t), 9)  # as the file has it
        u = min(max(kp * (r - q) - kd * dq, -joint.LIMIT_NM), joint.LIMIT_NM)
        yield t, r, q, u
        for _ in range(STEPS_PER_TICK):
            q, dq = moved(q, dq, u, step)


def write(path, seconds=joint.SECONDS, seed=1):
    noise = random.Random(seed)
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["t_s", "q_ref_rad", "q_rad", "tau_Nm"])
        for t, r, q, u in samples(seconds):
            seen = joint.ENCODER_STEP_RAD * round(q / joint.ENCODER_STEP_RAD)
            table.writerow([f"{t:.3f}", f"{r:.9f}", f"{seen:.9f}", f"{u + noise.gauss(0, joint.TORQUE_NOISE_NM):.9f}"])


if __name__ == "__main__":
    write(sys.argv[1], *map(float, sys.argv[2:3]))
