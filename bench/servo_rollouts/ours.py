"""The same records by our program: `diagnose` as a job of [[recordings]], and the rate of its lanes."""
import csv
import json
import pathlib
import subprocess
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "goals"))
from bench_context import Missing, Run, environment  # noqa: E402

JOB = """[experiment]
name = "servo"
seed = 7

[[recordings]]
manifest = "manifest.csv"

[recording]
columns = {time = "t_s", reference = "q_goal_rad", position = "q_rad", enabled = "torque_enabled"}

[known]
gravity_moment = "9.80665 * mass_kg * length_m"
inertia = "mass_kg * length_m * length_m"
command_gain = "0.165 * kp * supply_v"
command_limit = "0.97 * supply_v"

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb"]

[loop]
drive = "voltage"
rate_hz = 1000

[diagnose]
effects = "all"
"""
KNOWN = ["role", "mass_kg", "length_m", "kp", "supply_v"]


def diagnosis(program, records, folder):
    """CPU seconds of the whole process on one thread, and the JSON that it prints."""
    job = folder / "servo.toml"
    job.write_text(JOB)
    with open(folder / "manifest.csv", "w", newline="") as manifest:
        rows = csv.writer(manifest)
        rows.writerow(["file", *KNOWN])
        rows.writerows([record.file, *[getattr(record, name) for name in KNOWN]] for record in records)
    try:
        run = Run([program, "diagnose", job, "--out", folder / "servo.h5", "--json", "-", "--threads", 1])
    except (OSError, SystemExit) as failed:
        raise Missing(f"ours: {failed}") from failed
    return run.cpu_s, run.printed


def numbers_of(model, p):
    """Numbers of the nearest model of ours. It has one factor of both torques, of half of their difference."""
    torque_per_volt = p["kt"] / p["resistance"]
    ours = {"inertia": p["armature"], "viscous": p["viscous"], "coulomb": p["Fc"], "motor_gain": torque_per_volt,
            "back_emf": torque_per_volt * p["kt"]}
    if "Fs" in p:
        ours |= {"stribeck_friction": p["Fs"], "stribeck_speed": p["vs"]}
    if model in ("M3", "M4"):
        ours |= {"load_friction": min(2 * p["kl"], 1.0)}
    if model == "M4":
        ours |= {"load_stribeck_friction": 2 * p["ks"]}
    if model in ("M5", "M6"):
        ours |= {"load_friction": p["klm"] + p["kle"], "load_stribeck_friction": p["ksm"] + p["kse"]}
    if model == "M6":
        ours |= {"load_square_friction": (p["kqm"] + p["kqe"]) ** 2}
    return ours


def words_of(record, step_s):
    """One track of even samples, the goal and the drive held between them."""
    sample_s = float(np.median(np.diff(record.time_s)))
    ticks = max(1, round(sample_s / step_s))
    even = np.arange(record.time_s[0], record.time_s[-1], ticks * step_s)
    between = 0.5 * (record.time_s[1:] + record.time_s[:-1])
    row = np.searchsorted(between, even, side="right")  # the nearest
    moment, inertia = 9.80665 * record.mass_kg * record.length_m, record.mass_kg * record.length_m ** 2
    yield f"track {len(even)} {1 / (ticks * step_s):.17g} {ticks} {moment:.17g} {inertia:.17g}"
    yield f"{0.165 * record.kp * record.supply_v:.17g} {0.97 * record.supply_v:.17g}"
    for sample in zip(record.goal[row], np.interp(even, record.time_s, record.position), record.enabled[row]):
        yield "{:.17g} {:.17g} {:g}".format(*sample)


def lanes(program, training, cases, step_s, folder, seconds=1.0):
    """Fits a second and rms of each case {name: {number: value}}."""
    if not program.exists():
        raise Missing(f"our lanes: cmake --build --preset bench --target {program.name}")
    file = folder / "servo_tracks.txt"
    with open(file, "w") as written:
        for record in training:
            written.write("\n".join(words_of(record, step_s)) + "\n")
        for name, numbers in cases.items():
            pairs = " ".join(f"{key} {value:.17g}" for key, value in numbers.items())
            written.write(f"case {name} {len(numbers)} {pairs}\n")
    done = subprocess.run([str(program), str(file), str(seconds)], env=environment(), capture_output=True, text=True)
    if done.returncode != 0:
        raise Missing(f"our lanes ended with {done.returncode}: {done.stderr.strip()}")
    lines = [json.loads(line) for line in done.stdout.splitlines()]
    return {line["case"]: line for line in lines}
