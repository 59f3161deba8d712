"""What the leading estimator leaves of the training torque: of the rows it was fitted to, or of every sample it
simulated."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Residual:
    """Arrays [n]. Samples of one stretch follow each other without a gap."""

    left: np.ndarray  # measured minus modelled
    velocity: np.ndarray | None  # None: not in the file
    stretch: np.ndarray
    step_s: float  # NaN: recordings have several rates
    words: str  # "what OLS leaves in training"
    is_simulated: bool


def of_training(study):
    """A Residual; None where the file has no simulated torque of an estimator that fits simulations, or it ran
    away."""
    e = study.lead
    if e.rolls_out:
        return _of_simulation(study, e)
    data = study.train
    return Residual(data.torque - data.prediction(e.chosen), np.asarray(data.velocity), np.asarray(data.recording),
                    1 / data.kept_rate_hz, f"what {e.short} leaves in training", False)


def _of_simulation(study, e):
    replay = study.replay
    if not replay or e.name not in replay.models:
        return None
    model = replay.models.index(e.name)
    recordings = [one for one in replay.recordings if not one.is_validation]
    if not recordings or any(not one.torque or not one.torque.has(model) or one.diverged[model] for one in recordings):
        return None
    left = [one.torque.difference(model) for one in recordings]
    # what the job leaves out was not simulated: a gap
    known = [np.isfinite(values) for values in left]
    stretch, last = [], 0
    for one in known:
        numbers = last + np.cumsum(np.diff(one, prepend=False) & one)
        stretch.append(numbers[one])
        last = int(numbers[-1])
    rates = {one.rate_hz for one in recordings}
    has_velocity = all(one.velocity for one in recordings)
    return Residual(
        np.concatenate([values[one] for values, one in zip(left, known)]),
        np.concatenate([of.velocity.measured[one] for of, one in zip(recordings, known)]) if has_velocity else None,
        np.concatenate(stretch), 1 / rates.pop() if len(rates) == 1 else np.nan,
        f"what {e.short}, simulated, leaves of all training samples", True)
