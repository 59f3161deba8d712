#!/usr/bin/python3
"""One page with several results side by side: compare.py A.h5 B.h5 ... [--out compare.html]"""

import sys

from torquescope.page.compare import main

if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
