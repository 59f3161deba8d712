"""Diagnoses of a simulated joint, 1 kHz, 200 replicates, two threads, and of a real arm: seconds by the clock beside
the goal, and memory.

The arm is left out where there is no recording of it (jobs/README.md says where to get one).
"""
import pathlib
import sys
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "tests" / "jobs"))
import simulated_job  # noqa: E402

from bench_context import Run  # noqa: E402
from row import Row  # noqa: E402

ONE = {"stribeck": 0.35, "stribeck_speed": 0.15, "stribeck_exponent": 1.0}
THREE = {**ONE, "spring": 0.4, "cogging_sin": 0.08, "cogging_order": 6}
# name, effects, the recording's seconds, the seconds wanted
CASES = (("one effect, 60 s", ONE, 60, 5.0), ("three effects, 60 s", THREE, 60, 15.0),
         ("one effect, 300 s", ONE, 300, 60.0))
WANTED_MB = 500.0  # of 300 s
ARM_S, WANTED_ARM_S = 89.0, 60.0
JOBS = pathlib.Path(__file__).resolve().parents[2] / "jobs"


def simulation(effects, duration_s, seed):
    return simulated_job.job(
        [{"name": "ols"}],
        replaced=("model.bounds",),
        experiment={"name": "recording", "seed": seed},
        simulate={"mode": "closed_loop", "rate_hz": 1000, "duration_s": duration_s},
        simulate__plant={"inertia": 0.09, "viscous": 0.35, "coulomb": 0.6, **effects},
        simulate__reference={"kind": "multisine", "max_speed": 3.0},
        simulate__controller={"kind": "pd", "rate_hz": 1000},
        simulate__encoder={"counts_per_revolution": 131072})


def recording(context, effects, duration_s, seed):
    """A file, as a user has one."""
    plan, path = context.folder / "simulation.toml", context.folder / f"recording_{seed}.csv"
    plan.write_text(simulation(effects, duration_s, seed))
    path.unlink(missing_ok=True)
    Run([context.program(context.build), "simulate", plan, "--out", path, "--quiet"])
    return str(path)


COLUMNS = '{time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "tau_Nm"}'


def job(context, effects, duration_s):
    train, validation = (recording(context, effects, duration_s, seed) for seed in (11, 12))
    return "\n".join([
        simulated_job.section("[experiment]", {"name": "diagnosis", "seed": 11}),
        simulated_job.section("[recording]", {"train": train, "validate": validation}) + f"columns = {COLUMNS}\n",
        simulated_job.section("[filter]", {"cutoff_hz": 30, "parallel_cutoff_hz": 15, "decimate_to_hz": 50}),
        simulated_job.section("[model]", {"joint": "revolute", "terms": ["inertia", "viscous", "coulomb", "offset"]}),
        simulated_job.section("[diagnose]", {"effects": "all", "twins": 200})])


class Diagnosis:
    def __init__(self, context, build, text):
        path, out = context.folder / "diagnosis.toml", context.folder / "diagnosis.h5"
        path.write_text(text)
        out.unlink(missing_ok=True)
        start = time.monotonic()
        done = Run([context.program(build), "diagnose", path, "--out", out, "--threads", 2, "--quiet"], threads=2)
        self.clock_s, self.cpu_s, self.peak_mb = time.monotonic() - start, done.cpu_s, done.peak_mb


def rows_of(name, text, context, seconds, wanted_s):
    now, *before = [Diagnosis(context, build, text) for build in context.builds()]
    was = before[0] if before else None
    yield Row(f"diagnosis, {name}", "s", now.clock_s, wanted_s, "what is wanted", 1.0, was and was.clock_s)
    yield Row(f"diagnosis, {name}", "CPU s", now.cpu_s, seconds, "the recording's length", None, was and was.cpu_s)
    if seconds == 300:
        yield Row(f"diagnosis, {name}: peak memory", "MB", now.peak_mb, WANTED_MB, "what is wanted", 1.0,
                  was and was.peak_mb)


def arm_job(recordings):
    text = (JOBS / "ur10e_diagnose.toml").read_text(encoding="utf-8")
    return text.replace("../../shared/recordings", str(recordings)).replace('"robots/', f'"{JOBS}/robots/')


def rows(context):
    for name, effects, duration_s, wanted_s in CASES:
        yield from rows_of(name, job(context, effects, duration_s), context, duration_s, wanted_s)
    if (context.recordings / "ur10e").exists():
        yield from rows_of("six joints of UR10e, 89 s", arm_job(context.recordings), context, ARM_S, WANTED_ARM_S)
