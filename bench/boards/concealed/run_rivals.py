"""Lets the rivals answer the cases of a suite folder (run_suite.py OUT), on the engine's own columns.

    run_rivals.py PROGRAM OUT [--methods NAME,NAME] [--jobs N] [--keep-columns] [--again]

For every case that run_suite.py opened: `PROGRAM diagnose job.toml --columns C.h5` in OUT/open/NAME, then each method
of rivals/__init__.py. The columns are deleted again unless asked for (some 3 to 30 MB a case). Ended before its time,
the same command goes on: an answer stays while the recordings (their seal), the program and the rivals' own code are
those it was made with.

    OUT/rivals/METHOD/NAME.json   {"case", "verdict": none | named | data_fault | insufficient, "effects": [{"name",
                                  "family", "p"?, "q"?}], "ranking", "unseen": {"before", "after"}, "remark", "seconds",
                                  "made_with"}
    OUT/rivals/words.json         {METHOD: why it could not be run} ({} when all could)

verdict      none without names; data_fault when every name is a fault of a channel, as the engine's; insufficient where
             the engine refuses the recording before anything is searched: no method has columns there
Exit code: 0, also when a method is missing its library (words.json says which); 64 usage; 66 no cases; 70 when a rival
or the program fails.
"""

import argparse
import concurrent.futures
import functools
import hashlib
import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import time

import rivals
from rivals import columns as rival_columns

SLOWEST_S = 1800
REFUSED = 65  # the recording is to blame


def digest(*paths):
    whole = hashlib.sha256()
    for path in paths:
        whole.update(path.read_bytes())
    return whole.hexdigest()


@functools.lru_cache(maxsize=1)
def code_of_rivals():
    return digest(*sorted(pathlib.Path(rivals.__file__).parent.glob("*.py")))


def missing_library(method):
    """Why a method cannot be run here, in words; None when it can."""
    module = sys.modules[rivals.METHODS[method].__module__]
    needed, package = getattr(module, "NEEDS", (None, None))
    if needed and importlib.util.find_spec(needed) is None:
        return f"{method} was not run: Python's {needed} is missing (package {package}; scripts/install-deps --rivals)"
    return None


def record(case, found, answer, seconds):
    """The document of one answer."""
    family = {c.name: c.family for c in found.candidates}
    effects = [{"name": name, "family": family[name], **answer.facts.get(name, {})} for name in answer.effects]
    verdict = "none"
    if effects:
        verdict = "data_fault" if all(found[e["name"]].acts_on != "joint" for e in effects) else "named"
    document = {"case": case, "verdict": verdict, "effects": effects,
                "ranking": [{"name": name, "family": family[name]} for name in answer.ranking],
                "remark": answer.remark, "seconds": round(seconds, 3)}
    before = rival_columns.validation_relerr(found, [])
    if before is not None:
        document["unseen"] = {"before": before, "after": rival_columns.validation_relerr(found, answer.effects)}
    return document


def job_numbers(job):
    """q and max_effects of a job; the engine's defaults where it says nothing."""
    import tomllib

    section = tomllib.loads(job.read_text()).get("diagnose", {})
    return {"q": section.get("q", 0.05), "max_effects": section.get("max_effects", 5)}


class Case:
    def __init__(self, program, engine, out, name, methods, keep_columns=False, again=False):
        self.program, self.out, self.name, self.methods, self.keep = program, out, name, methods, keep_columns
        self.folder = out / "open" / name
        recordings = sorted(p for p in self.folder.iterdir() if p.is_file() and p.suffix != ".h5")
        self.made_with = digest(*recordings)[:16] + engine[:16] + code_of_rivals()[:16]
        self.again = again

    def path(self, method):
        return self.out / "rivals" / method / f"{self.name}.json"

    def is_answered(self, method):
        try:
            return not self.again and json.loads(self.path(method).read_text())["made_with"] == self.made_with
        except (OSError, ValueError, KeyError):
            return False

    def write(self, method, document):
        path = self.path(method)
        path.parent.mkdir(parents=True, exist_ok=True)
        unfinished = path.with_suffix(".new")
        unfinished.write_text(json.dumps({**document, "made_with": self.made_with}, indent=1))
        unfinished.replace(path)

    def run(self):
        """-> a line for people"""
        wanted = [method for method in self.methods if not self.is_answered(method)]
        if not wanted:
            return f"{self.name:12} kept"
        file = self.out / "columns" / f"{self.name}.h5"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.unlink(missing_ok=True)
        began = time.monotonic()
        result = subprocess.run([self.program, "diagnose", "job.toml", "--columns", file, "--quiet", "--threads", "1"],
                                cwd=self.folder, capture_output=True, text=True, timeout=SLOWEST_S, check=False)
        if result.returncode == REFUSED:
            for method in wanted:
                self.write(method, {"case": self.name, "verdict": "insufficient", "effects": [],
                                    "reason": result.stderr.strip(), "seconds": 0.0})
            return f"{self.name:12} refused: {result.stderr.strip()}"
        if result.returncode != 0:
            raise RuntimeError(f"{self.name}: diagnose --columns ended with {result.returncode}: {result.stderr}")
        made_s = time.monotonic() - began
        found = rival_columns.read(file, **job_numbers(self.folder / "job.toml"))
        said = []
        for method in wanted:
            began = time.monotonic()
            answer = rivals.METHODS[method](found)
            # the columns are part of every method's work
            document = record(self.name, found, answer, made_s + time.monotonic() - began)
            self.write(method, document)
            said.append(f"{method} {len(document['effects'])}")
        if not self.keep:
            file.unlink()
        return f"{self.name:12} columns in {made_s:5.1f} s; names: {', '.join(said)}"


def run_case(*words):
    return Case(*words).run()


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=pathlib.Path)
    parser.add_argument("out", type=pathlib.Path)
    parser.add_argument("--methods", help="names, separated by commas")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--keep-columns", action="store_true", help="leave OUT/columns/NAME.h5")
    parser.add_argument("--again", action="store_true", help="also what is answered")
    options = parser.parse_args(arguments)
    methods = options.methods.split(",") if options.methods else list(rivals.METHODS)
    unknown = [method for method in methods if method not in rivals.METHODS]
    if unknown:
        print(f"run_rivals.py: no method {', '.join(unknown)}; there are {', '.join(rivals.METHODS)}", file=sys.stderr)
        return 64
    out = options.out.resolve()
    names = sorted(path.parent.name for path in (out / "open").glob("*/job.toml"))
    if not names:
        print(f"run_rivals.py: no case in {out / 'open'}: run_suite.py makes them", file=sys.stderr)
        return 66
    words = {method: why for method in methods if (why := missing_library(method))}
    (out / "rivals").mkdir(exist_ok=True)
    (out / "rivals" / "words.json").write_text(json.dumps(words, indent=1))
    for why in words.values():
        print(why, file=sys.stderr)
    ready = [method for method in methods if method not in words]
    # one thread each: the cases are what is spread
    for library in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
        os.environ[library] = "1"
    program = options.program.resolve()
    engine = digest(program)
    try:
        with concurrent.futures.ProcessPoolExecutor(max(1, options.jobs)) as pool:
            cases = [pool.submit(run_case, program, engine, out, name, ready, options.keep_columns, options.again)
                     for name in names]
            for case in concurrent.futures.as_completed(cases):
                print(case.result(), flush=True)
    except (RuntimeError, subprocess.TimeoutExpired) as problem:
        print(f"run_rivals.py: {problem}", file=sys.stderr)
        return 70
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
