"""The board of concealed arms: judges verdicts by their sealed truths and prints one table with exact bounds.

    score_arms.py OUT... [--board FOLDER] [--markdown]

OUT is a folder of run_arm_suite.py; several are the shards of one suite. FOLDER (default: the first OUT) takes
arms_board.json. A verdict that is missing counts as a failure and as a false name.

    right joint     a name at the concealed joint, and at no other. Names of the whole arm count as of joint 0; of a
                    law that the whole arm has (LAWS_OF_THE_ARM) it is a name there, and at no joint
    right family    the first name there is of a family the law may answer to, or a class with the law
    exact or class  the law itself, or a class with it
    false name      at a joint that has nothing, or a law of no family that answers (of a decoy: any name but those of
                    a late channel)
    decoy told      a data fault or something unexplained, or the late channel's own name, at a joint that is part of it
    SNR             rms of what is left after the rigid arm and its friction were fitted again, over the noise

Rates of laws are over cases of SNR 1 and more; 0.9 counts as 1, since sizes are made to within a tenth.
Exit code 0 whatever the score; 66 without a truth, 65 when one is not that which was sealed.
"""

import argparse
import hashlib
import json
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "concealed"))
import measures

NEARLY_ONE = 0.9


def truth_path(out, folder):
    return out / "sealed" / folder / "truth.json"


def seal(out, folder):
    return hashlib.sha256(truth_path(out, folder).read_bytes()).hexdigest()


WHOLE_ARM = 0
LAWS_OF_THE_ARM = ("gravity_direction", "joint_zero", "joint_compliance")


def named_at(verdict):
    """{joint: [(name, family, the names of its class)]} of the joints that have names; 0: of the whole arm."""
    of_all = {WHOLE_ARM: verdict.get("arm", {}).get("effects", []),
              **{one["joint"]: one["effects"] for one in verdict["joints"]}}
    return {joint: [(e["name"], e["family"], {e["name"], *e["equivalent"]}) for e in effects]
            for joint, effects in of_all.items() if effects}


def answers(effect, truth):
    """At family level or better."""
    name, family, kin = effect
    return truth["law"] in kin or family in truth["families"]


def judged_law(truth, named, row):
    place = WHOLE_ARM if truth["law"] in LAWS_OF_THE_ARM else truth["joint"]
    own = [joint for joint in named if joint == place]
    first = [named[joint][0] for joint in own]
    others = set(named) - set(own)
    row["right_joint"] = bool(own) and not others
    row["right_family"] = row["right_joint"] and answers(first[0], truth)
    row["exact_or_class"] = row["right_joint"] and truth["law"] in first[0][2]
    row["false_joints"] = sorted(others | {joint for joint in own
                                           if not all(answers(effect, truth) for effect in named[joint])})


def judged_decoy(truth, verdict, named, row):
    part = {truth["joint"], truth.get("other", truth["joint"])}
    late = {joint for joint, effects in named.items() if any(kin & set(truth["may_name"]) for *_, kin in effects)}
    row["false_joints"] = sorted(joint for joint, effects in named.items()
                                 if not all(kin & set(truth["may_name"]) for *_, kin in effects))
    doubtful = {one["joint"] for one in verdict["joints"] if one.get("verdict") in ("unexplained", "data_fault")}
    refused = verdict["verdict"] == "data_fault" or not verdict["joints"]
    row["told"] = not row["false_joints"] and (refused or bool(part & (late | doubtful)))


def judged(truth, verdict, facts):
    """One row of the board; `verdict` None: there is no answer."""
    row = {"case": truth["case"], "name": facts.get("name", ""), "kind": truth["kind"], "arm": truth["arm"],
           "joints": truth["joints"], "motion": truth["motion"], "snr": truth["snr"],
           "seconds": facts.get("diagnosed", {}).get("seconds"), "verdict": "missing", "reason": "", "said": [],
           "right_joint": False, "right_family": False, "exact_or_class": False, "told": False,
           "false_joints": list(range(1, truth["joints"] + 1))}
    row.update({key: truth[key] for key in ("law", "joint", "decoy", "wanted_snr") if key in truth})
    if verdict is None:
        return row
    named = named_at(verdict)
    row["verdict"], row["reason"] = verdict["verdict"], verdict["reason"]
    row["said"] = [f"{name}@{joint}" + (f" (or {', '.join(sorted(kin - {name}))})" if len(kin) > 1 else "")
                   for joint, effects in named.items() for name, _, kin in effects]
    row["false_joints"] = sorted(named)
    if truth["kind"] == "law":
        judged_law(truth, named, row)
    elif truth["kind"] == "decoy":
        judged_decoy(truth, verdict, named, row)
    return row


def read_case(out, folder, facts):
    if facts["seal"] != seal(out, folder):
        raise ValueError(f"{folder}: the truth is not the one that was sealed")
    truth = json.loads(truth_path(out, folder).read_text())
    try:
        verdict = json.loads((out / "verdicts" / f"{folder}.json").read_text())
        if not {"verdict", "reason", "joints"} <= set(verdict):
            verdict = None
    except (OSError, ValueError):
        verdict = None
    return judged(truth, verdict, facts)


def table(rows):
    """[(words, rate or None, level in words)] with exact one-sided 95 % bounds."""
    clean, laws, decoys = ([row for row in rows if row["kind"] == kind] for kind in ("clean", "law", "decoy"))
    loud = [row for row in laws if row["snr"] >= NEARLY_ONE]
    joints = sum(row["joints"] for row in clean)
    wrong_joints = sum(len(row["false_joints"]) for row in clean)
    lines = [("Clean arms with a false name", measures.share(clean, lambda r: r["false_joints"]), "0 of 60"),
             ("Joints of clean arms with a false name", measures.rate(wrong_joints, joints), ""),
             ("Clean arms: nothing missing, and said so", measures.share(clean, lambda r: r["verdict"] == "none"), "")]
    for key, words, level in (("right_joint", "right joint, and no other", ">= 95 %"),
                              ("right_family", "right family there", ">= 90 %"),
                              ("exact_or_class", "exact name or class there", "")):
        lines.append((f"One law, SNR >= 1: {words}", measures.share(loud, lambda r: r[key]), level))
    lines += [("One law of any size: a false name", measures.share(laws, lambda r: r["false_joints"]), ""),
              ("Decoys told apart", measures.share(decoys, lambda r: r["told"]), ""),
              ("Decoys named as physics", measures.share(decoys, lambda r: r["false_joints"]), "")]
    return lines


def measured(rate):
    return "-" if rate is None else f"{100 * rate['value']:.1f} % ({rate['hits']} of {rate['n']})"


def bounds(rate):
    return "-" if rate is None else f"{100 * rate['low']:.1f} to {100 * rate['high']:.1f} %"


def text(rows):
    lines = [f"{'case':52} {'SNR':>6} {'verdict':12} {'':5} said"]
    for row in rows:
        right = row["told"] if row["kind"] == "decoy" else row["right_family"] if row["kind"] == "law" else True
        mark = "right" if right and not row["false_joints"] else "WRONG"
        lines.append(f"{row['case']:52} {row['snr']:6.2f} {row['verdict']:12} {mark} {'; '.join(row['said'])}")
    lines += ["", f"{'':50} {'measured':22} {'95 % sure above, below':24} wanted"]
    return lines + [f"{words:50} {measured(rate):22} {bounds(rate):24} {level}".rstrip()
                    for words, rate, level in table(rows)]


def markdown(rows):
    lines = ["| | measured | 95 % sure above, below | wanted |", "|---|---|---|---|"]
    return lines + [f"| {words} | {measured(rate)} | {bounds(rate)} | {level} |" for words, rate, level in table(rows)]


def score(outs, folders=None, board=None, as_markdown=False):
    """folders: those of one run; None: every case that was diagnosed."""
    rows = []
    for out in outs:
        notes = out / "made.json"
        made = json.loads(notes.read_text()) if notes.exists() else {}
        for folder, facts in sorted(made.items(), key=lambda one: one[1]["name"]):
            if (folders is None and "diagnosed" not in facts) or (folders is not None and folder not in folders):
                continue
            try:
                rows.append(read_case(out, folder, facts))
            except (ValueError, OSError) as problem:
                print(f"score_arms.py: {problem}", file=sys.stderr)
                return 65
    if not rows:
        print("score_arms.py: no case was made here", file=sys.stderr)
        return 66
    lines = [{"words": words, "rate": rate, "wanted": level} for words, rate, level in table(rows)]
    place = board or outs[0]
    place.mkdir(parents=True, exist_ok=True)
    (place / "arms_board.json").write_text(json.dumps({"schema": 1, "table": lines, "cases": rows}, indent=1))
    print("\n".join(markdown(rows) if as_markdown else text(rows)))
    return 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs="+", metavar="OUT")
    parser.add_argument("--board", type=pathlib.Path, help="folder of the board")
    parser.add_argument("--markdown", action="store_true", help="print the table as Markdown")
    options = parser.parse_args(arguments)
    return score(options.folders, None, options.board, options.markdown)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
