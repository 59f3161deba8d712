#!/usr/bin/python3
"""One page with several results side by side: compare.py A.h5 B.h5 ... [--out compare.html]"""

import sys

from page_command import end_as

if __name__ == "__main__":
    sys.exit(end_as("compare"))
