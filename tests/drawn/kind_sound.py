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
        return call("run", "job.toml", "--out", "r.h5").wrong_parameters(joint, TOLERANCE)

    return judge
