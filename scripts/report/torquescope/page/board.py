"""The scoreboard (board.json of bench/boards/concealed/score.py) with the words of its page. Every number of the page
is in that file."""

import json
from pathlib import Path

from . import quantities as q

OURS = "torquescope"
# verdicts without a name, and other words of the file that are no name of an effect
WORDS = {
    "none": "nothing missing",
    "partly": "partly explained",
    "unexplained": "something else",
    "insufficient": "too poor",
    "data_fault": "recording at fault",
    "missing": "no answer",
    "invalid": "unreadable answer",
    "train": "motion",
    "torquescope": "Torquescope",
}
# what stands first in the names of drawn cases (bench/boards/concealed/decoys.hpp, drawn_name.hpp)
CIRCUMSTANCES = {
    "one_speed": "one speed only",
    "one_direction": "one direction only",
    "narrow": "narrow travel",
    "encoder": "encoder steps unknown",
    "stamps": "time stamps wrong",
    "late": "torque late",
    "filter": "torque filtered",
    "hold": "torque held",
    "noise": "twice the noise",
    "gains": "gains a tenth off",
    "outside_memory_drag": "drag with memory",
    "outside_sloshing": "sloshing load",
    "outside_hidden_shaft": "hidden shaft",
    "outside_supply_sag": "sagging supply",
}


def plain(word):
    """A name of the file as a person reads it."""
    return WORDS.get(word, word.replace("_", " "))


def concealed_words(word):
    return CIRCUMSTANCES.get(word, plain(word))


def number(row, value):
    if value is None:
        return "–"
    if row["form"] == "percent":
        return f"{q.fixed(100 * value, 1)} %"
    return {"seconds": q.seconds, "count": q.tick, "number": lambda v: q.fixed(v, 3)}[row["form"]](value)


def _of(row):
    if row["value"] is None:
        return ""
    return f"{row['hits']} of {row['n']}" if row["hits"] is not None else f"n = {row['n']}"


class Board:
    def __init__(self, path):
        document = json.loads(Path(path).read_text())
        self.suite, self.methods = document["suite"], document["methods"]
        self.ours = self.methods[OURS]

    def row(self, key):
        return next(row for row in self.ours["table"] if row["key"] == key)


# ---- sentences

def verdict(board):
    """mark, word, tone, headline, evidence."""
    levels = [row["pass_holds"] for row in board.ours["table"] if row["pass"]]
    held, failed = levels.count("yes"), levels.count("no")
    rest = len(levels) - held - failed
    clean, family = board.row("clean_false_name"), board.row("single_family")
    parts = []
    if clean["n"]:
        parts.append(
            f"{q.count_word(clean['hits']).capitalize()} of {q.count(clean['n'], 'clean record')} got a false name"
        )
    if family["n"]:
        parts.append(f"{family['hits']} of {q.count(family['n'], 'single effect')} were named by their family")
    sentence = "; ".join(parts) + "." if parts else f"{q.count(board.suite['cases'], 'case')} judged."
    evidence = (f"{held} of {len(levels)} pass levels hold, {failed} do not, {rest} cannot be told from so few cases. "
                "An independent plant concealed the effects; only the scorer read what they are.")
    return {
        "mark": "●" if failed == 0 and rest == 0 else "◍",
        "word": "Scoreboard of concealed effects",
        "tone": "blue",
        "sentence": sentence,
        "headlines": [sentence],
        "evidence": evidence,
    }


def left_out(board):
    """A sentence, empty when every case was judged."""
    cases = board.suite.get("left_out", [])
    if not cases:
        return ""
    verb = "is" if len(cases) == 1 else "are"
    return (
        f"{q.count_word(len(cases)).capitalize()} of {q.count(board.suite['cases'] + len(cases), 'case')} {verb} in "
        "no row, because "
        f"half the step of the plant would have given another recording: {q.listed(one['case'] for one in cases)}."
    )


def head(board):
    seeds = ", ".join(map(str, board.suite["suite_seeds"])) or "none"
    return ["scoreboard", q.count(board.suite["cases"], "case"), f"suite seed {seeds}"]


def big_numbers(board):
    """Four of: [(number, unit, caption)]."""
    found = []
    for key, caption in (("clean_false_name", "clean records with a false name"),
                         ("single_family", "single effects of SNR 1 or more: right family first"),
                         ("false_share", "false share of the names"),
                         ("gap_closed", "of the gap to the oracle closed on validation data, median")):
        row = board.row(key)
        if row["value"] is not None:
            found.append((number(row, row["value"]), "", f"{caption}; {_of(row)}"))
    return found


# ---- tables: {"head": [...], "rows": [[...]]}

def scoreboard(board):
    """[{words, measured, of, bounds, pass, pass_holds, stretch, stretch_holds}] for the template."""
    rows = []
    for row in board.ours["table"]:
        known = row["low"] is not None or row["high"] is not None
        rows.append({"words": row["words"], "measured": number(row, row["value"]), "of": _of(row),
                     "bounds": f"{number(row, row['low'])} … {number(row, row['high'])}" if known else "",
                     **{key: row[key] for key in ("pass", "pass_holds", "stretch", "stretch_holds")}})
    return rows


def methods_table(board):
    """Every method in every row: measured, and of how many."""
    names = list(board.methods)
    rows = []
    for index, row in enumerate(board.ours["table"]):
        rows.append([row["words"], *(number(row, board.methods[name]["table"][index]["value"]) for name in names)])
    return {"head": ["", *map(plain, names)], "rows": rows}


def tiers_table(board):
    rows = [[tier["words"], tier["right"]["n"], *(tier[key]["hits"] for key in ("right", "false_name", "no_answer"))]
            for tier in board.ours["tiers"]]
    return {"head": ["kind of case", "cases", "right", "with a false name", "no answer"], "rows": rows}


def effects_table(board):
    """Found by family at each size, and what was said first instead of the name or its class."""
    sizes = sorted({size for row in board.ours["effects"] for size in row["sizes"]}, key=float)
    rows = []
    for row in board.ours["effects"]:
        found = [
            f"{row['sizes'][size][0]} of {row['sizes'][size][1]}" if size in row["sizes"] else "" for size in sizes
        ]
        instead = ", ".join(
            plain(word) + (f" ({times})" if times > 1 else "") for word, times in row["instead"].items()
        )
        rows.append([plain(row["effect"]), plain(row["family"]), *found,
                     *(f"{row[level]} of {row['cases']}" for level in ("exact", "class")), instead])
    return {
        "head": [
            "concealed",
            "family",
            *(f"SNR {size}" for size in sizes),
            "exact name",
            "name or class",
            "said instead",
        ],
        "rows": rows,
    }


def clean_answer(board):
    row = board.row("clean_false_name")
    return (f"Nothing is concealed in these records; every name is an invention. {row['hits']} of {row['n']} have one: "
            f"{number(row, row['value'])}, with 95 % certainty below {number(row, row['high'])}.") if row["n"] else ""


def clean_table(board):
    parts = {"joint": "joint", "controller": "controller", "noise": "noise", "train": "motion"}
    return {"head": ["made with", "", "records", "with a false name", "other than “nothing missing”"],
            "rows": [[parts[row["part"]], plain(row["value"]), row["records"], row["false_names"], row["not_none"]]
                     for row in board.ours["clean"]]}


def circumstances_table(board):
    kinds = {
        "T4": "outside the catalogue",
        "T5": "weak motion",
        "T6": "measurement decoy",
        "T7": "rig out of the ordinary",
    }
    return {"head": ["kind", "which", "cases", "right", "with a false name"],
            "rows": [[kinds[row["tier"]], concealed_words(row["words"]), row["cases"], row["right"], row["false_names"]]
                     for row in board.ours["circumstances"]]}


def misses(board):
    """[{case, concealed, forms, said, near, phantom, reason}]: what was concealed, what was said."""
    found = []
    for one in board.ours["misses"]:
        hidden = q.listed(concealed_words(word) for word in one["concealed"]) or "nothing"
        size = f", SNR {q.number(one['snr'], 2)}" if one["levels"] else ""
        said = q.listed(map(plain, one["names"])) or plain(one["verdict"])
        near = [f"{plain(name)} was guess {rank}" if len(one["levels"]) > 1 else f"its family was guess {rank}"
                for name, level, rank in one["levels"] if level == "missed" and rank is not None and rank <= 3]
        found.append({"case": one["case"], "concealed": hidden + size, "forms": q.listed(one["forms"]), "said": said,
                      "near": "; ".join(near),
                      "phantom": q.listed(map(plain, one["false_names"])), "reason": one["reason"]})
    return found


def provenance(board):
    suite = board.suite
    several = lambda hashes: ", ".join(hashes) or "unknown"
    return [
        ("cases", str(suite["cases"])),
        ("suite seed", ", ".join(map(str, suite["suite_seeds"])) or "none (sealed cases)"),
        ("sealed truths, SHA-256", suite["truths_sha256"]),
        ("program, SHA-256", several(suite["programs_sha256"])),
        ("plant, SHA-256", several(suite["plants_sha256"])),
    ]
