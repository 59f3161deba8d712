"""CMA-ES of the package `cma` over the logarithms of a model's parameters, from two starts, for some seconds.

The first start is where a model that this one contains has ended, with the rest of the parameters small: without it,
searches of many parameters ended above smaller models. The second, or the only one, is the middle of the box.
"""
import dataclasses
import time

import numpy as np

import friction_models
import servo_simulation

CROWD = 256  # parameter sets side by side, to see what numpy can do at most
SMALL = 0.2  # of the unit cube


@dataclasses.dataclass
class Search:
    model: str
    unit: np.ndarray  # the best, in the unit cube
    error: float = np.inf
    seconds: float = 0.0
    fits: int = 0
    ends: list = dataclasses.field(default_factory=list)  # of each start

    def numbers(self):
        return {name: float(value[0, 0]) for name, value in
                friction_models.parameters(self.model, self.unit[None]).items()}


def within(smaller, model):
    """Where a smaller model's best lies in the unit cube of this one."""
    known = dict(zip(friction_models.MODELS[smaller.model], smaller.unit))
    for one, both in (("kl", ("klm", "kle")), ("ks", ("ksm", "kse"))):
        known |= dict.fromkeys(both, known[one]) if one in known else {}
    return np.array([known.get(name, SMALL) for name in friction_models.MODELS[model]])


def climb(found, ticks, start, sigma, until, members, seed):
    """One CMA-ES; what it finds goes into `found`."""
    import cma

    strategy = cma.CMAEvolutionStrategy(start, sigma, {
        "bounds": [0, 1], "popsize": members, "seed": seed, "verbose": -9, "tolfun": 1e-6, "tolx": 1e-4})
    while not strategy.stop() and time.process_time() < until:
        asked = strategy.ask()
        mean_errors, _ = servo_simulation.errors(found.model, np.array(asked), ticks)
        mean_errors = np.where(np.isfinite(mean_errors), mean_errors, 1e3)
        strategy.tell(asked, mean_errors)
        found.fits += members
        if mean_errors.min() < found.error:
            found.error, found.unit = mean_errors.min(), np.array(asked[mean_errors.argmin()])
    found.ends.append(", ".join(strategy.stop()) or "not finished")


def search(model, ticks, seconds, members, seed, finished=()):
    """CPU seconds at most; `finished`: searches of other models. Raises ImportError without `cma`."""
    import cma  # noqa: F401

    middle, found = np.full(len(friction_models.MODELS[model]), 0.5), Search(model, None)
    contained = [one for one in finished if friction_models.contains(model, one.model)]
    starts = [(middle, 0.25)]
    if contained:
        starts.insert(0, (within(min(contained, key=lambda one: one.error), model), 0.1))
    begin = time.process_time()
    for count, (start, sigma) in enumerate(starts, 1):
        climb(found, ticks, start, sigma, begin + seconds * count / len(starts), members, seed)
    found.seconds = time.process_time() - begin
    return found


def crowd_rate(found, ticks):
    """Fits a CPU second of CROWD parameter sets around the found one, the best of three turns."""
    around = found.unit + np.random.default_rng(1).normal(0.0, 0.01, (CROWD, len(found.unit)))
    turns = []
    for _ in range(3):
        start = time.process_time()
        servo_simulation.errors(found.model, np.clip(around, 0.0, 1.0), ticks)
        turns.append(time.process_time() - start)
    return CROWD / min(turns)
