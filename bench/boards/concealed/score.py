"""The scoreboard of the concealed cases: judges, prints and stores. gather.py reads the truths.

    score.py OUT... [--board FOLDER] [--markdown] [--cases] [--all-right]

OUT is a folder of run_suite.py; several are the shards of one suite. FOLDER (default: the first OUT) takes board.json
and board.h5 (board_h5.py); scripts/report/build_board.py makes a page of the first. A rival that put its answers into
OUT/rivals/METHOD (verdict_record.py) is judged by the same functions and stands beside ours in all of them.
A verdict that is missing or does not follow the schema counts as a failure, not as an absent case. A case whose plant
was not exact is in no rate, and named.
Exit code 0 whatever the score, with --all-right 1 unless every case is right and none left out; 66 when there is no
truth; 65 when a truth is damaged, not the one that was sealed, or a case has two seals or two verdicts.
"""

import argparse
import dataclasses
import json
import pathlib
import sys

import board_h5
import board_text
import breakdown
import confidence
import gather
import protocol


def scored(judgements):
    """Everything the board says about one method."""
    return {
        "table": protocol.table(judgements),
        "tiers": breakdown.by_tier(judgements),
        "power": breakdown.power(judgements),
        "effects": breakdown.by_effect(judgements),
        "confusion": {"effects": breakdown.confusion(judgements, lambda j: j.found[0].name, breakdown.said_first),
                      "families": breakdown.confusion(judgements, lambda j: j.found[0].family, breakdown.family_first)},
        "confidence": confidence.calibration(protocol.stated(judgements)),
        "clean": breakdown.clean_controls(judgements),
        "circumstances": breakdown.by_circumstance(judgements),
        "iou": protocol.overlaps(judgements),
        "gap_closed": protocol.gaps(judgements),
        "misses": breakdown.misses(judgements),
        "runtime": breakdown.runtime(judgements),
        "cases": [dataclasses.asdict(j) for j in judgements],
    }


def board_of(gathered):
    return {
        "schema": 2,
        "suite": gathered.suite,
        "methods": {method: scored(cases) for method, cases in gathered.methods.items()},
    }


def score(folders, names=None, board_folder=None, form="text", with_cases=True, all_right=False):
    """Exit code; prints the board and writes it to `board_folder`."""
    try:
        gathered = gather.gather(folders, names)
    except gather.NoTruth as problem:
        print(f"score.py: {problem}", file=sys.stderr)
        return 66
    except ValueError as problem:
        print(f"score.py: {problem}", file=sys.stderr)
        return 65
    board = board_of(gathered)
    ours = gathered.methods[gather.OURS]
    folder = pathlib.Path(board_folder or folders[0])
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "board.json").write_text(json.dumps(board, indent=1))
    board_h5.write(folder / "board.h5", board)
    print(board_text.markdown(board) if form == "markdown" else board_text.text(board, ours if with_cases else []))
    wrong = [j.drawn or j.case for j in ours if not j.right] + [
        f"{one['case']} (left out)" for one in gathered.suite["left_out"]
    ]
    if all_right and wrong:
        print(f"\nnot right: {', '.join(wrong)}")
        return 1
    return 0


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", type=pathlib.Path, nargs="+", metavar="OUT")
    parser.add_argument("--board", type=pathlib.Path, help="folder of the board")
    parser.add_argument("--markdown", action="store_true", help="print the table as Markdown")
    parser.add_argument("--cases", action="store_true", help="print a line for every case as well")
    parser.add_argument("--all-right", action="store_true")
    options = parser.parse_args(arguments)
    return score(
        options.folders,
        None,
        options.board,
        "markdown" if options.markdown else "text",
        options.cases,
        options.all_right,
    )


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
