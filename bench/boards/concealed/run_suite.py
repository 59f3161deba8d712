"""Makes concealed cases, lets the engine diagnose them, and has the scorer judge the verdicts.

    run_suite.py PROGRAM MAKE_CASE OUT [--cases NAME,NAME | --clean FROM..TO [--sticking LAW] | --drawn FILE_OR_NAMES]
                 [--shard [I/N]] [--jobs N] [--threads N] [--twins N] [--all-right]

PROGRAM is `torquescope` (or anything that takes `diagnose JOB --json V.json --out R.h5`). Without --cases, --clean or
--drawn: every sealed case. Drawn cases are those of `make_case --list-drawn`, one name per line of a file or separated
by commas; their folders do not tell their names. Ended before its time, the same command goes on: a verdict stays as
long as the case's seal and the program are those it was made with; a diagnosis that failed is tried again. --shard runs
a share of the cases (shard.py), without I/N the one Slurm says; each shard wants an OUT of its own, and score.py OUT...
gathers them. --twins asks for a smaller diagnosis than the case's own job does, of rows that move one way alone: for
tests, not for boards.

    OUT/sealed/NAME     what make_case writes; only the scorer looks into it
    OUT/open/NAME       the job and its recordings, the folder the program runs in
    OUT/verdicts/NAME.json, OUT/results/NAME.h5, OUT/logs/NAME.txt
    OUT/made.json       which case was made (seal, program) and diagnosed (seal, program, seconds, exit code)
    OUT/board.json, OUT/board.h5   the scoreboard of these cases (score.py)

Exit code: the scorer's; 64 usage, 70 when make_case fails. A program that fails is a case without a verdict, no error
here.
"""

import argparse
import concurrent.futures
import dataclasses
import hashlib
import json
import os
import pathlib
import re
import subprocess
import sys
import threading
import time

import score
import shard

OPEN = ("job.toml", "train.csv", "validate.csv")
# a diagnosis of a minute of recording: beyond this it hangs
SLOWEST_S = 1800 * int(os.environ.get("TORQUESCOPE_TIMES_AS_LONG", "1"))


def digest(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@dataclasses.dataclass
class Suite:
    program: pathlib.Path
    make_case: pathlib.Path
    out: pathlib.Path
    threads: int = 0
    twins: int = 0

    def __post_init__(self):
        for folder in ("sealed", "open", "verdicts", "results", "logs"):
            (self.out / folder).mkdir(parents=True, exist_ok=True)
        self.notes = self.out / "made.json"
        self.made = json.loads(self.notes.read_text()) if self.notes.exists() else {}
        self.lock = threading.Lock()
        self.plant, self.engine = digest(self.make_case), digest(self.program)

    def note(self, name, **facts):
        with self.lock:
            self.made.setdefault(name, {}).update(facts)
            unfinished = self.notes.with_suffix(".new")
            unfinished.write_text(json.dumps(self.made, indent=1, sort_keys=True))
            unfinished.replace(self.notes)

    def make(self, name, words):
        """Returns the seal; the recordings of a case already made by this very plant stay."""
        known = self.made.get(name, {})
        folder = self.out / "open" / name
        if known.get("plant") == self.plant and all((folder / file).exists() for file in OPEN):
            return known["seal"]
        began = time.monotonic()
        answer = subprocess.run([self.make_case, *words, self.out / "sealed"], capture_output=True, text=True)
        seal = re.match(r"[0-9a-f]{64}\b", answer.stdout)
        if answer.returncode != 0 or not seal:
            raise RuntimeError(f"make_case {' '.join(words)}: {answer.stderr or 'no seal in its answer'}")
        folder.mkdir(exist_ok=True)
        for file in OPEN:
            (folder / file).unlink(missing_ok=True)
            os.link(self.out / "sealed" / name / file, folder / file)
        if self.twins:
            text = (folder / "job.toml").read_text()
            (folder / "job.toml").unlink()  # what is sealed stays as it is
            (folder / "job.toml").write_text(re.sub(r"(?m)^twins = .*", f"twins = {self.twins}", text))
        self.note(name, plant=self.plant, seal=seal[0], made_s=round(time.monotonic() - began, 2))
        return seal[0]

    def diagnose(self, name, seal):
        """True when the program was run, False when its verdict was there already."""
        known = self.made[name].get("diagnosed", {})
        verdict, result = self.out / "verdicts" / f"{name}.json", self.out / "results" / f"{name}.h5"
        if (
            (known.get("seal"), known.get("engine")) == (seal, self.engine)
            and known["exit_code"] == 0
            and verdict.exists()
        ):
            return False
        for old in (verdict, result):
            old.unlink(missing_ok=True)
        command = [self.program, "diagnose", "job.toml", "--json", verdict, "--out", result,
                   "--shard", "0/1"]  # in a Slurm array cases are shared, not the replicates of one
        environment = dict(os.environ)
        if self.threads:
            environment["OMP_NUM_THREADS"] = str(self.threads)
        began = time.monotonic()
        with open(self.out / "logs" / f"{name}.txt", "w", encoding="utf-8") as log:
            try:
                code = subprocess.run(command, cwd=self.out / "open" / name, stdout=log, stderr=subprocess.STDOUT,
                                      env=environment, timeout=SLOWEST_S).returncode
            except subprocess.TimeoutExpired:
                code = 124
        self.note(name, diagnosed={"seal": seal, "engine": self.engine, "exit_code": code,
                                   "seconds": round(time.monotonic() - began, 2)})
        return True

    def run(self, name, words):
        fresh = self.diagnose(name, self.make(name, words))
        facts = self.made[name]
        code = facts["diagnosed"]["exit_code"]
        failure = f"   FAILED with exit code {code}: see {self.out / 'logs' / name}.txt" if code else ""
        print(f"{name:12} made in {facts['made_s']:6.1f} s, diagnosed in {facts['diagnosed']['seconds']:7.1f} s"
              f"{'' if fresh else ' (kept)'}   seal {facts['seal'][:12]}{failure}", flush=True)


def wanted_cases(options, make_case):
    """-> {name: the words make_case takes for it}, or a message for the user."""
    if options.clean:
        ends = re.fullmatch(r"(\d+)\.\.(\d+)", options.clean)
        if not ends or int(ends[1]) > int(ends[2]):
            return f"--clean {options.clean}: write FROM..TO, for example 1..100"
        seeds, law = range(int(ends[1]), int(ends[2]) + 1), options.sticking
        if law:
            return {f"clean_{seed}_{law}": ["--clean", str(seed), law] for seed in seeds}
        return {f"clean_{seed}": ["--clean", str(seed)] for seed in seeds}
    if options.drawn:
        path = pathlib.Path(options.drawn)
        names = (path.read_text() if path.is_file() else options.drawn.replace(",", "\n")).split()
        folders, at_once = [], 200
        for i in range(0, len(names), at_once):
            answer = subprocess.run([make_case, "--folders", *names[i : i + at_once]], capture_output=True, text=True)
            if answer.returncode != 0:
                return f"--drawn: {answer.stderr.strip()}"
            folders += answer.stdout.split()
        return {folder: ["--drawn", name] for folder, name in zip(folders, names)} or "--drawn: no names in it"
    known = subprocess.run([make_case, "--list"], capture_output=True, text=True, check=True).stdout.split()
    names = options.cases.split(",") if options.cases else known
    unknown = sorted(set(names) - set(known))
    return f"no sealed case {', '.join(unknown)}; there are {', '.join(known)}" if unknown else {n: [n] for n in names}


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "make_case", "out"):
        parser.add_argument(name, type=pathlib.Path)
    which = parser.add_mutually_exclusive_group()
    which.add_argument("--cases", help="sealed cases, separated by commas")
    which.add_argument("--clean", help="seeds of clean records, FROM..TO")
    parser.add_argument("--sticking", help="law of clean records: creep_0.2, ..., lugre, karnopp (sticking_law.hpp)")
    which.add_argument("--drawn", help="names of drawn cases: a file, one per line, or separated by commas")
    parser.add_argument("--shard", nargs="?", const="", help="I/N: the cases whose name is dealt to it (shard.py)")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--threads", type=int, default=0, help="threads of each diagnosis; 0: as it likes")
    parser.add_argument("--twins", type=int, default=0, help="of each diagnosis; 0: as many as its job says")
    parser.add_argument("--all-right", action="store_true", help="exit code 1 unless every case is right")
    options = parser.parse_args(arguments)
    make_case = options.make_case.resolve()
    cases = wanted_cases(options, make_case)
    if isinstance(cases, str):
        print(f"run_suite.py: {cases}", file=sys.stderr)
        return 64
    if options.shard is not None:
        try:
            mine = shard.of(options.shard or None, os.environ)
        except ValueError as problem:
            print(f"run_suite.py: {problem}", file=sys.stderr)
            return 64
        names = shard.share(list(cases), mine)
        print(f"shard {mine[0]} of {mine[1]}: {len(names)} of {len(cases)} cases" if mine else "no shard: every case")
        cases = {name: cases[name] for name in names}
        if not cases:
            return 0
    suite = Suite(options.program.resolve(), make_case, options.out.resolve(), options.threads, options.twins)
    try:
        with concurrent.futures.ThreadPoolExecutor(max(1, options.jobs)) as pool:
            for done in [pool.submit(suite.run, *case) for case in cases.items()]:
                done.result()
    except RuntimeError as problem:
        print(f"run_suite.py: {problem}", file=sys.stderr)
        return 70
    print()
    return score.score([suite.out], cases, all_right=options.all_right)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
