"""The tables of the page of a diagnosis as finished words; diagnosis.html only sets them."""

import math
import re

from . import diagnosed, quantities as q, tables

DOTS_WIDTH = 150  # px of the picture of z
FIRST_SHOWN = 10
MARKS = {"named": "●", "class": "◍", "measurement": "✕", "no": "○", "not tested": "–"}


def candidates(joint):
    """One dict of words per candidate, with the pixels of its dot from the left edge. What is named first, then by p as
    it is shown, equal ones by z; what was not tested comes last."""
    scale = (DOTS_WIDTH - 12) / max([1.0] + [one.z for one in joint.candidates if math.isfinite(one.z)])
    return [_candidate(one, scale) for one in sorted(joint.candidates, key=_rank)]


def _rank(one):
    """As engine/app/result/candidate_text.cpp."""
    groups = {"not tested": 2, "no": 1}
    p, z = (value if math.isfinite(value) else worst for value, worst in ((one.p, math.inf), (one.z, -math.inf)))
    return groups.get(one.decision, 0), p, -z


def _candidate(one, scale):
    tested = one.decision != "not tested" and math.isfinite(one.z)
    pixels = lambda value: round(6 + max(value, 0.0) * scale, 1)  # noqa: E731
    return {
        "name": one.name,
        "title": diagnosed.effect_name(one.name),
        "family": diagnosed.plain(one.family),
        "mark": MARKS.get(one.decision, "○"),
        "decision": one.decision,
        "reason": one.reason or diagnosed.plain(one.decision),
        "z_pixel": pixels(one.z) if tested else None,
        "z": q.fixed(one.z, 1) if tested else "–",
        "p": diagnosed.p_cell(one.p, one.p_is_bound) if tested else "–",
        "cv_gain": f"{q.fixed(100 * one.cv_gain, 1)} %" if 0 < one.cv_gain <= 1 else diagnosed.share_words(one.cv_gain),
    }


def forward(joint):
    """{"head", "rows"} of the closed-loop simulations."""
    unit = q.unit(joint.unit_position)
    changed = diagnosed.has_after(joint)
    head = (
        ["recording", f"motion, rms {unit}", f"error before {unit}"]
        + ([f"error after {unit}"] if changed else [])
        + [f"encoder step {unit}"]
    )
    rows = [
        [one.recording, q.number(one.motion_rms), q.number(one.before_rms)]
        + ([q.number(one.after_rms)] if changed else [])
        + [q.number(one.encoder_step) if one.encoder_step else "–"]
        for one in joint.forward
    ]
    return {"head": head, "rows": rows}


def equations(study, joint):
    """The model's line, then one (name, equation) per effect put into it."""
    return tables.equation(study), [
        (diagnosed.effect_words(effect), signs(effect.equation)) for effect in joint.effects if effect.equation
    ]


def signs(text):
    for plain, sign in (("ddq", "q\u0308"), ("dq", "q\u0307"), ("tau", "τ"), ("delta", "δ")):
        text = re.sub(rf"\b{plain}\b", sign, text)
    return text.replace(" * ", " · ").replace("-", q.MINUS)


def unexplained(joint):
    """[sentence] about what no candidate explains."""
    return [f"{q.percent(share)} of the residual's energy lies at {diagnosed.axis_title(where.axis)} "
            f"{diagnosed.range_words(where.start, where.stop, diagnosed.axis_unit(where))} and is not explained."
            for where, share in joint.unexplained if math.isfinite(share)]
