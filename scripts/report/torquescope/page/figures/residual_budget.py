"""What the residual of the baseline is made of."""

import numpy as np

from .. import diagnosed, quantities, readings, style
from . import Case

# in the order of the bar; the purple says "physics" here as in the map
PARTS = (("missing physics", "little3"), ("wrong parameters", "de"), ("unexplained", "ink"), ("noise", "floor"))


def draw(shares, width=style.WIDE):
    """shares [4]: in the order of PARTS, sum 1."""
    narrow = width < style.WIDE
    canvas = style.Canvas(width, 84 if narrow else 60)
    bar = canvas.axes(0, 4, width, 28)
    bar.set_axis_off()
    bar.set(xlim=(0, max(float(np.sum(shares)), 1e-12)), ylim=(0, 1))
    readings.of(bar, ("", ""), ("", ""), zoom="")
    at = 0.0
    for share, (words, colour) in zip(shares, PARTS):
        readings.note(bar, f"{words}: {quantities.percent(share, 3)}", cell=(at, at + share, 0, 1))
        bar.barh(0.5, share, 1, left=at, color=style.LIGHT[colour])
        at += share
    for index, (share, (words, colour)) in enumerate(zip(shares, PARTS)):
        left = (index % 2) * width / 2 if narrow else index * 220
        top = 38 + (index // 2) * 20 if narrow else 38
        swatch = canvas.axes(left, top, left + 12, top + 12)
        swatch.set_axis_off()
        swatch.set(xlim=(0, 1), ylim=(0, 1))
        swatch.barh(0.5, 1, 1, color=style.LIGHT[colour])
        canvas.text(left + 18, top + 11, f"{words} {quantities.percent(share)}", color=style.LIGHT["ink"])
    return canvas.figure


def shares_of(joint):
    return [joint.budget_missing_physics, joint.budget_parameter_error, joint.budget_unexplained, joint.budget_noise]


def cases(study):
    sentence = "Shares of the energy that the baseline leaves in training."
    return {diagnosed.figure_name(study, joint, "residual_budget"):
            Case(draw, {"shares": shares_of(joint)}, "What the baseline's residual is made of", sentence, wide=True)
            for joint in study.diagnosis.joints if joint.twins and np.isfinite(shares_of(joint)).all()}
