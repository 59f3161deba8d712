"""How the seed's job grows with samples, members, parameters, runs and threads, and what storing it costs.

    python3 bench/runs/scale.py build/bench [--most-samples 1000000] [--rounds 5]

"whole" is `torquescope run`: it simulates the recording, searches, stores every generation. Everything else is
bench_seed_search, which begins with its data in memory. "data" is what the recording takes as doubles (R + 1 columns).
"""
import argparse
import pathlib
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from measure import Run, median_of, print_table  # noqa: E402
from seed_job import GENERATIONS, MEMBERS, RUNS, SeedJob  # noqa: E402


class Bench:
    def __init__(self, build, folder, rounds):
        self.build, self.folder, self.rounds = build, pathlib.Path(folder), rounds

    def search(self, data, fitness, runs=RUNS, members=MEMBERS, generations=GENERATIONS, threads=1, stored=False):
        out = self.folder / "stored.h5"
        out.unlink(missing_ok=True)
        return Run([self.build / "bench/runs/bench_seed_search", data, fitness, runs, members, generations, threads,
                    *([out] if stored else [])], threads)

    def interleaved(self, *functions):
        done = [[] for _ in functions]
        for _ in range(self.rounds):
            for runs, function in zip(done, functions):
                runs.append(function())
        return done


def whole_program(bench, most_samples):
    rows = []
    n = 1000
    while n <= most_samples:
        job = SeedJob(bench.build / "bin/torquescope", bench.folder, n)
        few = bench if n <= 100_000 else Bench(bench.build, bench.folder, 1)
        done = few.interleaved(
            *[lambda fitness=fitness: job.run(fitness) for fitness in ("direct", "float32", "gram", "lean")]
        )
        data_mb = n * 5 * 8 / 1e6
        rows.append([f"{n:.0e}".replace("+0", ""), *[f"{median_of(runs, lambda run: run.cpu_s):.3f}" for runs in done],
                     f"{data_mb:.1f}", *[f"{done[which][0].peak_mb:.0f}" for which in (0, 2, 3)]])
        n *= 10
    print("\nwhole process, CPU s, then peak MB; lean: gram with [output] samples = false")
    print_table(["n", "direct", "float32", "gram", "lean", "data MB", "direct", "gram", "lean"], rows)


def storing(bench):
    rows = []
    for n, fitness, runs, generations in (
        (1000, "in_time", RUNS, 100),
        (10_000, "in_time", RUNS, 100),
        (10_000, "direct", RUNS, 100),
        (10_000, "gram", RUNS, 100),
        (1000, "gram", 10_000, 200),
    ):
        data = SeedJob(bench.build / "bin/torquescope", bench.folder, n).write_data()
        few = bench if runs == RUNS else Bench(bench.build, bench.folder, 1)
        searches = [lambda stored=stored: few.search(data, fitness, runs, MEMBERS, generations, stored=stored)
                    for stored in (False, True)]
        without, stored = few.interleaved(*searches)
        storing_s = median_of(stored, lambda run: run.printed["storing_s"])
        search_s = median_of(without, lambda run: run.cpu_s)
        rows.append(
            [
                f"{n} {fitness}",
                runs,
                f"{search_s:.4f}",
                f"{median_of(stored, lambda run: run.cpu_s):.4f}",
                f"{storing_s:.4f}",
                f"{100 * storing_s / search_s:.1f}",
                f"{1e6 * storing_s / (runs * (generations + 1)):.2f}",
            ]
        )
    print("\nstoring every generation (30 members, R = 4), process CPU s")
    print_table(["n, fitness", "runs", "without", "with", "storing", "storing %", "us/generation"], rows)


def sizes(bench):
    rows = []
    for members, R, runs, threads in (
        (30, 4, 30, 1),
        (120, 4, 30, 1),
        (480, 4, 30, 1),
        (30, 11, 30, 1),
        (30, 24, 30, 1),
        (30, 60, 30, 1),
        (30, 4, 120, 1),
        (30, 4, 30, 2),
    ):
        (done,) = bench.interleaved(
            lambda: bench.search(f"random:10000:{R}", "in_time", runs, members, threads=threads)
        )
        search_s = median_of(done, lambda run: run.printed["search_s"])
        each = search_s / (runs * members * (GENERATIONS + 1))
        rows.append(
            [
                f"NP {members}",
                R,
                runs,
                threads,
                f"{search_s:.3f}",
                f"{1e6 * each:.3f}",
                f"{1e9 * each / 1e4 / (R + 1):.4f}",
            ]
        )
    print("\nn = 1e4, every sample in time: CPU of the searches")
    print_table(["members", "R", "runs", "threads", "CPU s", "us/evaluation", "ns/multiply-add"], rows)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--most-samples", type=int, default=1_000_000)
    parser.add_argument("--rounds", type=int, default=5)
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        bench = Bench(wanted.build.resolve(), folder, wanted.rounds)
        storing(bench)
        sizes(bench)
        whole_program(bench, wanted.most_samples)


if __name__ == "__main__":
    main()
