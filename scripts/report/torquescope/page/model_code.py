"""The model of one joint as text for other programs: a C function, a joint of MuJoCo's MJCF, a table for Simulink.

A model here is {name: Parameter} as the file has it. What has no expression below (memory, time, the load) is left out,
and named as left out. Names come from files: what is no plain identifier is never written into code.
"""

import math
import re

import numpy as np

# (parameters it needs, expression in C): s is the sign of dq. The first whose parameters are all there is taken
EXPRESSIONS = (
    (("inertia",), "inertia * ddq"),
    (("viscous",), "viscous * dq"),
    (("coulomb",), "coulomb * s"),
    (("coulomb_positive",), "coulomb_positive * (dq > 0)"),
    (("coulomb_negative",), "coulomb_negative * (dq < 0)"),
    (("offset",), "offset"),
    (("gravity_sin",), "gravity_sin * sin(q)"),
    (("gravity_cos",), "gravity_cos * cos(q)"),
    (("asymmetric_viscous",), "asymmetric_viscous * fabs(dq)"),
    (("stribeck", "stribeck_speed", "stribeck_exponent"),
     "s * stribeck * exp(-pow(fabs(dq) / stribeck_speed, stribeck_exponent))"),
    (("quadratic_drag",), "quadratic_drag * dq * fabs(dq)"),
    (("cubic_drag",), "cubic_drag * pow(dq, 3)"),
    (("power_law_viscous", "power_law_exponent"), "s * power_law_viscous * pow(fabs(dq), power_law_exponent)"),
    (("position_friction_slope",), "s * position_friction_slope * q"),
    (("position_friction_cos", "position_friction_order"),
     "s * position_friction_cos * cos(position_friction_order * q)"),
    (("position_friction_sin", "position_friction_order"),
     "s * position_friction_sin * sin(position_friction_order * q)"),
    (("spring", "spring_hardening", "spring_rest"), "spring * (q + spring_hardening * pow(q - spring_rest, 3))"),
    (("spring",), "spring * q"),
    (("cogging_cos", "cogging_order"), "cogging_cos * cos(cogging_order * q)"),
    (("cogging_sin", "cogging_order"), "cogging_sin * sin(cogging_order * q)"),
)
TABLE_POINTS = 12  # on each side of rest


def split(model):
    """([(names, expression)] of what can be written, [names] of what is left out)."""
    written, done = [], set()
    for names, expression in EXPRESSIONS:
        if all(name in model for name in names) and names[0] not in done:
            written.append((names, expression))
            done |= set(names)
    return written, [name for name in model if name not in done]


def c_function(model, joint, effort):
    """A C function of position, velocity and acceleration; joint: "revolute" or "prismatic"."""
    written, left_out = split(model)
    if not written:
        return ""
    angle = "m" if joint == "prismatic" else "rad"
    lines = ["#include <math.h>", "",
             f"/* {effort} in {'N' if joint == 'prismatic' else 'N m'} from q in {angle}, dq in {angle}/s, ddq in "
             f"{angle}/s^2"]
    if left_out:
        lines.append(f"   left out, for it needs more than these three: {_said(left_out)}")
    lines[-1] += " */"
    lines.append(f"double joint_{effort}(double q, double dq, double ddq) {{")
    for name in dict.fromkeys(name for names, _ in written for name in names):
        unit = _plain(model[name].unit)
        lines.append(f"  const double {name} = {_exact(model[name].value)};{f'  /* {unit} */' if unit != '1' else ''}")
    used = " ".join(expression for _, expression in written)
    if re.search(r"\bs\b", used):
        lines.append("  const double s = (dq > 0) - (dq < 0);")
    lines += [f"  (void){name};" for name in ("q", "dq", "ddq") if not re.search(rf"\b{name}\b", used)]
    lines.append("  return " + "\n       + ".join(expression for _, expression in written) + ";")
    return "\n".join([*lines, "}", ""])


def value(model, q, dq, ddq):
    """What c_function computes, in numpy."""
    known = {name: one.value for name, one in model.items()}
    known |= {"q": q, "dq": dq, "ddq": ddq, "s": np.sign(dq), "sin": np.sin, "cos": np.cos, "exp": np.exp,
              "fabs": np.abs, "pow": np.power, "__builtins__": {}}
    return sum(eval(expression, known) for _, expression in split(model)[0])  # noqa: S307  expressions of this file


def mjcf_joint(model, name, joint):
    """A <joint> of MuJoCo: what it has words for; the rest is named in a comment. Empty without friction."""
    attributes = {"armature": "inertia", "damping": "viscous", "frictionloss": "coulomb"}
    taken = {key: model[source] for key, source in attributes.items() if source in model and model[source].value >= 0}
    if "coulomb" not in model and {"coulomb_positive", "coulomb_negative"} <= set(model):
        level = (model["coulomb_positive"].value - model["coulomb_negative"].value) / 2
        if level >= 0:
            taken["frictionloss"] = level
    if not {"damping", "frictionloss"} & set(taken):
        return ""
    written = " ".join(f'{key}="{getattr(one, "value", one):.5g}"' for key, one in taken.items())
    kind = "slide" if joint == "prismatic" else "hinge"
    inside = {"inertia", "viscous", "coulomb", "coulomb_positive", "coulomb_negative"}
    rest = [one for one in model if one not in inside]
    lines = [f'<joint name="{_plain(name) or "joint"}" type="{kind}" {written}/>']
    if "armature" in taken:
        lines.append("<!-- armature is all inertia of the joint: where the body has its own, take that off -->")
    if "coulomb" not in model and "frictionloss" in taken:
        lines.append("<!-- frictionloss is the mean of both directions -->")
    if rest:
        lines.append(f"<!-- a joint of MJCF has no words for: {_said(rest)} -->")
    return "\n".join([*lines, ""])


def friction_table(model, fastest):
    """Lines for MATLAB: velocity and torque of a 1-D Lookup Table of Simulink, up to the fastest recorded speed."""
    names = [name for names, expression in split(model)[0] for name in names if re.search(r"\b(dq|s)\b", expression)
             and not re.search(r"\bq\b", expression)]
    friction = {name: model[name] for name in names}
    if not friction or not fastest > 0:
        return ""
    # denser towards rest, where friction bends; a step on either side of zero
    side = fastest * np.geomspace(1e-3, 1, TABLE_POINTS)
    dq = np.concatenate([-side[::-1], [-1e-6 * fastest, 1e-6 * fastest], side])
    torque = value(friction, 0.0, dq, 0.0) * np.ones_like(dq)
    rows = [f"{name} = [{' '.join(f'{one:.4g}' for one in values)}];"
            for name, values in (("velocity", dq), ("friction", torque))]
    rows.append("% 1-D Lookup Table: Breakpoints velocity, Table data friction, Extrapolation Linear")
    return "\n".join([*rows, ""])


def _exact(number):
    return repr(float(number)) if math.isfinite(number) else "NAN"


def _plain(text):
    """Without what could end a comment, an attribute or a line."""
    return re.sub(r"[^\w ./^()+-]", "", str(text)).replace("--", "-")


def _said(names):
    return ", ".join(_plain(name).replace("_", " ") for name in names)
