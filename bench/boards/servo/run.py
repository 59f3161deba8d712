#!/usr/bin/python3
"""Has drawn servos diagnosed from recordings with several loads, gains and motions, and counts right and false names.

    run.py TORQUESCOPE --seed S --cases N --out DIR [--first K] [--plant MAKE_SERVO_RECORDS] [--timeout SECONDS]
           [--set KEY=VALUE ...] [--records WORDS]

Cases take turns: nothing missing, one law, two, three; which ones is drawn. Cases of DIR that have a verdict are not
diagnosed again.
--first    the number of the first case (0)
--plant    by default the one that was built beside TORQUESCOPE
--set      a line of the job's [diagnose], in TOML
--records  options of make_servo_records, as one word: --records "--motions 3 --lengths 0.15"
"""

import argparse
import json
import random
import shlex
import subprocess
import sys
import time
from pathlib import Path

from grade import grade, kept_names, summary, told

LAWS = ("command_delay", "goal_speed_limit", "goal_acceleration_limit", "load_friction", "load_square", "stribeck",
        "load_stribeck", "dead_band", "punch", "torque_lag", "arm_mass", "angle_friction")
KINDS = 4  # of cases: none to three laws


def words():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("torquescope", type=Path)
    parser.add_argument("--seed", type=int, required=True)
    parser.add_argument("--cases", type=int, required=True, metavar="N")
    parser.add_argument("--out", type=Path, required=True, metavar="DIR")
    parser.add_argument("--first", type=int, default=0, metavar="K")
    parser.add_argument("--plant", type=Path)
    parser.add_argument("--timeout", type=float, default=900.0, metavar="SECONDS")
    parser.add_argument("--set", action="append", default=[], metavar="KEY=VALUE")
    parser.add_argument("--records", type=shlex.split, default=[], metavar="WORDS")
    asked = parser.parse_args()
    if any("=" not in line for line in asked.set):
        parser.error("--set wants KEY=VALUE")
    asked.plant = asked.plant or asked.torquescope.resolve().parent.parent / "bench/boards/servo/make_servo_records"
    for program in (asked.torquescope, asked.plant):
        if not program.is_file():
            parser.error(f"there is no program {program} (--plant names make_servo_records)")
    return asked


def drawn_laws(seed, number):
    return random.Random(f"{seed}/{number}").sample(LAWS, number % KINDS)


def with_settings(job, settings):
    """The text of a job whose last section, [diagnose], has these lines."""
    keys = [line.split("=", 1)[0].strip() for line in settings]
    kept = [line for line in job.splitlines() if line.split("=", 1)[0].strip() not in keys]
    return "\n".join(kept + settings) + "\n"


def moved_mrad(folder):
    """By how much each law of a set moves its servo."""
    return {law["name"]: law["effect_mrad"] for law in json.loads((folder / "truth.json").read_text())["laws"]}


def diagnose(asked, number):
    """-> (truth, document or None, seconds)"""
    case = asked.out / f"case_{asked.seed}_{number}"
    result, took = case / "out.json", case / "seconds"
    if not took.exists():
        seed = 1000 * asked.seed + number  # of the servo and its motions
        subprocess.run([asked.plant, "--seed", str(seed), "--out", case, "--with", *drawn_laws(asked.seed, number),
                        *asked.records], check=True)
        job = case / "job.toml"
        job.write_text(with_settings(job.read_text(), asked.set))
        start = time.monotonic()
        with open(result, "wb") as out, open(case / "out.txt", "wb") as screen:
            try:
                subprocess.run([asked.torquescope.resolve(), "diagnose", "job.toml", "--json", "-", "--out", "out.h5",
                                "--progress", "none", "--color", "never"], cwd=case, stdout=out, stderr=screen,
                               timeout=asked.timeout, check=False)
            except subprocess.TimeoutExpired:
                screen.write(f"\nended after {asked.timeout:.0f} s\n".encode())
        (case / "out.h5").unlink(missing_ok=True)
        took.write_text(f"{time.monotonic() - start:.1f}\n")
    try:
        document = json.loads(result.read_text())
    except ValueError:
        document = {}
    if "verdict" not in document:
        document = None  # why is in out.txt
    return json.loads((case / "truth.json").read_text()), document, float(took.read_text())


def main():
    asked = words()
    graded = []
    for number in range(asked.first, asked.first + asked.cases):
        truth, document, seconds = diagnose(asked, number)
        laws = [law["name"] for law in truth["laws"]]
        named = kept_names(document) if document else None
        verdict = document["verdict"] if document else "no answer"
        graded.append((laws, grade(laws, named)))
        print(f"{number:3}  {told(truth, verdict, named, graded[-1][1])}  {seconds:.0f} s", flush=True)
    print("\n" + summary(graded))


if __name__ == "__main__":
    sys.exit(main())
