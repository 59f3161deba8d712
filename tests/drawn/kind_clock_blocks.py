"""Each channel with a time column of its own, of other rates, starts and lengths: "Time, Position, Time, Torque"."""

import numpy as np

from drafted import draft, wrong_run
from joint import draw_joint, record

HEADS = [("Time", "Position", "Torque"), ("t [s]", "Angle [rad]", "Torque [Nm]"), ("time_s", "q_rad", "tau_Nm"),
         ("Zeit [s]", "Position", "Drehmoment"), ("X", "Y", "Y")]


def clock_of(rng, recording, share):
    """Stamps of a channel: another rate, another start, now and then uneven; within the recording."""
    rate = recording.rate * share
    start, end = rng.uniform(0, 0.3), recording.time[-1] - rng.uniform(0, 0.3)
    stamps = np.arange(start, end, 1 / rate)
    if rng.random() < 0.3:
        stamps += rng.uniform(-0.1, 0.1, len(stamps)) / rate
    return np.sort(stamps)


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=rng.uniform(20, 40), noise=0.005)
    time_name, position, torque = HEADS[int(rng.integers(len(HEADS)))]
    is_same = rng.random() < 0.15  # two equal clocks
    clocks = [clock_of(rng, recording, 1.0)]
    clocks.append(clocks[0] if is_same else clock_of(rng, recording, float(rng.choice([0.5, 0.8, 1.0, 1.0, 2.0]))))
    has_reference = rng.random() < 0.4
    names, values = [position, torque], [recording.position, recording.torque]
    if has_reference:
        names.append("Target " + position if position != "Y" else "Y")
        values.append(recording.reference)
        clocks.append(clock_of(rng, recording, 1.0))
    blocks = [(clock, np.interp(clock, recording.time, one)) for clock, one in zip(clocks, values)]
    step = rng.random() < 0.3  # stamps since 1970
    first = 1.7e9 if step else 0.0
    rows = max(len(clock) for clock in clocks)
    separator = str(rng.choice([",", ";", "\t"]))
    lines = []
    if position == "Y":
        groups = ["Position", "", "Torque", ""] + (["Target position", ""] if has_reference else [])
        lines.append(separator.join(groups))
    lines.append(separator.join(text for name in names for text in (time_name, name)))
    for k in range(rows):
        cells = []
        for clock, one in blocks:
            cells += [f"{first + clock[k]:.6f}", f"{one[k]:.9g}"] if k < len(clock) else ["", ""]
        lines.append(separator.join(cells))
    (folder / "data.csv").write_text("\n".join(lines) + "\n")

    def judge(call):
        answer, job = draft(call, folder, "data.csv")
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-500:]}"
        clock = job["recording"].get("clocks", {}).get("torque")
        if bool(clock) == is_same:
            return f"the torque's clock is {clock!r}"
        if has_reference and "reference" not in job["recording"]["columns"]:
            return "no reference"
        return wrong_run(call, joint)

    return judge
