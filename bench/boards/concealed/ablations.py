"""What the parts of the method bring: the suite once more for each part that is taken away, the same recordings, one
key of the job changed.

    ablations.py PROGRAM MAKE_CASE OUT --drawn FILE_OR_NAMES [--only NAME,NAME] [--shard I/N] [--jobs N] [--threads N]

OUT is a folder of run_suite.py; cases that are missing there are made, and diagnosed as they are. Resumable as
run_suite.py is.

    OUT/ablations/NAME/open/CASE      the edited job, links to the recordings; verdicts, results, logs beside
    OUT/rivals/ablation_NAME/CASE.json   the same verdict, its seconds with it: the scorer puts it beside the rivals
    OUT/ablations/board.json          the table that is printed

Exit code: 0 whatever the table says; 64 usage; 70 when make_case fails.
"""

import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import sys

import ablation_score
import run_suite
import shard


def with_key(key, value):
    """-> an edit that sets [diagnose] key = value, whatever stood there."""
    def edit(job):
        job = re.sub(rf"(?m)^{key} *=.*\n", "", job)
        if "[diagnose]\n" not in job:
            raise ValueError("the job has no section [diagnose]")
        return job.replace("[diagnose]\n", f"[diagnose]\n{key} = {value}\n")
    return edit


def with_level(key, value):
    """-> an edit that sets a number of the decision, [diagnose.levels] key = value."""
    def edit(job):
        if "[diagnose]\n" not in job:
            raise ValueError("the job has no section [diagnose]")
        return f"{job.rstrip()}\n\n[diagnose.levels]\n{key} = {value}\n"
    return edit


def without_reference(job):
    """No reference in the recording's columns: the loop cannot be identified, replicates track the measured motion."""
    key = r'reference *= *"[^"]*"'
    edited = re.sub(rf"\b{key} *, *|, *{key}", "", job)
    if edited == job:
        raise ValueError("the job names no reference column")
    return edited


# a name, and what it does to the job
ABLATIONS = {
    "no_delay": with_level("longest_delay", "0"),
    "one_sticking": with_level("sticking_odds", "1"),
    "any_size": with_key("delta", "0"),
    "any_fall": with_key("least_fall", "0"),
    "any_power": with_key("tolerance", "1"),
    "one_refined": with_level("refined", "1"),
    "no_early_end": with_level("exceedances", "1000"),
    "own_columns": with_level("same_columns", "0"),
    "beam_of_one": with_level("beam", "1"),
    "controller_unknown": without_reference,
}


class Ablated(run_suite.Suite):
    """The suite of one ablation: recordings of the whole suite, jobs edited."""

    def __init__(self, whole, name):
        super().__init__(whole.program, whole.make_case, whole.out / "ablations" / name, whole.threads)
        self.whole, self.edit = whole, ABLATIONS[name]
        self.published = whole.out / "rivals" / f"ablation_{name}"
        self.published.mkdir(parents=True, exist_ok=True)

    def make(self, name, words):
        """Returns the seal of recordings and job: an edit that changes is diagnosed again."""
        seal = self.whole.make(name, words)
        source, folder = self.whole.out / "open" / name, self.out / "open" / name
        folder.mkdir(exist_ok=True)
        for file in run_suite.OPEN:
            (folder / file).unlink(missing_ok=True)
            if file == "job.toml":
                (folder / file).write_text(self.edit((source / file).read_text()))
            else:
                os.link(source / file, folder / file)
        self.note(name, plant=self.plant, seal=seal, made_s=0.0)
        return f"{seal} {run_suite.digest(folder / 'job.toml')}"

    def run(self, name, words):
        super().run(name, words)
        verdict, published = self.out / "verdicts" / f"{name}.json", self.published / f"{name}.json"
        published.unlink(missing_ok=True)
        if verdict.exists():
            document = json.loads(verdict.read_text())
            published.write_text(json.dumps({**document, "seconds": self.made[name]["diagnosed"]["seconds"]}))


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "make_case", "out"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument(
        "--drawn", required=True, help="names of drawn cases: a file, one per line, or separated by commas"
    )
    parser.add_argument("--only", help="ablations, separated by commas")
    parser.add_argument("--shard", help="I/N: as run_suite.py")
    parser.add_argument("--jobs", type=int, default=1, help="cases at a time")
    parser.add_argument("--threads", type=int, default=0, help="threads of each diagnosis; 0: as it likes")
    options = parser.parse_args(arguments)
    options.clean = options.cases = None
    wanted = options.only.split(",") if options.only else list(ABLATIONS)
    unknown = [name for name in wanted if name not in ABLATIONS]
    cases = run_suite.wanted_cases(options, options.make_case.resolve())
    if unknown or isinstance(cases, str):
        why = f"no ablation {', '.join(unknown)}; there are {', '.join(ABLATIONS)}" if unknown else cases
        print(f"ablations.py: {why}", file=sys.stderr)
        return 64
    if options.shard:
        cases = {name: cases[name] for name in shard.share(list(cases), shard.of(options.shard, {}))}
    whole = run_suite.Suite(
        options.program.resolve(), options.make_case.resolve(), options.out.resolve(), options.threads
    )
    suites = {"torquescope": whole, **{name: Ablated(whole, name) for name in wanted}}
    rows = {}
    try:
        for name, suite in suites.items():
            print(f"\n{name}", flush=True)
            with concurrent.futures.ThreadPoolExecutor(max(1, options.jobs)) as pool:
                for done in [pool.submit(suite.run, *case) for case in cases.items()]:
                    done.result()
            rows[name] = ablation_score.row(suite.out / "verdicts", whole.out / "sealed", cases)
    except (RuntimeError, ValueError) as problem:
        print(f"ablations.py: {problem}", file=sys.stderr)
        return 70
    print("\n" + "\n".join(ablation_score.table_lines(rows)))
    (whole.out / "ablations" / "board.json").write_text(json.dumps(rows, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
