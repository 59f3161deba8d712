"""What the page says of estimators that fit simulations of the recordings: their errors are of all samples, and their
"gap" is the fitness itself."""

import math

from . import quantities as q

DRIVES = {"reference": "simulated in closed loop", "command": "simulated from the drive’s recorded command",
          "windows": "simulated from the recorded {effort}, in windows"}


def how(study):
    """'simulated in closed loop'"""
    drive = study.replay.recordings[0].drive if study.replay else ""
    return DRIVES.get(drive, "simulated").format(effort=study.effort)


def ran_away(e):
    return not math.isfinite(e.mse_median)


def evidence(study, e):
    """What it leaves, over how many samples, and which of its parameters stop at a bound."""
    if ran_away(e):
        return f"The simulation of {e.short} ran away, so there are no errors."
    samples = sum(one.samples for one in study.replay.recordings if not one.is_validation) if study.replay else 0
    said = [f"{e.short} leaves {q.with_unit(q.number(e.residual_std_median), study.error_unit(e))} of the "
            f"{study.error_of(e)} (standard deviation) on "
            + (f"{q.count(samples, 'sample')}, {how(study)}." if samples else f"all samples, {how(study)}.")]
    bounds = [name.replace("_", " ") for name in (e.at_bounds if e.at_bounds is not None else ())]
    if bounds:
        them = "it is" if len(bounds) == 1 else "they are"
        said.append(f"{e.short} ends on the bound{'' if len(bounds) == 1 else 's'} of {q.listed(bounds)}: the "
                    f"recordings do not say what {them}.")
    return " ".join(said)


def errors(study, e):
    """'LM: 3.0 % relative error of the force in training, 3.5 % in validation, over all samples, in its loop.'"""
    if ran_away(e):
        return evidence(study, e)
    further = "" if study.validate is None else f", {q.percent(e.validation_relerr_median)} in validation"
    return (f"{e.short}: {q.percent(e.relerr_median)} relative error of the {study.error_of(e)} in training{further}, "
            f"over all samples, {how(study)}.")


def note(study):
    """Below the table of estimators."""
    them = q.listed(e.short for e in study.rolled)
    verb = "fits" if len(study.rolled) == 1 else "fit"
    others = " Other errors are of rows." if len(study.rolled) < len(study.estimators) else ""
    return (f"{them} {verb} simulations of the recordings: errors are of all samples, {how(study)}.{others} Fitness: "
            "the squared error of what is fitted, over that of the model where the fit begins; nobody knows its least "
            "value.")


def recording_note(study):
    """Beside the rows of the filter."""
    them = q.listed(e.short for e in study.rolled)
    if not them:
        return ""
    return f" {them} {'simulates' if len(study.rolled) == 1 else 'simulate'} every sample, not these rows."
