"""Are the p-values of clean records uniform, and how often is something named where nothing is missing?

    run_suite.py torquescope make_case OUT --clean 1..120
    calibrate.py OUT [--json CALIBRATION.json]

Reads of every clean record in OUT: the p-values in its result (engine/store/RESULT_FORMAT.md, /diagnosis: candidates,
effects that were not tested left out; axes of the map; the whole mismatch), its verdict, and from the scorer's side
which rig it was made with. The pooled figures are those of the candidates.

Effects of one record share its noise, so only p-values of different records are independent: the distance of Kolmogorov
and Smirnov stands beside its 5 % critical value effect by effect, over records. The pooled rates have their spread from
the records as a whole. Twins make p-values discrete (1/(M+1)): a distance below that says nothing.

    D      largest distance of the empirical distribution from the uniform one
    D+     the same above the diagonal only: too many small p-values, the harmful side

Exit code 0 whatever comes out; 66 when no record could be read.
"""

import argparse
import json
import math
import pathlib
import statistics
import sys

import h5py

import binomial

LEVELS = (0.01, 0.05, 0.10)
FEWEST_RECORDS = 20  # an effect tested on fewer says nothing about its distribution


def p_values_of(path):
    """-> {statistic: p} of the first joint: candidates while nothing was named yet, the axes of the map, the whole
    mismatch."""
    text = lambda word: word.decode() if isinstance(word, bytes) else str(word)
    with h5py.File(path, "r") as file:
        joint = file["diagnosis/joint_1"]
        found = {"(whole mismatch)": float(joint.attrs["omnibus_p"])}
        for axis, group in joint["map"].items() if "map" in joint else ():
            found[f"(map, {axis})"] = float(group.attrs["p"])
        if "candidates" in joint:
            table = joint["candidates"]
            for name, p, decision in zip(table["names"][()], table["p"][()], table["decisions"][()]):
                if text(decision) != "not tested":
                    found[text(name)] = float(p)
    return {name: p for name, p in found.items() if math.isfinite(p)}


def distances(values):
    """-> (D, D+) of the empirical distribution from the uniform one."""
    values, n = sorted(values), len(values)
    above = max(((i + 1) / n - p for i, p in enumerate(values)), default=0.0)
    below = max((p - i / n for i, p in enumerate(values)), default=0.0)
    return max(above, below), max(0.0, above)


def critical(n):
    """5 % critical value of D for n independent values (Stephens 1970; exact to 1 % from n = 10 on)."""
    return 1.358 / (math.sqrt(n) + 0.12 + 0.11 / math.sqrt(n))


def pooled_rate(records, level):
    """Share of p-values at most `level`, and its standard error from the spread between records."""
    shares = [sum(p <= level for p in record.values()) / len(record) for record in records if record]
    error = statistics.stdev(shares) / math.sqrt(len(shares)) if len(shares) > 1 else None
    return {"level": level, "rate": statistics.fmean(shares) if shares else math.nan, "standard_error": error}


def effect_row(values):
    n = len(values)
    distance, above = distances(values)
    hits = [sum(p <= level for p in values) for level in LEVELS]
    return {"records": n, "D": distance, "D_plus": above, "critical_5": critical(n), "rates": [h / n for h in hits],
            "chance_of_5": binomial.lower(hits[1], n) <= 0.05 <= binomial.upper(hits[1], n)}


def by_effect(records):
    effects = {}
    for record in records:
        for name, p in record.items():
            effects.setdefault(name, []).append(p)
    return {name: effect_row(values) for name, values in effects.items() if len(values) >= FEWEST_RECORDS}


def calibration(records):
    """records: list of {"rig": {...}, "p": {effect: p}, "named": [...], "verdict": "none"}."""
    candidates = lambda record: {name: p for name, p in record["p"].items() if not name.startswith("(")}
    tables = [candidates(record) for record in records]
    false = sum(1 for record in records if record["named"])
    other = sum(1 for record in records if record["verdict"] != "none")
    groups = {}
    for record in records:
        for part in ("joint", "controller", "noise", "train"):
            groups.setdefault(f"{part} {record['rig'][part]}", []).append(record)
    distance, above = distances([p for table in tables for p in table.values()])
    return {
        "records": len(records),
        "pooled": {
            "p_values": sum(map(len, tables)),
            "D": distance,
            "D_plus": above,
            "rates": [pooled_rate(tables, level) for level in LEVELS],
        },
        "effects": by_effect([record["p"] for record in records]),
        "groups": {
            name: {
                "records": len(group),
                "rate_5": pooled_rate([candidates(r) for r in group], 0.05)["rate"],
                "false_names": sum(1 for r in group if r["named"]),
            }
            for name, group in sorted(groups.items())
        },
        "false_name": {"hits": false, "of": len(records), "upper_95": binomial.upper(false, len(records))},
        "not_none": {"hits": other, "of": len(records)},
        "names": sorted(name for record in records for name in record["named"]),
    }


def read_records(out):
    records, lost = [], []
    for path in sorted(out.glob("sealed/*/truth.json")):
        truth, name = json.loads(path.read_text()), path.parent.name
        if truth["expected"] != "none":
            continue
        try:
            verdict = json.loads((out / "verdicts" / f"{name}.json").read_text())
            named = [effect["name"] for joint in verdict["joints"] for effect in joint["effects"]]
            records.append({"case": name, "rig": truth["rig"], "verdict": verdict["verdict"], "named": named,
                            "p": p_values_of(out / "results" / f"{name}.h5")})
        except (OSError, ValueError, KeyError) as problem:
            lost.append(f"{name}: {problem}")
    return records, lost


def page(found):
    pooled, false = found["pooled"], found["false_name"]
    lines = [
        f"{found['records']} clean records, {pooled['p_values']} p-values: D {pooled['D']:.3f}, D+ "
        f"{pooled['D_plus']:.3f}"
    ]
    for rate in pooled["rates"]:
        error = "" if rate["standard_error"] is None else f" +- {rate['standard_error']:.2%}"
        lines.append(f"  p <= {rate['level']:4.0%}   {rate['rate']:6.2%}{error}")
    lines.append(f"false name in {false['hits']} of {false['of']} records (95 % bound {false['upper_95']:.1%}); "
                 f"verdict other than none in {found['not_none']['hits']}")
    if found["names"]:
        lines.append(f"  named: {', '.join(found['names'])}")
    lines += ["", f"{'statistic':28} {'records':>7} {'D':>6} {'D+':>6} {'5 %':>6}   p<=1 %  p<=5 %  p<=10 %"]
    for name, row in sorted(found["effects"].items(), key=lambda item: -item[1]["D_plus"] / item[1]["critical_5"]):
        remark = "" if row["D"] <= row["critical_5"] else "  not uniform"
        remark += "" if row["chance_of_5"] else "  not 5 %"
        lines.append(f"{name:28} {row['records']:7} {row['D']:6.3f} {row['D_plus']:6.3f} {row['critical_5']:6.3f}   "
                     + "  ".join(f"{rate:6.1%}" for rate in row["rates"]) + remark)
    lines += ["", f"{'rigs':28} {'records':>7} {'p<=5 %':>7}  false names"]
    for name, group in found["groups"].items():
        lines.append(f"{name:28} {group['records']:7} {group['rate_5']:7.1%}  {group['false_names']}")
    return "\n".join(lines)


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=pathlib.Path, help="folder of run_suite.py")
    parser.add_argument("--json", type=pathlib.Path)
    options = parser.parse_args(arguments)
    records, lost = read_records(options.out)
    if lost:
        print(f"left out {len(lost)} records without a readable diagnosis, first {lost[0]}", file=sys.stderr)
    if not records:
        print(f"calibrate.py: no diagnosed clean record in {options.out}; run_suite.py makes them", file=sys.stderr)
        return 66
    found = calibration(records)
    print(page(found))
    if options.json:
        options.json.write_text(json.dumps(found, indent=1))
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
