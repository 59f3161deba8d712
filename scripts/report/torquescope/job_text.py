"""A job as TOML, from plain Python values: sections are dicts, what is repeated is a list of dicts."""

import json
import os
from collections.abc import Mapping

import numpy as np

from .errors import UsageError

INLINE = ("columns", "clocks", "encoding")  # tables that are values (engine/experiment/job/job.hpp)


def job_text(job):
    """The text of {section: {key: value}}; a section may hold sections, and [[estimator]] is a list of them."""
    return "\n".join(line for name, body in job.items() for line in _section(name, body)) + "\n"


def _section(name, body):
    if isinstance(body, (list, tuple)):
        for one in body:
            yield from _table(name, one, f"[[{name}]]")
    else:
        yield from _table(name, body, f"[{name}]")


def _table(name, body, head):
    if not isinstance(body, Mapping):
        raise UsageError(f"error: {name} = {body!r} is no section\n  help: {name}={{\"key\": value}}")
    yield head
    below = {}
    for key, value in body.items():
        is_section = key not in INLINE and (isinstance(value, Mapping) or _is_list_of_sections(value))
        if is_section:
            below[key] = value
        else:
            yield f"{_key(key)} = {_value(f'{name}.{key}', value)}"
    yield ""
    for key, value in below.items():
        yield from _section(f"{name}.{_key(key)}", value)


def _is_list_of_sections(value):
    return isinstance(value, (list, tuple)) and len(value) > 0 and all(isinstance(one, Mapping) for one in value)


def _key(key):
    return key if key.replace("_", "").replace("-", "").isalnum() and key.isascii() else _text(key)


def _text(text):
    # JSON's escapes are TOML's; DEL alone needs one that JSON does not write
    return json.dumps(text, ensure_ascii=False).replace("\x7f", "\\u007f")


def _value(where, value):
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return repr(float(value))
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {_value(where, one)}" for key, one in value.items()) + "}"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_value(where, one) for one in value) + "]"
    raise UsageError(f"error: {where} = {value!r} is nothing that a job can hold\n"
                     "  help: numbers, texts, true or false, and lists of these")
