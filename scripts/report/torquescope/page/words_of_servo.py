"""What the page says of a set of recordings of servos. Every number is stored in the file; errors are mean absolute,
of the position, over all samples."""

import math

from . import diagnosed, quantities as q, words, words_of_replay
from .words_of_diagnosis import VERDICTS, kept_together

FIRST_SHOWN = 6  # recordings; the others are folded
MOST_DRAWN = 60  # recordings: beyond, the page would be heavy; the table has all
FINER = {"rad": ("mrad", 1e3), "m": ("mm", 1e3)}  # of errors


def has_after(servo):
    """An effect was kept: there is an after to set beside the before."""
    return bool(servo.kept)


def finer(servo):
    """(unit, how many of it make one of the file's)"""
    return FINER.get(servo.unit, (q.unit(servo.unit), 1.0))


def error(servo, value):
    """In the finer unit, without it."""
    return q.number(value * finer(servo)[1]) if math.isfinite(value) else "diverged"


def before_after(servo, one):
    """'52.6 → 0.36'"""
    sides = [one.before, one.after] if has_after(servo) else [one.before]
    return " → ".join(error(servo, value) for value in sides)


def verdict(study):
    servo = study.servo
    mark, word, tone = VERDICTS.get(servo.verdict, ("◌", diagnosed.plain(servo.verdict), "ochre"))
    if servo.verdict == "insufficient":
        word = "The model predicts nothing"
    several = [1 + len(effect.rivals) for effect in servo.kept if effect.rivals]
    sentence = servo.headline[:1].upper() + servo.headline[1:].rstrip(".") + "."
    return {"mark": mark, "word": word.format(count=q.count_word(several[0]) if several else "several"), "tone": tone,
            "sentence": sentence, "headlines": [kept_together(sentence)], "evidence": kept_together(_evidence(servo))}


def _evidence(servo):
    """How far the model is from the recordings, and how far from itself."""
    if not servo.recordings or not math.isfinite(servo.left_rms) or servo.replicates_rms <= 0:
        return ""
    unit, times = finer(servo)
    left, apart = (q.number(times * value, 2) for value in (servo.left_rms, servo.replicates_rms))
    return (f"In training {left} {unit} rms of the position are left; simulations that begin elsewhere within an "
            f"encoder step differ by {apart} {unit}.")


def head(study):
    servo = study.servo
    validation = sum(one.is_validation for one in servo.recordings)
    said = [study.job.name, f"{study.joint} joint" if study.joint else "servo"]
    if servo.recordings:
        of_validation = f", {q.whole(validation)} of validation" if validation else ""
        said.append(q.count(len(servo.recordings), "recording") + of_validation)
    return [*said, *words.date_of(study)]


def big_numbers(study):
    """[(number, unit, caption)]: errors in training and validation, before and after."""
    servo, found = study.servo, []
    for role, one in (("training", servo.train), ("validation", servo.validate)):
        of = q.count(one.recordings, f"{'validation' if role == 'validation' else 'training'} recording")
        for side, value in (("before", one.before), ("after", one.after)):
            if one.recordings and (side == "before" or has_after(servo)):
                number = error(servo, value)
                unit = finer(servo)[0] if math.isfinite(value) else ""
                found.append((number, unit, f"mean absolute error, {of}" + (f", {side}" if has_after(servo) else "")))
    return found


def named_recordings(study):
    """[(name of its figure, its replay, its record)]: validation first, the worst after first."""
    both = [(f"replay_{at}", replay, record) for at, (replay, record) in
            enumerate(zip(study.replay.recordings, study.servo.recordings), start=1)] if study.replay else []
    worst = lambda one: -one.after if math.isfinite(one.after) else -math.inf  # noqa: E731
    return sorted(both, key=lambda one: (not one[2].is_validation, worst(one[2])))


def captioned(study):
    """[(name of its figure, its replay, caption)] of those that have a figure."""
    return [(name, replay, _caption(study.servo, replay, record))
            for name, replay, record in named_recordings(study)[:MOST_DRAWN]]


def quantities_told(servo):
    """Names of the quantities that tell recordings apart; all of them where nothing does."""
    names = list(dict.fromkeys(key for one in servo.recordings for key in one.quantities))
    apart = [name for name in names if len({one.quantities.get(name) for one in servo.recordings}) > 1]
    return apart or names


def folds(study):
    """[(summary, names of figures)] of those that are not shown at first."""
    rest = [(name, record) for name, _, record in named_recordings(study)[FIRST_SHOWN:MOST_DRAWN]]
    found = []
    for is_validation, kind in ((True, "validation"), (False, "training")):
        names = [name for name, record in rest if record.is_validation == is_validation]
        shown = any(one[2].is_validation == is_validation for one in named_recordings(study)[:FIRST_SHOWN])
        if names:
            found.append((q.count(len(names), f"{'more ' if shown else ''}{kind} recording"), names))
    return found


def quantity_text(record, key):
    value = record.quantities.get(key, math.nan)
    return value if isinstance(value, str) else q.tick(value) if math.isfinite(value) else "–"


def _caption(servo, replay, record):
    """Quantities and errors of a recording."""
    known = ", ".join(f"{key} {quantity_text(record, key)}" for key in quantities_told(servo)
                      if key in record.quantities)
    said = [f"{known}." if known else "",
            f"Mean absolute error {before_after(servo, record)} {finer(servo)[0]}, all "
            f"{q.count(record.samples, 'sample')} at {q.tick(replay.rate_hz)} Hz."]
    if words_of_replay.ends_early(replay):
        said.append(f"Believe the simulation until {q.seconds(replay.horizon_s)}; what comes after is shaded.")
    return kept_together(" ".join(text for text in said if text))


def motion_answer(study):
    servo = study.servo
    validation = any(one.is_validation for one in servo.recordings)
    order = "Validation recordings come first" if validation else "No recording is of validation"
    said = f"{order}; those with the largest error {'after ' if has_after(servo) else ''}lead. " \
        if len(servo.recordings) > 1 else ""
    said += "Simulated in closed loop from the commanded position, over all samples"
    said += ": before by the job’s model, after with the effects below." if has_after(servo) else " by the job’s model."
    more = len(servo.recordings) - MOST_DRAWN
    return said + (f" {q.count(more, 'recording')} more {'is' if more == 1 else 'are'} in the table alone."
                   if more > 0 else "")


def effects_answer(study):
    servo = study.servo
    if not servo.kept:
        return "No effect of drive or gear was kept."
    effect = servo.kept[0]
    said = (f"{q.count_word(len(servo.kept)).capitalize()} effect{'s' if len(servo.kept) > 1 else ''} of drive and "
            f"gear {'were' if len(servo.kept) > 1 else 'was'} kept. D says how much worse the recordings are fitted "
            "without an effect; p, how often replicates of the model without it gain as much by chance")
    counts = {step.replicates for step in servo.steps}
    if len(counts) == 1 and (least := 1 / (counts.pop() + 1)) > 0:
        said += f": {q.number(least, 2)} at least" if effect.p >= least * (1 - 1e-9) else ""
    return said + "."


def confused(effect):
    """[sentence] about what else it could be."""
    said = []
    if effect.rivals:
        said.append(f"In these recordings it cannot be told from {q.listed(plain(name) for name in effect.rivals)}.")
    if effect.not_told_from:
        said.append(f"Easily confused with {_words(effect.not_told_from)}.")
    return said


def plain(name):
    return diagnosed.plain(name)


def _words(text):
    """Names in a sentence of the engine without their underscores."""
    return text.replace("_", " ").rstrip(".")


def equation(effect):
    """With signs of mathematics."""
    return effect.equation.replace("<=", "≤").replace(">=", "≥").replace(" - ", f" {q.MINUS} ").replace(" * ", " · ")


def errors_answer(study):
    unit = finer(study.servo)[0]
    return (f"Mean absolute error of the position in {unit}, over all samples of the recordings that have the value. "
            "Recordings are counted in the columns training and validation.")


def left_out_answer(study):
    return ("The effects are those that were chosen on all recordings of training. Their numbers are fitted anew "
            f"without the recordings of each value; the errors, in {finer(study.servo)[0]}, are those of the "
            "recordings that were left out.")


def step_title(step):
    """Of a model of the search."""
    return f"With {q.listed(plain(name) for name in step.model)}" if step.model else "The job’s model"
