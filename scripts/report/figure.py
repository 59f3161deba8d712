#!/usr/bin/python3
"""One figure of a result as PDF, PNG or SVG: figure.py --list R.h5"""

import sys

from torquescope.page.figure import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
