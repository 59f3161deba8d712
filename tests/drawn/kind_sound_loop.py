"""A sound recording of a joint in its loop, of good and bad tracking, with physics that the model lacks or without: a
torque that follows from reference and position is the torque of the joint. No finding speaks of the column."""

import numpy as np
from joint import draw_joint, write_csv, write_job
from kind_sound_physics import OF_THE_COLUMN
from loop import draw_model, follow

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}


def braking(rng, joint):
    """What else brakes, as a function of time, position and velocity, with its name."""
    part, speed, order, phase = rng.uniform(0.1, 0.6), rng.uniform(0.03, 0.3), rng.integers(4, 30), rng.uniform(0, 6)
    size = part * joint.coulomb
    laws = {"nothing": None, "stribeck": lambda _, q, v: 2 * size * np.tanh(v / 0.01) * np.exp(-abs(v) / speed),
            "cogging": lambda _, q, v: size * np.sin(order * q + phase), "spring": lambda _, q, v: 3 * size * q,
            "push": lambda t, q, v: size * np.sin(2 * np.pi * speed * t + phase)}
    name = str(rng.choice(list(laws)))
    return name, laws[name]


def draw(rng, folder):
    joint = draw_joint(rng, gravity=rng.random() < 0.4)
    name, extra = braking(rng, joint)
    feedforward, bandwidth = rng.choice([0.0, rng.uniform(0.3, 1.0)]), 10 ** rng.uniform(0.4, 1.3)
    followed = follow(rng, joint, draw_model(rng, joint), feedforward, bandwidth, 2 ** int(rng.integers(11, 20)),
                      noise=rng.choice([0.0, rng.uniform(0.002, 0.05)]), extra=extra)
    recording, late = followed.recording, int(rng.integers(4))
    if rng.random() < 0.3 and late:  # the position comes a few rows late
        recording.position = np.concatenate([np.repeat(recording.position[0], late), recording.position[:-late]])
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        check = call("check", "job.toml")
        wrong = check.topics() & (OF_THE_COLUMN | {"torque_computed"})
        case = f"{name}, feedforward {feedforward:.2g}, {bandwidth:.2g} Hz"
        return f"{case}: check says {wrong}: {check.text[-600:]}" if wrong or "lines" not in check.document else None

    return judge
