"""A sound recording of a joint with physics that the model lacks: no finding speaks of the torque column."""

import dataclasses

import numpy as np
from joint import Joint, draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
OF_THE_COLUMN = {"command_beyond_limit", "torque_zero_steps", "torque_zero_drifts", "reference_constant"}
LAWS = ["stribeck", "load", "cogging", "thermal", "friction_steps", "gravity", "spring", "drag", "asymmetric",
        "payload", "saturating_motor", "wander", "hysteresis", "push"]


def extra_torque(rng, law, joint, time, position, velocity, acceleration):
    """What the model lacks; sizes of a twentieth to half of the dry friction or of the torque."""
    friction, part, share = joint.coulomb, rng.uniform(0.05, 0.5), time / time[-1]
    sign, after = np.sign(velocity), time >= rng.uniform(0.2, 0.8) * time[-1]
    torque = joint.torque(position, velocity, acceleration)
    if law == "stribeck":
        return 2 * part * friction * sign * np.exp(-np.abs(velocity) / rng.uniform(0.03, 0.3))
    if law == "load":
        return 0.5 * part * np.abs(torque) * sign
    if law == "cogging":
        return part * friction * np.sin(rng.integers(4, 40) * position + rng.uniform(0, 6))
    if law == "thermal":
        return part * (friction * sign + joint.viscous * velocity) * np.exp(-share / rng.uniform(0.1, 1))
    if law == "friction_steps":
        return part * friction * sign * after
    if law == "gravity":
        return rng.uniform(0.2, 3) * friction * np.sin(position + rng.uniform(-3, 3))
    if law == "spring":
        return rng.uniform(0.2, 3) * friction * position
    if law == "drag":
        return part * joint.viscous * velocity * np.abs(velocity)
    if law == "asymmetric":
        return part * (friction + joint.viscous * velocity) * (velocity > 0)
    if law == "payload":
        return after * (part * joint.inertia * acceleration + friction * np.sin(position + rng.uniform(-0.3, 0.3)))
    if law == "saturating_motor":  # the torque constant falls as the current rises: 5 to 25 % at the largest
        largest = np.abs(torque).max()
        return 0.5 * part * torque * (torque / largest) ** 2
    if law == "wander":
        return part * friction * sign * np.cumsum(rng.standard_normal(len(time))) / np.sqrt(len(time))
    if law == "hysteresis":
        return part * friction * hysteresis(position, rng.uniform(0.02, 0.2))
    return rng.uniform(0.3, 2) * friction * bump(time, rng.uniform(0.1, 0.8) * time[-1], rng.uniform(0.5, 3))


def bump(time, start, width):
    phase = (time - start) / width
    return np.where((phase > 0) & (phase < 1), np.sin(np.pi * phase) ** 2, 0)


def hysteresis(position, way):
    """From -1 to 1, and the way back the same (a Dahl model of first order)."""
    state, out = 0.0, np.empty(len(position))
    for k, step in enumerate(np.diff(position, prepend=position[0])):
        state += step / way - abs(step) / way * state
        out[k] = state
    return out


def draw(rng, folder):
    joint = draw_joint(rng)
    law = str(rng.choice(LAWS))
    rate = float(rng.choice([200, 250, 400, 500]))

    @dataclasses.dataclass(frozen=True)
    class Rich(Joint):
        def torque(self, position, velocity, acceleration):
            time = np.arange(len(position)) / rate
            return super().torque(position, velocity, acceleration) + extra_torque(
                rng, law, joint, time, position, velocity, acceleration)

    recording = record(rng, Rich(**dataclasses.asdict(joint)), seconds=rng.uniform(20, 50), rate=rate,
                       noise=rng.uniform(0.002, 0.03))
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        check = call("check", "job.toml")
        wrong = check.topics() & OF_THE_COLUMN
        return f"{law}: check says {wrong}: {check.text[-600:]}" if wrong else None

    return judge
