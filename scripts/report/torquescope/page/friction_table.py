"""Friction of a joint as a table for Simulink. A model is {name: Parameter} as the file has it."""

import re

import numpy as np

from .effect_code import CODE

TABLE_POINTS = 12  # on each side of rest
MOTION = re.compile(r"\b(q|ddq|load)\b")
VELOCITY = re.compile(r"\b(dq|s|friction_sign)\b")


def friction_effects(model):
    """[(effect, expression)] of what depends on the velocity alone and has all its parameters in the model."""
    return [(effect, expression) for effect, (names, expression) in CODE.items()
            if all(name in model for name in names) and VELOCITY.search(expression) and not MOTION.search(expression)]


def value(model, dq, sign=(1.0, -1.0)):
    """Torque of these effects; sign: friction_sign of both directions."""
    known = {name: one.value for name, one in model.items()}
    known |= {"dq": dq, "s": np.sign(dq), "friction_sign": np.where(dq > 0, sign[0], np.where(dq < 0, sign[1], 0.0)),
              "exp": np.exp, "fabs": np.abs, "pow": np.power, "__builtins__": {}}
    return sum(eval(expression, known) for _, expression in friction_effects(model))  # noqa: S307  of effect_code.py


def friction_table(model, fastest, sign=(1.0, -1.0)):
    """Lines for MATLAB: velocity and torque of a 1-D Lookup Table of Simulink, up to the fastest recorded speed."""
    effects = friction_effects(model)
    if not effects or not fastest > 0:
        return ""
    if not np.all(np.isfinite(sign)):
        if any("friction_sign" in expression for _, expression in effects):
            return ""  # of an earlier version: these levels are not in the file
        sign = (1.0, -1.0)
    # denser towards rest, where friction bends; a step on either side of zero
    side = fastest * np.geomspace(1e-3, 1, TABLE_POINTS)
    dq = np.concatenate([-side[::-1], [-1e-6 * fastest, 1e-6 * fastest], side])
    torque = value(model, dq, sign) * np.ones_like(dq)
    rows = [f"{name} = [{' '.join(f'{one:.4g}' for one in values)}];"
            for name, values in (("velocity", dq), ("friction", torque))]
    rows.append("% 1-D Lookup Table: Breakpoints velocity, Table data friction, Extrapolation Linear")
    return "\n".join([*rows, ""])
