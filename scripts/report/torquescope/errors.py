"""What goes wrong, as exceptions: the text is what the program prints, `exit_code` what it ends with."""

import json
from dataclasses import dataclass, field


@dataclass(frozen=True)
class Problem:
    """One of the things that are wrong, as `--json` of the program has it; what is unknown is None or empty."""

    code: int
    problem: str
    file: str = None
    line: int = None
    column: int = None
    key: str = None
    notes: list = field(default_factory=list)
    suggestion: str = None
    help: str = None


class Error(Exception):
    """What a user can act on; the text says what is wrong, where, and what to write instead."""

    exit_code = 70

    def __init__(self, text, problems=()):
        super().__init__(text)
        self.problems = list(problems)
        if self.problems:
            self.exit_code = self.problems[0].code


class UsageError(Error, ValueError):
    """Arguments that do not go together."""

    exit_code = 64


class DataError(Error, ValueError):
    """The recording is at fault."""

    exit_code = 65


class ResultError(DataError):
    """The file is missing, damaged, unfinished or not a Torquescope result; the text says which."""


class JobError(Error, ValueError):
    """The job is at fault: an unknown key, a value out of range, a column that is not there."""

    exit_code = 78


_OF_CODE = {64: UsageError, 65: DataError, 78: JobError}


def from_engine(text, document):
    """The exception for problems of the engine: their text, and the JSON document of the program."""
    problems = [Problem(**one) for one in json.loads(document)["errors"]]
    return _OF_CODE.get(problems[0].code, Error)(text.rstrip("\n"), problems)
