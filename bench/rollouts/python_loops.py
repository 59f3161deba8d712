"""The same joint stepped once a tick, in Python: one trial over floats, and many side by side in arrays of numpy.

A step is second order: viscous friction by the trapezoid, gravity at the middle of the tick. Dry friction is implicit:
what it could stop within the tick rests at the end of it. Position and torque are those at the start of every tick.
"""
import math

import numpy as np

from joint import LIMIT_NM, TICK_S


def one_trial(parameters, reference, start):
    """Position and torque, one number a tick. The fastest Python: floats, no arrays inside the loop."""
    inertia, viscous, coulomb, offset, gravity_sin, gravity_cos, kp, kd = map(float, parameters)
    keep, gain = inertia - TICK_S * viscous / 2, 1.0 / (inertia + TICK_S * viscous / 2)
    held, half, sin, cos = TICK_S * coulomb, TICK_S / 2, math.sin, math.cos
    q, dq = float(start), 0.0
    positions, torques = [], []
    for r in reference.tolist():
        u = kp * (r - q) - kd * dq
        if u > LIMIT_NM:
            u = LIMIT_NM
        elif u < -LIMIT_NM:
            u = -LIMIT_NM
        positions.append(q)
        torques.append(u)
        middle = q + half * dq
        push = keep * dq + TICK_S * (u - offset - gravity_sin * sin(middle) - gravity_cos * cos(middle))
        after = gain * (push - held) if push > held else gain * (push + held) if push < -held else 0.0
        q += half * (dq + after)
        dq = after
    return np.array(positions), np.array(torques)


def side_by_side(parameters, reference, start):
    """The same for many vectors of parameters: [trials][8] gives [trials][ticks] twice. No array is made in a tick."""
    inertia, viscous, coulomb, offset, gravity_sin, gravity_cos, kp, kd = np.ascontiguousarray(np.transpose(parameters))
    keep, gain = inertia - TICK_S * viscous / 2, 1.0 / (inertia + TICK_S * viscous / 2)
    # gravity as one sine: size sin(q + phase)
    size, phase = TICK_S * np.hypot(gravity_sin, gravity_cos), np.arctan2(gravity_cos, gravity_sin)
    held, half, offset = TICK_S * coulomb, TICK_S / 2, TICK_S * offset
    trials = len(inertia)
    q, dq, u, push, other = np.full(trials, float(start)), *np.zeros((4, trials))
    positions, torques = np.empty((2, len(reference), trials))
    add, subtract, multiply, sine = np.add, np.subtract, np.multiply, np.sin
    least, most = np.minimum, np.maximum
    for k, r in enumerate(reference.tolist()):
        positions[k] = q
        subtract(r, q, u)
        multiply(u, kp, u)
        multiply(kd, dq, other)
        subtract(u, other, u)
        least(u, LIMIT_NM, u)
        most(u, -LIMIT_NM, u)
        torques[k] = u
        multiply(dq, half, other)
        add(q, other, q)  # the middle of the tick
        add(q, phase, other)
        sine(other, other)
        multiply(other, size, other)
        multiply(u, TICK_S, push)
        subtract(push, other, push)
        subtract(push, offset, push)
        multiply(keep, dq, other)
        add(push, other, push)
        # less what dry friction can take: push - clip(push, -held, held)
        least(push, held, other)
        most(other, -held, other)
        subtract(push, other, push)
        multiply(push, gain, dq)
        multiply(dq, half, other)
        add(q, other, q)
    return np.ascontiguousarray(positions.T), np.ascontiguousarray(torques.T)
