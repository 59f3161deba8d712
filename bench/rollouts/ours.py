"""The same recording by our program: `run` with the estimator `lm`, then `replay` for its errors."""
import json
import pathlib
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "goals"))
from bench_context import Missing, Run, environment  # noqa: E402

CASE = "friction joint, P loop"
LANES = "bench/rollouts/bench_rollouts"
JOB = """[experiment]
name = "rollouts"

[recording]
train = "{recording}"
columns = {{time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "tau_Nm"}}

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb", "offset", "gravity"]

[loop]
controller = "pd"

[[estimator]]
name = "lm"
"""


def lanes_per_second(build):
    """Joint steps a second and core of our lanes alone."""
    program = build / LANES
    if not program.exists():
        raise Missing(f"our lanes: cmake --build --preset bench --target {program.name}")
    done = subprocess.run([str(program)], env=environment(), capture_output=True, text=True)
    lines = [json.loads(line) for line in done.stdout.splitlines() if line.startswith("{")]
    found = [line["steps_per_second"] for line in lines if line["case"] == CASE]
    if not found:
        raise Missing(f'our lanes: {program.name} ended with {done.returncode} and printed no case "{CASE}"')
    return max(found)


def errors(replayed, ticks):
    """rms of the torque and of the position, of all samples, out of the JSON of `replay`."""
    channels = replayed["recordings"][0]["channels"]

    def rms(channel):
        models = channels[channel]["models"]
        one = next((model for model in models if model["model"] == "lm"), models[-1])
        if one["n"] != ticks:
            raise Missing(f"ours: replay compares {one['n']} samples of the {channel}, not all {ticks}")
        return one["rms"]

    return rms("torque"), rms("position")


def fit(program, recording, ticks, folder):
    """CPU seconds of the whole process, reading and storing included, and the errors it ends with."""
    if not program.exists():
        raise Missing("ours: cmake --build --preset bench --target torquescope")
    job, result = folder / "rollouts.toml", folder / "rollouts.h5"
    job.write_text(JOB.format(recording=recording))
    result.unlink(missing_ok=True)
    try:
        seconds = Run([program, "run", job, "--out", result, "--threads", 1]).cpu_s
        replayed = Run([program, "replay", result, "--json", "-"]).printed
    except SystemExit as failed:
        raise Missing(f"ours: {failed}") from failed
    return seconds, *errors(replayed, ticks)
