#!/usr/bin/python3
"""One self-contained page from a scoreboard: build_board.py FOLDER | BOARD.json"""

import sys

from torquescope.page.build_board import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
