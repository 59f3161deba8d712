"""Headers in German, French, Spanish, Italian, Japanese, Chinese: units, decimal commas, encodings."""

import numpy as np

from drafted import draft, wrong_columns, wrong_run
from joint import draw_joint, record

# time, position, speed, torque or current, command; {} a unit in brackets
HEADERS = [
    ("Zeit {s}", "Winkel {deg}", "Drehzahl {rpm}", "Drehmoment {Nm}", "Sollwinkel {deg}", "latin-1"),
    ("Zeit {ms}", "Lageistwert {deg}", "Geschwindigkeit {deg/s}", "Motorstrom {mA}", "Lagesollwert {deg}", "utf-8"),
    ("Zeitstempel {s}", "Istposition {rad}", "Winkelgeschwindigkeit {rad/s}", "Strom {A}", "Sollposition {rad}",
     "utf-8"),
    ("Temps {s}", "Angle mesuré {deg}", "Vitesse {rpm}", "Couple {Nm}", "Consigne d'angle {deg}", "latin-1"),
    ("Temps {ms}", "Position {rad}", "Vitesse mesurée {rad/s}", "Courant moteur {A}", "Position consigne {rad}",
     "utf-8"),
    ("Tiempo {s}", "Posición {deg}", "Velocidad {rpm}", "Par motor {Nm}", "Posición deseada {deg}", "latin-1"),
    ("Tiempo {ms}", "Ángulo {rad}", "Velocidad {rad/s}", "Corriente {mA}", "Consigna {rad}", "utf-8"),
    ("Tempo {s}", "Posizione {rad}", "Velocità {rad/s}", "Coppia {Nm}", "Riferimento posizione {rad}", "latin-1"),
    ("時間 {s}", "位置 {deg}", "速度 {rpm}", "トルク {Nm}", "指令位置 {deg}", "utf-8"),
    ("時刻 {ms}", "現在角度 {rad}", "角速度 {rad/s}", "モータ電流 {A}", "目標角度 {rad}", "utf-16"),
    ("时间 {s}", "实际位置 {rad}", "速度 {rad/s}", "力矩 {Nm}", "目标位置 {rad}", "utf-8"),
]
SPELLINGS = {"s": ["s"], "ms": ["ms"], "deg": ["°", "deg"], "rad": ["rad"], "rpm": ["rpm", "1/min", "U/min"],
             "rad/s": ["rad/s"], "deg/s": ["°/s"], "Nm": ["Nm", "N m", "N·m"], "mA": ["mA"], "A": ["A"]}
SI = {"s": 1, "ms": 1e-3, "deg": np.pi / 180, "rad": 1, "rpm": np.pi / 30, "rad/s": 1, "deg/s": np.pi / 180, "Nm": 1,
      "mA": 1, "A": 1}


def draw(rng, folder):
    joint = draw_joint(rng)
    recording = record(rng, joint, seconds=20)
    *header, encoding = HEADERS[int(rng.integers(len(HEADERS)))]
    brackets = [("[", "]"), ("(", ")")][int(rng.integers(2))]
    if encoding == "utf-8" and rng.random() < 0.2:
        brackets = [("［", "］"), ("（", "）")][int(rng.integers(2))]
    has_units_row = rng.random() < 0.25
    signals = [recording.time, recording.position, recording.velocity, recording.torque, recording.reference]
    names, units, values = [], [], []
    for text, signal in zip(header, signals):
        words, unit = text[:-1].split(" {")
        spelled = str(rng.choice(SPELLINGS[unit]))
        names.append(words if has_units_row else words + " " + brackets[0] + spelled + brackets[1])
        units.append(spelled)
        values.append(signal / SI[unit])
    roles = ["time", "position", "velocity", "torque", "reference"]
    name_of = dict(zip(roles, names))
    has_reference = rng.random() < 0.6
    order = [k for k in rng.permutation(5) if has_reference or k != 4]
    order = [0, *[k for k in order if k != 0]]
    comma = rng.random() < 0.5
    separator = ";" if comma else str(rng.choice([",", ";", "\t"]))
    rows = [separator.join(names[k] for k in order)]
    if has_units_row:
        rows.append(separator.join(units[k] for k in order))
    for row in zip(*(values[k] for k in order)):
        text = separator.join(f"{one:.9g}" for one in row)
        rows.append(text.replace(".", ",") if comma else text)
    (folder / "data.csv").write_bytes("\r\n".join([*rows, ""]).encode(encoding))

    def judge(call):
        answer, job = draft(call, folder, "data.csv")
        if answer.code:
            return f"init ends with {answer.code}: {answer.text[-400:]}"
        wrong = wrong_columns(job, {role: name_of[role] for role in ("time", "position", "torque")}
                              | {"reference": name_of["reference"] if has_reference else None})
        return wrong or wrong_run(call, joint)

    return judge
