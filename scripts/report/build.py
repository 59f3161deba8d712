#!/usr/bin/python3
"""One self-contained page from a result: build.py R.h5 [--out R.html]"""

import sys


def main(arguments):
    """As the page's own; 70 where memory does not suffice, which only an import may say in its own words."""
    try:
        from torquescope.page.build import main as build

        return build(arguments)
    except MemoryError:
        pass
    except ImportError as error:
        if not any(words in str(error) for words in ("allocate memory", "failed to map segment")):
            raise
    print("error: there is not enough memory for the page", file=sys.stderr)
    return 70


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
