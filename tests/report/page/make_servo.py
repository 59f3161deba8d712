"""What `torquescope diagnose` writes of a set of recordings of servos (/servo and /replay of
engine/store/RESULT_FORMAT.md): a servo whose goal is delayed, simulated with and without the delay.

    make_servo.py KIND OUT.h5      KIND is one of the functions in KINDS
"""

import itertools
import json
import sys

import h5py
import make_replay
import numpy as np

MODELS = ["job's model", "with what was named"]
DELAY_S = 0.04
GAINS, MASSES, MOTIONS = (8.0, 32.0), (0.5, 0.75, 1.0), ("lift & drop", "steps", "two_sines")


def motion(seconds, rate_hz, seed, gain):
    """time, measured [3][n], simulated [2][3][n]: of a first-order servo; of the position alone something is used."""
    time = np.arange(int(seconds * rate_hz)) / rate_hz
    random = np.random.default_rng(seed)
    phase = random.uniform(0, 6.28)

    def position(delay):
        late = time - delay - 1 / gain
        return 0.8 * np.sin(2 * np.pi * 0.4 * late + phase) + 0.3 * np.sin(2 * np.pi * 0.9 * late)

    measured = position(DELAY_S) + random.normal(scale=2e-4 * (1 + seed % 5), size=len(time))
    zero = np.zeros_like(time)
    stacked = [np.array([one, zero, zero]) for one in (measured, position(0.0), position(DELAY_S))]
    return time, stacked[0], np.array(stacked[1:])


def recordings(count, seconds):
    """[(name, role, quantities, signals)]: those of the middle mass are of validation."""
    found = []
    for number, (mass, gain, kind) in zip(range(count), itertools.cycle(itertools.product(MASSES, GAINS, MOTIONS))):
        role = "validate" if mass == MASSES[1] else "train"
        found.append((f"{number:02}_m{mass:g}_kp{gain:g}.csv", role,
                      {"kp": gain, "mass_kg": mass, "motion": kind}, motion(seconds, 100, number, gain)))
    return found


def error(ones):
    """Of records of recordings."""
    samples = sum(one["samples"] for one in ones)
    mean = {side: sum(one["samples"] * one[side] for one in ones) / samples if samples else None
            for side in ("before", "after")}
    return {"recordings": len(ones), "samples": samples, **mean}


def number(name, unit, value, half=None):
    return {"name": name, "unit": unit, "value": value,
            "ci95": [None, None] if half is None else [value - half, value + half]}


def table(quantity, ones, roles, mean=None):
    values = sorted({one["quantities"][quantity] for one in ones})
    rows = []
    for value in values:
        here = [one for one in ones if one["quantities"][quantity] == value]
        rows.append({"value": value if isinstance(value, str) else f"{value:g}",
                     **{role: error([one for one in here if mean or one["role"] == role]) for role in roles}})
    return {"quantity": quantity, "rows": rows}


def law(name, title, equation, not_told_from, gain, parameters, rivals=()):
    return {"name": name, "title": title, "equation": equation, "not_told_from": not_told_from, "gain": gain,
            "p": 1 / 49, "parameters": parameters, "rivals": list(rivals)}


def delay_and_friction():
    return [
        law("command_delay", "Delay of the command", "goal(t) = reference(t - command_delay)",
            "torque_lag and torque_delay at a low gain; a faster motion tells", 41592.9,
            [number("command_delay_s", "s", 0.0402, 2e-5)]),
        law("load_friction", "Load-dependent friction", "F = load_friction |motor + weight| / 2", "", 312.4,
            [number("load_friction", "1", 0.1488, 0.0011), number("stribeck_speed", "rad/s", 16.7)],
            ["load_stribeck_friction"]),
    ]


def move(name, refusal, gain, by_chance, p, before, after):
    return {"name": name, "refusal": refusal, "gain": gain, "gain_by_chance": by_chance, "p": p,
            "error_before": before, "error_after": after}


def steps():
    return [{"model": [], "replicates": 48,
             "moves": [move("command_delay", "none", 587.2, 11.0, 1 / 49, 0.144, 0.021),
                       move("torque_lag", "not_predicted", 120.0, 9.5, 1 / 49, 0.144, 0.143),
                       move("load_friction", "chance", 0.0, 9.7, 1.0, 0.144, None)]},
            {"model": ["command_delay"], "replicates": 48,
             "moves": [move("load_friction", "none", 312.4, 6.8, 1 / 49, 0.021, 0.002),
                       move("torque_lag", "failed_fit", -4.4, 4.2, 1 / 49, 0.021, 0.022)]},
            {"model": ["command_delay", "load_friction"], "replicates": 48,
             "moves": [move("arm_mass", "chance", 0.3, 2.1, 0.6, 0.002, None)]}]


def document(verdict, headline, ones, kept, left_out=(), notes=()):
    numbers = [number("inertia", "kg m2", 0.0234, 4e-6), number("viscous", "N m s/rad", 0.0544, 3e-5),
               number("motor_gain", "N m per unit", 0.245, 4e-5)]
    roles = {role: [one for one in ones if one["role"] == role] for role in ("train", "validate")}
    kinds = list(ones[0]["quantities"]) if ones else []
    return {
        "schema": 1, "kind": "servo", "name": "servo_loads", "verdict": verdict, "headline": headline,
        "error": {"unit": "rad", **{role: error(of) for role, of in roles.items()}},
        "command_unit": "V", "adequacy": {"left_rms": 0.00043, "replicates_rms": 0.00026},
        "kept": kept, "parameters": numbers + [one for law in kept for one in law["parameters"]],
        "parameters_before": [{**one, "value": 1.3 * one["value"], "ci95": [one["value"], 1.6 * one["value"]]}
                              for one in numbers],
        "notes": [{"note": word, "text": text} for word, text in notes],
        "tables": [table(quantity, ones, ("train", "validate")) for quantity in kinds],
        "left_out": [table(quantity, roles["train"], ("left_out",), mean=True) for quantity in left_out],
        "recordings": ones,
        "loop": {"reason": "decides", "decides": True, "controller": "p", "steps": steps() if kept else []}}


def write(path, of, signals, models=MODELS):
    with h5py.File(path, "w") as file:
        make_replay.tell(file, format=3, complete=1, creator="torquescope 0.1.0", content_sha256="0" * 64)
        job = file.create_group("job")
        make_replay.tell(job, name="servo_loads", study="", seed=7, runs=0, sha256="1" * 64)
        make_replay.put(job, "text", [b"[experiment]\nname = \"servo_loads\"\n"])
        group = file.create_group("servo")
        make_replay.tell(group, verdict=of["verdict"], headline=of["headline"])
        make_replay.put(group, "json", [json.dumps(of, indent=2).encode()])
        if not signals:
            return
        group = make_replay.replay_group(file, models, 0, len(models) - 1)
        for at, (one, (time, measured, simulated)) in enumerate(zip(of["recordings"], signals), start=1):
            make_replay.write_recording(
                group.create_group(f"recording_{at}"), one["name"], one["role"], 100,
                (time, measured, simulated[:len(models)]), loop="given", loop_error=np.nan,
                loop_words="controller p as the job gives it", channels=["position"])


def of_recordings(count, seconds, has_laws=True):
    """(records of recordings as the JSON has them, their signals)"""
    ones, signals = [], []
    for name, role, quantities, (time, measured, simulated) in recordings(count, seconds):
        left = measured[0] - simulated[:, 0]
        mae, share = np.abs(left).mean(1), np.sqrt((left**2).mean(1)) / measured[0].std()
        after = 1 if has_laws else 0
        ones.append({"name": name, "role": role, "quantities": quantities, "samples": len(time), "before": mae[0],
                     "after": mae[after], "relerr_before": share[0], "relerr_after": share[after], "horizon_s": None})
        signals.append((time, measured, simulated))
    return ones, signals


def servo(path, count=18, seconds=4):
    """Two effects, one with a rival; several of validation, and tables of what was left out."""
    ones, signals = of_recordings(count, seconds)
    headline = "explained by Delay of the command 0.0402 s; Load-dependent friction 0.1488"
    notes = [("always_on", "The drive is never off: viscous friction and back-EMF are one number.")]
    write(path, document("class", headline, ones, delay_and_friction(), ("mass_kg", "kp"), notes), signals)


def sixty(path):
    servo(path, 60, 6)


def nothing_missing(path):
    """One recording of training alone, and one model."""
    ones, signals = of_recordings(1, 4, has_laws=False)
    headline = "nothing is missing: the recordings differ from their simulation no more than replicates of it do"
    of = document("none", headline, ones, [], notes=[("no_validation", "No recording has role = \"validate\".")])
    write(path, {**of, "tables": []}, signals, MODELS[:1])


def ran_away(path):
    """The job's model: no replay, no errors, no numbers."""
    of = document("insufficient", "insufficient: the job's model runs away; check the gains", [], [])
    write(path, {**of, "parameters": [], "parameters_before": []}, [])


KINDS = {"servo": servo, "servo_60": sixty, "servo_none": nothing_missing, "servo_ran_away": ran_away}

if __name__ == "__main__":
    KINDS[sys.argv[1]](sys.argv[2])
