"""The seed's job beside optimisers and products of others: 30 runs of 30 members, 100 generations, R = 4, one thread.

Others' seconds are those of their searches. Where one did fewer than 30 runs, equal work, its seconds are scaled.
"""
import pathlib
import statistics
import sys

from bench_context import Missing, Run
from row import Row
from seed_job import GENERATIONS, MEMBERS, RUNS, SeedJob

PEERS = pathlib.Path(__file__).resolve().parent.parent / "peers"
NAMES = {"pagmo_de": "pagmo2's de, in C++", "nlopt_crs2": "NLopt's CRS2", "openblas_de": "DE on OpenBLAS",
         "eigen_de": "DE on Eigen"}
WHOLE_GOALS = {10_000: 40.0, 100_000: 500.0, 1_000_000: 500.0}


def peer_seconds(build, peer, data, runs):
    return Run([build / "bench/peers/bench_peers", peer, data, runs]).printed["search_s"] * RUNS / runs


def script_seconds(python, script, data, runs):
    return Run([python, PEERS / script, data, runs]).printed["search_s"] * RUNS / runs


def search_seconds(build, data, fitness):
    done = Run([build / "bench/runs/bench_seed_search", data, fitness, RUNS, MEMBERS, GENERATIONS, 1]).printed
    return done["search_s"] + done["setup_s"]


def rows(context):
    if not (context.build / "bench/peers/bench_peers").exists():
        raise Missing("pagmo2, NLopt and OpenBLAS: scripts/install-deps --bench")
    job = SeedJob(context.program(context.build), context.folder, 10_000)
    data = job.write_data()
    ours, was = context.in_turns(5, lambda build: search_seconds(build, data, "direct"))
    searches = "searches that read every sample, n = 1e4"
    for peer, name in NAMES.items():
        seconds = min(peer_seconds(context.build, peer, data, RUNS) for _ in range(3))
        yield Row(searches, "CPU s", ours, seconds, name, None, was)
    yield Row(searches, "CPU s", ours, script_seconds(sys.executable, "scipy_de.py", data, 3), "scipy, vectorised",
              None, was)
    if context.peers_python.exists():
        yield Row(searches, "CPU s", ours, script_seconds(context.peers_python, "pygmo_de.py", data, 2),
                  "pygmo's de, fitness in numpy", None, was)
    yield from whole_process(context)


def whole_process(context):
    for n, goal in WHOLE_GOALS.items():
        jobs = {build: SeedJob(context.program(build), context.folder, n) for build in context.builds()}
        data = jobs[context.build].write_data()
        runs = RUNS if n == 10_000 else 3 if n == 100_000 else 1
        seconds = statistics.median(peer_seconds(context.build, "pagmo_de", data, runs)
                                    for _ in range(3 if n < 1_000_000 else 1))
        ours, was = context.in_turns(5, lambda build: jobs[build].run("gram").cpu_s)
        yield Row(f"whole process from statistics, n = {n:.0e}".replace("+0", ""), "CPU s", ours, seconds,
                  "searches of pagmo2's de", goal, was)
        (context.folder / data.name).unlink()
