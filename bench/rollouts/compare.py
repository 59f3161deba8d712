"""A joint with dry friction in a position loop, 60 s at 1 kHz: rollouts and fits of 8 parameters, ours and peers'.

    python3 bench/rollouts/compare.py BUILD [--rounds 3] [--seconds 60] [--peers-alone]

Everybody gets the same file and one thread; the rounds go in turns. Rate: the best round. CPU seconds: the median,
until rms torque and rms position of all samples are within 1 % of the least that anybody reached. A peer's seconds are
without imports and reading; ours are those of the whole process. Who never comes so near has "not reached" it; the
seconds behind are those to within 1 % of its own end.
"""
import argparse
import json
import os
import pathlib
import statistics
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "goals"))
import joint  # noqa: E402
import ours  # noqa: E402
import recording  # noqa: E402
from bench_context import Context, Missing  # noqa: E402
from measure import print_table  # noqa: E402

HERE, ROOT = pathlib.Path(__file__).resolve().parent, pathlib.Path(__file__).resolve().parents[2]
PEERS = ("python_peer", "mujoco_peer", "mujoco_sysid_peer")
NEAR = 1.01
HEAD = ["who", "joint steps/s and core", "CPU s to the same error", "rms torque, N m", "rms position, rad"]


def by_peers(context, file):
    """The lines of all peers, and a line for each that is missing."""
    lines, missing = [], []
    for peer in PEERS:
        try:
            printed = context.by_peers(HERE / f"{peer}.py", file).splitlines()
            lines += [json.loads(line) for line in printed if line.startswith("{")]
        except (Missing, OSError) as absent:
            missing.append(f"{peer}: {absent}")
    return lines, missing


def by_us(context, file, ticks):
    """Ours in the form of a peer's line: what is known after a run is its end."""
    lines, missing = [], []
    for who, measure in (("ours, lanes alone", lambda: (ours.lanes_per_second(context.build), [])),
                         ("ours, lm, whole process",
                          lambda: (None, [ours.fit(context.program(context.build), file, ticks, context.folder)]))):
        try:
            steps_per_second, trace = measure()
            lines.append({"who": who, "steps_per_second": steps_per_second, "trace": trace})
        except (Missing, OSError) as absent:
            missing.append(str(absent))
    return lines, missing


def seconds_to(trace, torque, position):
    """When a trace first comes within 1 % of both errors, or None."""
    return next((at for at, *seen in trace if seen[0] <= NEAR * torque and seen[1] <= NEAR * position), None)


def cells(lines, least):
    """A row of the table out of one program's lines, a line a round."""
    rates = [line["steps_per_second"] for line in lines if line["steps_per_second"]]
    row = [lines[0]["who"], f"{max(rates):.3g}" if rates else ""]
    traces = [line["trace"] for line in lines if line["trace"]]
    if not traces:
        return [*row, "", "", ""]
    reached, own = ([seconds_to(trace, *wanted(trace)) for trace in traces]
                    for wanted in (lambda _: least, lambda trace: trace[-1][1:]))
    seconds = (f"not reached ({statistics.median(own):.3g})" if None in reached
               else f"{statistics.median(reached):.3g}")
    return [*row, seconds, *[f"{error:.4g}" for error in traces[0][-1][1:]]]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=lambda name: pathlib.Path(name).resolve())
    parser.add_argument("--rounds", type=int, default=3)
    parser.add_argument("--seconds", type=float, default=joint.SECONDS, help="length of the recording")
    parser.add_argument("--peers-alone", action="store_true", help="without ours")
    wanted = parser.parse_args()
    load, found, missing = os.getloadavg()[0], {}, []
    peers_python = ROOT / "build/bench_peers/bin/python"
    if not peers_python.exists():  # scipy at least is there without
        peers_python = pathlib.Path(sys.executable)
    with tempfile.TemporaryDirectory() as folder:
        context = Context(wanted.build, None, peers_python, None, pathlib.Path(folder))
        file = context.folder / "recording.csv"
        recording.write(file, wanted.seconds)
        for _ in range(wanted.rounds):
            groups = [by_peers(context, file)]
            if not wanted.peers_alone:
                groups.append(by_us(context, file, round(wanted.seconds / joint.TICK_S)))
            for line in (line for lines, _ in groups for line in lines):
                found.setdefault(line["who"], []).append(line)
            missing = [line for _, lines in groups for line in lines]
    ends = [line["trace"][-1][1:] for lines in found.values() for line in lines if line["trace"]]
    least = [min(column) for column in zip(*ends)]
    print_table(HEAD, [cells(lines, least) for lines in found.values()])
    print(f"the noise alone: {joint.TORQUE_NOISE_NM:.4g} N m, {joint.POSITION_NOISE_RAD:.4g} rad (rounding)")
    print(f"load {load:.1f} at the start, {os.getloadavg()[0]:.1f} at the end, {os.cpu_count()} cores")
    for line in missing:
        print(f"left out: {line}")


if __name__ == "__main__":
    main()
