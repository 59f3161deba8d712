"""What the engine does, on recordings in memory or on a job file: check, identify, diagnose, simulate.

Options    the sections of a job: filter={"cutoff_hz": 40}, diagnose={"twins": 400}, experiment={"seed": 7}
Results    with out= a file stays, and the same call goes on from what an interrupted one has saved; without it the
           result lives in a temporary file as long as the Result
Errors     those of the engine (errors.py), all problems of a job at once
Stops      Ctrl-C: after the running step; again: at once, and the step ends in the background
"""

from __future__ import annotations

import os
import re
import shutil
import tempfile
import warnings
from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple, Union

import numpy as np

from .errors import Error, UsageError
from .job_text import job_text
from .native import compiled
from .recording import Recording, common_section
from .result import Result
from .robot import Robot
from .waiting import wait_for

UNNAMED = "<job>"  # a job that is no file: messages show no line of it (engine/python/module.cpp)
Path = Union[str, "os.PathLike[str]"]
Recordings = Union[Recording, Iterable[Recording]]
Model = Union[Mapping[str, Any], Robot, None]
Estimators = Union[str, Mapping[str, Any], Iterable[Union[str, Mapping[str, Any]]]]
Section = Mapping[str, Any]


class CheckLine(NamedTuple):
    level: str  # "ok", "note", "warn", "fault"
    topic: str
    text: str


class RecordingWarning(UserWarning):
    """Something about a recording, or a job, that does not stop the work."""


class _Order(NamedTuple):
    """A job for the engine, and recordings that it names."""

    path: str
    text: str | None  # None: that of the file
    recordings: dict[str, list]


def diagnose(recordings: Recordings | Path, *, validate: Recordings = (), model: Model = None, out: Path | None = None,
             threads: int = 0, progress: bool | None = None, **sections: Section) -> Result:
    """Finds the physics that a model of the recordings lacks.

    recordings  a Recording, several (one fit to all of them, each in its own loop), or a job file
    validate    recordings that no fit uses: they judge
    model       {"joint": "revolute", "terms": [...]}, or a Robot; ts.describe() lists terms and effects
    out         file of the result; None: it lives as long as what is returned
    threads     0: all processors
    progress    None: shown in a terminal and a notebook
    sections    of a job: filter={"cutoff_hz": 40}, diagnose={"effects": ["stribeck", "cogging"]}

    Example     found = ts.diagnose(motion, validate=other, model={"terms": ["inertia", "viscous", "coulomb"]})
                found.verdict, found.reason, found.effects[0].parameters["stribeck"].value
    Units       SI of the joint: rad or m, s, N m or N; where the factor of a current is not known, the current's
    Shares      errors and shares are fractions of 1; intervals are 95 %; NaN: not measured
    Errors      JobError, DataError, UsageError, with every problem at once; Ctrl-C stops after the running step
    Takes       seconds to minutes
    """
    order = _order(recordings, validate, model, None, sections)
    return _carry_out(order, True, out, threads, progress)


def identify(recordings: Recordings | Path, *, validate: Recordings = (), model: Model = None,
             estimators: Estimators = "ols", out: Path | None = None, threads: int = 0, progress: bool | None = None,
             **sections: Section) -> Result:
    """Fits the parameters of a model to recordings; arguments, units and errors as of diagnose().

    estimators  names ("ols", "wls", "fade"), or {"name": "de", "runs": 20}

    Example     fit = ts.identify(motion, model={"terms": ["inertia", "viscous", "coulomb", "offset"]})
                fit.parameters["inertia"].value, fit.parameters["inertia"].lower
    """
    order = _order(recordings, validate, model, estimators, sections)
    return _carry_out(order, False, out, threads, progress)


def check(recordings: Recordings | Path, *, validate: Recordings = (), model: Model = None,
          estimators: Estimators = "ols", threads: int = 0, **sections: Section) -> list[CheckLine]:
    """Everything that `torquescope check` says before a run."""
    _engine = compiled()
    order = _order(recordings, validate, model, estimators, sections)
    return [CheckLine(*line) for line in _engine.check(*order, _threads(threads))]


def simulate(job: Mapping[str, Any] | Path) -> Recording:
    """The recording that [simulate] of a job describes: of a job file, or of {"simulate": {...}, "model": {...}}."""
    _engine = compiled()
    path, text = (UNNAMED, job_text(job)) if isinstance(job, Mapping) else (os.fspath(job), None)
    with tempfile.TemporaryDirectory(prefix="torquescope_") as folder:
        file = os.path.join(folder, "simulated.csv")
        _engine.simulate(path, text, file)
        columns = _engine.columns_of_file(file)
    return _simulated(columns)


def describe(name: str | None = None) -> None:
    """Prints what a job can name: effects, optimisers, sections with their keys; all names without one."""
    _engine = compiled()
    entries = _engine.catalogue()
    known = [entry for entry in entries if name in (None, entry[0])]
    if not known:
        raise UsageError(f"error: nothing is called {name!r}\n  help: ts.describe() tells every name")
    for entry_name, kind, title, text, options in known:
        print(f"{entry_name:24} {kind:10} {title}")
        for line in text if name else ():
            print(f"  {line}")
        for key, type_name, unit, range_text, default, meaning in options if name else ():
            takes = " ".join(word for word in (range_text or type_name, "" if unit == "1" else unit) if word)
            print(f"  {key:20} {meaning} ({takes}; default {default or 'none'})")


def _simulated(columns):
    """As a logger would have it: reference, encoder position and torque of one joint, or of each joint of an arm."""
    patterns = {"position": r"q(\d*)_(rad|m)", "torque": r"(?:tau|F)(\d*)_(Nm|N)", "reference": r"q_ref(\d*)_(rad|m)"}
    signals = {}
    for channel, pattern in patterns.items():
        of_joints = [values for name, values in columns.items() if re.fullmatch(pattern, name)]
        if of_joints:
            signals[channel] = of_joints[0] if len(of_joints) == 1 else np.column_stack(of_joints)
    return Recording(time=columns["t_s"], name="simulated", **signals)


def _order(recordings, validate, model, estimators, sections):
    validate = [validate] if isinstance(validate, Recording) else list(validate)
    if isinstance(recordings, (str, os.PathLike)):
        if validate or model is not None or sections:
            raise UsageError(f"error: {os.fspath(recordings)} is a whole job, and options stand beside it\n"
                             "  help: write them into the job, or give recordings in place of the job")
        return _Order(os.fspath(recordings), None, {})
    train = [recordings] if isinstance(recordings, Recording) else list(recordings)
    strangers = [one for one in (*train, *validate) if not isinstance(one, Recording)]
    if strangers or not train:
        raise UsageError(f"error: {strangers[0]!r} is no Recording" if strangers else "error: no recording was given")
    tables, names = _named(train + validate)
    section = {"train": names[:len(train)], **({"validate": names[len(train):]} if validate else {})}
    given = dict(sections)
    job = {"experiment": {"name": train[0].name.replace("/", "_"), **given.pop("experiment", {})},
           "recording": {**section, **common_section(train + validate), **given.pop("recording", {})}}
    if model is not None:
        job["model"] = {"robot": model} if isinstance(model, Robot) else model
    job.update(given)
    if estimators is not None:
        listed = [estimators] if isinstance(estimators, (str, Mapping)) else list(estimators)
        job["estimator"] = [{"name": one} if isinstance(one, str) else one for one in listed]
    return _Order(UNNAMED, job_text(job), tables)


def _named(recordings):
    """Tables by name, and the name of each recording: two that are called the same are told apart."""
    tables, names, known = {}, [], {}
    for recording in recordings:
        if id(recording) not in known:
            name, number = recording.name, 1
            while name in tables:
                number += 1
                name = f"{recording.name} ({number})"
            known[id(recording)] = name
            tables[name] = recording.table(recordings[0].joint)
        names.append(known[id(recording)])
    return tables, names


def _threads(count):
    if not isinstance(count, (int, np.integer)) or isinstance(count, bool) or count < 0:
        raise UsageError(f"error: threads = {count!r}\n  help: 0 takes all processors that it may use, N takes N")
    return int(count)


def _carry_out(order, diagnoses, out, threads, progress):
    _engine = compiled()
    threads, folder = _threads(threads), None
    if out is None:
        folder = tempfile.mkdtemp(prefix="torquescope_")
        out = os.path.join(folder, "result.h5")
    try:
        work = _engine.begin(diagnoses, *order, os.fspath(out), threads)
        try:
            wait_for(work, progress, lambda: _warn(work))
        except KeyboardInterrupt as interrupt:
            _say_what_is_safe(work, interrupt)
            raise
        work.finish()
        result = Result(out, is_ours=True)
    except BaseException:
        if folder is not None:
            shutil.rmtree(folder, ignore_errors=True)
        raise
    return result if folder is None else result.goes_with(folder)


def _say_what_is_safe(work, interrupt):
    if not work.wait(0) or not hasattr(interrupt, "add_note"):  # Python 3.10 has no notes
        return
    try:
        work.finish()
    except Error as stopped:
        interrupt.add_note(str(stopped))


def _warn(work):
    depth = 6  # of whoever called diagnose() or identify()
    for topic, text in work.take_messages():
        if topic == "warning":
            warnings.warn(text, RecordingWarning, stacklevel=depth)
