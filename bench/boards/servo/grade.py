"""What a verdict about a servo is worth beside the laws that it has, in words and in counts."""

import collections
import dataclasses

# names of the program -> laws of the plant, where they differ
ALIASES = {"load_dependent_friction": "load_friction", "torque_lag_s": "torque_lag", "actuator_lag": "torque_lag",
           "command_delay_s": "command_delay", "stribeck_friction": "stribeck",
           "load_square_friction": "load_square", "load_stribeck_friction": "load_stribeck"}


def kept_names(document):
    """-> [[name, equivalent name, ...], ...]: the one place that knows the document of `diagnose --json`.

    A list `kept` of names, or of objects with `name` and `equivalent` (or `rivals`), at the top or in a joint, or the
    `effects` of joints.
    """
    places = [document, *(document.get("joints") or [])]
    kept = [one for place in places for one in place.get("kept", [])]
    if not any("kept" in place for place in places):
        kept = [one for place in places for one in place.get("effects", [])]
    named = []
    for one in kept:
        names = [one] if isinstance(one, str) else [one["name"], *one.get("equivalent", one.get("rivals", []))]
        named.append([ALIASES.get(name, name) for name in names])
    return named


@dataclasses.dataclass(frozen=True)
class Grade:
    word: str            # right, class, wrong, missed; of a clean servo clean or false; no answer
    right: tuple = ()    # laws that are named by themselves
    in_class: tuple = ()  # laws that are among the equivalents of a name
    missed: tuple = ()
    false: tuple = ()    # names without a law of the servo among their equivalents


def grade(laws, named):
    """laws: names of the truth; named: kept_names(), None where there is no answer."""
    if named is None:
        return Grade("no answer", missed=tuple(laws))
    right = tuple(law for law in laws if any(names[0] == law for names in named))
    in_class = tuple(law for law in laws if law not in right and any(law in names for names in named))
    missed = tuple(law for law in laws if law not in right + in_class)
    false = tuple(names[0] for names in named if not set(names) & set(laws))
    if not laws:
        word = "false" if false else "clean"
    elif missed:
        word = "wrong" if false and not right + in_class else "missed"
    else:
        word = "class" if in_class else "right"
    return Grade(word, right, in_class, missed, false)


def told(truth, verdict, named, graded):
    """A case in one line: what is there and how far it moves the servo, what was said, what that is worth."""
    hidden = ", ".join(f"{law['name']} {law['number']:.3g} ({law['effect_mrad']:.3g} mrad)" for law in truth["laws"])
    said = verdict + (": " + ", ".join("/".join(names) for names in named) if named else "")
    worth = graded.word + (f", missed: {', '.join(graded.missed)}" if graded.missed else "")
    worth += f", false: {', '.join(graded.false)}" if graded.false else ""
    return f"{hidden or 'nothing'} -> {said} -> {worth}"


def summary(graded):
    """graded: (laws of the truth, Grade) of every case."""
    lines = []
    clean = [one for laws, one in graded if not laws]
    hidden = [(laws, one) for laws, one in graded if laws]
    if clean:
        count = collections.Counter(one.word for one in clean)
        lines.append(f"clean: falsely named {count['false']} of {len(clean)}, no answer {count['no answer']}")
    if hidden:
        count = collections.Counter(one.word for _, one in hidden)
        extra = sum(bool(one.false) for _, one in hidden)
        lines.append(f"cases with laws: right {count['right']} of {len(hidden)}, in a class with the truth "
                     f"{count['class']}, wrong {count['wrong']}, missed {count['missed']}, no answer "
                     f"{count['no answer']}; false names beside in {extra}")
        n = sum(len(laws) for laws, _ in hidden)
        lines.append(f"laws: right {sum(len(one.right) for _, one in hidden)} of {n}, in a class "
                     f"{sum(len(one.in_class) for _, one in hidden)}, missed "
                     f"{sum(len(one.missed) for _, one in hidden)}; false names "
                     f"{sum(len(one.false) for _, one in hidden)}")
        by_law = collections.defaultdict(collections.Counter)
        for _, one in hidden:
            for word in ("right", "in_class", "missed"):
                for law in getattr(one, word):
                    by_law[law][word.replace("_", " a ")] += 1
        lines += [f"      {law}: " + ", ".join(f"{word} {k}" for word, k in words.items())
                  for law, words in sorted(by_law.items())]
    return "\n".join(lines)
