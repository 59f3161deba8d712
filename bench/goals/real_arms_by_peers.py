"""One real arm by ours, Pinocchio with numpy and FIGAROH, in the Python of the peers: errors in % and CPU seconds.

    real_arms_by_peers.py PROGRAM FOLDER ROBOT
"""
import json
import pathlib
import resource
import sys
import time
import tomllib

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "arms"))
import identify_peer  # noqa: E402

try:
    import figaroh_peer
except ImportError:
    figaroh_peer = None


def timed(work):
    """The error that `work` returns, and the CPU seconds of it and of the processes it started."""
    def spent():
        return time.process_time() + sum(resource.getrusage(resource.RUSAGE_CHILDREN)[:2])
    start = spent()
    validation = work()
    return {"unseen": 100 * validation, "cpu_s": spent() - start}


def by_figaroh(job, folder):
    model, make = identify_peer.parts_of(job, folder)
    train, validation, _ = make(figaroh_peer.figaroh_columns)
    chosen, found = figaroh_peer.least_squares(model, job, train)
    return identify_peer.errors([(phi[:, chosen], tau) for phi, tau in validation], found["wls"])[-1]


def main(program, folder, robot):
    text = (identify_peer.JOBS / f"{robot}.toml").read_text(encoding="utf-8")
    job, folder = tomllib.loads(text), pathlib.Path(folder).resolve()
    found = {"ours": timed(lambda: identify_peer.ours(program, text, job, folder)["wls"][2][-1]),
             "Pinocchio and numpy": timed(lambda: identify_peer.peer(job, folder)["wls"][2][-1])}
    if figaroh_peer:
        found["FIGAROH"] = timed(lambda: by_figaroh(job, folder))
    print(json.dumps(found))


main(*sys.argv[1:])
