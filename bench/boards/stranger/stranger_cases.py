#!/usr/bin/python3
"""Makes a stranger's cases, has them diagnosed one by one, and scores them.

    stranger_cases.py TORQUESCOPE STRANGER FOLDER [--twins N] [--all-right] [CASE...]     all cases when none is named

What is done already (FOLDER/CASE/seconds) is not done again. --all-right: exit code 1 unless every case is right.
"""
import argparse
import subprocess
import sys
import time
from pathlib import Path

import score


def diagnose(program, folder):
    for old in folder.glob("*.h5*"):
        if old.is_file():
            old.unlink()
    (folder / "verdict.json").unlink(missing_ok=True)
    start = time.monotonic()
    with open(folder / "out.txt", "w") as out:
        try:
            subprocess.run(
                [program, "diagnose", "job.toml", "--json", "verdict.json", "--color", "never", "--progress", "none"],
                cwd=folder,
                stdout=out,
                stderr=subprocess.STDOUT,
                timeout=400,
            )
        except subprocess.TimeoutExpired:
            out.write("no answer within 400 s\n")
    (folder / "seconds").write_text(f"{time.monotonic() - start:.2f}\n")


def main():
    words = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    words.add_argument("torquescope", type=Path)
    words.add_argument("stranger", type=Path)
    words.add_argument("folder", type=Path)
    words.add_argument("cases", nargs="*")
    words.add_argument("--twins", type=int)
    words.add_argument("--all-right", action="store_true")
    asked = words.parse_intermixed_args()
    listed = subprocess.run([asked.stranger, "--list"], check=True, capture_output=True, text=True).stdout
    cases = asked.cases or [line.split()[0] for line in listed.splitlines()]
    for case in cases:
        folder = asked.folder / case
        if (folder / "seconds").exists() and not asked.all_right:
            continue
        subprocess.run([asked.stranger, case, folder], check=True)
        if asked.twins:
            with open(folder / "job.toml", "a") as job:  # [diagnose] is its last section
                job.write(f"twins = {asked.twins}\n")
        diagnose(asked.torquescope.resolve(), folder)
    score.main([str(asked.folder), *cases])
    marks = [score.row(asked.folder / case)[1] for case in cases]
    return 1 if asked.all_right and any(mark != "right" for mark in marks) else 0


if __name__ == "__main__":
    sys.exit(main())
