"""The log holds the torque asked for, the drive gives no more than a limit: of both signs, two, or one side only."""

import numpy as np
from joint import draw_joint, simulate, write_csv, write_job

TOLERANCE = 0.05  # of a parameter: of what the same job gives with the torque that the drive gave
LEVEL = 0.1  # of the limit


def draw(rng, folder):
    joint = draw_joint(rng)
    sides = rng.choice(["both", "two", "upper", "lower"], p=[0.55, 0.15, 0.15, 0.15])
    beyond = rng.uniform(0.03, 0.15)  # share of the rows
    recording, upper, lower = simulate(rng, joint, sides, beyond)
    torque = str(rng.choice(["tau_Nm", "tau_cmd", "torque_des", "u_Nm", "desired_torque_Nm"]))
    roles = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": torque}
    write_csv(folder / "data.csv", {roles[role]: values for role, values in recording.columns().items()})
    (folder / "given").mkdir()
    given = recording.columns() | {"torque": np.clip(recording.torque, lower, upper)}
    write_csv(folder / "given" / "data.csv", {roles[role]: values for role, values in given.items()})
    write_job(folder / "given", "data.csv", roles)
    write_job(folder, "data.csv", roles)

    def judge(call):
        check = call("check", "job.toml")
        line = next((one for one in check.document.get("lines", []) if one["topic"] == "command_beyond_limit"), None)
        if line is None:
            return f"check does not say command_beyond_limit ({sides}, {beyond:.2f}): {check.topics('warn', 'fault')}"
        said = [abs(float(word)) for word in line["text"].replace(",", " ").split() if is_number(word)]
        for limit in (upper, lower):
            if limit is not None and not any(abs(one - abs(limit)) <= LEVEL * abs(limit) for one in said):
                return f"the limit {limit:.3g} is not said: {line['text']}"
        run = call("run", "job.toml", "--out", "r.h5")
        if run.code:
            return f"run ends with {run.code}: {run.text[-300:]}"
        got, wanted = run.parameters(), call("run", "given/job.toml", "--out", "given.h5").parameters()
        for name in ("inertia", "viscous", "coulomb"):
            true = wanted[name]
            if abs(got[name] - true) > TOLERANCE * true:
                return f"{name} {got[name]:.4g}, {true:.4g} of what was given ({sides}, {beyond:.2f})"
        return None

    return judge


def is_number(word):
    try:
        return np.isfinite(float(word))
    except ValueError:
        return False
