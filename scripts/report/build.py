#!/usr/bin/python3
"""One self-contained page from a result: build.py R.h5 [--out R.html]"""

import sys

from page_command import end_as

if __name__ == "__main__":
    sys.exit(end_as("build"))
