"""What the peers share: a fit of all parameters by scipy, and a trace of the errors it has seen and when."""
import json
import time

import numpy as np
from scipy import optimize

from joint import NAMES

STEP = 1e-6  # of a parameter, for differences


class Trace:
    """CPU seconds since the start, rms torque and rms position of every trial that was evaluated."""

    def __init__(self, recording):
        self.recording, self.entries, self.start = recording, [], time.process_time()

    def saw(self, position, torque):
        now = time.process_time() - self.start
        rms = [float(np.sqrt(np.mean(np.square(error))))
               for error in (torque - self.recording.torque, position - self.recording.position)]
        self.entries.append([now, *rms])


def neighbours(x):
    """Each parameter moved by a little, one after the other, and by how much."""
    steps = STEP * np.maximum(np.abs(x), 1e-3)
    return x + np.diag(steps), steps


def by_least_squares(simulate, trace, start, together):
    """scipy's least_squares over simulate([trials][8]) -> positions and torques, [trials][ticks] each.

    `together`: the columns of the Jacobian are simulated beside the trial itself, for a simulator whose trials cost
    next to nothing side by side."""
    recording, kept = trace.recording, {}

    def differences(base, columns, steps):
        return ((columns - base) / steps[:, None]).T

    def residuals(x):
        others, steps = neighbours(x)
        positions, torques = simulate(np.vstack([x, others]) if together else x[None, :])
        trace.saw(positions[0], torques[0])
        rows = recording.weighted(positions, torques)
        kept.update(x=x.copy(), rows=rows[0], jacobian=differences(rows[0], rows[1:], steps) if together else None)
        return rows[0]

    def jacobian(x):
        if not np.array_equal(x, kept["x"]):
            residuals(x)
        if not together:
            others, steps = neighbours(x)
            kept["jacobian"] = differences(kept["rows"], recording.weighted(*simulate(others)), steps)
        return kept["jacobian"]

    return optimize.least_squares(residuals, start, jac=jacobian, x_scale="jac", max_nfev=30).x


def rate(simulate, trials, ticks, rounds=3):
    """Joint steps a CPU second: the best of some rounds of simulate()."""
    seconds = []
    for _ in range(rounds):
        start = time.process_time()
        simulate()
        seconds.append(time.process_time() - start)
    return trials * ticks / min(seconds)


def report(who, steps_per_second, trace=None, found=None):
    """One line for compare.py."""
    print(json.dumps({"who": who, "steps_per_second": steps_per_second, "trace": trace.entries if trace else [],
                      "found": {} if found is None else dict(zip(NAMES, map(float, found)))}), flush=True)
