#!/usr/bin/python3
"""One self-contained page from a scoreboard, in the style of the results' page.

    build_board.py BOARD.json [--out BOARD.html]
"""

import argparse
import sys
from pathlib import Path

import board as words
import build
from figures import board_cases


def page(board):
    """The text of the page."""
    return build.render(
        board_cases(board),
        parts=["board.html"],
        verdict=words.verdict(board),
        head=words.head(board),
        numbers=words.big_numbers(board),
        verdict_json="",
        legend=[],
        scoreboard=words.scoreboard(board),
        tiers=words.tiers_table(board),
        rivals=words.methods_table(board) if len(board.methods) > 1 else None,
        left_out=words.left_out(board),
        effects=words.effects_table(board),
        clean=words.clean_table(board),
        clean_answer=words.clean_answer(board),
        circumstances=words.circumstances_table(board),
        misses=words.misses(board),
        provenance=words.provenance(board),
    )


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("board", help="board.json of tests/concealed/score.py")
    parser.add_argument("--out", help="BOARD.html (default: the board's name)")
    options = parser.parse_args(arguments)
    out = Path(options.out or Path(options.board).with_suffix(".html"))
    out.write_text(page(words.Board(options.board)), encoding="utf-8")
    print(f"wrote  {out}  {out.stat().st_size / 1e6:.1f} MB")
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
