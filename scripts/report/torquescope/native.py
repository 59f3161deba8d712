"""The compiled engine, or a word about its absence."""


def compiled():
    """The module torquescope._engine."""
    try:
        from . import _engine
    except ImportError as error:
        raise ImportError(f"the engine is not there ({error}): `pip install .` in a clone builds it; reading results "
                          "does without") from error
    return _engine
