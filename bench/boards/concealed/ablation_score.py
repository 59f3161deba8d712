"""The scorer of ablations.py: a few counts per ablation, judged like everything else (judge.py)."""
import contextlib
import json

import judge

SIZABLE_SNR = 0.9  # as score.py


def judged(verdicts, sealed, names):
    judgements = []
    for name in names:
        truth, verdict = json.loads((sealed / name / "truth.json").read_text()), verdicts / f"{name}.json"
        with contextlib.suppress(judge.Inexact):  # in no rate, as in gather.py
            judgements.append(judge.judge(truth, json.loads(verdict.read_text()) if verdict.exists() else None))
    return judgements


def row(verdicts, sealed, names):
    """What the table shows of one ablation: the verdicts of these cases in one folder, their truths in another."""
    judgements = judged(verdicts, sealed, names)
    clean = [j for j in judgements if j.expected == "none"]
    named = [j for j in judgements if j.expected == "named"]
    single = [j for j in named if len(j.found) == 1 and j.snr >= SIZABLE_SNR]
    others = [j for j in judgements if j.expected != "none"]
    # silence must not look like caution, as in score.py
    invented = lambda j: bool(j.false_names) or j.verdict in ("missing", "invalid")
    count = lambda items, test: (sum(1 for item in items if test(item)), len(items))
    shares = [len(j.false_names) / j.n_named for j in judgements if j.n_named]
    return {
        "clean: any false name": count(clean, invented),
        "other: any false name": count(others, invented),
        "single: family": count(single, lambda j: j.reached("family") and j.found[0].first),
        "single: exact": count(single, lambda j: j.reached("exact") and j.found[0].first),
        "right": count(judgements, lambda j: j.right),
        "false share of names": sum(shares) / len(shares) if shares else None,
    }


def table_lines(rows):
    """rows: {method: row()}"""
    heads = list(next(iter(rows.values())))
    shown = lambda value: (
        "-" if value is None else f"{value[0]}/{value[1]}" if isinstance(value, tuple) else f"{value:.2f}"
    )
    lines = [f"{'':24}" + "".join(f"{head:>24}" for head in heads)]
    return lines + [
        f"{method:24}" + "".join(f"{shown(entry[head]):>24}" for head in heads) for method, entry in rows.items()
    ]
