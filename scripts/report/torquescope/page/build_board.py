"""One self-contained page from a scoreboard, in the style of the results' page.

    build_board.py FOLDER | BOARD.json [--out BOARD.html]

FOLDER is that of scripts/proof: board.json, real/real.json, or both.
"""

import argparse
import sys
from pathlib import Path

from . import board as words, build, real_board
from .figures import board_cases


def page(board, real=None):
    """The text of the page: concealed cases, real recordings below them; either may be None."""
    said = _of_cases(board) if board else _of_real_alone(real)
    if real:
        said["parts"].append("real.html")
        said["real"] = {"answer": real_board.answer(real), "rows": real_board.rows(real)}
    return build.render(board_cases(board) if board else {}, verdict_json="", legend=[], has_real=bool(real), **said)


def _of_cases(board):
    return {
        "parts": ["board.html"],
        "verdict": words.verdict(board),
        "head": words.head(board),
        "numbers": words.big_numbers(board),
        "scoreboard": words.scoreboard(board),
        "tiers": words.tiers_table(board),
        "rivals": words.methods_table(board) if len(board.methods) > 1 else None,
        "left_out": words.left_out(board),
        "effects": words.effects_table(board),
        "clean": words.clean_table(board),
        "clean_answer": words.clean_answer(board),
        "circumstances": words.circumstances_table(board),
        "misses": words.misses(board),
        "provenance": words.provenance(board),
    }


def _of_real_alone(real):
    return {"parts": [], "verdict": real_board.verdict(real), "head": ["scoreboard", "real recordings"], "numbers": []}


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("board", type=Path, help="folder of scripts/proof, or the board.json that it writes")
    parser.add_argument("--out", type=Path, help="BOARD.html (default: the board's name)")
    options = parser.parse_args(arguments)
    path = options.board / "board.json" if options.board.is_dir() else options.board
    real_path = path.parent / "real" / "real.json"
    if not path.exists() and not real_path.exists():
        parser.error(f"neither {path} nor {real_path} is there: scripts/proof makes them")
    out = options.out or path.with_suffix(".html")
    board = words.Board(path) if path.exists() else None
    out.write_text(page(board, real_board.RealBoard(real_path) if real_path.exists() else None), encoding="utf-8")
    print(f"wrote  {out}  {out.stat().st_size / 1e6:.1f} MB")
    return 0
