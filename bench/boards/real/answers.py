"""What counts as an answer for each recording of a folder: FOLDER/answers.json (README.md describes the layout).

Reads and checks; judges nothing. A file that cannot be graded by is refused with its place and the way out, before a
diagnosis has taken an hour.
"""

import dataclasses
import json
import re

VERDICTS = ("none", "named", "class", "partly", "unexplained", "insufficient", "data_fault")
GRADES = ("right", "acceptable", "useless")


class Unusable(ValueError):
    """The answers cannot be graded by: file, key and what to write instead."""


@dataclasses.dataclass(frozen=True)
class Answer:
    needs: tuple = ()  # sets of names: each must be met by a name or its class
    may: frozenset = frozenset()  # names that are not false beside those
    values: dict = dataclasses.field(default_factory=dict)  # parameter: intervals, one of which holds its size
    class_only: frozenset = frozenset()  # names that must not stand alone
    say: str = ""  # a regular expression: a text with it is right under a verdict of say_verdicts
    say_verdicts: tuple = ()
    verdicts: dict = dataclasses.field(default_factory=dict)  # without names: verdict -> grade; others are wrong
    truth: str = ""  # for people


def read(path):
    """{name of the case: Answer}"""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as problem:
        raise Unusable(f"{path}: {problem.strerror}; see the README beside run_real.py for the layout") from problem
    except ValueError as problem:
        raise Unusable(f"{path}: not JSON ({problem})") from problem
    cases = document.get("cases") if isinstance(document, dict) else None
    if not isinstance(cases, dict) or not cases:
        raise Unusable(f'{path}: no object "cases" of one object for each job; the README beside run_real.py has one')
    return {name: _answer(f"{path}: cases.{name}", fields) for name, fields in cases.items()}


def _answer(place, fields):
    known = {"needs", "may", "values", "class_only", "say", "say_verdicts", "truth", *GRADES}
    if not isinstance(fields, dict):
        raise Unusable(f"{place}: an object is needed")
    if unknown := sorted(set(fields) - known):
        raise Unusable(f"{place}.{unknown[0]}: no such key; there are {', '.join(sorted(known))}")
    names = lambda key: _names(f"{place}.{key}", fields.get(key, []))
    verdicts = {}
    for grade in GRADES:
        for word in names(grade):
            if word not in VERDICTS:
                raise Unusable(f"{place}.{grade}: no verdict is called {word}; there are {', '.join(VERDICTS)}")
            verdicts.setdefault(word, grade)
    say = fields.get("say", "")
    try:
        re.compile(say)
    except (re.error, TypeError) as problem:
        raise Unusable(f"{place}.say: no regular expression ({problem})") from problem
    needs = fields.get("needs", [])
    if not isinstance(needs, list):
        raise Unusable(f"{place}.needs: a list of lists of names is needed")
    return Answer(
        needs=tuple(frozenset(_names(f"{place}.needs", one)) for one in needs),
        may=frozenset(names("may")),
        values={key: _intervals(f"{place}.values.{key}", held) for key, held in fields.get("values", {}).items()},
        class_only=frozenset(names("class_only")),
        say=say,
        say_verdicts=tuple(names("say_verdicts")),
        verdicts=verdicts,
        truth=fields.get("truth", ""),
    )


def _names(place, words):
    if not isinstance(words, list) or not all(isinstance(word, str) for word in words):
        raise Unusable(f"{place}: a list of names is needed")
    return words


def _intervals(place, held):
    is_interval = lambda one: isinstance(one, list) and len(one) == 2 and one[0] <= one[1]
    if not isinstance(held, list) or not all(map(is_interval, held)):
        raise Unusable(f"{place}: a list of intervals [from, to] is needed")
    return held
