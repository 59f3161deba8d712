"""The scoreboard of the concealed cases; the only program that reads a truth.json.

    score.py TRUTH_DIR VERDICT_DIR [--json BOARD.json] [--all-right]

TRUTH_DIR/NAME/truth.json stands against VERDICT_DIR/NAME.json (`torquescope diagnose --json`). A verdict that is missing or
does not follow the schema counts as a failure, not as an absent case. Bounds are one-sided 95 % Clopper-Pearson.
Drawn cases are shown tier by tier as well, and what was found by the size it was made with.
Exit code 0 whatever the score, with --all-right 1 unless every case is right; 66 when there is no truth; 65 when a truth is damaged.
"""
import argparse
import dataclasses
import json
import pathlib
import statistics
import sys

import binomial
import judge

SIZABLE_SNR = 0.9  # PHYSICS.md section 4 states the naming rates from 1 on; sizes are made to within a tenth


def read_verdict(path):
    """The parsed verdict; None when missing; an empty one, which judge() calls invalid, when it is no JSON."""
    try:
        verdict = json.loads(path.read_text())
    except FileNotFoundError:
        return None
    except ValueError:
        return {}
    return verdict if isinstance(verdict, dict) else {}


def rate(hits, n, wanted):
    """wanted: "low" for rates of failures (upper bound), "high" for rates of success (lower bound)."""
    if n == 0:
        return None
    bound = binomial.upper(hits, n) if wanted == "low" else binomial.lower(hits, n)
    return {"hits": hits, "of": n, "rate": hits / n, "bound": bound, "bound_is": "upper" if wanted == "low" else "lower"}


def spread(values):
    values = sorted(v for v in values if v is not None)
    if not values:
        return None
    return {"n": len(values), "median": statistics.median(values), "p90": values[min(len(values) - 1, int(0.9 * len(values)))]}


def scoreboard(judgements):
    clean = [j for j in judgements if j.expected == "none"]
    named = [j for j in judgements if j.expected == "named"]
    outside = [j for j in judgements if j.expected == "unexplained"]
    weak = [j for j in judgements if j.expected == "insufficient"]
    decoys = [j for j in judgements if j.expected == "measurement"]
    single = [j for j in named if len(j.found) == 1 and j.snr >= SIZABLE_SNR]
    several = [j for j in named if len(j.found) > 1]
    found = [f for j in named for f in j.found]
    intervals = [inside for f in found for inside in f.intervals]
    count = lambda items, test: sum(1 for item in items if test(item))
    unanswered = lambda j: j.verdict in ("missing", "invalid")
    # silence must not look like caution: a missing verdict counts as one with a false name
    invented = lambda j: j.false_names or unanswered(j)
    return {
        "cases": len(judgements),
        "no answer": rate(count(judgements, unanswered), len(judgements), "low"),
        "clean: any false name": rate(count(clean, invented), len(clean), "low"),
        "clean: verdict none": rate(count(clean, lambda j: j.right), len(clean), "high"),
        "single: exact": rate(count(single, lambda j: j.reached("exact") and j.found[0].first), len(single), "high"),
        "single: exact or class": rate(count(single, lambda j: j.reached("class") and j.found[0].first), len(single), "high"),
        "single: family": rate(count(single, lambda j: j.reached("family") and j.found[0].first), len(single), "high"),
        "several: whole set by family": rate(
            count(several, lambda j: j.reached("family") and not j.false_names), len(several), "high"),
        "outside the catalogue: unexplained": rate(count(outside, lambda j: j.right), len(outside), "high"),
        "weak motion: class or insufficient": rate(count(weak, lambda j: j.right), len(weak), "high"),
        "decoys of measurement: called physics": rate(count(decoys, invented), len(decoys), "low"),
        "with effects: any false name": rate(
            count(named + outside + weak, invented), len(named + outside + weak), "low"),
        "false share of names": spread(
            [len(j.false_names) / max(1, j.n_named) for j in named if not unanswered(j)]),
        "effects called equivalent": spread([f.n_equivalent for f in found if f.level != "missed"]),
        "region IoU": spread([f.iou for f in found]),
        "parameter error": spread([f.parameter_error for f in found]),
        "intervals that hold the truth": rate(sum(intervals), len(intervals), "high"),
        "unseen gap closed": spread([j.gap_closed for j in named]),
        "right": rate(count(judgements, lambda j: j.right), len(judgements), "high"),
    }


def by_tier(judgements):
    """-> {tier: its scoreboard}; cases that were not drawn belong to none."""
    return {tier: scoreboard([j for j in judgements if j.tier == tier]) for tier in sorted({j.tier for j in judgements} - {""})}


def power_curve(judgements):
    """-> {tier: {size: shares of cases with everything found}}, of cases that conceal what the catalogue holds."""
    curve = {}
    for tier, size in sorted({(j.tier, j.wanted_snr) for j in judgements if j.tier and j.expected == "named"}):
        here = [j for j in judgements if (j.tier, j.wanted_snr) == (tier, size) and j.expected == "named"]
        hits = lambda level: sum(1 for j in here if j.reached(level) and not j.false_names)
        curve.setdefault(tier, {})[f"{size:g}"] = {
            **{level: rate(hits(level), len(here), "high") for level in judge.LEVELS},
            "false name": rate(sum(1 for j in here if j.false_names), len(here), "low")}
    return curve


def power_lines(curve):
    lines = [f"{'tier':5} {'size':>5} {'cases':>6} {'exact':>7} {'class':>7} {'family':>7} {'false name':>11}"]
    for tier, sizes in curve.items():
        for size, row in sizes.items():
            lines.append(f"{tier:5} {size:>5} {row['exact']['of']:6} {row['exact']['rate']:7.1%} {row['class']['rate']:7.1%} "
                         f"{row['family']['rate']:7.1%} {row['false name']['rate']:11.1%}")
    return lines


def _number(value, form):
    return "-" if value is None else format(value, form)


def case_line(j, width):
    levels = ", ".join(f"{f.name} {f.level}" for f in j.found) or "-"
    iou = ", ".join(_number(f.iou, ".2f") for f in j.found) or "-"
    error = ", ".join(_number(f.parameter_error, ".1%") for f in j.found) or "-"
    return (f"{j.drawn or j.case:{width}} {j.expected:12} {j.snr:7.2f}  {j.verdict:12} {'right' if j.right else 'WRONG':6} {levels:36} "
            f"{', '.join(j.false_names) or '-':20} {iou:10} {error:12} {_number(j.gap_closed, '.0%'):>6}")


def board_line(name, entry):
    if entry is None:
        return f"{name:36} -"
    if "hits" in entry:
        sign = "<" if entry["bound_is"] == "upper" else ">"
        return f"{name:36} {entry['hits']:4} of {entry['of']:<4} {entry['rate']:7.1%}   {sign} {entry['bound']:.1%} (95 %)"
    return f"{name:36} median {entry['median']:.3g}, 90th percentile {entry['p90']:.3g}   (n = {entry['n']})"


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("truths", type=pathlib.Path)
    parser.add_argument("verdicts", type=pathlib.Path)
    parser.add_argument("--json", type=pathlib.Path)
    parser.add_argument("--all-right", action="store_true")
    options = parser.parse_args(arguments)
    paths = sorted(options.truths.glob("*/truth.json"))
    if not paths:
        print(f"score.py: no truth in {options.truths}", file=sys.stderr)
        return 66
    try:
        judgements = [judge.judge(json.loads(path.read_text()), read_verdict(options.verdicts / f"{path.parent.name}.json"))
                      for path in paths]
    except ValueError as problem:
        print(f"score.py: {problem}", file=sys.stderr)
        return 65
    board = scoreboard(judgements)
    width = max(10, *(len(j.drawn or j.case) for j in judgements))
    print(f"{'case':{width}} {'expected':12} {'SNR_eff':>7}  {'verdict':12} {'':6} {'true effects':36} {'false names':20} "
          f"{'IoU':10} {'parameters':12} {'gap':>6}")
    print("\n".join(case_line(j, width) for j in judgements))
    print()
    print("\n".join(board_line(name, entry) for name, entry in board.items() if name != "cases"))
    tiers, curve = by_tier(judgements), power_curve(judgements)
    for tier, rows in tiers.items():
        print(f"\n{tier}, {rows['cases']} cases")
        print("\n".join("  " + board_line(name, row) for name, row in rows.items() if name != "cases" and row))
    if curve:
        print("\nfound by the size it was made with, and nothing beside")
        print("\n".join(power_lines(curve)))
    if options.json:
        options.json.write_text(json.dumps({"board": board, "tiers": tiers, "power": curve, "cases": [dataclasses.asdict(j) for j in judgements]}, indent=1))
    wrong = [j.drawn or j.case for j in judgements if not j.right]
    if options.all_right and wrong:
        print(f"\nnot right: {', '.join(wrong)}")
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
