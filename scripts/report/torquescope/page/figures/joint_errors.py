"""Relative error of every joint on the training and on the validation recording; the axis starts at zero."""

from . import Case, relative_error
from .. import style


def cases(study):
    e = study.arm.reference(study)
    validation = e.validation_joint_relerr
    rows = [(joint.title, e.joint_relerr[k], float("nan") if validation is None else validation[k], style.LIGHT["ink"])
            for k, joint in enumerate(study.arm.joints) if joint.train is not None]
    last = e.validation_relerr_median if study.validate is not None else float("nan")
    rows.append(("arm", e.relerr_median, last, style.LIGHT["augmented"]))
    sentence = f"{e.short}, rows in which the joint moves one way. Blue: over all joints."
    return {"joint_errors": Case(relative_error.draw, {"rows": rows}, "Error of every joint", sentence, wide=True)}
