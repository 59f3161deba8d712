#!/usr/bin/python3
"""One self-contained page from a result: build.py R.h5 [--out R.html]"""

import sys

from torquescope.page.build import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
