#!/usr/bin/python3
"""Compares what the program said with what a stranger's case conceals.

    score.py FOLDER [CASE...]     FOLDER/CASE has truth/truth.json and verdict.json; prints one row per case (Markdown)
    --forgive NAME                as if NAME had not been said where it is not what is concealed: to see past one known
                                  fault

right        what an expert would sign: clean is none; one effect is its name alone (or a class with it); of an effect
             whose form is not the catalogue's its family will do; a pair is both; outside the catalogue is unexplained;
             weak motion is no wrong name
acceptable   true, but less than could be said: no name although something is there, one of a pair, a near relative
wrong        a false name, "nothing" where something is, "something" where nothing is, no answer
"""

import json
import sys
from pathlib import Path

FAMILY = {
    "gravity": "static_position",
    "asymmetric_viscous": "velocity_law",
    "stribeck": "reversal",
    "speed_drag": "velocity_law",
    "power_law_viscous": "velocity_law",
    "presliding": "reversal",
    "maxwell_slip": "reversal",
    "breakaway_dwell": "reversal",
    "friction_lag": "velocity_law",
    "position_dependent_friction": "static_position",
    "load_dependent_friction": "load",
    "directional_efficiency": "load",
    "thermal_friction": "time",
    "friction_drift": "time",
    "spring": "static_position",
    "cable": "static_position",
    "end_stop": "static_position",
    "cogging": "order_locked",
    "torque_ripple": "order_locked",
    "transmission_error": "order_locked",
    "joint_elasticity": "acceleration",
    "backlash": "reversal",
    "delay": "acceleration",
    "actuator_lag": "acceleration",
    "torque_constant": "load",
    "clipping": "measurement",
    "sensor_drift": "time",
    "encoder_eccentricity": "order_locked",
    "contact": "outside",
    "payload_change": "time",
    "periodic_disturbance": "outside",
}

# concealed forms that are the catalogue's own equation: these have to be named exactly
TEXTBOOK = {"pressed_bearing", "oblique_axis", "soft_shaft", "late_torque", "bristles", "slip_elements", "damped_gap",
            "off_centre_disc", "loose_screw"}

# which parameter of the program has an exact partner among the concealed values: name, index of the value, factor
PARTNER = {
    "pressed_bearing": ("load_dependent_friction", 0),
    "soft_shaft": ("elasticity_frequency", 0),
    "late_torque": ("delay", 0),
    "loose_screw": ("friction_step_time", 1),
    "hunt_crossley": ("end_stop_position", 1),
    "wavy_motor": ("torque_ripple_order", 1),
    "wavy_gear": ("transmission_error_order", 1),
    "gripped_load": ("payload_time", 1),
    "leaning": ("contact_start", 1),
    "bristles": ("presliding_distance", 0),
    "press_next_door": ("disturbance_frequency", 1),
    "damped_gap": ("backlash_half_gap", 0),
    "off_centre_disc": (("encoder_eccentricity_sin", "encoder_eccentricity_cos"), 0),
    "oblique_axis": (("gravity_sin", "gravity_cos"), 0),
}


def concealed_value(law):
    """The value that has a partner; a cogging table has one tooth per 1/values[1]."""
    if law["form"] == "tabulated":
        return "cogging_order", law["values"][1] * 6.283185307179586
    if law["form"] in PARTNER:
        name, index = PARTNER[law["form"]]
        return name, law["values"][index]
    return None, None


def parameter_error(law, effects):
    wanted, truth = concealed_value(law)
    if wanted is None:
        return None
    found = {p["name"]: p["value"] for e in effects if e["name"] == law["name"] for p in e["parameters"]}
    if isinstance(wanted, tuple):
        value = sum(found[n] ** 2 for n in wanted) ** 0.5 if all(n in found for n in wanted) else None
    else:
        value = found.get(wanted)
    return None if value is None else abs(value / truth - 1)


def matches(law, effect):
    """2: that effect; 1: its class or (where the form is another) its family; 0: not it."""
    if effect["name"] == law["name"]:
        return 2
    if law["name"] in effect.get("equivalent", []):
        return 1
    if law["form"] not in TEXTBOOK and FAMILY.get(law["name"]) == effect["family"]:
        return 1
    return 0


def judge(truth, verdict):
    """right, acceptable or wrong; and why."""
    word = verdict["verdict"]
    effects = [e for joint in verdict["joints"] for e in joint.get("effects", [])]
    names = {e["name"] for e in effects}
    laws, kind, acceptable = truth["laws"], truth["kind"], set(truth["acceptable"])
    if kind == "clean":
        if word == "none":
            return "right", ""
        return ("acceptable", "abstains") if word == "insufficient" else ("wrong", "something where nothing is")
    if kind == "outside":
        if not names and word in ("unexplained", "data_fault"):
            return "right", ""
        if names and names <= acceptable:
            return "acceptable", "near relative"
        return ("wrong", "false name") if names else ("wrong", "missed")
    false = [e for e in effects if not any(matches(law, e) for law in laws) and e["name"] not in acceptable]
    if kind == "weak":
        return ("wrong", "false name") if false else ("right", "")
    if false:
        return "wrong", "false name: " + " ".join(e["name"] for e in false)
    found = [law for law in laws if any(matches(law, e) for e in effects)]
    extra = [e["name"] for e in effects if max((matches(law, e) for law in laws), default=0) < 2]
    if len(found) == len(laws):
        if len(effects) > len(laws):
            return "acceptable", "said twice: " + " ".join(extra)
        return "right", "" if not extra else "by family or class"
    if names or word == "unexplained":
        return "acceptable", "half of it" if found else "near relative" if names else "not named"
    return "wrong", "missed"


def region_overlap(law, effects):
    place = law.get("place")
    for e in effects:
        region = e.get("region")
        if place and region and e["name"] == law["name"] and region["axis"] == place["axis"]:
            both = min(place["to"], region["to"]) - max(place["from"], region["from"])
            either = max(place["to"], region["to"]) - min(place["from"], region["from"])
            return max(0.0, both) / either
    return None


def percent(x):
    return "" if x is None else f"{100 * x:.2f}"


def forgiven(truth, verdict, name):
    """The verdict without one name, unless it is concealed; what had nothing but that name is none."""
    if name is None or any(name in (law["name"], *truth["acceptable"]) for law in truth["laws"]):
        return verdict
    joints = [{**j, "effects": [e for e in j.get("effects", []) if e["name"] != name]} for j in verdict["joints"]]
    changed = any(len(a["effects"]) < len(b.get("effects", [])) for a, b in zip(joints, verdict["joints"]))
    nothing_left = changed and not any(j["effects"] for j in joints)
    return {**verdict, "joints": joints, "verdict": "none" if nothing_left else verdict["verdict"]}


def row(folder, forgive=None):
    truth = json.loads((folder / "truth/truth.json").read_text())
    seconds = (folder / "seconds").read_text().strip() if (folder / "seconds").exists() else ""
    told = " + ".join(
        f"{law['name']} ({law['form']})" if law["name"] != "outside" else law["form"] for law in truth["laws"]
    )
    try:
        verdict = forgiven(truth, json.loads((folder / "verdict.json").read_text()), forgive)
    except (OSError, ValueError):
        return truth, "wrong", f"| {folder.name} | {told or 'nothing'} | no answer | wrong | | | | | {seconds[:5]} |"
    mark, why = judge(truth, verdict)
    joint = verdict["joints"][0] if verdict["joints"] else {}
    effects = joint.get("effects", [])
    said = ", ".join(e["name"] + ("".join(f"/{n}" for n in e.get("equivalent", []))) for e in effects)
    errors = [parameter_error(law, effects) for law in truth["laws"]]
    overlaps = [region_overlap(law, effects) for law in truth["laws"]]
    after = joint.get("augmented", {})
    cells = [folder.name, told or "nothing", f"{verdict['verdict']}: {said}" if said else verdict["verdict"],
             f"{mark}{' (' + why + ')' if why else ''}",
             " ".join(f"{100 * e:.1f}" for e in errors if e is not None),
             " ".join(f"{o:.2f}" for o in overlaps if o is not None),
             percent(joint.get("baseline", {}).get("validation_relerr")), percent(after.get("validation_relerr")),
             f"{float(seconds):.0f}" if seconds else ""]
    return truth, mark, "| " + " | ".join(cells) + " |"


def main(words):
    forgive = None
    if "--forgive" in words:
        at = words.index("--forgive")
        forgive, words = words[at + 1], words[:at] + words[at + 2:]
    folder = Path(words[0])
    cases = words[1:] or sorted(p.parent.name for p in folder.glob("*/seconds"))
    counts = {}
    print("| case | concealed | verdict | score | parameter error % | place IoU | unseen before % | after % | s |")
    print("|---|---|---|---|---|---|---|---|---|")
    for case in cases:
        truth, mark, line = row(folder / case, forgive)
        print(line)
        for kind in (truth["kind"], "all"):
            counts.setdefault(kind, {"right": 0, "acceptable": 0, "wrong": 0})[mark] += 1
    print()
    for kind, count in counts.items():
        print(f"{kind:8} " + ", ".join(f"{number} {mark}" for mark, number in count.items()))


if __name__ == "__main__":
    main(sys.argv[1:])
