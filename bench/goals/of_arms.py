"""Rows of arms and their products beside Pinocchio's regressor, or plain Eigen's where Pinocchio is missing."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "arms"))
from bench_context import Missing  # noqa: E402
from row import Row  # noqa: E402

ROWS_GOAL, BOTH_GOAL, PEAK_GOAL = 20.0, 13.0, 0.75


def rows(context):
    import compare

    for robot, name in compare.ROBOTS.items():
        ours, peers = compare.measured(context.build, robot, 3)
        was = compare.measured(context.was, robot, 3)[0] if context.was else {}
        peer = next((one for one in peers if "inocchio" in one), next(iter(peers), None))
        if peer is None:
            raise Missing("no peer of arms was built")
        yield Row(f"{name}: rows", "ns/sample", ours["rows_ns"], peers[peer]["regressor_ns"], f"{peer}'s regressor",
                  ROWS_GOAL, was.get("rows_ns"))
        yield Row(f"{name}: rows and products", "ns/sample", ours["both_ns"], peers[peer]["both_ns"],
                  f"{peer}'s regressor, Eigen's rank updates", BOTH_GOAL, was.get("both_ns"))
        yield Row(f"{name}: rows and products", "% of peak", ours["both_percent"], 100.0,
                  "the multiply-add peak of the same thread", PEAK_GOAL, was.get("both_percent"), True)
