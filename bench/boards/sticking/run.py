#!/usr/bin/python3
"""Has drawn joints diagnosed whose friction sticks in several ways, and counts false names and right ones.

    run.py TORQUESCOPE --seed S --clean N --single N [--plant MAKE_STICKING_CASE] [--jobs J] [--set KEY=VALUE ...]
           [--keep DIR]

--set    a line of the job's [diagnose], in TOML: --set twins=200 --set 'q=0.02'
--keep   cases and verdicts stay in DIR; those of DIR that have a verdict are not diagnosed again
--plant  by default the one that was built beside TORQUESCOPE
One line a case and the counts are printed; README.md says what the grades mean.
"""

import argparse
import concurrent.futures
import json
import subprocess
import sys
import tempfile
import time
from pathlib import Path

from grade import grade, summary, told

LONGEST_S = 3600  # for one diagnosis


def words():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("torquescope", type=Path)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--clean", type=int, default=0, metavar="N")
    parser.add_argument("--single", type=int, default=0, metavar="N")
    parser.add_argument("--plant", type=Path)
    parser.add_argument("--jobs", type=int, default=1, metavar="J")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--keep", type=Path, metavar="DIR")
    asked = parser.parse_args()
    if any("=" not in line for line in asked.set):
        parser.error("--set wants KEY=VALUE")
    beside = asked.torquescope.resolve().parent.parent / "bench/boards/sticking/make_sticking_case"
    asked.plant = asked.plant or beside
    for program in (asked.torquescope, asked.plant):
        if not program.is_file():
            parser.error(f"there is no program {program} (--plant names make_sticking_case)")
    return asked


def with_settings(job, settings):
    """The text of a job with lines of its last section, [diagnose], replaced or added."""
    head, section, tail = job.rpartition("[diagnose]\n")
    lines = dict(line.split(" = ", 1) for line in tail.strip().splitlines())
    lines |= {key.strip(): value.strip() for key, value in (line.split("=", 1) for line in settings)}
    return head + section + "".join(f"{key} = {value}\n" for key, value in lines.items())


def diagnose(asked, folder, kind, number):
    """-> (truth, verdict or None, seconds); what DIR has already is not done again."""
    case = folder / f"{kind}_{asked.seed}_{number}"
    result, took = case / "out.json", case / "seconds"
    if not took.exists():
        subprocess.run([asked.plant, str(asked.seed), str(number), kind, case], check=True)
        job = case / "job.toml"
        job.write_text(with_settings(job.read_text(), asked.set))
        result.unlink(missing_ok=True)
        start = time.monotonic()
        with open(case / "out.txt", "w", encoding="utf-8") as out:
            try:
                subprocess.run([asked.torquescope.resolve(), "diagnose", "job.toml", "--json", "out.json", "--out",
                                "out.h5", "--progress", "none", "--color", "never", "--threads", "1"],
                               cwd=case, stdout=out, stderr=subprocess.STDOUT, timeout=LONGEST_S, check=False)
            except subprocess.TimeoutExpired:
                result.unlink(missing_ok=True)
        (case / "out.h5").unlink(missing_ok=True)
        took.write_text(f"{time.monotonic() - start:.1f}\n")
    verdict = json.loads(result.read_text()) if result.exists() else None
    return json.loads((case / "truth.json").read_text()), verdict, float(took.read_text())


def main():
    asked = words()
    with tempfile.TemporaryDirectory() as scratch:
        folder = asked.keep or Path(scratch)
        cases = [("clean", n) for n in range(asked.clean)] + [("single", n) for n in range(asked.single)]
        graded = []
        with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
            for (kind, number), (truth, verdict, seconds) in zip(
                    cases, pool.map(lambda case: diagnose(asked, folder, *case), cases)):
                graded.append((truth, grade(truth, verdict)))
                print(f"{kind:6} {number:3}  {told(truth, verdict, graded[-1][1])}  {seconds:.0f} s", flush=True)
    print("\n" + summary(graded))


if __name__ == "__main__":
    sys.exit(main())
