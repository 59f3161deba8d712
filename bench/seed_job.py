"""The seed's job for benchmarks: one simulated joint, four parameters, 30 runs of DE with 30 members and 100
generations.

`make` writes the job file, runs it once, and writes regressor and torque out of its result for programs that search
only: n and R as uint64, the regressor by columns, the torque, all of them 8 bytes each.
"""

import pathlib
import subprocess
import sys

from measure import Run

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tests" / "jobs"))

import simulated_job  # noqa: E402

RUNS, MEMBERS, GENERATIONS = 30, 30, 100
RATE_HZ = 1000

# a way to the fitness: settings of the method, and of the output
FITNESS = {
    "direct": ({"fitness": "direct"}, {}),
    "gram": ({"fitness": "gram"}, {}),
    "float32": ({"fitness": "direct", "precision": "float32"}, {}),
    "lean": ({"fitness": "gram"}, {"samples": False}),
}


def job(n, runs, members, generations, fitness):
    method, output = FITNESS[fitness]
    return simulated_job.job(
        [{"name": "de", "population": members, "generations": generations, "F": 0.8, "CR": 0.9, **method}],
        replaced=("filter", "simulate.plant"),
        experiment={"name": "seed", "seed": 1, "runs": runs},
        filter={"edge_s": 0},
        model={"terms": ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]},
        simulate={"rate_hz": RATE_HZ, "duration_s": n / RATE_HZ},
        simulate__plant={"inertia": 0.0036, "viscous": 0.0164, "coulomb_positive": 0.0089, "coulomb_negative": -0.2582},
        simulate__reference={"kind": "multisine", "max_speed": 3.1},
        simulate__noise={"torque_std": 0.05},
        output=output)


class SeedJob:
    """The job at one n: a file per way to the fitness, and the data for programs that search only."""

    def __init__(self, program, folder, n, runs=RUNS, members=MEMBERS, generations=GENERATIONS):
        self.program, self.n = program, n
        self.folder = pathlib.Path(folder)
        for fitness in FITNESS:
            self.file(fitness).write_text(job(n, runs, members, generations, fitness))

    def file(self, fitness):
        return self.folder / f"seed_{self.n}_{fitness}.toml"

    def run(self, fitness, threads=1):
        """The whole program: simulates the recording, searches, stores everything."""
        result = self.folder / "result.h5"
        result.unlink(missing_ok=True)
        return Run([self.program, "run", self.file(fitness), "--out", result, "--threads", threads], threads)

    def write_data(self):
        """Regressor and torque as the program has them."""
        self.run("gram")
        path = self.folder / f"seed_{self.n}.bin"
        # by another process: what this one holds would count as peak memory of all that it starts
        subprocess.run([sys.executable, __file__, self.folder / "result.h5", path], check=True)
        return path


def export(result_file, data_file):
    import h5py
    import numpy as np

    with h5py.File(result_file, locking=False) as result, open(data_file, "wb") as file:
        regressor, torque = result["/data/train/regressor"][:], result["/data/train/torque"][:]
        np.array(regressor.shape, dtype=np.uint64).tofile(file)
        np.ascontiguousarray(regressor.T).tofile(file)
        torque.tofile(file)


if __name__ == "__main__":
    export(*sys.argv[1:])
