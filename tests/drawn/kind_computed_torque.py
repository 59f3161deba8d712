"""The torque column is what a model gives for the commanded motion, written as if it had been measured."""

import numpy as np
from joint import draw_joint, write_csv, write_job
from loop import draw_model, follow

LEAST_TRACKING_ERROR = 0.01  # of the motion: a joint that does what it is told has the torque it is told
COLUMNS = ["tau_Nm", "torque", "effort", "tau_ff", "torque_Nm", "load_torque"]


def draw(rng, folder):
    joint = draw_joint(rng, gravity=rng.random() < 0.4)
    model = draw_model(rng, joint)
    while True:
        followed = follow(rng, joint, model, rng.choice([0.0, rng.uniform(0.3, 1.0)]), rng.uniform(2.5, 7),
                          2 ** int(rng.integers(14, 20)))
        if followed.tracking_error() > LEAST_TRACKING_ERROR:
            break
    recording = followed.recording
    recording.torque = followed.model
    if rng.random() < 0.4:  # by differences of the reference, as a program does that has no formula
        speed = np.gradient(recording.reference, recording.time)
        recording.torque = model.torque(recording.reference, speed, np.gradient(speed, recording.time))
    roles = {"time": "t_s", "reference": str(rng.choice(["q_ref_rad", "q_cmd", "desired"])), "position": "q_rad",
             "torque": str(rng.choice(COLUMNS))}
    write_csv(folder / "data.csv", {roles[role]: values for role, values in recording.columns().items()},
              str(rng.choice(["%.9g", "%.6f"])))
    write_job(folder, "data.csv", roles)

    def judge(call):
        case = f"tracking error {100 * followed.tracking_error():.2g} %, {recording.rate:g} Hz"
        check = call("check", "job.toml")
        if "torque_computed" not in check.topics("warn"):
            return f"{case}: check says {check.topics()}"
        if check.topics("warn") & {"torque_zero_steps", "torque_zero_drifts", "command_beyond_limit"}:
            return f"{case}: and more of the column: {check.topics('warn')}"
        run = call("run", "job.toml", "--out", "r.h5")
        if run.code or "computed, not measured" not in " ".join(run.text.split()):
            return f"{case}: run ends with {run.code}: {run.text[-300:]}"
        diagnosis = call("diagnose", "job.toml", "--out", "d.h5")
        if diagnosis.document.get("verdict") != "data_fault" or "computed" not in diagnosis.text:
            return f"{case}: diagnose: {diagnosis.text[-300:]}"
        return None

    return judge
