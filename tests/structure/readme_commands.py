"""A newcomer with a CSV follows the documents: every block that is marked as a test runs, document by document.

    readme_commands.py ROOT PROGRAM

Marked is a fenced block behind the comment `<!-- test -->`: its commands must succeed, with the folder of PROGRAM first
on the PATH. A block behind `<!-- test: NAME -->` is a job: it is written to NAME, and `torquescope check NAME` must
find nothing wrong. The blocks of one document follow each other in one folder. At first it holds recordings of one
joint (mine.csv, joint.csv, joint_other_motion.csv) and a link to the jobs of ROOT. A diagnosis of mine.csv must name
what the recording conceals. The recordings are made here, by numpy alone: a joint with a controller, an encoder, noise
and Stribeck friction, which no template has.
"""
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

BLOCK = re.compile(r"^<!-- test(?:: (?P<name>\S+))? -->\n```\w+\n(?P<text>.*?)^```$", re.DOTALL | re.MULTILINE)
VERDICT = re.compile(r"^. (NAMED|ONE OF A CLASS|NOTHING MISSING|UNEXPLAINED|INSUFFICIENT|DATA FAULT)\b", re.MULTILINE)
MINUTES = 5  # for one block, on a busy machine

RATE_HZ, SUBSTEPS, SECONDS = 500, 10, 20
INERTIA, VISCOUS, COULOMB = 0.10, 0.6, 0.8           # kg m2, N m s/rad, N m
STRIBECK, STRIBECK_SPEED = 0.5, 0.08                 # N m, rad/s: what the model lacks
STIFFNESS, DAMPING = 400.0, 20.0                     # of the controller, N m/rad and N m s/rad
COUNTS, TORQUE_NOISE, TORQUE_CONSTANT = 131072, 0.02, 0.105


def recording(motion, seed):
    """Rows t, commanded position, position, torque of a joint under proportional-derivative control.

    Dry friction takes from the speed of each step what it can, and never turns it round.
    """
    noise = np.random.default_rng(seed)
    t = np.arange(SECONDS * RATE_HZ) / RATE_HZ
    wanted = motion(t)
    wanted_speed = np.gradient(wanted, 1 / RATE_HZ)
    step, count = 1 / (RATE_HZ * SUBSTEPS), 2 * np.pi / COUNTS
    q, speed, seen_before = wanted[0], wanted_speed[0], wanted[0]
    rows = np.empty((len(t), 4))
    for k, at in enumerate(t):
        seen = count * round(q / count)
        torque = STIFFNESS * (wanted[k] - seen) + DAMPING * (wanted_speed[k] - (seen - seen_before) * RATE_HZ)
        seen_before = seen
        rows[k] = at, wanted[k], seen, torque + TORQUE_NOISE * noise.standard_normal()
        for _ in range(SUBSTEPS):
            free = speed + step * (torque - VISCOUS * speed) / INERTIA
            lost = step * (COULOMB + STRIBECK * math.exp(-(speed / STRIBECK_SPEED) ** 2)) / INERTIA
            speed = math.copysign(max(abs(free) - lost, 0.0), free)
            q += step * speed
    return rows


def write(path, rows, torque_name, torque_unit=1.0):
    with open(path, "w", encoding="utf-8") as file:
        file.write(f"t_s,q_ref_rad,q_rad,{torque_name}\n")
        for t, wanted, seen, torque in rows:
            file.write(f"{t:.4f},{wanted:.8f},{seen:.8f},{torque / torque_unit:.5f}\n")


def training_motion(t):
    return 0.6 * np.sin(0.2 * np.pi * t) + 0.35 * np.sin(0.46 * np.pi * t) + 0.12 * np.sin(1.42 * np.pi * t)


def other_motion(t):
    return 0.5 * np.sin(0.26 * np.pi * t) + 0.3 * np.sin(0.62 * np.pi * t) + 0.15 * np.sin(1.06 * np.pi * t)


def run(commands, folder, program):
    """What the commands said; SystemExit with it when one of them failed."""
    path = f"{program.parent}:{os.environ['PATH']}"
    environment = {**os.environ, "PATH": path, "LC_ALL": "C.UTF-8", "OMP_NUM_THREADS": "2"}
    done = subprocess.run(["bash", "-eu", "-c", commands], cwd=folder, env=environment, stdin=subprocess.DEVNULL,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=60 * MINUTES,
                          check=False)
    if done.returncode != 0:
        raise SystemExit(f"exit code {done.returncode} of\n{commands}\n{done.stdout}")
    return done.stdout


def check_verdict(said, folder):
    """The five lines of the README end with a name, a result and a page."""
    verdict = VERDICT.search(said)
    assert verdict and verdict[1] in ("NAMED", "ONE OF A CLASS"), f"the concealed friction has no name in\n{said}"
    assert "Stribeck" in " ".join(said.split()), f"the concealed friction has another name in\n{said}"
    for result in ("mine.h5", "mine.html"):
        assert (folder / result).stat().st_size > 10_000, f"{result} is missing or empty after\n{said}"
    print(f"  five lines of a document and an own CSV: {verdict[0]}")


def follow(blocks, root, program, train, validate):
    """Every marked block of one document, in order."""
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "jobs").symlink_to((root / "jobs").resolve())
        write(folder / "mine.csv", train, "tau_Nm")
        write(folder / "joint.csv", train, "i_A", TORQUE_CONSTANT)
        write(folder / "joint_other_motion.csv", validate, "i_A", TORQUE_CONSTANT)
        for block in blocks:
            if block["name"]:
                (folder / block["name"]).write_text(block["text"], encoding="utf-8")
                run(f"torquescope check {block['name']}", folder, program)
                print(f"  passes torquescope check: {block['name']}")
            else:
                said = run(block["text"], folder, program)
                if "diagnose job.toml" in block["text"]:
                    check_verdict(said, folder)


def main(root, program):
    root, program = pathlib.Path(root), pathlib.Path(program).resolve()
    train, validate = recording(training_motion, 1), recording(other_motion, 2)
    kinds = []
    for document in sorted(root.rglob("*.md")):
        if {"build", ".git"} & set(document.relative_to(root).parts):
            continue
        blocks = list(BLOCK.finditer(document.read_text(encoding="utf-8")))
        if not blocks:
            continue
        name = document.relative_to(root).as_posix()
        print(f"{name}: {len(blocks)} blocks", flush=True)
        follow(blocks, root, program, train, validate)
        kinds += [(name, bool(block["name"])) for block in blocks]
    assert ("README.md", False) in kinds, "README.md has no block of commands that is marked as a test"
    assert ("jobs/README.md", False) in kinds, "jobs/README.md has no block of commands that is marked as a test"
    assert ("jobs/README.md", True) in kinds, "jobs/README.md has no job that is marked as a test"
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
