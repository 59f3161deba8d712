"""What a verdict is worth beside the truth of a case, in words and in counts. README.md has the grades."""

import collections
import dataclasses

ANSWERED = ("right", "class", "family", "wrong")
SILENT = ("none", "unexplained", "insufficient", "data_fault", "besides", "no answer")


@dataclasses.dataclass(frozen=True)
class Grade:
    word: str             # one of ANSWERED or SILENT; of a clean case "false" or one of SILENT
    too_many: tuple = ()  # names that are not there, beside a right one, a class or one of the family
    besides: tuple = ()   # names of what is in the joint although it was not hidden: its sticking, its drive's lag


def names_of(effect):
    return {effect["name"], *effect.get("equivalent", [])}


def grade(truth, verdict):
    """truth: truth.json; verdict: the document of `torquescope diagnose --json`, None where there is none."""
    if verdict is None:
        return Grade("no answer")
    effects = [effect for joint in verdict["joints"] for effect in joint.get("effects", [])]
    hidden = truth["effects"][0] if truth["effects"] else {"name": None, "family": None}
    # the first that answers best: by its own name, as one of a class, by its family
    best = (next((e for e in effects if e["name"] == hidden["name"]), None)
            or next((e for e in effects if hidden["name"] in names_of(e)), None))
    others = [e for e in effects if e is not best]
    besides = tuple(e["name"] for e in others if names_of(e) & set(truth["besides"]))
    foreign = [e for e in others if e["name"] not in besides]
    if best is None:
        best = next((e for e in foreign if e["family"] == hidden["family"]), None)
        foreign = [e for e in foreign if e is not best]
        word = "family" if best else None
    else:
        word = "class" if best.get("equivalent") else "right"
    too_many = tuple(e["name"] for e in foreign)
    if word:
        return Grade(word, too_many, besides)
    if foreign:
        return Grade("wrong" if truth["effects"] else "false", (), besides)
    # "besides": names, but only of what was not hidden
    return Grade("besides" if besides else verdict["verdict"], (), besides)


def told(truth, verdict, graded):
    """A case in one line: what is there, what was said, what that is worth."""
    sticking, reading, motion = truth["sticking"], truth["reading"], truth["motion"]
    size = sticking.get("speed_rad_s", sticking.get("length_rad"))
    law = sticking["law"] + (f" {1e3 * size:.2g} m{'rad/s' if 'speed_rad_s' in sticking else 'rad'}" if size else "")
    joint = (f"{law}, {reading['encoder_bits']:.0f} bit, {reading['log_hz']:.0f} Hz, {reading['torque']}, "
             f"{motion['kind']}, {'cut-off %.0f Hz' % truth['cutoff_hz'] if truth['cutoff_hz'] else 'no filter'}")
    hidden = ", ".join(f"{e['name']} ({e['form']}) {100 * e['relative_size']:.2g} %" for e in truth["effects"])
    effects = [e for one in (verdict or {"joints": []})["joints"] for e in one.get("effects", [])]
    names = ", ".join("/".join([e["name"], *e.get("equivalent", [])]) for e in effects)
    said = (verdict["verdict"] if verdict else "no answer") + (f": {names}" if names else "")
    worth = graded.word + (f", too many: {', '.join(graded.too_many)}" if graded.too_many else "")
    return f"{hidden or 'nothing'} [{joint}] -> {said} -> {worth}"


def summary(graded):
    """graded: (truth, Grade) of every case."""
    clean = [(t, g) for t, g in graded if not t["effects"]]
    single = [(t, g) for t, g in graded if t["effects"]]
    lines = []
    if clean:
        count = collections.Counter(g.word for _, g in clean)
        lines.append(f"clean: falsely named {count['false']} of {len(clean)}; "
                     + ", ".join(f"{word} {count[word]}" for word in SILENT))
        laws = collections.Counter(t["sticking"]["law"] for t, _ in clean)
        false = collections.Counter(t["sticking"]["law"] for t, g in clean if g.word == "false")
        lines.append("       falsely named by sticking law: "
                     + ", ".join(f"{law} {false[law]} of {n}" for law, n in sorted(laws.items())))
    if single:
        count = collections.Counter(g.word for _, g in single)
        missed = sum(count[word] for word in SILENT)
        n = len(single)
        lines.append(f"single: right alone {count['right']} of {n}, in a class with the truth {count['class']}, "
                     f"family {count['family']}, wrong name {count['wrong']}, missed {missed} ("
                     + ", ".join(f"{word} {count[word]}" for word in SILENT) + ")")
        laws = sum(len(g.too_many) for _, g in single)
        lines.append(f"        a law too many: {laws} in {sum(bool(g.too_many) for _, g in single)} cases")
        by_name = collections.defaultdict(collections.Counter)
        for t, g in single:
            by_name[t["effects"][0]["name"]][g.word if g.word in ANSWERED else "missed"] += 1
        for name, words in sorted(by_name.items()):
            lines.append(f"        {name}: " + ", ".join(f"{word} {k}" for word, k in words.items()))
    beside = sum(bool(g.besides) for _, g in graded)
    lines.append(f"all: names of what is there besides (sticking, lag of the drive) in {beside} of {len(graded)}")
    return "\n".join(lines)
