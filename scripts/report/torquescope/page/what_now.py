"""What to do with a result: lines for the next job, the motion to record, the model for other programs.

A block is {"title", "words", "text"}: a heading, one sentence, and lines to copy.
"""

import math

import numpy as np

from . import diagnosed, quantities as q
from .effect_titles import TERMS
from .friction_table import friction_table
from ..reader.diagnosis_records import Parameter

# where the load is inertia alone
HELD_AT_ONE = {"load_dependent_friction": ["load_friction_inertia_share"],
               "directional_efficiency": ["efficiency_inertia_share"]}


def blocks_of_joint(study, joint):
    """Of a diagnosed joint, single or one of an arm."""
    model = joint.augmented if diagnosed.has_after(joint) and joint.augmented else joint.baseline
    found = [_new_terms(study, joint), _narrower_search(study, joint), _simulation(study, joint, model)]
    sign = joint.friction_sign_forward, joint.friction_sign_backward
    table = "" if study.arm else friction_table(model, _fastest(joint), sign)
    programs = _programs(joint.model_c, joint.model_mjcf, table)
    return [one for one in found if one] + programs


def blocks_of_study(study):
    """Of an identification of one joint: the leading estimator's median run, as the tables have it."""
    e = study.lead
    model = {str(name): Parameter(str(name), str(unit), float(value), math.nan, math.nan)
             for name, unit, value in zip(study.model.names, study.model.units, e.chosen)}
    fastest = float(np.abs(study.train.velocity).max())
    programs = _programs(e.model_c or "", e.model_mjcf or "", friction_table(model, fastest))
    return [_diagnosis(study), *programs]


def blocks_of_arm(study):
    file = _file(study)
    found = [{"title": "The arm for other programs", "words": "URDF for ROS, MJCF for MuJoCo; --toml and --json too.",
              "text": f"torquescope export {file} --urdf arm.urdf\ntorquescope export {file} --mjcf arm.xml\n"}]
    return [*found, motion(study)]


def motion(study):
    """The motion that tells the parameters of an arm apart best; the job file's own name is not in the result."""
    return {"title": "A motion that tells more",
            "words": "Searched within the arm's limits from the robot file that the job names; JOB.toml is this job.",
            "text": "torquescope excite JOB.toml --out motion.csv\n"}


def _diagnosis(study):
    return {"title": "What does the model lack?", "words": "This job as a diagnosis; JOB.toml is its file.",
            "text": "torquescope diagnose JOB.toml --out diagnosis.h5\ntorquescope report diagnosis.h5\n"}


def _new_terms(study, joint):
    terms = [effect.name for effect in joint.effects if effect.name in TERMS]
    if not terms or study.arm:
        return None
    own = _terms(study)
    return {"title": "To fit with it from the start",
            "words": f"In place of the line terms of [model]: {_listed_effects(terms)} can be a term.",
            "text": f"[model]\nterms = [{', '.join(map(_quoted, [*own, *terms]))}]\n"}


def _narrower_search(study, joint):
    names = list(dict.fromkeys(name for effect in joint.effects for name in (effect.name, *effect.equivalent)))
    own = _terms(study)  # what the model has already is no candidate
    names += [name for advice in joint.advice for name in advice.would_separate if name not in (*names, *own)]
    if len(names) < 2:
        return None
    return {"title": "To ask a new recording about these alone",
            "words": f"Of {_listed_effects(names)}: fewer candidates need less evidence.",
            "text": f"[diagnose]\neffects = [{', '.join(map(_quoted, names))}]\n"}


def _simulation(study, joint, model):
    """Of effects whose parameters a simulated joint takes; those of a recorded channel are no part of it."""
    physics = [effect for effect in joint.effects if not effect.is_fault]
    if not physics:
        return None
    lines, title = [], "To simulate the joint with it"
    if study.arm:
        for effect in physics:
            lines += ["[[simulate.effects]]", f"joint = {joint.joint}", f"name = {_quoted(effect.name)}"]
            lines += [f"{_key(name)} = {one.value:.6g}" for name, one in effect.parameters.items()]
            lines += _held(effect, effect.parameters)
    else:
        faults = {name for effect in joint.effects if effect.is_fault for name in effect.parameters}
        lines = ["[simulate.plant]", *(f"{_key(name)} = {one.value:.6g}" for name, one in model.items()
                                       if name not in faults)]
        lines += [line for effect in physics for line in _held(effect, model)]
    return {"title": title, "words": f"The joint as found, with {_listed_effects(e.name for e in physics)}.",
            "text": "\n".join(lines) + "\n"}


def _held(effect, found):
    """Shapes that the search held at their only value, and that a simulation wants to be told."""
    return [f"{name} = 1" for name in HELD_AT_ONE.get(effect.name, ()) if name not in found]


def _programs(c, mjcf, table):
    """What the result holds as code, and the table; nothing of what an earlier version did not write."""
    texts = (("As a C function", "The torque from position, velocity and acceleration.", c),
             ("As a joint of MJCF", "For MuJoCo.", mjcf),
             ("As a table for Simulink",
              "Friction over the recorded speeds, for MATLAB: what depends on the velocity alone.", table))
    return [{"title": title, "words": words, "text": text} for title, words, text in texts if text]


def _fastest(joint):
    """Largest speed of the traces and of the map, 0 unknown."""
    speeds = [float(np.nanmax(np.abs(trace.velocity))) for trace in joint.traces if len(trace.velocity)]
    row = joint.map.get("velocity")
    if row is not None and len(row.start):
        speeds.append(float(max(abs(row.start[0]), abs(row.stop[-1]))))
    return max(speeds, default=0.0)


def _terms(study):
    """The terms of the model, by its parameters: the file has no list of them."""
    of_several = {"gravity_sin": "gravity", "gravity_cos": "gravity", "quadratic_drag": "speed_drag",
                  "cubic_drag": "speed_drag"}
    return dict.fromkeys(of_several.get(str(name), str(name)) for name in study.model.names)


def _listed_effects(names):
    return q.listed(diagnosed.effect_name(name) for name in names)


def _file(study):
    return study.path.split("/")[-1]


def _quoted(text):
    """A basic string of TOML."""
    escaped = str(text).replace("\\", "\\\\").replace('"', '\\"')
    return f'"{escaped}"' if escaped.isprintable() else '""'


def _key(text):
    return text if text.isidentifier() and text.isascii() else _quoted(text)
