"""One table from the JSON of Google Benchmark: kernel, instruction set, R, n, NP, ns, percent of the FMA peak.

    python3 bench/table.py build/bench/kernels.json
"""
import json
import sys

from measure import print_table


def rows(document):
    for entry in document["benchmarks"]:
        if entry.get("aggregate_name") != "median":
            continue
        kernel, instruction_set, *sizes = entry["run_name"].split("/")
        size = dict(part.split(":") for part in sizes if ":" in part)
        yield (
            kernel,
            instruction_set,
            size.get("R", ""),
            f'{float(size["n"]):.0e}'.replace("+0", ""),
            size.get("NP", ""),
            f'{entry["ns_per_sample_candidate"]:.4f}',
            f'{entry["percent_of_peak"]:.0f}' if entry["percent_of_peak"] else "-",
            f'{entry["peak_gflops"]:.0f}',
            *[f'{entry[rate]:.1f}' if rate in entry else "" for rate in ("sweep_gb_per_s", "read_gb_per_s")],
        )


def main(path):
    with open(path) as file:
        document = json.load(file)
    head = ("kernel", "target", "R", "n", "NP", "ns/sample/cand", "% of peak", "peak GF/s", "sweep GB/s", "read GB/s")
    print_table(head, list(rows(document)))


if __name__ == "__main__":
    main(sys.argv[1])
