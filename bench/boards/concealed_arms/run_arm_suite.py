"""Makes concealed cases of whole arms, lets the engine diagnose them, and has the scorer judge the verdicts.

    run_arm_suite.py PROGRAM MAKE_ARM_CASE OUT --cases FILE_OR_NAMES [--shard [I/N]] [--jobs N] [--threads N]

Names are those of make_arm_case (arm_case.hpp): one a line of a file, or separated by commas. Ended before its time,
the same command goes on: a verdict stays as long as plant and program are those it was made with. --shard runs a share
of the cases (bench/boards/concealed/shard.py), each into an OUT of its own; score_arms.py OUT... gathers them.

    OUT/sealed/FOLDER      the truth; only the scorer looks into it
    OUT/open/FOLDER        job, robot and recordings, the folder the program runs in
    OUT/verdicts/FOLDER.json, OUT/results/FOLDER.h5, OUT/logs/FOLDER.txt
    OUT/made.json          by folder: name, plant, seal (sha256 of the truth), program, seconds, exit code
    OUT/arms_board.json    the board (score_arms.py)

Exit code: the scorer's; 64 usage, 70 when a case cannot be made, 77 with a message without MuJoCo.
"""

import argparse
import concurrent.futures
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import threading
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "concealed"))
import score_arms
import shard

OPEN = ("job.toml", "robot.toml", "train.csv", "unseen.csv")
SLOWEST_S = 3600  # a diagnosis of seven joints takes minutes: beyond this it hangs


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


class Suite:
    def __init__(self, program, make_case, out, threads=0):
        self.program, self.make_case, self.out, self.threads = program, make_case, out, threads
        for folder in ("sealed", "open", "verdicts", "results", "logs"):
            (out / folder).mkdir(parents=True, exist_ok=True)
        self.notes = out / "made.json"
        self.made = json.loads(self.notes.read_text()) if self.notes.exists() else {}
        self.lock = threading.Lock()
        self.plant, self.engine = digest(make_case), digest(program)

    def note(self, folder, **facts):
        with self.lock:
            self.made.setdefault(folder, {}).update(facts)
            unfinished = self.notes.with_suffix(".new")
            unfinished.write_text(json.dumps(self.made, indent=1, sort_keys=True))
            unfinished.replace(self.notes)

    def make(self, folder, name):
        """What the engine may see goes to another folder than the truth; a case of this very plant stays."""
        target, known = self.out / "open" / folder, self.made.get(folder, {})
        if known.get("plant") == self.plant and all((target / file).exists() for file in OPEN):
            return
        answer = subprocess.run([self.make_case, name, self.out / "sealed"], capture_output=True, text=True)
        if answer.returncode != 0:
            raise RuntimeError(f"make_arm_case {name}: {answer.stderr.strip()}")
        target.mkdir(exist_ok=True)
        for file in OPEN:
            (self.out / "sealed" / folder / file).replace(target / file)
        self.made.pop(folder, None)
        self.note(folder, name=name, plant=self.plant, seal=score_arms.seal(self.out, folder))

    def diagnose(self, folder):
        """True when the program was run, False when its verdict was there already."""
        known = self.made[folder].get("diagnosed", {})
        verdict, result = self.out / "verdicts" / f"{folder}.json", self.out / "results" / f"{folder}.h5"
        if known.get("engine") == self.engine and known["exit_code"] == 0 and verdict.exists():
            return False
        for old in (verdict, result):
            old.unlink(missing_ok=True)
        command = [self.program, "diagnose", "job.toml", "--json", verdict, "--out", result, "--quiet",
                   "--shard", "0/1"]  # in a Slurm array cases are shared, not the replicates of one
        environment = {**os.environ, **({"OMP_NUM_THREADS": str(self.threads)} if self.threads else {})}
        began = time.monotonic()
        with open(self.out / "logs" / f"{folder}.txt", "w", encoding="utf-8") as log:
            try:
                code = subprocess.run(command, cwd=self.out / "open" / folder, stdout=log, stderr=subprocess.STDOUT,
                                      env=environment, timeout=SLOWEST_S).returncode
            except subprocess.TimeoutExpired:
                code = 124
        self.note(folder, diagnosed={"engine": self.engine, "exit_code": code,
                                     "seconds": round(time.monotonic() - began, 1)})
        return True

    def run(self, folder, name):
        self.make(folder, name)
        fresh = self.diagnose(folder)
        done = self.made[folder]["diagnosed"]
        failure = f"   FAILED with exit code {done['exit_code']}" if done["exit_code"] else ""
        print(f"{name:12} {folder}  {done['seconds']:7.1f} s{'' if fresh else ' (kept)'}{failure}", flush=True)


def wanted_cases(words, make_case):
    """{folder: name}"""
    path = pathlib.Path(words)
    names = (path.read_text() if path.is_file() else words.replace(",", "\n")).split()
    answer = subprocess.run([make_case, "--folders", *names], capture_output=True, text=True)
    if answer.returncode != 0:
        raise ValueError(answer.stderr.strip())
    return dict(zip(answer.stdout.split(), names))


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "make_case", "out"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--cases", required=True, help="a file of names, or names separated by commas")
    parser.add_argument("--shard", nargs="?", const="", help="I/N: the cases whose name is dealt to it")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--threads", type=int, default=0, help="threads of each diagnosis; 0: as it likes")
    options = parser.parse_args(arguments)
    if not options.make_case.is_file():
        print(f"skipped: no {options.make_case}: it is built where MuJoCo is (libmujoco-dev)")
        return 77
    try:
        cases = wanted_cases(options.cases, options.make_case.resolve())
        mine = shard.of(options.shard or None, os.environ) if options.shard is not None else None
    except ValueError as problem:
        print(f"run_arm_suite.py: {problem}", file=sys.stderr)
        return 64
    folders = shard.share(list(cases), mine)
    suite = Suite(options.program.resolve(), options.make_case.resolve(), options.out.resolve(), options.threads)
    try:
        with concurrent.futures.ThreadPoolExecutor(max(1, options.jobs)) as pool:
            for done in [pool.submit(suite.run, folder, cases[folder]) for folder in folders]:
                done.result()
    except RuntimeError as problem:
        print(f"run_arm_suite.py: {problem}", file=sys.stderr)
        return 70
    return score_arms.score([suite.out], folders)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
