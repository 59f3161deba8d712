"""Draws recordings with one kind of mistake in them (or none) and counts how often the program says what is right.

A kind is a file kind_NAME.py beside this one. Its `draw(rng, folder)` writes the files of a case and returns a function
`judge(call)`. `call("check", "job.toml", ...)` runs the program in that folder and returns an Answer; the
function returns None where all is right, else a sentence that says what is wrong.
Use: TORQUESCOPE=build/release/bin/torquescope /usr/bin/python3 tests/drawn/run.py KIND... --seed S --cases N
"""

import argparse
import dataclasses
import importlib
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
PROGRAM = str(pathlib.Path(os.environ.get("TORQUESCOPE", HERE.parents[1] / "build/release/bin/torquescope")).resolve())


@dataclasses.dataclass
class Answer:
    code: int
    text: str  # what was printed, both streams
    document: dict  # what --json wrote; empty where nothing was written

    def topics(self, *levels):
        """The topics of the findings of `check`, of these levels or of all."""
        lines = self.document.get("lines", [])
        return {line["topic"] for line in lines if not levels or line["level"] in levels}

    def parameters(self):
        """What the first estimator of `run` gives, by name."""
        parameters = self.document["estimators"][0]["parameters"]
        return {one["name"]: one.get("value", one.get("median")) for one in parameters}

    def wrong_parameters(self, joint, tolerance, scale=1.0):
        """What `run` gives that is not the joint's own by these shares (by name, or one for all), or None."""
        if self.code:
            return f"run ends with {self.code}: {self.text[-300:]}"
        if not isinstance(tolerance, dict):
            tolerance = dict.fromkeys(("inertia", "viscous", "coulomb"), tolerance)
        got = self.parameters()
        for name, share in tolerance.items():
            true = getattr(joint, name) / scale
            if abs(got[name] - true) > share * abs(true):
                return f"{name} {got[name]:.4g}, true {true:.4g}"
        return None


def caller_in(folder):
    def call(command, *words, json_file=True):
        out = pathlib.Path(folder) / f"{command}.json"
        out.unlink(missing_ok=True)
        more = ["--json", str(out)] if json_file else []
        result = subprocess.run([PROGRAM, command, *map(str, words), *more, "--color", "never"], cwd=folder, text=True,
                                capture_output=True, timeout=600, check=False)
        document = json.loads(out.read_text()) if out.exists() else {}
        return Answer(result.returncode, result.stdout + result.stderr, document)
    return call


def wrong_in(kind, seed, case, keep):
    """What is wrong with a case, or None."""
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(keep or folder) / (f"{kind}_{seed}_{case}" if keep else "")
        folder.mkdir(parents=True, exist_ok=True)
        rng = np.random.default_rng([seed, case, *kind.encode()])
        judge = importlib.import_module(f"kind_{kind}").draw(rng, folder)
        return judge(caller_in(folder))


def main():
    kinds = sorted(path.stem[5:] for path in HERE.glob("kind_*.py"))
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("kinds", nargs="*", default=[], help=", ".join(kinds))
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--cases", type=int, default=20)
    parser.add_argument("--cases-in-full", type=int, help="as many where scripts/test --full runs them")
    parser.add_argument("--least", type=float, default=0.9, help="share of right cases below which the exit code is 1")
    parser.add_argument("--keep", help="folder that keeps the files of all cases")
    given = parser.parse_args()
    if given.cases_in_full and os.environ.get("TORQUESCOPE_FULL"):
        given.cases = given.cases_in_full
    sys.path.insert(0, str(HERE))
    too_few = False
    for kind in given.kinds or kinds:
        right = 0
        for case in range(given.cases):
            wrong = wrong_in(kind, given.seed, case, given.keep)
            right += wrong is None
            if wrong:
                print(f"  {kind} seed {given.seed} case {case}: {wrong}", flush=True)
        print(f"{kind}: {right} of {given.cases} right", flush=True)
        too_few |= right < given.least * given.cases
    return 1 if too_few else 0


if __name__ == "__main__":
    sys.exit(main())
