"""One table of ratios: every goal, and ours beside others; some minutes on two idle cores.

    python3 bench/goals/main.py BUILD [--was BUILD] [--recordings FOLDER] [--only WORD ...]

BUILD is where the programs of the preset bench are; --was: those of an earlier commit, measured in turns with today's.
"gain" says how many times better ours is than the other. A peer that is absent is left out, and a line says how to get
it. Commands for more depth: scripts/bench kernels | peers | arms | runs.
"""
import argparse
import importlib
import os
import pathlib
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).parent))
from bench_context import Context, Missing  # noqa: E402
from measure import print_table  # noqa: E402
from row import HEAD  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[2]
GROUPS = ("kernels", "seed_job", "storing", "arms", "mujoco", "real_arms", "diagnoses")


def recordings():
    return pathlib.Path(os.environ.get("TORQUESCOPE_RECORDINGS", ROOT.parent / "shared" / "recordings"))


def measured(context, groups):
    """Rows, and a line for everything that is missing."""
    rows, missing = [], []
    for group in groups:
        start = time.monotonic()
        try:
            for row in importlib.import_module(f"of_{group}").rows(context):
                rows.append(row)
        except (Missing, SystemExit) as absent:  # the latter: a program of the group failed
            missing.append(f"{group}: {absent}")
        print(f"{group}: {time.monotonic() - start:.0f} s", file=sys.stderr, flush=True)
    return rows, missing


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--was", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--recordings", type=lambda name: pathlib.Path(name).resolve(), default=recordings())
    parser.add_argument("--only", nargs="+", choices=GROUPS, default=GROUPS)
    wanted = parser.parse_args()
    load = os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        context = Context(wanted.build, wanted.was, ROOT / "build/bench_peers/bin/python", wanted.recordings,
                          pathlib.Path(folder))
        rows, missing = measured(context, wanted.only)
    print_table(HEAD, [row.cells() for row in rows])
    print(f"load {load:.1f} at the start, {os.getloadavg()[0]:.1f} at the end, {os.cpu_count()} cores")
    for line in missing:
        print(f"left out: {line}")


if __name__ == "__main__":
    main()
