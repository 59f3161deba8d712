"""A model without gravity: the weight of the link comes before a spring where both serve; a true spring stays one."""

import dataclasses

import numpy as np

from joint import Joint, draw_joint, record, write_csv, write_job

ROLES = {"time": "t_s", "reference": "q_ref_rad", "position": "q_rad", "torque": "tau_Nm"}
DIAGNOSE = """
[diagnose]
effects = ["gravity", "spring", "cable", "asymmetric_viscous", "stribeck"]
twins = 60
"""


def draw(rng, folder):
    joint = draw_joint(rng)
    is_weight = rng.random() < 0.7
    size = joint.coulomb * rng.uniform(0.6, 2)
    zero = rng.uniform(0, 2 * np.pi)  # where the link hangs down

    @dataclasses.dataclass(frozen=True)
    class Loaded(Joint):
        def torque(self, position, velocity, acceleration):
            more = size * (np.sin(position - zero) if is_weight else position)
            return super().torque(position, velocity, acceleration) + more

    recording = record(rng, Loaded(**dataclasses.asdict(joint)), seconds=rng.uniform(20, 40), rate=200,
                       noise=rng.uniform(0.002, 0.02))
    write_csv(folder / "data.csv", {ROLES[role]: values for role, values in recording.columns().items()})
    write_job(folder, "data.csv", ROLES, more=DIAGNOSE)

    def judge(call):
        answer = call("diagnose", "job.toml", "--out", "d.h5")
        if answer.code:
            return f"diagnose ends with {answer.code}: {answer.text[-300:]}"
        told = answer.document["joints"][0]
        names = [one["name"] for one in told["effects"]]
        alike = [name for one in told["effects"] for name in one["equivalent"]]
        if is_weight and names[:1] != ["gravity"]:
            return f"a weight: {told.get('class', told.get('headline'))} {names} or {alike}"
        if not is_weight and "spring" not in names + alike:
            return f"a spring: {told.get('class', told.get('headline'))} {names} or {alike}"
        return None

    return judge
