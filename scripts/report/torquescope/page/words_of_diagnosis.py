"""What the page of a diagnosis says in sentences. The verdict's own sentences are those of the file; these set them."""

import math
import re

from . import diagnosed, quantities as q
from .words import head_of_recordings

# verdict: mark, word, tone (a colour of page.css)
VERDICTS = {
    "named": ("●", "Missing physics named", "blue"),
    "class": ("◍", "Missing physics: one of {count}", "blue"),
    "partly": ("◐", "Missing physics partly explained", "blue"),
    "none": ("○", "Nothing missing", "ink"),
    "unexplained": ("◌", "Unexplained: something else is missing", "ochre"),
    "insufficient": ("▽", "Recording too poor", "ochre"),
    "data_fault": ("✕", "Recording at fault", "ochre"),
}
MOST_HEADLINES = 2
_SENTENCE = re.compile(r"(?<=[.!?]) (?=[A-Z0-9])")
_HOW_SURE = re.compile(r" \(([^()]*p [<=][^()]*)\)(?=\.$)")


def verdict(study):
    """mark, word, tone, sentence (what is missing, with its numbers), evidence: the whole reason, in small."""
    found = study.diagnosis
    mark, word, tone = VERDICTS.get(found.verdict, ("◌", diagnosed.plain(found.verdict), "ochre"))
    # the class that keeps the verdict from a single name
    several = [1 + len(effect.equivalent) for joint in found.joints for effect in joint.effects if effect.equivalent]
    headlines, evidence = ([found.headline], [found.reason, *_replicates(found)]) if found.headline else _set(found)
    word = word.format(count=q.count_word(several[0]) if several else "several")
    if found.verdict in ("named", "class", "partly") and any(
        diagnosed.is_fault(effect) for joint in found.joints for effect in joint.effects
    ):
        word += ", and a fault of the recording"
    return {"mark": mark, "word": word, "tone": tone,
            "sentence": " ".join(headlines), "headlines": [kept_together(line) for line in headlines],
            "evidence": kept_together(" ".join(evidence))}


def joint_verdict(joint):
    """Of one joint among others: "Missing physics named"."""
    mark, word, _ = VERDICTS[joint.verdict]
    several = [1 + len(effect.equivalent) for effect in joint.effects if effect.equivalent]
    return f"{mark} " + word.format(count=q.count_word(several[0]) if several else "several")


def missing_first(joints):
    """As they stand on a page: what lacks most first, in the order of VERDICTS; what lacks nothing last."""
    order = [*(name for name in VERDICTS if name != "none"), "none"]
    return sorted(joints, key=lambda joint: order.index(joint.verdict) if joint.verdict in order else 0)


def joint_line(joint):
    """Of one joint among others: what it lacks, and its errors. "Stribeck friction. Error in training, all samples:
    5.1 → 0.5 %; error in validation, ..." """
    names = [diagnosed.effect_words(effect) for effect in joint.effects]
    what = _capital(q.listed(names)) + ". " if names else ""
    if not names and joint.verdict != "none":
        what = _SENTENCE.split(joint.reason)[0] + " " if joint.reason else ""
    errors = [f"{caption}: {_before_after(before, after)}" for before, after, caption in diagnosed.told_errors(joint)]
    return what + (_capital("; ".join(errors)) + "." if errors else "")


def kept_together(text):
    """A number stays on one line with its unit, a p with its value."""
    text = re.sub(r"(?<=\d) (?=%|[kmµ]?(?:N|rad|s|m|Hz|A|V|kg|K)\b)", "\u00a0", text)
    return re.sub(r"\bp ([<=]) ", "p\u00a0\\1\u00a0", text.replace("N m", "N\u00a0m"))


def _set(found):
    sentences = _SENTENCE.split(found.reason)
    places = [*found.joints, *([found.arm] if found.arm else [])]
    effects = {effect.sentence.strip(): effect for place in places for effect in place.effects}
    headlines, evidence = [], []
    for number, sentence in enumerate(sentences):
        is_effect = sentence in effects
        if (is_effect or number == 0) and len(headlines) < MOST_HEADLINES:
            sure = _HOW_SURE.search(sentence)
            headlines.append(_HOW_SURE.sub("", sentence))
            if sure:
                of = f"{diagnosed.effect_words(effects[sentence])}: " if is_effect and len(effects) > 1 else ""
                evidence.append(_capital(f"{of}{sure[1]}."))
        else:
            evidence.append(sentence)
    return headlines, evidence + _replicates(found)


def _replicates(found):
    twins = max((joint.twins for joint in found.joints), default=0)
    return [f"p from {q.whole(twins)} simulated replicates."] if twins and "replicates" not in found.reason else []


def _capital(text):
    # "p < 0.005" is a formula and stays as it is
    return text if text.startswith("p ") else text[:1].upper() + text[1:]


def head(study):
    joints = study.diagnosis.joints
    which = diagnosed.which_joint(joints[0]) if len(joints) == 1 else q.count(len(joints), "joint")
    return head_of_recordings(study, f"{which}, {study.model.joint}")


def big_numbers(joint):
    """[(number, unit, caption)]: at most four, without what was not measured."""
    found = [(_before_after(before, after), "", caption) for before, after, caption in diagnosed.told_errors(joint)]
    if math.isfinite(joint.explained_share):
        found.append((q.percent(joint.explained_share), "", "of what is missing on held-out rows is explained"))
    as_far = diagnosed.twins_as_far(joint)
    if as_far is not None:
        found.append((q.whole(as_far), f"of {q.whole(joint.twins)}", "simulated replicates look like this"))
    return found


def _before_after(before, after):
    return f"{q.number(100 * before, 2)} → {q.percent(after)}" if math.isfinite(after) else q.percent(before)


def map_answer(joint):
    rows = diagnosed.rows_drawn(joint)
    if not rows:
        return "Not measured: no map could be made from this recording."
    located = [row for row in rows if row.regions]
    if not located:
        return f"Nowhere: no stretch of the {q.count_word(len(rows))} axes holds more than the replicates do."
    located.sort(key=lambda row: -row.energy_share if math.isfinite(row.energy_share) else 0.0)
    where = q.listed(diagnosed.axis_title(row.axis) for row in located)
    most = q.percent(located[0].energy_share)
    others = len(rows) - len(located)
    quiet = f"; nothing is located on the other {q.count_word(others) if others > 1 else 'one'}" if others else ""
    return f"Located on {where}, where up to {most} of the residual's energy is beyond the replicates{quiet}."


def candidates_answer(joint):
    tested = sum(one.decision != "not tested" for one in joint.candidates)
    named = [one for one in joint.candidates if one.decision == "named"]
    said = "No candidate was tested"
    if tested:
        said = (f"{q.count(tested, 'candidate')} tested, smallest p first, equal p by z; "
                + ("what is named stands on top" if named else "none is named"))
    return (
        f"{said}. p counts the search over all effects and shapes. CV gain: share of the mismatch that is predicted on "
        "blocks of time that nothing was fitted to; –: not tried."
    )


def fit_answer(study, joint):
    if not math.isfinite(joint.validation_relerr):
        given = "was not judged" if study.validate is not None else "was not given"
        return f"A validation recording {given}: whether the model holds on another motion, this file cannot say."
    nuisances = q.listed(joint.nuisances)
    refitted = f" In the validation recording: {nuisances}." if joint.nuisances else ""
    if not diagnosed.has_after(joint):
        error = q.percent(joint.validation_relerr)
        return f"Nothing was put into the model; its validation error is {error}.{refitted}"
    before, after = joint.validation_relerr, joint.augmented_validation_relerr
    return f"Validation error {q.percent(before)} before, {q.percent(after)} after.{refitted}"


def title(effect):
    return _capital(effect.title or diagnosed.plain(effect.name))


def effect_line(joint, effect):
    """The evidence for one effect in one line."""
    p = diagnosed.p_cell(effect.p, effect.p_is_bound)
    said = [f"z {q.fixed(effect.z, 1)}", f"p {p.replace('<', '< ') if p.startswith('<') else '= ' + p}"]
    gains = [(effect.gain_train, "in training"), (effect.gain_cv, "cross-validated")]
    gains = [f"{diagnosed.share_words(gain)} {where}" for gain, where in gains if math.isfinite(gain)]
    if gains:
        said.append(f"of the residual's energy it takes {q.listed(gains)}")
    if math.isfinite(effect.peak):
        said.append(f"peak {q.with_unit(q.number(effect.peak, 2), joint.unit_torque)}")
    if effect.equivalent:
        said.append(f"cannot be told from {q.listed(diagnosed.effect_name(name) for name in effect.equivalent)}")
    fault = "A fault of the recording, not physics of the joint. " if diagnosed.is_fault(effect) else ""
    return fault + "; ".join(said) + "."


def forward_answer(joint):
    one = joint.forward[0]
    if not diagnosed.has_after(joint) or not math.isfinite(one.after_rms):
        return ("The model in a closed loop, driven by the recording's reference: "
                "how far its position strays from the measured one.")
    return ("The model in a closed loop, driven by the recording's reference: its position strays "
            f"{q.with_unit(q.number(one.before_rms, 2), joint.unit_position)} before, "
            f"{q.with_unit(q.number(one.after_rms, 2), joint.unit_position)} after.")


def next_steps(study, joint):
    """[sentence]: what to record or mend; empty when nothing is open."""
    said = [_capital(study.diagnosis.way_out.rstrip(".")) + "."] if study.diagnosis.way_out else []
    for advice in joint.advice:
        apart = [diagnosed.effect_name(name) for name in advice.would_separate]
        to = f" to tell {q.listed(apart)} apart" if len(apart) > 1 else ""
        if len(apart) == 1:
            to = f" to tell whether it is {apart[0]}, which came closest"
        said.append(f"{_capital(advice.lacks.rstrip('.'))}{to}.")
    return said


def how_found(joint):
    """[(what, value)] for the fold: the replicates, and what the recording has beyond them."""
    told = [("replicates", q.whole(joint.twins) if joint.twins else "not made")]
    for what, value in (("mismatch beyond the replicates, rms", joint.mismatch_rms),
                        ("the same after", joint.left_rms)):
        measured = math.isfinite(value) and joint.twins
        told.append((what, q.with_unit(q.number(value), joint.unit_torque) if measured else "not measured"))
    return told
