"""What `torquescope diagnose` found in a set of recordings of servos, as plain Python, out of the group /servo.

    from torquescope.reader import Result
    servo = Result("servo.h5").servo()                 None when the file holds none
    servo.verdict, servo.headline                      'named', 'explained by ...'
    servo.validate.before, servo.validate.after        mean absolute errors of the position, validation recordings
    servo.kept[0].title, servo.kept[0].rivals          effects that were kept, and those they cannot be told from
    servo.parameters["load_friction"].value            with 95 % interval: lower, upper
    servo.tables["mass_kg"][0].validate.after          errors by one quantity of the recordings

Errors     mean absolute, of the position, over all samples of the recordings that a number is about, in `unit`
Absent     NaN: it diverged, or there are no such recordings
Source     engine/store/RESULT_FORMAT.md, section /servo
"""

from __future__ import annotations

import json
import math
from dataclasses import dataclass, field

from ..errors import ResultError
from .diagnosis_records import Parameter


@dataclass
class ServoError:
    """Of the job's model (before) and of the one with the effects that were kept (after)."""

    recordings: int
    samples: int
    before: float
    after: float


@dataclass
class KeptLaw:
    name: str
    title: str
    equation: str
    not_told_from: str  # what it is easily confused with, and what tells them apart; "": nothing known
    gain: float  # D, against the final model without it
    p: float  # of chance, among replicates
    parameters: dict[str, Parameter]
    rivals: list[str]  # effects that explain these recordings about as well


@dataclass
class ServoRow:
    """Errors of the recordings with one value of a quantity. `left_out` of a table of Servo.left_out, else the other
    two."""

    value: str
    train: ServoError | None = None
    validate: ServoError | None = None
    left_out: ServoError | None = None


@dataclass
class ServoRecording:
    name: str
    role: str  # "train", "validate"
    quantities: dict[str, float | str]  # of the manifest
    samples: int
    before: float
    after: float
    relerr_before: float  # rms error over the rms of the motion about its mean
    relerr_after: float
    horizon_s: float  # time until which the simulation can be believed; NaN: to its end

    @property
    def is_validation(self) -> bool:
        return self.role == "validate"


@dataclass
class ServoMove:
    """An effect beside the model of a step."""

    name: str
    refusal: str  # "none", "chance", "smaller", "failed_fit", "at_bound", "not_predicted"
    gain: float  # D
    gain_by_chance: float  # D that a share alpha of the replicates reach
    p: float
    error_before: float  # relative, of the position, of validation where there are such recordings
    error_after: float


@dataclass
class ServoStep:
    """One model of the search, and every effect that was tried beside it."""

    model: list[str]  # effects in it
    replicates: int
    moves: list[ServoMove]


@dataclass
class Servo:
    name: str
    verdict: str  # "named", "class", "partly", "none", "unexplained", "insufficient"
    headline: str
    unit: str  # of errors
    command_unit: str  # "V", "A", "rad"
    train: ServoError
    validate: ServoError
    left_rms: float  # of the position in training, after
    replicates_rms: float  # the same of replicates of the model
    kept: list[KeptLaw]
    parameters: dict[str, Parameter]  # with the effects that were kept
    parameters_before: dict[str, Parameter]
    notes: dict[str, str]  # {word: sentence}
    tables: dict[str, list[ServoRow]]  # {quantity: rows}
    left_out: dict[str, list[ServoRow]]  # {quantity: rows}: numbers of the effects fitted without these recordings
    recordings: list[ServoRecording]  # in the order of /replay
    steps: list[ServoStep]  # of the search, in its order
    document: dict = field(repr=False)  # all of it, as the file has it


def read_servo(group) -> Servo:
    """The Servo from the group /servo (a read_result.Group). Errors: ResultError."""
    try:
        document = json.loads(str(group.json[0]))
        return _servo(document)
    except (ValueError, LookupError, TypeError, AttributeError) as error:
        raise ResultError(f"the file is damaged in /servo: {type(error).__name__}: {error}") from error


def _servo(of):
    unit, adequacy = of["error"]["unit"], of["adequacy"]
    return Servo(
        name=of["name"], verdict=of["verdict"], headline=of["headline"], unit=unit, command_unit=of["command_unit"],
        train=_error(of["error"]["train"]), validate=_error(of["error"]["validate"]),
        left_rms=_number(adequacy["left_rms"]), replicates_rms=_number(adequacy["replicates_rms"]),
        kept=[_effect(one) for one in of["kept"]],
        parameters=_parameters(of["parameters"]), parameters_before=_parameters(of["parameters_before"]),
        notes={one["note"]: one["text"] for one in of["notes"]},
        tables=_tables(of["tables"]), left_out=_tables(of["left_out"]),
        recordings=[ServoRecording(**_numbers(one, ServoRecording)) for one in of["recordings"]],
        steps=[ServoStep(one["model"], one["replicates"],
                         [ServoMove(**_numbers(move, ServoMove)) for move in one["moves"]])
               for one in of["loop"]["steps"]],
        document=of)


def _number(value):
    return math.nan if value is None else float(value)


def _numbers(of, record):
    """The values of a record of this kind: null is NaN."""
    return {name: _number(of[name]) if field.type == "float" else of[name]
            for name, field in record.__dataclass_fields__.items()}


def _error(of):
    return ServoError(**_numbers(of, ServoError))


def _parameters(numbers):
    return {one["name"]: Parameter(one["name"], one["unit"], *map(_number, (one["value"], *one["ci95"])))
            for one in numbers}


def _effect(of):
    return KeptLaw(**{**_numbers(of, KeptLaw), "parameters": _parameters(of["parameters"])})


def _tables(tables):
    roles = ("train", "validate", "left_out")
    return {table["quantity"]: [ServoRow(row["value"], **{role: _error(row[role]) for role in roles if role in row})
                                for row in table["rows"]] for table in tables}
