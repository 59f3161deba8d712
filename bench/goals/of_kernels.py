"""Kernels beside a loop of nothing but multiply-adds, in the same thread, in turns of milliseconds."""
import json
import subprocess

from bench_context import environment
from row import Row

GOAL = 0.8
CACHED, FROM_MEMORY = "n:10000/NP:30", "n:1000000/NP:120"
PICK = f"^residual_energy/[^/]+/R:(4|60)/({CACHED}|{FROM_MEMORY})"


def percents(build):
    """(R, n and NP) -> percent of the peak, of the widest instruction set."""
    out = build / "kernels_quick.json"
    subprocess.run([build / "bench/kernels/bench_kernels", f"--benchmark_filter={PICK}", f"--benchmark_out={out}",
                    "--benchmark_out_format=json"], check=True, env=environment(), stdout=subprocess.DEVNULL,
                   stderr=subprocess.DEVNULL)
    found = {}
    for entry in json.loads(out.read_text())["benchmarks"]:
        if entry.get("aggregate_name") != "median":
            continue
        _, _, size, *rest = entry["run_name"].split("/")
        place = (size[2:], "/".join(rest[:2]))
        found[place] = max(found.get(place, 0.0), entry["percent_of_peak"])
    return found


def rows(context):
    now = percents(context.build)
    before = percents(context.was) if context.was else {}
    for (parameters, where), percent in sorted(now.items(), key=lambda item: (item[0][1], int(item[0][0]))):
        words = "in the caches" if where == CACHED else "n = 1e6, four runs at once"
        yield Row(f"residual energy, R = {parameters}, {words}", "% of peak", percent, 100.0,
                  "the multiply-add peak of the same thread", GOAL, before.get((parameters, where)), True)
