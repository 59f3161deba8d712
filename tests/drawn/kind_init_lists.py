"""The joints of a data set for imitation as lists in cells: "[0.01, 0.10]"."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record

NAMES = [("observation.state", "observation.effort", "action"), ("qpos", "effort", "action"),
         ("joint_positions", "joint_torques", "joint_commands"), ("position", "torque", "target")]


def draw(rng, folder):
    n = int(rng.integers(2, 8))
    rate = float(rng.choice([100, 200, 250]))
    joints = [draw_joint(rng) for _ in range(n)]
    recordings = [record(rng, joint, seconds=20, rate=rate) for joint in joints]
    position, torque, command = NAMES[int(rng.integers(len(NAMES)))]
    has_command = rng.random() < 0.5
    separator = str(rng.choice([",", ";", "\t"]))
    between = str(rng.choice([", ", ",", " "]))
    quote = '"' if rng.random() < 0.6 else ""

    def lists(signals):
        rows = np.column_stack(signals)
        return [quote + "[" + between.join(f"{one:.7g}" for one in row) + "]" + quote for row in rows]

    columns = {"timestamp": [f"{t:.6f}" for t in recordings[0].time],
               "frame_index": [str(k) for k in range(len(recordings[0].time))],
               position: lists([one.position for one in recordings]), torque: lists([one.torque for one in recordings])}
    if has_command:
        columns[command] = lists([one.reference for one in recordings])
    lines = [separator.join(columns), *(separator.join(row) for row in zip(*columns.values()))]
    (folder / "data.csv").write_text("\n".join(lines) + ("\n" if rng.random() < 0.5 else ""))
    chosen = int(rng.integers(n))

    def judge(call):
        answer, job = draft(call, folder, "data.csv", "--joint", chosen + 1)
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-300:]}"
        wrong = wrong_columns(job, {"time": "timestamp", "position": f"{position}[{chosen}]",
                                    "torque": f"{torque}[{chosen}]",
                                    "reference": f"{command}[{chosen}]" if has_command else None})
        return wrong or wrong_run(call, joints[chosen])

    return judge
