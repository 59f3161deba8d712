"""CPU seconds and peak memory of a command, and tables of such: what bench/peers and bench/runs share."""
import json
import os
import statistics
import subprocess
import sys

# an exported name of a processor would give OpenBLAS slower kernels than it picks itself
SLOWING = ("OPENBLAS_CORETYPE", "OPENBLAS_L2_SIZE")
ONE_THREAD = {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1", "MKL_NUM_THREADS": "1", "OMP_WAIT_POLICY": "passive"}


def environment(threads=1):
    kept = {name: value for name, value in os.environ.items() if name not in SLOWING}
    return kept | ONE_THREAD | {"OMP_NUM_THREADS": str(threads)}


class Run:
    """One process: `cpu_s` (user and system), `peak_mb`, and what it printed as JSON, if it did.

    Linux counts what the starting process held as the started one's: peaks below 12 MB read as 12 MB."""

    def __init__(self, command, threads=1):
        process = subprocess.Popen([str(part) for part in command], env=environment(threads), stdout=subprocess.PIPE,
                                   stderr=subprocess.DEVNULL, text=True)
        output = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        if process.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))} ended with {process.returncode}")
        self.cpu_s = usage.ru_utime + usage.ru_stime
        self.peak_mb = usage.ru_maxrss / 1000
        self.printed = json.loads(output) if output.startswith("{") else {}


def median_of(runs, number):
    return statistics.median(number(run) for run in runs)


def print_table(head, rows):
    """Columns as wide as their widest cell; the first one to the left, all others to the right."""
    table = [head, *[[str(cell) for cell in row] for row in rows]]
    widths = [max(len(row[column]) for row in table) for column in range(len(head))]
    for row in table:
        cells = [row[0].ljust(widths[0]), *[cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]]
        print("  ".join(cells), flush=True)
