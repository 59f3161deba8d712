"""Diagnoses recordings of real machines and grades what is said of them.

    run_real.py PROGRAM FOLDER OUT [--twins N] [--only NAME]... [--threads N]

FOLDER has jobs and answers as README.md says; it is read only. Cases run one after another. Ended before its time, the
same command goes on: a case that was finished by this program, with this job and these recordings, is not run again.
--only takes the beginning of a name, several times if need be.

    OUT/tree/...        the jobs, beside links to their recordings
    OUT/NAME.json, .h5, .txt   verdict, result, screen
    OUT/made.json       which case was run with what
    OUT/real.json       the table, for scripts/report/build_board.py

Exit code 0 whatever the grades; 66 when FOLDER has no answers or lacks a job; 64 usage. Without FOLDER nothing is done
but saying so, and the exit code is 0.
"""

import argparse
import hashlib
import json
import os
import pathlib
import subprocess
import sys
import time

import answers
import grading
import job_copy

SLOWEST_S = 3600  # of one diagnosis: beyond this it hangs


class Runs:
    """What was run so far, in OUT/made.json."""

    def __init__(self, program, folder, out, options):
        self.program, self.folder, self.out, self.options = program, folder, out, options
        self.notes = out / "made.json"
        self.made = json.loads(self.notes.read_text()) if self.notes.exists() else {}
        self.engine = hashlib.sha256(program.read_bytes()).hexdigest()

    def note(self, name, facts):
        self.made[name] = facts
        unfinished = self.notes.with_suffix(".new")
        unfinished.write_text(json.dumps(self.made, indent=1, sort_keys=True))
        unfinished.replace(self.notes)

    def job_of(self, name):
        """FOLDER/jobs/NAME.toml; a name with a folder in it is a path in FOLDER."""
        return self.folder / (f"{name}.toml" if "/" in name else f"jobs/{name}.toml")

    def run(self, name):
        """True when the program was run, False when its answer was there already."""
        job = self.job_of(name)
        text = job_copy.with_twins(job.read_text(encoding="utf-8"), self.options.twins)
        facts = {"engine": self.engine, "job": job_copy.digest(job, text)}
        known = self.made.get(name, {})
        if {key: known.get(key) for key in facts} == facts and known.get("exit_code") is not None:
            return False
        copy = job_copy.place(self.folder, job, self.out / "tree", text)
        verdict, result, screen = (self.file(name, kind) for kind in ("json", "h5", "txt"))
        for old in (verdict, result):
            old.unlink(missing_ok=True)
        command = [self.program, "diagnose", copy, "--all", "--color", "never", "--progress", "none", "--json", verdict,
                   "--out", result]
        if self.options.threads:
            command += ["--threads", str(self.options.threads)]
        began = time.monotonic()
        with open(screen, "w", encoding="utf-8") as log:
            try:
                code = subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, timeout=SLOWEST_S).returncode
            except subprocess.TimeoutExpired:
                code = 124
        self.note(name, {**facts, "exit_code": code, "seconds": round(time.monotonic() - began, 1),
                         "twins": self.options.twins})
        return True

    def file(self, name, kind):
        return self.out / f"{name.replace('/', '.')}.{kind}"

    def said(self, name):
        try:
            document = json.loads(self.file(name, "json").read_text(encoding="utf-8"))
        except (OSError, ValueError):
            document = None
        screen = self.file(name, "txt")
        return grading.said_of(document, screen.read_text(encoding="utf-8") if screen.exists() else "")

    def row(self, name, answer):
        """One case of the table, as JSON."""
        said = self.said(name)
        grade, why = grading.grade(said, answer) if answer else (None, "no answer is given")
        return {
            "case": name,
            "verdict": said.verdict,
            "names": [{"name": one["name"], "equivalent": one.get("equivalent") or []}
                      for one in grading.names_of(said)],
            **{key: getattr(said, key) for key in ("rows", "before", "after", "explained")},
            "grade": grade,
            "why": why,
            "truth": answer.truth if answer else "",
            "seconds": self.made[name]["seconds"],
        }


def board_of(rows):
    """{schema, grades: {grade: how many}, gains_nothing, cases}"""
    graded = [row for row in rows if row["grade"]]
    kept = [row for row in rows if row["names"] and None not in (row["before"], row["after"])]
    return {
        "schema": 1,
        "grades": {grade: sum(row["grade"] == grade for row in graded) for grade in grading.GRADES},
        "with_names": len(kept),
        "gains_nothing": sum(row["after"] > (1.0 - grading.least_fall()) * row["before"] for row in kept),
        "cases": rows,
    }


def percent(share):
    return "-" if share is None else f"{100 * share:.1f}"


def explained(row):
    """Share of what is missing that the names explain."""
    return "-" if row["explained"] is None else f"{100 * row['explained']:.0f}"


def line(row):
    """As a line of the terminal."""
    names = "; ".join(one["name"] + (f" [{'|'.join(one['equivalent'])}]" if one["equivalent"] else "")
                      for one in row["names"])
    why = f" ({row['why']})" if row["why"] else ""
    rows = {"unseen": "unseen", "cross-validated": "CV"}.get(row["rows"], "-")
    return (f"{row['case']:22} {(row['grade'] or '-'):10} {row['verdict']:12} {rows:6} {percent(row['before']):>7} "
            f"{percent(row['after']):>7} {explained(row):>12}  {row['seconds']:6.0f}  {names or '-'}{why}")


def head():
    return (f"{'recording':22} {'grade':10} {'verdict':12} {'rows':6} {'before':>7} {'after':>7} "
            f"{'explained':>12}  {'s':>6}  names\n"
            f"{'':53} {'% of the torque':>15} {'% of missing':>12}")


def cases_of(folder, known, only):
    """Names of the cases to run: the jobs of FOLDER/jobs, and answered ones that are elsewhere in FOLDER."""
    names = sorted({path.stem for path in folder.glob("jobs/*.toml")} | set(known))
    return [name for name in names if not only or any(name.startswith(one) for one in only)]


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    for name in ("program", "folder", "out"):
        parser.add_argument(name, type=pathlib.Path)
    parser.add_argument("--twins", type=int, help="of every job, instead of its own number")
    parser.add_argument("--only", action="append", default=[], help="cases whose name begins so")
    parser.add_argument("--threads", type=int, default=0, help="of each diagnosis; 0: as it likes")
    options = parser.parse_args(arguments)
    if not options.folder.is_dir():
        print(f"skipped: no folder {options.folder}; real recordings belong to others and are not part of the "
              "repository (bench/boards/real/README.md)")
        return 0
    try:
        known = answers.read(options.folder / "answers.json")
    except answers.Unusable as problem:
        print(f"run_real.py: {problem}", file=sys.stderr)
        return 66
    names = cases_of(options.folder, known, options.only)
    if not names:
        print(f"run_real.py: no case begins with {' or '.join(options.only)}; there are {', '.join(sorted(known))}",
              file=sys.stderr)
        return 64
    options.out.mkdir(parents=True, exist_ok=True)
    runs = Runs(options.program.resolve(), options.folder, options.out.resolve(), options)
    if absent := [name for name in names if not runs.job_of(name).exists()]:
        print(f"run_real.py: {options.folder / 'answers.json'}: cases.{absent[0]}: there is no job "
              f"{runs.job_of(absent[0])}; write one, or take the answer out", file=sys.stderr)
        return 66
    rows = []
    print(head(), flush=True)
    for name in names:
        fresh = runs.run(name)
        rows.append(runs.row(name, known.get(name)))
        print(line(rows[-1]) + ("" if fresh else "  (kept)"), flush=True)
    board = board_of(rows)
    (options.out / "real.json").write_text(json.dumps(board, indent=1))
    counted = ", ".join(f"{grade} {n}" for grade, n in board["grades"].items())
    print(f"\n{len(rows)} recordings: {counted}; names that lower the held-out error by less than "
          f"{100 * grading.least_fall():.0f} %: {board['gains_nothing']} of {board['with_names']}")
    return 0


if __name__ == "__main__":
    os.environ.setdefault("OMP_WAIT_POLICY", "passive")
    sys.exit(main(sys.argv[1:]))
