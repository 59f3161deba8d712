"""Rows of an arm of six joints beside MuJoCo's sysid, as its users call it: from Python, one sample at a time."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "arms"))
from bench_context import Missing  # noqa: E402
from row import Row  # noqa: E402

SCRIPT = pathlib.Path(__file__).with_name("mujoco_rows.py")


def rows(context):
    import compare

    if not context.peers_python.exists():
        raise Missing("MuJoCo's sysid: scripts/install-peers --bench")
    ours, was = context.in_turns(1, lambda build: compare.rows_alone(build, "ur10e"))
    theirs = 1e3 * float(context.by_peers(SCRIPT, 2000))
    yield Row("UR10e, 6 joints: rows", "ns/sample", ours, theirs, "MuJoCo's sysid, from Python", None, was)
