"""One CMA-ES of the package `cma` over the logarithms of a model's parameters, until it ends or its seconds do."""
import dataclasses
import time

import numpy as np

import friction_models
import servo_simulation

CROWD = 256  # parameter sets side by side, to see what numpy can do at most


@dataclasses.dataclass
class Search:
    model: str
    unit: np.ndarray  # the best, in the unit cube
    seconds: float
    fits: int
    end: str

    def numbers(self):
        return {name: float(value[0, 0]) for name, value in
                friction_models.parameters(self.model, self.unit[None]).items()}


def search(model, ticks, seconds, members, seed):
    """CPU seconds; every member is simulated on all records. Raises ImportError without `cma`."""
    import cma

    size = len(friction_models.MODELS[model])
    strategy = cma.CMAEvolutionStrategy(size * [0.5], 0.25, {
        "bounds": [0, 1], "popsize": members, "seed": seed, "verbose": -9, "tolfun": 1e-7, "tolx": 1e-5})
    start, fits = time.process_time(), 0
    while not strategy.stop() and time.process_time() - start < seconds:
        asked = strategy.ask()
        mean_errors, _ = servo_simulation.errors(model, np.array(asked), ticks)
        strategy.tell(asked, np.where(np.isfinite(mean_errors), mean_errors, 1e3))
        fits += members
    end = ", ".join(strategy.stop()) or "not finished"
    return Search(model, np.array(strategy.result.xbest), time.process_time() - start, fits, end)


def crowd_rate(found, ticks):
    """Fits a CPU second of CROWD parameter sets around the found one, the best of three turns."""
    around = found.unit + np.random.default_rng(1).normal(0.0, 0.01, (CROWD, len(found.unit)))
    turns = []
    for _ in range(3):
        start = time.process_time()
        servo_simulation.errors(found.model, np.clip(around, 0.0, 1.0), ticks)
        turns.append(time.process_time() - start)
    return CROWD / min(turns)
