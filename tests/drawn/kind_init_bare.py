"""Names that say nothing: init asks, shows what each column looks like, and takes the columns that a person names."""

import re

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record, write_csv

NAMES = [list("abcdef"), [f"ch{k}" for k in range(6)], [f"Column{k}" for k in range(1, 7)],
         ["CH A", "CH B", "CH C", "CH D", "CH E", "CH F"], ["w", "y", "z", "k", "n", "h"]]


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=20)
    names = NAMES[int(rng.integers(len(NAMES)))]
    order = ["time", "position", "torque", "velocity", "noise"]
    order = [order[k] for k in rng.permutation(len(order))]
    name_of = dict(zip(order, names))
    signals = {"time": recording.time, "position": recording.position, "torque": recording.torque,
               "velocity": recording.velocity, "noise": rng.standard_normal(len(recording.time))}
    write_csv(folder / "data.csv", {name_of[role]: signals[role] for role in order})

    def judge(call):
        answer, _ = draft(call, folder, "data.csv")
        if answer.code != 78:
            return f"init ends with {answer.code}: {answer.text[-300:]}"
        text = " ".join(answer.text.split())
        for role, words in {"time": "a clock", "position": "as a position", "torque": "as a torque",
                            "velocity": "as a speed"}.items():
            if not re.search(rf'column "{name_of[role]}": [^"]*("{name_of["position"]}"[^"]*)?{words}', text):
                return f'it does not say that "{name_of[role]}" is {words}: {text[-1500:]}'
        absent, _ = draft(call, folder, "data.csv", "--position", "nothing", "--torque", name_of["torque"])
        if absent.code != 64 or "no such column" not in absent.text:
            return f"an absent column ends with {absent.code}: {absent.text[-300:]}"
        named, job = draft(call, folder, "data.csv", "--position", name_of["position"], "--torque", name_of["torque"],
                           "--time", name_of["time"])
        if named.code:
            return f"init with names ends with {named.code}: {named.text[-300:]}"
        wrong = wrong_columns(job, {"position": name_of["position"], "torque": name_of["torque"],
                                    "time": name_of["time"], "reference": None})
        return wrong or wrong_run(call, joint)

    return judge
