"""pagmo2's differential evolution by its Python package, the fitness in numpy: python3 pygmo_de.py FILE RUNS

Prints the CPU seconds of the searches alone, and the median of the MSE they found, as bench_peers does.
"""
import json
import sys
import time

import numpy as np
import pygmo

from scipy_de import GENERATIONS, MEMBERS, read_problem

RAND_1_BIN = 7


class Fitness:
    def __init__(self, phi, tau):
        self.phi, self.tau = phi, tau

    def fitness(self, parameters):
        left = self.phi @ parameters - self.tau
        return [left @ left / left.size]

    def get_bounds(self):
        return [-1.0] * self.phi.shape[1], [1.0] * self.phi.shape[1]


def search(phi, tau, seed):
    start = pygmo.population(pygmo.problem(Fitness(phi, tau)), MEMBERS, seed=seed)
    de = pygmo.algorithm(pygmo.de(GENERATIONS, 0.8, 0.9, RAND_1_BIN, 0.0, 0.0, seed=seed))
    return de.evolve(start).champion_f[0]


def main(path, runs):
    phi, tau = read_problem(path)
    start = time.process_time()
    found = [float(search(phi, tau, seed)) for seed in range(1, runs + 1)]
    print(json.dumps({"search_s": time.process_time() - start, "mse": float(np.median(found))}))


main(sys.argv[1], int(sys.argv[2]))
