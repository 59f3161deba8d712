"""Recordings of real machines (real.json of bench/boards/real/run_real.py) with the words of their table on the
scoreboard's page. Every number of it is in that file."""

import json
from pathlib import Path

from . import quantities as q
from .board import plain

TONES = {"right": "held", "wrong": "failed"}
ROWS = {"unseen": "validation", "cross-validated": "left out in turn", "": "–"}


class RealBoard:
    def __init__(self, path):
        document = json.loads(Path(path).read_text())
        self.cases, self.grades = document["cases"], document["grades"]
        self.with_names, self.gains_nothing = document["with_names"], document["gains_nothing"]


def percent(share):
    return "–" if share is None else f"{q.fixed(100 * share, 1)} %"


def explained(case):
    """Share of what is missing that the names explain; a table of an earlier version has none."""
    share = case.get("explained")
    return "–" if share is None else f"{q.fixed(100 * share, 0)} %"


def said(case):
    """Names with those that the recording cannot exclude; the verdict's word where there is none."""
    names = [plain(one["name"]) + (f" or {q.listed(map(plain, one['equivalent']))}" if one["equivalent"] else "")
             for one in case["names"]]
    part = " (in part)" if names and case["verdict"] == "partly" else ""
    return "; ".join(names) + part or plain(case["verdict"])


def rows(real):
    """[{case, said, grade, tone, why, errors, truth}] for the template."""
    return [{"case": case["case"], "said": said(case), "grade": case["grade"] or "–",
             "tone": TONES.get(case["grade"], ""), "why": case["why"], "truth": case["truth"],
             "before": percent(case["before"]), "after": percent(case["after"]),
             "of": ROWS.get(case["rows"], case["rows"]),
             "explained": explained(case), "seconds": q.seconds(case["seconds"])} for case in real.cases]


def counted(real):
    return q.listed(f"{n} {grade}" for grade, n in real.grades.items())


def answer(real):
    sentence = f"{q.count(len(real.cases), 'recording')}: {counted(real)}."
    if real.with_names:
        vain = q.count_word(real.gains_nothing).capitalize()
        sentence += (f" {vain} of {q.count(real.with_names, 'verdict')} with names lower the error on rows that "
                     "nothing was fitted to by less than a twentieth, which is wrong whatever the names are.")
    return sentence


def verdict(real):
    """mark, word, tone, headline, evidence: of a page that has nothing but real recordings."""
    sentence = f"{q.count(len(real.cases), 'real recording')}: {counted(real)}."
    return {
        "mark": "◍",
        "word": "Recordings of real machines",
        "tone": "blue",
        "sentence": sentence,
        "headlines": [sentence],
        "evidence": "Other people's machines; what counts as an answer was written down beside the recordings.",
    }
