"""All records under all parameter sets of a population at once, tick by tick: arrays of (members, records).

    te = -m g l sin q,  tm = kt / R (V - kt dq) while the drive is on,  V = clip(0.165 kp (goal - q) vin, +-0.97 vin)
    (m l^2 + armature) ddq = tm + te - viscous dq - friction

Semi-implicit Euler. Dry friction takes off what it can of the speed: at rest it holds while |tm + te| <= F, in motion
it opposes with F, and where the speed would change its sign the joint stops.
"""
import numpy as np

from friction_models import Friction, parameters

CHUNK = 256  # ticks of which positions are kept, until samples are read from them


class Errors:
    """Sums of |simulated - measured| and of its square, of each member, read chunk by chunk."""

    def __init__(self, ticks, members):
        self.ticks, self.absolute, self.squares = ticks, np.zeros(members), np.zeros(members)
        self.order = np.argsort(ticks.sample_tick, kind="stable")
        self.sorted_ticks = ticks.sample_tick[self.order]

    def read(self, history, first, until):
        here = self.order[slice(*np.searchsorted(self.sorted_ticks, (first, until)))]
        tick, record = self.ticks.sample_tick[here] - first, self.ticks.sample_record[here]
        error = history[tick, :, record] - self.ticks.measured[here, None]
        self.absolute += np.abs(error).sum(axis=0)
        self.squares += (error * error).sum(axis=0)


def errors(model, unit, ticks):
    """Mean absolute error and rms of each member over all samples of all records, rad; not finite: diverged."""
    p = parameters(model, unit)
    shape = (len(unit), len(ticks.start))
    q, dq = np.tile(ticks.start, (shape[0], 1)), np.zeros(shape)
    tm, te, free, loss, least = np.empty((5, *shape))
    friction, seen = Friction(p, shape), Errors(ticks, shape[0])
    history = np.empty((CHUNK, *shape))
    torque_per_volt = p["kt"] / p["resistance"]
    brake = torque_per_volt * p["kt"]
    step_per_inertia = ticks.step_s / (ticks.inertia + p["armature"])
    damping = p["viscous"]
    always_on = ticks.enabled.all(axis=1)
    with np.errstate(all="ignore"):
        for tick in range(ticks.count):
            row = tick % CHUNK
            history[row] = q
            if row == CHUNK - 1 or tick == ticks.count - 1:
                seen.read(history, tick - row, tick + 1)
            np.subtract(ticks.goal[tick], q, out=tm)
            tm *= ticks.volts_per_rad
            np.minimum(tm, ticks.most_volts, out=tm)
            np.maximum(tm, -ticks.most_volts, out=tm)
            tm *= torque_per_volt
            tm -= np.multiply(dq, brake, out=free)
            if not always_on[tick]:
                tm *= ticks.enabled[tick]
            np.sin(q, out=te)
            te *= -ticks.weight
            np.multiply(friction(dq, tm, te), step_per_inertia, out=loss)
            np.add(tm, te, out=free)
            free -= np.multiply(dq, damping, out=te)
            free *= step_per_inertia
            free += dq
            np.minimum(free, loss, out=least)
            np.maximum(least, np.negative(loss, out=loss), out=least)
            free -= least
            dq *= free  # negative where the speed would change its sign
            np.multiply(free, dq >= 0.0, out=dq)
            q += np.multiply(dq, ticks.step_s, out=least)
    samples = len(ticks.measured)
    return seen.absolute / samples, np.sqrt(seen.squares / samples)
