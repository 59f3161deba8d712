"""A sound recording: no warning by `check`, and `run` gives what was put in."""

from joint import draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
TOLERANCE = 0.1  # of a parameter; the filters alone cost 2 to 5 % of the Coulomb friction


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint)
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES)

    def judge(call):
        check = call("check", "job.toml")
        if check.topics("warn", "fault"):
            return f"check finds fault: {check.topics('warn', 'fault')}"
        run = call("run", "job.toml", "--out", "r.h5")
        if run.code:
            return f"run ends with {run.code}: {run.text[-300:]}"
        got = run.parameters()
        for name in ("inertia", "viscous", "coulomb"):
            true = getattr(joint, name)
            if abs(got[name] - true) > TOLERANCE * true:
                return f"{name} {got[name]:.4g}, true {true:.4g}"
        return None

    return judge
