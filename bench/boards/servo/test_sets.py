#!/usr/bin/python3
"""A drawn set: its files, the same bytes twice, and that a law moves the servo; the shipped set beside its own numbers.

    test_sets.py MAKE_SERVO_RECORDS JOBS
"""

import csv
import json
import subprocess
import sys
import tempfile
import tomllib
from pathlib import Path

import numpy as np

COUNT = 2 * np.pi / 4096
HEAD = "t_s,q_goal_rad,q_rad,torque_enabled"
MANIFEST = ["file", "role", "mass_kg", "length_m", "kp", "supply_v", "motion"]
FIVE_DIGITS = 1e-4      # rad that a position of five digits may be off
SHIPPED_BYTES = 350_000
OTHER_MACHINE = 2.5 * COUNT  # another sine of the C library may turn a rounding, and what follows from it
SHIPPED = ["--seed", "1", "--with", "command_delay", "goal_speed_limit", "load_friction", "--lengths", "0.15",
           "--motions", "4", "--seconds", "4"]  # jobs/servo_records/README.md says so too


def make(program, folder, *words):
    subprocess.run([program, "--out", folder, *words], check=True)


def rows_of(path):
    text = path.read_text()
    assert text.splitlines()[0] == HEAD, text[:60]
    return np.loadtxt(text.splitlines()[1:], delimiter=",")


def check_files(folder, seconds, least_step=0.01):
    """Every recording of the manifest is there, whole, of a servo that follows; -> the manifest's lines."""
    with open(folder / "manifest.csv", newline="") as file:
        reader = csv.DictReader(file)
        lines = list(reader)
        assert reader.fieldnames == MANIFEST, reader.fieldnames
    records = {path.name for path in folder.glob("*.csv")} - {"manifest.csv"}
    assert records == {line["file"] for line in lines} and len(lines) == len(records), records
    for line in lines:
        t, goal, q, enabled = rows_of(folder / line["file"]).T
        assert len(t) == round(100 * seconds) and t[0] == 0, line
        assert np.min(np.diff(t)) >= least_step - 1e-9, line
        assert np.allclose(q / COUNT, np.round(q / COUNT), atol=FIVE_DIGITS / COUNT), "positions between counts"
        drops = line["motion"] == "lift_and_drop"
        assert set(enabled) == ({0, 1} if drops else {1}), line
        on = enabled == 1
        assert np.ptp(q[on]) > 0.5 * np.ptp(goal[on]), line
        if drops:
            assert np.all(q[-20:] == q[-1]) and abs(q[-1]) < 0.5 < np.max(abs(q)), "it falls and comes to rest"
    return lines


def check_set(program, folder):
    words = ["--seed", "5", "--with", "load_friction", "stribeck"]
    for time in ("first", "again"):
        make(program, folder / time, *words)
    names = sorted(path.name for path in (folder / "first").iterdir())
    assert names == sorted(path.name for path in (folder / "again").iterdir())
    for name in names:
        assert (folder / "first" / name).read_bytes() == (folder / "again" / name).read_bytes(), f"{name} changes"
    lines = check_files(folder / "first", 6)
    assert len(lines) == 3 * 2 * 2 * 5, len(lines)
    assert {(line["role"], line["mass_kg"]) for line in lines} == {("train", "0.5"), ("train", "1"),
                                                                   ("validate", "0.75")}
    assert {line["kp"] for line in lines} == {"8", "32"} and {line["length_m"] for line in lines} == {"0.1", "0.15"}

    truth = json.loads((folder / "first/truth.json").read_text())
    assert [law["name"] for law in truth["laws"]] == ["load_friction", "stribeck"], truth
    assert all(law["effect_mrad"] > 0 for law in truth["laws"]), truth
    job = tomllib.loads((folder / "first/job.toml").read_text())
    assert job["recordings"] == [{"manifest": "manifest.csv"}] and job["loop"]["drive"] == "voltage", job

    # the same motions without the laws: another answer to the same goals
    make(program, folder / "base", "--seed", "5")
    assert json.loads((folder / "base/truth.json").read_text())["laws"] == []
    differences = []
    for line in lines:
        with_laws, base = (rows_of(folder / which / line["file"]).T for which in ("first", "base"))
        assert np.array_equal(with_laws[1], base[1]), "the goals are the seed's"
        differences.append(np.mean(abs(with_laws[2] - base[2])))
    assert np.mean(differences) > 2 * COUNT, differences
    print(f"{len(lines)} recordings; load friction and Stribeck move the servo {1e3 * np.mean(differences):.1f} mrad")


def check_options(program, folder):
    make(program, folder, "--seed", "5", "--masses", "0.3", "--unseen", "0.4", "--kps", "16", "--lengths", "0.1",
         "--motions", "6", "--seconds", "4", "--jitter", "0.001")
    lines = check_files(folder, 4, least_step=0.008)
    assert len(lines) == 12 and lines[5]["file"] == "m0.3_l100_kp16_two_sines_2.csv", lines
    for words, why in ((["--with", "stribek"], "no law is called stribek"), (["--motions", "0"], "is not between"),
                       (["--mass", "1"], "no option is called --mass"), (["--kps", "8a"], "8a is no number")):
        refused = subprocess.run([program, "--out", folder, *words], capture_output=True, text=True, check=False)
        assert refused.returncode == 64 and why in refused.stderr, refused


def check_shipped(program, jobs, folder):
    """jobs/servo_records is what the program writes, and jobs/servo_loads.toml what it says of a set."""
    records = jobs / "servo_records"
    lines = check_files(records, 4)
    assert sum(path.stat().st_size for path in records.iterdir()) < SHIPPED_BYTES
    make(program, folder, *SHIPPED)
    assert (records / "manifest.csv").read_bytes() == (folder / "manifest.csv").read_bytes()
    for line in lines:
        shipped, made = (rows_of(where / line["file"]) for where in (records, folder))
        assert np.max(abs(shipped - made)) < OTHER_MACHINE, f"{line['file']} is not what seed 1 gives"
    shipped, made = (tomllib.loads(path.read_text()) for path in (jobs / "servo_loads.toml", folder / "job.toml"))
    assert shipped.pop("experiment")["name"] == "servo_loads" and made.pop("experiment")
    shipped["recordings"] = [{"manifest": Path(one["manifest"]).name} for one in shipped["recordings"]]
    assert shipped == made, shipped


def main(program, jobs):
    with tempfile.TemporaryDirectory() as folder:
        check_set(program, Path(folder) / "set")
        check_options(program, Path(folder) / "options")
        check_shipped(program, Path(jobs), Path(folder) / "shipped")


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2]))
