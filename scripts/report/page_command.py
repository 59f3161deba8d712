"""How build.py and compare.py end: as their page does, or with 70 where memory does not suffice."""

import importlib
import sys


def end_as(page):
    """page: a module of torquescope.page. Libraries that find no memory say so in an ImportError of their own words."""
    try:
        return importlib.import_module(f"torquescope.page.{page}").main(sys.argv[1:])
    except MemoryError:
        pass
    except ImportError as error:
        if not any(words in str(error) for words in ("allocate memory", "failed to map segment")):
            raise
    print("error: there is not enough memory for the page", file=sys.stderr)
    return 70
