"""What merging shards costs beside the runs that it merges, and the line from there to ten million runs.

    python3 bench/runs/merge.py build/bench [--runs 10000] [--shards 20] [--population 30] [--generations 10]

DE, four parameters. By default 30 members and few generations: runs so small that all that happens once a run shows. A
run's cost is the slope between half the runs and all of them. "one process" is `torquescope run` of the same job; the
merged file must equal its file byte for byte. Memory of few runs is mostly what is read ahead, which has a bound. Goal:
merging costs at most 10 % of one process.
"""
import argparse
import filecmp
import pathlib
import shutil
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).parent.parent))
from measure import Run, print_table  # noqa: E402

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent.parent / "tests" / "jobs"))
import simulated_job  # noqa: E402

GOAL_RUNS = 10_000_000


class Sharded:
    """A job, its segments from all shards, and what to make of them."""

    def __init__(self, program, folder, runs, shards, population, generations):
        self.program, self.runs, self.folder = program, runs, pathlib.Path(folder) / str(runs)
        self.folder.mkdir()
        self.job = self.folder / "job.toml"
        self.job.write_text(simulated_job.job([{"name": "de", "population": population, "generations": generations}],
                                              experiment={"name": "merge", "runs": runs}))
        for index in range(shards):
            self.torquescope("run", "segments.h5", "--shard", f"{index}/{shards}")

    def torquescope(self, command, out, *options):
        return Run([self.program, command, self.job, "--out", self.folder / out, "--threads", 1, "--quiet", *options])

    def merge(self):
        """Merging removes the segments, so copies are merged."""
        (self.folder / "merged.h5").unlink(missing_ok=True)
        shutil.copytree(self.folder / "segments.h5.parts", self.folder / "merged.h5.parts")
        return self.torquescope("merge", "merged.h5")

    def run(self):
        (self.folder / "whole.h5").unlink(missing_ok=True)
        return self.torquescope("run", "whole.h5")

    def bytes_a_run(self):
        return (self.folder / "whole.h5").stat().st_size / self.runs

    def expect_equal(self):
        if not filecmp.cmp(self.folder / "merged.h5", self.folder / "whole.h5", shallow=False):
            sys.exit("the merged result is not that of one process")


def slope(half, many, runs, number):
    median = [statistics.median(number(run) for run in done) for done in (half, many)]
    return (median[1] - median[0]) / runs


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    for option, value in (("runs", 10_000), ("shards", 20), ("population", 30), ("generations", 10), ("rounds", 3)):
        parser.add_argument(f"--{option}", type=int, default=value)
    wanted = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        program = wanted.build.resolve() / "bin/torquescope"
        half, many = (Sharded(program, folder, runs, wanted.shards, wanted.population, wanted.generations)
                     for runs in (wanted.runs // 2, wanted.runs))
        rows, costs = [], []
        for name in ("run", "merge"):
            done = [[getattr(job, name)() for _ in range(wanted.rounds)] for job in (half, many)]
            runs = many.runs - half.runs
            cost, memory = (slope(*done, runs, number) for number in (lambda run: run.cpu_s, lambda run: run.peak_mb))
            costs.append(cost)
            rows.append([{"run": "one process", "merge": "merge"}[name], f"{1e3 * cost:.4f}", f"{1e3 * memory:.2f}",
                         f"{cost * GOAL_RUNS / 60:.0f}", f"{memory * GOAL_RUNS / 1e3:.1f}"])
        many.expect_equal()
        print(f"\n{many.runs} runs of {wanted.population} x {wanted.generations}, {wanted.shards} shards, "
              f"{many.bytes_a_run() / 1e3:.1f} kB a run; the last two columns: by this line to 1e7 runs")
        print_table(["", "CPU ms/run", "memory kB/run", "CPU min", "memory GB"], rows)
        print(f"merging costs {100 * costs[1] / costs[0]:.0f} % of the runs (goal: 10 %)")


if __name__ == "__main__":
    main()
