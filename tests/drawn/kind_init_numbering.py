"""Several joints in one file, with commands beside what was measured; one channel may count from 0, another from 1."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record, write_csv

POSITIONS = ["q{}", "pos{}", "position_{}", "joint_{}_pos", "q_act_{}", "theta{}_rad", "ActPos[{}]", "msr_q{}"]
TORQUES = ["tau{}", "torque_{}", "effort{}", "joint_{}_torque", "tau_act_{}", "tau{}_Nm", "ActTorque[{}]", "msr_trq{}"]
COMMANDS = ["cmd", "des", "desired", "goal", "target", "ref", "reference", "setpoint", "sp", "command", "commanded"]


def draw(rng, folder):
    n = int(rng.integers(2, 8))
    rate = float(rng.choice([125, 200, 250, 500]))
    joints = [draw_joint(rng) for _ in range(n)]
    recordings = [record(rng, joint, seconds=25, rate=rate) for joint in joints]
    first_position, first_torque = (int(rng.integers(0, 2)) for _ in range(2))
    kind = int(rng.integers(len(POSITIONS)))
    position, torque = POSITIONS[kind], TORQUES[kind if rng.random() < 0.5 else int(rng.integers(len(TORQUES)))]
    word = str(rng.choice(COMMANDS))
    command = word + "_q{}" if rng.random() < 0.5 else "q_" + word + "_{}"
    has_command = rng.random() < 0.6
    columns = {"t_s": recordings[0].time}
    blocks = [{position.format(first_position + k): recordings[k].position for k in range(n)},
              {torque.format(first_torque + k): recordings[k].torque for k in range(n)}]
    if has_command:
        blocks.append({command.format(first_position + k): recordings[k].reference for k in range(n)})
        blocks.append({f"tau_{word}_{first_torque + k}": np.roll(recordings[k].torque, -2) for k in range(n)})
    for at in rng.permutation(len(blocks)):
        columns |= blocks[at]
    write_csv(folder / "data.csv", columns)
    chosen = int(rng.integers(n))

    def judge(call):
        answer, job = draft(call, folder, "data.csv", "--joint", chosen + 1)
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-300:]}"
        wrong = wrong_columns(job, {
            "time": "t_s", "position": position.format(first_position + chosen),
            "torque": torque.format(first_torque + chosen),
            "reference": command.format(first_position + chosen) if has_command else None})
        if wrong:
            return wrong
        if f"of {n};" not in answer.text:
            return f"it does not say {n} joints: {answer.text[-300:]}"
        if (first_position != first_torque) != ("belongs to" in answer.text):
            return "what it says of the numbering is wrong"
        return wrong_run(call, joints[chosen])

    return judge
