"""One verdict on one real recording: right, acceptable, useless or wrong, and why.

Nobody knows all that is in a real joint, so a name is judged by two things: whether it is among the names that its
answer allows, and whether the error on rows that nothing was fitted to is lower for it. A name without the second is
wrong, whatever it is.
"""

import dataclasses
import re

GRADES = ("right", "acceptable", "useless", "wrong")


def least_fall():
    """Share by which a name must lower the held-out error. Below it a name buys nothing that an engineer would notice;
    it is the layout's rule (README.md), alike for every recording."""
    return 0.05


def widest_class():
    """A class of so many names or more says too little to be right; the layout's rule as well."""
    return 5


@dataclasses.dataclass(frozen=True)
class Said:
    """What the program said of one recording."""
    verdict: str = "no answer"
    effects: tuple = ()
    text: str = ""
    rows: str = ""  # "unseen", "cross-validated": what the errors are of
    before: float | None = None  # relative errors of the baseline, of the model with its names
    after: float | None = None
    explained: float | None = None  # share of what is missing on held-out rows, by its names


def said_of(document, screen=""):
    """document: of `torquescope diagnose --json`, None where there is none; screen: what the program printed."""
    joints = document.get("joints") if isinstance(document, dict) else None
    if not joints or "verdict" not in document:
        return Said(text=screen.strip())
    joint = joints[0]
    baseline, augmented = joint["baseline"], joint.get("augmented") or {}
    validation = baseline.get("validation_relerr") is not None
    error = "validation_relerr" if validation else "cv_relerr"
    return Said(
        verdict=document["verdict"],
        effects=tuple(joint.get("effects") or ()),
        text=" ".join([document.get("reason") or "", screen]),
        rows="unseen" if validation else "cross-validated" if baseline.get(error) is not None else "",
        before=baseline.get(error),
        after=augmented.get(error),
        explained=(joint.get("explained") or {}).get("share"),  # absent in earlier documents
    )


def members(effect):
    return {effect["name"], *(effect.get("equivalent") or ())}


def names_of(said):
    """Names that are kept: a verdict that keeps none may list those it withdrew."""
    return said.effects if said.verdict in ("named", "class", "partly", "data_fault") else ()


def gains_nothing(said):
    return (
        bool(names_of(said))
        and None not in (said.before, said.after)
        and said.after > (1.0 - least_fall()) * said.before
    )


def grade(said, answer):
    """-> (grade, why)"""
    if said.verdict == "no answer":
        return "useless", _first_error(said.text)
    words = re.sub(r"\s+", " ", said.text)
    says_so = bool(answer.say) and said.verdict in answer.say_verdicts and bool(re.search(answer.say, words, re.I))
    kept = names_of(said)
    if kept and not (said.verdict == "data_fault" and "data_fault" in answer.verdicts):
        return _of_names(said, kept, answer, says_so)
    if says_so:
        return "right", "says so"
    return answer.verdicts.get(said.verdict, "wrong"), ""


def _first_error(screen):
    """The first line that the program calls an error; its help is in the file of the screen."""
    lines = [" ".join(line.split()) for line in screen.splitlines() if line.startswith("error")]
    return lines[0] if lines else "no answer"


def _of_names(said, kept, answer, says_so):
    allowed = answer.may.union(*answer.needs)
    false = [effect["name"] for effect in kept if not members(effect) & allowed]
    if gains_nothing(said):
        return "wrong", "; ".join(["the held-out error is no lower"] + [f"false: {name}" for name in false])
    if false:
        return "wrong", f"false: {', '.join(false)}"
    met = bool(answer.needs) and all(any(_meets(effect, names, answer) for effect in kept) for names in answer.needs)
    if not met and not says_so:
        return "acceptable", "the true name is missing" if answer.needs else "no false name"
    alone = [effect["name"] for effect in kept if effect["name"] in answer.class_only and len(members(effect)) == 1]
    if alone:
        return "acceptable", f"alone, where only a class can be told: {', '.join(alone)}"
    wide = [effect["name"] for effect in kept if len(members(effect)) >= widest_class()]
    if wide:
        return "acceptable", f"a class too wide: {', '.join(wide)}"
    return "right", ""


def _meets(effect, names, answer):
    """It or its class is among the names, and the size of its parameters lies where the answer wants it."""
    if not members(effect) & names:
        return False
    holds = lambda value, intervals: any(low <= abs(value) <= high for low, high in intervals)
    return all(
        holds(parameter["value"], answer.values[parameter["name"]])
        for parameter in effect.get("parameters") or ()
        if parameter["name"] in answer.values and parameter["value"] is not None
    )
