"""One figure of a result, or of a scoreboard, as PDF, PNG or SVG, for a paper.

    figure.py --list R.h5                              names of the figures this file can show
    figure.py convergence R.h5 convergence.pdf
    figure.py torque_trace_train R.h5 trace.png --narrow
    figure.py power_T1 board.json power.pdf            board.json of scripts/proof
"""

import argparse
import sys

from ..errors import ResultError
from . import style
from .board import Board
from .figures import all_cases, board_cases
from .study import Study


def cases_of(path):
    return board_cases(Board(path)) if path.endswith(".json") else all_cases(Study(path))


def main(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--list", action="store_true", help="list the figures of R.h5")
    parser.add_argument("--narrow", action="store_true", help="a wide figure in the width of a column (352 px)")
    parser.add_argument("names", nargs="+", metavar="[NAME] R.h5 [OUT.pdf|OUT.png|OUT.svg]")
    options = parser.parse_args(arguments)
    try:
        return _list(parser, options.names) if options.list else _write(parser, options)
    except ResultError as error:
        print(f"error: {error}", file=sys.stderr)
        return 65


def _list(parser, names):
    if len(names) != 1:
        parser.error("--list takes one result file")
    for name, case in cases_of(names[0]).items():
        print(f"{name:32} {case.title}")
    return 0


def _write(parser, options):
    if len(options.names) != 3:
        parser.error("expected NAME R.h5 OUT.pdf")
    name, result, out = options.names
    if not out.endswith((".pdf", ".png", ".svg")):
        parser.error(f"cannot write {out}: the name must end in .pdf, .png or .svg")
    cases = cases_of(result)
    if name not in cases:
        print(f"error: no figure \"{name}\" in {result}\n  help: figure.py --list {result}", file=sys.stderr)
        return 64
    case = cases[name]
    style.save(case.figure(style.WIDE if case.wide and not options.narrow else style.SMALL), out)
    return 0
