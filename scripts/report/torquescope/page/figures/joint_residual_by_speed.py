"""What the model leaves at each joint over its speed: a wrong friction model shows as a shape here."""

from .. import quantities, style
from . import Case, residual_by_speed


def cases(study):
    e, found = study.arm.reference(study), {}
    for joint in study.arm.joints:
        if joint.train is None:
            continue
        arguments = {"velocity": joint.train.velocity,
                     "residual": joint.train.torque - joint.train.prediction(e.chosen),
                     "velocity_unit": quantities.unit(joint.train.velocity_unit),
                     "unit": quantities.unit(joint.train.unit), "colour": style.LIGHT["ink"]}
        found[f"joint_residual_by_speed_{joint.number}"] = Case(
            residual_by_speed.draw, arguments, f"{joint.heading}: residual over speed",
            f"Mean of what {e.short} leaves in training; grey: ±1 standard deviation. A shape is friction the model "
            "lacks.")
    return found
