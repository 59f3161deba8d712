"""A velocity and a torque, and no position: it is integrated, and the answer says what cannot be told then."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record, write_csv

UNITS = [("rad/s", 1.0), ("rpm", 2 * np.pi / 60), ("deg/s", np.pi / 180)]
NAMES = [("t_s", "speed_{u}", "tau_Nm"), ("time [s]", "velocity [{u}]", "torque [Nm]"),
         ("Zeit [s]", "Drehzahl [{u}]", "Drehmoment [Nm]"), ("timestamp", "wheel.speed ({u})", "motor.torque (Nm)")]


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=rng.uniform(20, 40))
    unit, per_unit = UNITS[int(rng.integers(len(UNITS)))]
    time, speed, torque = NAMES[int(rng.integers(len(NAMES)))]
    speed = speed.format(u=unit)
    measured = recording.velocity * (1 + rng.uniform(-0.005, 0.005))
    measured = measured + rng.uniform(0, 0.003) * measured.std() * rng.standard_normal(len(measured))
    columns = {time: recording.time, speed: measured / per_unit, torque: recording.torque}
    if rng.random() < 0.5:
        columns["temperature_C"] = 30 + 0.1 * recording.time
    write_csv(folder / "data.csv", columns, form="%.7g")

    def judge(call):
        answer, job = draft(call, folder, "data.csv")
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-500:]}"
        wrong = wrong_columns(job, {"time": time, "velocity": speed, "torque": torque, "position": None})
        if wrong:
            return wrong
        check = call("check", "drafted.toml")
        if "position_integrated" not in check.topics() or "start is unknown" not in check.text:
            return f"check does not say it: {check.text[-400:]}"
        return wrong_run(call, joint)

    return judge
