"""What storing every generation costs beside the searches, and the memory of the whole process beside its data."""
from bench_context import Run
from row import Row
from seed_job import GENERATIONS, MEMBERS, RUNS, SeedJob

MOST_SHARE = 0.08  # of the searches' seconds
SPARE_MB = 20
BYTES_PER_SAMPLE = 40  # R + 1 columns of doubles


def storing_and_searching(context, build, data):
    out = context.folder / "stored.h5"
    command = [build / "bench/runs/bench_seed_search", data, "direct", RUNS, MEMBERS, GENERATIONS, 1]
    pairs = []
    for _ in range(5):
        out.unlink(missing_ok=True)
        pairs.append((Run([*command, out]).printed["storing_s"], Run(command).cpu_s))
    return tuple(sorted(column)[2] for column in zip(*pairs))


def rows(context):
    data = SeedJob(context.program(context.build), context.folder, 10_000).write_data()
    now = storing_and_searching(context, context.build, data)
    try:
        before = [storing_and_searching(context, context.was, data)] if context.was else []
    except SystemExit:
        before = []  # an earlier benchmark that stores nothing
    yield Row("storing every generation, n = 1e4", "CPU s", now[0], now[1], "the searches that read every sample",
              1.0 / MOST_SHARE, before[0][0] if before else None)
    for n in (100_000, 1_000_000):
        found = [SeedJob(context.program(build), context.folder, n).run("lean").peak_mb for build in context.builds()]
        yield Row(f"peak memory, statistics, no samples stored, n = {n:.0e}".replace("+0", ""), "MB", found[0],
                  n * BYTES_PER_SAMPLE / 1e6 + SPARE_MB, f"the data and {SPARE_MB} MB", 1.0,
                  found[1] if context.was else None)
