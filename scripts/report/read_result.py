#!/usr/bin/python3
"""Prints a summary of a result: read_result.py R.h5 [--verify]"""

import sys

from torquescope.reader.read_result import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
