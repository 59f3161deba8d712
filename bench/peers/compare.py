"""Our program against pagmo2, NLopt, OpenBLAS, Eigen and scipy on the seed's job, in turns; one table per n.

    python3 bench/peers/compare.py build/bench [--n 10000 100000 1000000] [--rounds 5]

Every program runs once per round, one after the other, so that a busy neighbour hits all; the median over the rounds
counts. A peer's seconds are those of its searches, without reading its data; ours twice: the searches likewise, and the
whole process that simulates the recording, searches and stores every generation. Long peers do fewer of the 30 runs
(said in the column "runs"; the runs of a job are equal work) and are scaled to 30.
"""

import argparse
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from measure import Run, median_of, print_table  # noqa: E402
from seed_job import GENERATIONS, MEMBERS, RUNS, SeedJob  # noqa: E402

SCIPY = pathlib.Path(__file__).parent / "scipy_de.py"
COMPILED = ("pagmo_de", "nlopt_crs2", "openblas_de", "eigen_de", "textbook_de")
OURS = ("in_time", "direct", "float32", "gram")
WHOLE = ("direct", "float32", "gram", "lean")
REFERENCES = ("pagmo_de", "openblas_de", "eigen_de", "scipy_de")


def runs_of(peer, n):
    """of 30: some seconds a round"""
    if n <= 10_000:
        return 5 if peer == "scipy_de" else RUNS
    if n <= 100_000:
        return 1 if peer == "scipy_de" else 5
    return 1


def programs(build, job, data):
    """name -> (runs, function that runs it once, function from a Run to its seconds)"""
    searched = lambda run: run.printed["search_s"]  # noqa: E731
    for peer in COMPILED:
        runs = runs_of(peer, job.n)
        yield peer, runs, lambda peer=peer, runs=runs: Run(
            [build / "bench/peers/bench_peers", peer, data, runs]
        ), searched
    runs = runs_of("scipy_de", job.n)
    yield "scipy_de", runs, lambda runs=runs: Run([sys.executable, SCIPY, data, runs]), searched
    for fitness in OURS:
        # packing and statistics belong to the search, once for all runs, so these are never scaled
        command = [build / "bench/runs/bench_seed_search", data, fitness, RUNS, MEMBERS, GENERATIONS, 1]
        yield (f"ours, {fitness}", RUNS, lambda command=command: Run(command),
               lambda run: run.printed["search_s"] + run.printed["setup_s"])
    for fitness in WHOLE:
        yield f"ours, {fitness}, whole process", RUNS, lambda fitness=fitness: job.run(fitness), lambda run: run.cpu_s


def compare(build, folder, n, rounds):
    job = SeedJob(build / "bin/torquescope", folder, n)
    entries = list(programs(build, job, job.write_data()))
    done = {name: [] for name, *_ in entries}
    for _ in range(rounds):
        for name, _, run, _ in entries:
            done[name].append(run())
    seconds = {name: median_of(done[name], of) * RUNS / runs for name, runs, _, of in entries}
    rows = []
    for name, runs, _, _ in entries:
        mse = done[name][0].printed.get("mse")
        rows.append([name, runs, f"{seconds[name]:.4f}", f"{median_of(done[name], lambda run: run.peak_mb):.0f}",
                     f"{mse:.7g}" if mse else "", *[f"{seconds[peer] / seconds[name]:.2f}" for peer in REFERENCES]])
    print(
        f"\nn = {n}: {RUNS} runs of {MEMBERS} members and {GENERATIONS} generations, R = 4, one thread, CPU, median "
        f"of {rounds}"
    )
    print_table(
        ["program", "runs", "CPU s for 30", "peak MB", "median MSE", *[f"{peer} /" for peer in REFERENCES]], rows
    )


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--n", type=int, nargs="+", default=[10_000, 100_000, 1_000_000])
    parser.add_argument("--rounds", type=int, default=5)
    wanted = parser.parse_args()
    for n in wanted.n:
        with tempfile.TemporaryDirectory() as folder:
            compare(wanted.build.resolve(), folder, n, wanted.rounds)


if __name__ == "__main__":
    main()
