"""Real arms identified by us beside Pinocchio with numpy, and FIGAROH: the error on validation rows, and CPU seconds.

Recordings are not ours to copy: jobs/README.md says where to get them.
"""
import json
import pathlib

from bench_context import Missing
from row import Row

SCRIPT = pathlib.Path(__file__).with_name("real_arms_by_peers.py")
ROBOTS = {"panda": "Panda", "ur10e": "UR10e"}


def rows(context):
    if not context.peers_python.exists():
        raise Missing("Pinocchio and FIGAROH: scripts/install-peers --bench")
    there = [robot for robot in ROBOTS if (context.recordings / robot).exists()]
    if not there:
        raise Missing("recordings of Panda and UR10e: --recordings FOLDER or $TORQUESCOPE_RECORDINGS (jobs/README.md)")
    for robot in there:
        now, *before = [json.loads(context.by_peers(SCRIPT, context.program(build), context.recordings, robot))
                        for build in context.builds()]
        was = before[0]["ours"] if before else {}
        for name in ("Pinocchio and numpy", "FIGAROH"):
            if name not in now:
                continue
            yield Row(f"{ROBOTS[robot]}: error on unseen rows, WLS", "%", now["ours"]["unseen"], now[name]["unseen"],
                      name, None, was.get("unseen"))
            yield Row(f"{ROBOTS[robot]}: identification", "CPU s", now["ours"]["cpu_s"], now[name]["cpu_s"], name, None,
                      was.get("cpu_s"))
