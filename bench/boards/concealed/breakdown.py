"""The scoreboard taken apart: by tier, by size, by effect, by rig; what was said instead; misses and phantoms.

Everything is made of dictionaries, lists and numbers, so that it can be stored as JSON. The first name of a verdict is
what it says about one concealed effect; a verdict without names says its own word.
"""

import collections

import binomial
import judge
import measures
import protocol

TIERS = {
    "T0": "clean records",
    "T1": "one effect",
    "T2": "two effects",
    "T3": "three effects",
    "T4": "physics outside the catalogue",
    "T5": "weak motion",
    "T6": "measurement decoys",
    "T7": "rigs out of the ordinary",
}
GUESSES = "guess"  # of power(): the family is among the first three guesses


def by_tier(judgements):
    """[{tier, words, right, false_name, no_answer}] of the tiers that have cases."""
    rows = []
    for tier, words in TIERS.items():
        here = [j for j in judgements if protocol.kind(j) == tier]
        if here:
            rows.append(
                {
                    "tier": tier,
                    "words": words,
                    "right": measures.share(here, lambda j: j.right),
                    "false_name": measures.share(here, protocol.invented),
                    "no_answer": measures.share(here, protocol.unanswered),
                }
            )
    return rows


def _band(hits, n):
    return {"hits": hits, "n": n, "low": binomial.lower(hits, n, 0.025), "high": binomial.upper(hits, n, 0.025)}


def power(judgements):
    """[{tier, size, exact, class, family, guess, false_name}]: cases made at this size in which everything was found
    and nothing invented; each with its two-sided 95 % band."""
    rows = []
    made = [j for j in judgements if j.wanted_snr and j.expected == "named"]
    for tier, size in sorted({(j.tier, j.wanted_snr) for j in made}):
        here = [j for j in made if (j.tier, j.wanted_snr) == (tier, size)]
        row = {"tier": tier, "size": size}
        for level in judge.LEVELS:
            row[level] = _band(sum(j.reached(level) and not j.false_names for j in here), len(here))
        row[GUESSES] = _band(sum(all(f.rank is not None and f.rank <= 3 for f in j.found) for j in here), len(here))
        row["false_name"] = _band(sum(map(protocol.invented, here)), len(here))
        rows.append(row)
    return rows


def said_first(j):
    return j.names[0][0] if j.names else j.verdict


def family_first(j):
    return j.names[0][1] if j.names else j.verdict


def confusion(judgements, row_of, column_of):
    """{rows, columns, counts[row][column]} of the cases with one effect of the catalogue."""
    counts = collections.Counter((row_of(j), column_of(j)) for j in judgements if protocol.kind(j) == "T1" and j.found)
    rows = sorted({row for row, _ in counts})
    words = {column for _, column in counts}
    # what is right stands on the diagonal, other names after it, verdicts without a name last
    verdicts = [
        word
        for word in ("class", "partly", "unexplained", "none", "insufficient", "data_fault", "missing", "invalid")
        if word in words
    ]
    columns = rows + sorted(words - set(rows) - set(verdicts)) + verdicts
    return {"rows": rows, "columns": columns, "counts": [[counts[row, column] for column in columns] for row in rows]}


def by_effect(judgements):
    """[{effect, sizes: {size: [found by family, cases]}, exact, class, cases, instead: {what was said: cases}}] of
    T1."""
    rows = []
    single = [j for j in judgements if protocol.kind(j) == "T1" and j.found]
    for effect in sorted({j.found[0].name for j in single}):
        here = [j for j in single if j.found[0].name == effect]
        sizes = {}
        for j in here:
            tally = sizes.setdefault(f"{j.wanted_snr or round(j.snr, 2):g}", [0, 0])
            tally[0] += protocol.first_answers(j, "family")
            tally[1] += 1
        instead = collections.Counter(said_first(j) for j in here if not protocol.first_answers(j, "class"))
        rows.append(
            {
                "effect": effect,
                "family": here[0].found[0].family,
                "cases": len(here),
                "sizes": sizes,
                "exact": sum(protocol.first_answers(j, "exact") for j in here),
                "class": sum(protocol.first_answers(j, "class") for j in here),
                "instead": dict(instead.most_common()),
            }
        )
    return rows


def clean_controls(judgements):
    """[{part, value, records, false_names, not_none}] of T0, by what the rigs are made of."""
    clean, rows = [j for j in judgements if protocol.kind(j) == "T0"], []
    for part in ("joint", "controller", "noise", "train"):
        for value in sorted({str(j.rig[part]) for j in clean if part in j.rig}):
            here = [j for j in clean if str(j.rig.get(part)) == value]
            rows.append(
                {
                    "part": part,
                    "value": value,
                    "records": len(here),
                    "false_names": sum(map(protocol.invented, here)),
                    "not_none": sum(not j.right for j in here),
                }
            )
    return rows


def by_circumstance(judgements):
    """[{tier, words, cases, right, false_names}] of T4 to T7 by the first word of their names."""
    groups = {}
    for j in judgements:
        if j.tier in ("T4", "T5", "T6", "T7") and j.concealed:
            groups.setdefault((j.tier, j.concealed[0]), []).append(j)
    return [{"tier": tier, "words": words, "cases": len(here), "right": sum(j.right for j in here),
             "false_names": sum(map(protocol.invented, here))} for (tier, words), here in sorted(groups.items())]


def misses(judgements):
    """Cases that are not right, phantoms first, then the largest effects."""
    wrong = sorted((j for j in judgements if not j.right),
                   key=lambda j: (not protocol.invented(j), -protocol.size(j), j.drawn or j.case))
    return [
        {
            "case": j.drawn or j.case,
            "folder": j.case,
            "tier": protocol.kind(j),
            "snr": protocol.size(j),
            "concealed": list(j.concealed),
            "levels": [[f.name, f.level, f.rank] for f in j.found],
            "forms": [f.form for f in j.found if f.form],
            "verdict": j.verdict,
            "names": [name for name, *_ in j.names],
            "false_names": list(j.false_names),
            "reason": j.reason,
        }
        for j in wrong
    ]


def runtime(judgements):
    seconds = [j.seconds for j in judgements if j.seconds is not None]
    return {"seconds": seconds, "total_s": sum(seconds)}
