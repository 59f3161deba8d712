"""Recordings as people really have them: what `check`, `run` and `diagnose` must say of each (../shared/cases).

The recordings are not ours to give: the tests are skipped with a message where the folder is absent. Each case names
the finding that `check` must report, the exit code of `run`, and the parameters that `run` must give. Verdicts of
`diagnose` take minutes and come with TORQUESCOPE_FULL=1. What is expected is what the README of the case calls right.
Where the program does not get there, the row says so as a known miss: it is printed and counted, never as passed.
Use: TORQUESCOPE=build/release/bin/torquescope /usr/bin/python3 tests/cases/run_cases.py [CASE...]
"""

import json
import os
import pathlib
import subprocess
import sys
import tempfile
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = pathlib.Path(os.environ.get("TORQUESCOPE_CASES", ROOT.parent / "shared" / "cases"))
PROGRAM = os.environ.get("TORQUESCOPE", str(ROOT / "build/release/bin/torquescope"))
FULL = bool(os.environ.get("TORQUESCOPE_FULL"))

SOUND = {"inertia": 0.09, "viscous": 0.35, "coulomb": 0.6}  # the plant behind most cases
# the arm of three joints: frictions, and first moments that the masses of its URDF give
ARM_FRICTION = {"viscous_1": 0.5, "viscous_2": 0.8, "viscous_3": 0.3, "coulomb_1": 0.4, "coulomb_2": 0.6,
                "coulomb_3": 0.25}
ARM = {**ARM_FRICTION, "mxr2": 0.525, "mx3": 0.12}
ARM_FINDINGS = ["arm_setup", "arm_changes_at", "beyond_limits"]
NO_TOLERANCE_BEYOND = 0.05  # of each parameter: what the sound copy is off by, and as much again


class Case:
    """found: codes that `check` reports (all of them); run: exit code of `run`; values: parameters that `run` gives;
    unsaid: codes that `check` must not report; says: words of `check` or `run`; verdict: what `diagnose` may say;
    advised: (text, text) of the job, written as the program advises; drafted: a recording that `init` drafts the job
    from, and the columns it must write; known_miss:
    (what `diagnose` says instead, why). A known miss that is none any more fails."""

    def __init__(self, folder, found=(), run=0, values=None, says=(), job="job.toml", verdict=None, sound=False,
                 unsaid=(), advised=None, drafted=None, known_miss=None):
        self.folder, self.found, self.run, self.values = folder, found, run, values
        self.unsaid = unsaid
        self.says, self.job, self.verdict, self.sound = says, job, verdict, sound
        self.advised, self.drafted, self.known_miss = advised, drafted, known_miss

    @property
    def name(self):
        name = self.folder if self.job == "job.toml" else f"{self.folder}/{self.job}"
        return name + (" as advised" if self.advised else " as drafted" if self.drafted else "")

    def job_in(self, folder):
        """The job file: that of the case, or its copy with the advice followed, beside links to the recordings."""
        job = CASES / self.folder / self.job
        if not self.advised:
            return job
        for data in [*job.parent.glob("*.gz"), *job.parent.glob("*.urdf")]:
            (pathlib.Path(folder) / data.name).symlink_to(data)
        text = job.read_text()
        assert self.advised[0] in text, f"{job} does not hold {self.advised[0]}"
        copy = pathlib.Path(folder) / self.job
        copy.write_text(text.replace(*self.advised))
        return copy


def drafted_by_init(case, folder):
    """The job that `init` writes, what it said, and what is wrong with its columns."""
    recording, columns = case.drafted
    job = pathlib.Path(folder) / "job.toml"
    command = [PROGRAM, "init", str(CASES / case.folder / recording), "--out", str(job), "--color", "never"]
    result = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=600, check=False)
    if result.returncode:
        return job, result.stderr, [f"init ends with {result.returncode}: {result.stderr.strip()[-300:]}"]
    written = tomllib.loads(job.read_text())["recording"]["columns"]
    return job, result.stderr, [f"init takes {written}, not {columns}"] if written != columns else []


NONE = ("none",)
CASE_LIST = [
    Case("00_baseline", values=SOUND, sound=True, verdict=NONE),
    Case("01a_wrap_many", ["position_wraps"], values=SOUND, verdict=NONE),
    Case("01c_wrap_few_noref", ["position_wraps"], values=SOUND, verdict=NONE),
    Case("02_counts_int16", ["position_wraps"], values=SOUND, verdict=NONE),
    Case("03_current_uint16", ["unsigned_register"], values=SOUND, verdict=NONE),
    Case("03c_uint16_after_the_advice", ["unsigned_register"], run=65, says=["sign"], verdict=("data_fault",)),
    Case("04_permille", ["unit_of_current"], run=65, says=["torque_per_unit"], verdict=("data_fault",)),
    Case("05_degrees", ["unit_in_name"], run=65, says=["position_per_unit = 0.01745"], verdict=("data_fault",)),
    Case("06a_stale_packets", ["rows_repeated"], values=SOUND, verdict=NONE),
    Case("06c_stale_named_elasticity", ["rows_repeated"], values=SOUND, verdict=("none", "data_fault")),
    Case("06c_stale_named_elasticity", ["rows_repeated"], job="job_06s4.toml", verdict=("none", "data_fault")),
    Case("06c_stale_named_elasticity", ["rows_repeated"], job="job_06s7.toml", verdict=("none", "data_fault")),
    Case("06c_stale_named_elasticity", ["rows_repeated"], job="job_06s8.toml", verdict=("none", "data_fault")),
    Case("07_position_zero_tick", ["single_wrong_rows"], values=SOUND, says=["2313", "5122", "8779"], verdict=NONE),
    Case("08b_torque_glitch", ["torque_spikes"], values=SOUND, says=["4002", "7002"], verdict=NONE),
    Case("09a_clock_jump_forward", ["clock_was_set"], values=SOUND, verdict=NONE),
    Case("09b_clock_small_step", values=SOUND, says=["even grid"], verdict=NONE),
    Case("09c_rows_out_of_order", ["rows_out_of_order"], values=SOUND, verdict=NONE),
    Case("10a_bursts_jitter", ["stamps_of_arrival"], values=SOUND, says=["500 Hz"], verdict=NONE),
    Case("10b_bursts_equal", ["stamps_of_arrival"], values=SOUND, says=["500 Hz"], verdict=NONE),
    Case("11_sign_inverted", run=65, says=["sign"], verdict=("data_fault",)),
    Case("12_velocity_absolute", ["velocity_contradicts"], values=SOUND, verdict=NONE),
    Case("13_velocity_rpm", ["velocity_factor"], values=SOUND, says=["rpm"], verdict=NONE),
    Case("14_velocity_lagging", ["velocity_late"], values=SOUND, verdict=NONE),
    Case("14_velocity_lagging", ["velocity_late"], values=SOUND, job="job_unseen.toml", verdict=NONE),
    Case("14b_velocity_good", values=SOUND, sound=True, verdict=NONE),
    Case("14c_velocity_minus", ["velocity_factor"], values=SOUND, verdict=NONE),
    Case("15a_other_joints_torque", ["less_than_none"], run=65, says=["makes negative what cannot be"],
         verdict=("data_fault",)),
    Case("15b_command_as_position", ["command_as_position"], verdict=("data_fault",)),
    Case("16_two_publishers", ["rows_interleaved"], run=65, verdict=("data_fault",)),
    Case("17_every_row_twice", ["rows_repeated"], values=SOUND, verdict=NONE),
    Case("19_load_dependent", sound=True, verdict=("named", "one_of_class", "class")),
    Case("20_torque_switched_off", ["torque_switched_off"], verdict=("none", "named", "class", "unexplained")),
    Case("21_box_too_small", says=["bound"], verdict=NONE),
    Case("22_hdf5_states", values=SOUND, job="job_good.toml", sound=True),
    Case("22_hdf5_states", values=SOUND, job="job_left_open.toml"),
    Case("22_hdf5_states", values=SOUND, job="job_left_swmr.toml"),
    Case("22_hdf5_states", run=65, job="job_truncated.toml"),
    Case("22_hdf5_states", run=(65, 78), job="job_lengths_differ.toml"),
    Case("24_rostopic_echo_p", ["time_unit"], values=SOUND, verdict=NONE),
    Case("25_milliseconds_4kHz", ["time_unit"], values=SOUND, says=["time_per_unit"], verdict=NONE),
    Case("25_milliseconds_4kHz", run=65, says=["cut-off"], job="job_as_advised.toml"),
    Case("26_decimal_comma", values=SOUND, verdict=NONE),
    Case("27_rates_differ", values=SOUND, verdict=NONE),
    Case("27_rates_differ", values=SOUND, verdict=NONE,
         advised=('train = ["a.csv.gz", "b.csv.gz"]', 'train = "a.csv.gz"\nvalidate = "b.csv.gz"')),
    Case("28_nan_hole", ["stretch_left_out"], values=SOUND, verdict=NONE),
    Case("29_torque_30ms_late", verdict=("data_fault",)),
    Case("31_uneven_directions", sound=True, verdict=("named", "class")),
    Case("32_float32_far_out", values=SOUND, sound=True, verdict=NONE),
    Case("33_resonance", sound=True, verdict=("named", "class")),
    Case("34_velocity_constant", ["velocity_constant"], values=SOUND, verdict=NONE),
    Case("35_zero_states", ["single_wrong_rows"], values=SOUND, verdict=NONE),
    Case("37_pasted_recordings", ["position_jumps"], run=65, says=["5002"], verdict=("data_fault",)),
    Case("38_zero_set_anew", ["position_jumps"], run=65, verdict=("data_fault",)),
    Case("40_merged_topics", values=SOUND, verdict=NONE),
    Case("40_merged_topics", values=SOUND, job="job_one_clock.toml", sound=True),
    Case("41a_float32_clock_5000s", values=SOUND, verdict=NONE),
    # the motion hardly tells viscous from Coulomb friction: 0.21 and 0.64 of all rows of the source as well
    Case("52_slow_source", ["slow_source"], values={"inertia": 0.092}, says=["66.67 Hz"],
         verdict=("insufficient",)),
    Case("43_table_oddities", job="job_bom.toml"),
    Case("43_table_oddities", job="job_units_row.toml"),
    Case("43_table_oddities", job="job_preamble.toml"),
    Case("43_table_oddities", job="job_iso.toml"),
    Case("43_table_oddities", job="job_clock.toml"),
    Case("43_table_oddities", job="job_sec_nsec.toml"),
    Case("51_numbered_from_0_and_1", says=['"tau1" belongs to "q0"', "joint 1 of 6"],
         drafted=("data.csv.gz", {"time": "t_s", "position": "q0", "torque": "tau1"})),
    Case("53_stop_code_reference", ["reference_constant"], values=SOUND, says=["no command"], verdict=NONE),
    Case("53_stop_code_reference", values=SOUND, says=["no command"], verdict=NONE,
         drafted=("data.csv.gz", {"time": "t_s", "position": "q_rad", "torque": "tau_Nm"})),
    Case("56_vector_cells", drafted=("data.csv", {"time": "timestamp", "position": "observation.state[0]",
                                                  "torque": "observation.effort[0]", "reference": "action[0]"})),
    Case("57_action_is_next_state", ["reference_is_position"], says=["1 row ahead"], verdict=NONE),
    Case("57_action_is_next_state", says=["1 row ahead"], verdict=NONE,
         drafted=("data.csv.gz", {"time": "t_s", "position": "q_rad", "torque": "tau_Nm"})),
    Case("54_command_before_clamp", ["command_beyond_limit"], values=SOUND, says=["no more than 2.0"],
         verdict=("data_fault",)),
    Case("55_torque_zeroed_again", ["torque_zero_steps"], values=SOUND, says=["23 s (row 5752)"],
         verdict=("data_fault",)),
    Case("58_arm_sound", values=ARM, unsaid=ARM_FINDINGS),
    Case("59_arm_torque_without_gravity", ["arm_setup"], verdict=("data_fault",),
         says=["gravity is not in this torque", "gravity = [0, 0, 0]"]),
    Case("59_arm_torque_without_gravity", values=ARM_FRICTION, unsaid=ARM_FINDINGS,
         advised=("[model]", "[model]\ngravity = [0, 0, 0]")),
    Case("60_arm_axis_turned", ["arm_setup"], run=65, verdict=("data_fault",),
         says=["j2 counts the other way round", "joint_sign = [1, -1, 1]"]),
    Case("60_arm_axis_turned", values=ARM, unsaid=ARM_FINDINGS,
         advised=("[recording]", "[recording]\njoint_sign = [1, -1, 1]")),
    Case("61_arm_zero_off", ["arm_setup"], verdict=("data_fault",), says=["the zero of j2", "zero = [0, -0.2"]),
    Case("61_arm_zero_off", values=ARM, unsaid=ARM_FINDINGS,
         advised=("[recording]", "[recording]\nzero = [0, -0.25, 0]")),
    Case("62_arm_motor_side_torque", ["arm_setup"], verdict=("data_fault",),
         says=["the torque of j3 is", "times too small", "torque_per_unit = [1, 1, "]),
    Case("62_arm_motor_side_torque", values=ARM, unsaid=ARM_FINDINGS,
         advised=("[recording]", "[recording]\ntorque_per_unit = [1, 1, 49.68]")),
    Case("63_arm_picked_up_a_load", ["arm_changes_at"], says=["the torque changes at 15", "leave_out = [["]),
    Case("63_arm_picked_up_a_load", values=ARM, unsaid=ARM_FINDINGS,
         advised=("[recording]", "[recording]\nleave_out = [[15.02, 31]]")),
]


def call(command, job, folder, *more):
    out = pathlib.Path(folder) / f"{command}.json"
    result = subprocess.run(
        [PROGRAM, command, str(job), "--json", str(out), "--color", "never", *more],
        capture_output=True, text=True, cwd=folder, timeout=1800, check=False,
    )
    document = json.loads(out.read_text()) if out.exists() else {}
    return result.returncode, document, result.stdout + result.stderr


def parameters_of(document):
    """What the first estimator (least squares) gives, by name."""
    first = document["estimators"][0]
    return {one["name"]: one.get("value", one.get("median")) for one in first["parameters"]}


def problems_with(case):
    found = []
    with tempfile.TemporaryDirectory() as folder:
        said = ""
        if case.drafted:
            job, said, found = drafted_by_init(case, folder)
        else:
            job = case.job_in(folder)
        code, document, text = call("check", job, folder)
        topics = {line["topic"]: line["level"] for line in document.get("lines", [])}
        for wanted in case.found:
            if wanted not in topics:
                found.append(f"check does not report {wanted}: {text.strip()[-300:]}")
        for code in case.unsaid:
            if code in topics:
                found.append(f"check reports {code}: {text.strip()[-300:]}")
        if case.sound and any(level in ("warn", "fault") for level in topics.values()):
            found.append(f"check finds fault with a sound recording: {text.strip()[-400:]}")
        run_code, document, run_text = call("run", job, folder, "--out", "r.h5")
        wanted_codes = case.run if isinstance(case.run, tuple) else (case.run,)
        if run_code not in wanted_codes:
            found.append(f"run ends with {run_code}, not {case.run}: {run_text.strip()[-300:]}")
        for words in case.says:
            if words not in " ".join((said + text + run_text).split()):
                found.append(f"neither check nor run says \"{words}\": {(said + text + run_text).strip()[-500:]}")
        if case.values and run_code == 0:
            got = parameters_of(document)
            for name, value in case.values.items():
                if not abs(got[name] - value) <= NO_TOLERANCE_BEYOND * value:
                    found.append(f"{name} = {got[name]:.4g}, not {value}")
        if FULL and case.verdict:
            _, document, text = call("diagnose", job, folder, "--out", "d.h5")
            verdict = document.get("verdict")
            wanted = (case.known_miss[0],) if case.known_miss else case.verdict
            if verdict not in wanted:
                found.append(f"diagnose says {verdict}, not {wanted}: {text.strip()[:500]}")
            if case.known_miss and verdict in case.verdict:
                found.append("this is no known miss any more: take known_miss out of its row")
    return found


def main(names):
    if not CASES.is_dir():
        print(f"skipped: {CASES} is not there (recordings that are not ours to give)")
        return 77
    failed = missed = 0
    cases = [case for case in CASE_LIST if not names or any(name in case.name for name in names)]
    for case in cases:
        found = problems_with(case)
        misses = FULL and case.known_miss is not None and not found
        failed += bool(found)
        missed += misses
        reason = f": diagnose says {case.known_miss[0]}, not {case.verdict[0]}; {case.known_miss[1]}" if misses else ""
        print(f"{'FAIL' if found else 'miss' if misses else 'ok  '} {case.name}{reason}", flush=True)
        for line in found:
            print("       " + line.replace("\n", "\n       "))
    print(f"{len(cases) - failed - missed} of {len(cases)} passed, {missed} known misses, {failed} failed")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
