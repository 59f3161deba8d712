"""Rows and products of arms: ours against Pinocchio's or plain Eigen's regressor and Eigen's rank updates, as ratios.

    compare.py BUILD [--rounds N] [--long N]

BUILD is where bench/arms/ is built; --long: samples of the long run, 0 for none.
Every program runs in turns, ROUNDS times; the least time of each piece stands. One thread.
"""
import argparse
import json
import pathlib
import subprocess

ROBOTS = {"crs_a465": "CRS A465, 5 joints", "ur10e": "UR10e, 6 joints", "panda": "Panda, 7 joints"}
ROOT = pathlib.Path(__file__).resolve().parents[2]


def run(command, text=None):
    return subprocess.run([str(word) for word in command], input=text, capture_output=True, text=True,
                          check=True).stdout


def least(results, key):
    return min(result[key] for result in results)


def rows_alone(build, robot):
    """ns a sample of our rows."""
    path = ROOT / "jobs" / "robots" / f"{robot}.toml"
    return json.loads(run([build / "bench/arms/bench_arms", path, "--samples", 200_000, "--rounds", 4]))["rows_ns"]


def measured(build, robot, rounds):
    """Ours, and every peer's by its name: the best number of each kind. Rows must agree."""
    path = ROOT / "jobs" / "robots" / f"{robot}.toml"
    ours, peers = build / "bench/arms/bench_arms", build / "bench/arms/bench_arm_peers"
    description = run([ours, path, "--describe"])
    mine, theirs = [], {}
    for _ in range(rounds):
        mine.append(json.loads(run([ours, path, "--samples", 200_000, "--rounds", 4])))
        for line in run([peers, "--samples", 20_000, "--rounds", 4], description).splitlines():
            peer = json.loads(line)
            theirs.setdefault(peer["peer"], []).append(peer)
    check = json.loads(run([ours, path, "--samples", 20_000, "--rounds", 1]))["squares"]
    for name, results in theirs.items():
        if abs(results[0]["squares"] - check) > 1e-9 * check:
            raise SystemExit(f"{name} has other rows than ours: {results[0]['squares']} against {check}")
    best = {key: least(mine, key) for key in ("rows_ns", "both_ns")}
    best |= {key: max(one[key] for one in mine) for key in ("products_percent", "both_percent")}
    return best, {name: {key: least(results, key) for key in ("regressor_ns", "both_ns")}
                  for name, results in theirs.items()}


def compare(build, robot, rounds):
    ours, peers = measured(build, robot, rounds)
    rows, both = ours["rows_ns"], ours["both_ns"]
    print(f"| {ROBOTS[robot]} | ours | {rows:.0f} | 1 | {both:.0f} | 1 | "
          f"{ours['products_percent']:.0f}, {ours['both_percent']:.0f} |")
    for name, peer in peers.items():
        print(f"| | {name} | {peer['regressor_ns']:.0f} | {peer['regressor_ns'] / rows:.1f} | {peer['both_ns']:.0f} | "
              f"{peer['both_ns'] / both:.1f} | |")


def report_long(build, n):
    result = json.loads(run([build / "bench/arms/bench_arms", ROOT / "jobs/robots/crs_a465.toml", "--samples", n,
                             "--rounds", 3]))
    print(f"\n{n:.0e} samples x 47 parameters (CRS A465): {1e-9 * n * result['both_ns']:.2f} s, "
          f"{result['more_kilobytes'] / 1024:.1f} MB beside the recording")


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--rounds", type=int, default=5)
    parser.add_argument("--long", type=int, default=10_000_000)
    wanted = parser.parse_args()
    print("| arm | who | rows, ns a sample | times ours | rows and products, ns | times ours | % of peak: "
          "products, all |")
    print("|---|---|---|---|---|---|---|")
    for robot in ROBOTS:
        compare(wanted.build, robot, wanted.rounds)
    if wanted.long > 0:
        report_long(wanted.build, wanted.long)


if __name__ == "__main__":
    main()
