"""A line of groups above names that repeat, perhaps a line of units below and some lines above."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record

GROUPS = ["Axis {}", "Joint{}", "J{}", "Motor {}", "Achse {}"]
NAMES = [("Position", "Torque", "Set position"), ("pos", "effort", "pos_cmd"), ("ActPos", "ActTorque", "TargetPos"),
         ("Istposition", "Drehmoment", "Sollposition")]


def draw(rng, folder):
    n = int(rng.integers(2, 5))
    rate = float(rng.choice([125, 250, 500]))
    joints = [draw_joint(rng) for _ in range(n)]
    recordings = [record(rng, joint, seconds=20, rate=rate) for joint in joints]
    group, first = str(rng.choice(GROUPS)), int(rng.integers(0, 2))
    names = NAMES[int(rng.integers(len(NAMES)))]
    has_command, has_units = rng.random() < 0.5, rng.random() < 0.5
    degrees = has_units and rng.random() < 0.5
    unit = np.pi / 180 if degrees else 1.0
    separator = str(rng.choice([",", ";", "\t"]))
    heads, lower, units, columns = [""], ["Time"], ["s"], [recordings[0].time]
    for k, one in enumerate(recordings):
        signals = [one.position / unit, one.torque, one.reference / unit][: 3 if has_command else 2]
        heads += [group.format(first + k)] + [""] * (len(signals) - 1)
        lower += names[: len(signals)]
        units += (["deg" if degrees else "rad", "Nm", "deg" if degrees else "rad"])[: len(signals)]
        columns += signals
    lines = ["Recorded on Monday", ""] if rng.random() < 0.3 else []
    lines += [separator.join(heads), separator.join(lower)] + ([separator.join(units)] if has_units else [])
    lines += [separator.join(f"{one:.9g}" for one in row) for row in zip(*columns)]
    (folder / "data.csv").write_text("\n".join(lines) + "\n")
    chosen = int(rng.integers(n))
    prefix = group.format(first + chosen) + "."

    def judge(call):
        answer, job = draft(call, folder, "data.csv", "--joint", chosen + 1)
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-300:]}"
        wrong = wrong_columns(job, {"time": "Time", "position": prefix + names[0], "torque": prefix + names[1],
                                    "reference": prefix + names[2] if has_command else None})
        return wrong or wrong_run(call, joints[chosen])

    return judge
