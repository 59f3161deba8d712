"""scipy's differential evolution, vectorised over the population: python3 scipy_de.py FILE RUNS

Prints the CPU seconds of the searches alone, and the median of the MSE they found, as bench_peers does.
"""
import json
import sys
import time

import numpy as np
from scipy.optimize import differential_evolution

MEMBERS, GENERATIONS = 30, 100


def read_problem(path):
    n, columns = np.fromfile(path, dtype=np.uint64, count=2)
    numbers = np.fromfile(path, dtype=np.float64, offset=16)
    phi = numbers[: n * columns].reshape(int(columns), int(n)).T
    return phi, numbers[n * columns :]


def search(phi, tau, seed):
    def mse(members):
        residuals = phi @ members - tau[:, None]
        return np.einsum("ij,ij->j", residuals, residuals) / tau.size

    start = np.random.default_rng(seed).uniform(-1, 1, (MEMBERS, phi.shape[1]))
    # tol = atol = 0: as many evaluations as everybody else
    return differential_evolution(mse, [(-1, 1)] * phi.shape[1], strategy="rand1bin", maxiter=GENERATIONS, init=start,
                                  mutation=0.8, recombination=0.9, tol=0, atol=0, polish=False, seed=seed,
                                  updating="deferred", vectorized=True).fun


def main(path, runs):
    phi, tau = read_problem(path)
    start = time.process_time()
    found = [float(search(phi, tau, seed)) for seed in range(1, runs + 1)]
    print(json.dumps({"search_s": time.process_time() - start, "mse": float(np.median(found))}))


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]))
