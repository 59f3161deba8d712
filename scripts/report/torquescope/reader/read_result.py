"""Read a Torquescope result file (engine/store/RESULT_FORMAT.md) in Python. Needs h5py and numpy.

    from torquescope.reader import Result
    result = Result("R.h5")
    result.job.name                                    'crs_a465_joint'
    result.model.names                                 array(['inertia', 'viscous', ...])
    result.provenance.finished                         from R.h5.made.json beside it
    result.train.torque                                a numpy array, read when first asked for
    fade = result.estimators["fade"]
    fade.mse_median, fade.cr_start                     attributes of the group
    fade.gap_history                                   all runs: array [run][generation]
    fade["population"][3, -1]                          of the last generation of run 3 only
    fade.unit("mse"), fade.long_name("mse")            what a dataset says about itself
    result.diagnosis.joints[0].effects[0].name         'stribeck': what `torquescope diagnose` found,
                                                       diagnosis_records.py
    result.replay().recordings[0].torque.measured      recordings beside their simulation, read_replay.py
    result.servo().kept[0].title                       what was found in many recordings of servos, read_servo.py

On the command line, `read_result.py R.h5` prints a summary; with --verify it first reads all of the file and compares
its digest.
"""

import argparse
import contextlib
import json
import os
import sys

import h5py
import numpy as np

from ..errors import ResultError
from .content_digest import FIRST_FORMAT, content_sha256
from .file_seal import check_seal
from .first_look import WHAT_H5PY_RAISES, look_first
from .read_diagnosis import read_diagnosis
from .read_replay import read_replay, replay_table
from .read_servo import read_servo

NEWEST_FORMAT = 3


def _plain(value):
    """What HDF5 stores as Python would have it: bytes become str, numpy numbers become int or float."""
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, np.ndarray) and value.dtype.kind == "S":
        return [text.decode() for text in value]
    if isinstance(value, np.generic):
        return value.item()
    return value


@contextlib.contextmanager
def _told_of(node):
    """Whatever h5py says of a file that is damaged becomes a ResultError with the place."""
    try:
        yield
    except WHAT_H5PY_RAISES as error:
        raise ResultError(f"{node.file.filename} is damaged in {node.name}: {error}") from error


class Group:
    """A group of the file: its attributes, datasets and groups are its Python attributes.

    Datasets are read when first asked for, and kept; texts come as arrays of str.
    `group["name"]` gives the h5py dataset instead, to read a part of something large.
    """

    def __init__(self, group):
        self._group = group
        self._arrays = {}

    def __getattr__(self, name):
        if name.startswith("_"):
            raise AttributeError(name)
        if name in self._arrays:
            return self._arrays[name]
        if name in self._group:
            with _told_of(self._group):
                found = self._group[name]
            if isinstance(found, h5py.Group):
                return Group(found)
            self._arrays[name] = self._read(found)
            return self._arrays[name]
        if name in self._group.attrs:
            with _told_of(self._group):
                return _plain(self._group.attrs[name])
        raise AttributeError(f"{self._group.name} has no {name!r}; it has: {', '.join(self._names())}")

    def __getitem__(self, name):
        return self._group[name]

    def __contains__(self, name):
        return name in self._group or name in self._group.attrs

    def __dir__(self):
        return [*super().__dir__(), *self._names()]

    def __repr__(self):
        return f"<{self._group.name}: {', '.join(self._names())}>"

    def get(self, name, default=None):
        """The value, or `default` when the file has none."""
        return getattr(self, name) if name in self else default

    def _names(self):  # with an underscore: a result may hold a dataset "names"
        return [*self._group.keys(), *self._group.attrs.keys()]

    def file_name(self):
        """Of the result."""
        return self._group.file.filename

    def attributes(self):
        """All attributes as a dict: options and summaries of an estimator."""
        with _told_of(self._group):
            return {name: _plain(value) for name, value in self._group.attrs.items()}

    def unit(self, name):
        """Unit of a dataset; "1" for none."""
        attributes = self._group[name].attrs
        return _plain(attributes["units" if "units" in attributes else "unit"])  # "unit": format 2

    def long_name(self, name):
        """Label of a dataset, for people."""
        return _plain(self._group[name].attrs["long_name"])

    @staticmethod
    def _read(dataset):
        with _told_of(dataset):
            if h5py.check_string_dtype(dataset.dtype):
                return np.array([text.decode() for text in dataset[()]], dtype=str)
            return dataset[()]


def _circumstances(name, content_sha256):
    """What RESULT.made.json says of this very result: when, where, by whom. {} when it is not there."""
    try:
        with open(f"{name}.made.json", encoding="utf-8") as file:
            told = json.load(file)
    except (OSError, ValueError):
        return {}
    return told if isinstance(told, dict) and told.get("content_sha256") == content_sha256 else {}


class Provenance(Group):
    """How a result was made: the program, from the file; when and where, from RESULT.made.json (from the file, if it is
    old)."""

    def __init__(self, group, told):
        super().__init__(group)
        self._told = told

    def __getattr__(self, name):
        return self._told[name] if not name.startswith("_") and name in self._told else super().__getattr__(name)

    def __contains__(self, name):
        return name in self._told or super().__contains__(name)

    def _names(self):
        return [*super()._names(), *self._told]


class Result(Group):
    """A result file: `job`, `provenance`, `model`, `train`, `validate` (None without such data), `estimators`.

    `estimators` is a dict in the order of the job; empty for a diagnosis, which is at `diagnosis` (else None) as the
    records of diagnosis_records.py. Whatever else the file has is there under its own name:
    `result.data.regressor_health`; but /replay is `replay()` and /servo is `servo()`. Use it in a `with` block, or
    close() it.
    """

    def __init__(self, name, is_ours=False):
        """is_ours: this process has just made the file, and need not look for traps in it."""
        self.path = os.fspath(name)
        if not is_ours:
            look_first(name)
        try:
            # the file is never changed once it has its name, so a lock would protect nothing
            self._file = h5py.File(name, "r", locking=False)
        except WHAT_H5PY_RAISES as error:
            raise ResultError(f"{name} is damaged or not an HDF5 file: {error}") from error
        super().__init__(self._file)
        try:
            self._check(name)
            self.estimators = {key: Group(self._file["runs"][key]) for key in self._order()}
            if "provenance" in self._file:
                self.provenance = Provenance(self._file["provenance"], _circumstances(name, self.get("content_sha256")))
        except ResultError:
            self.close()
            raise
        except WHAT_H5PY_RAISES as error:
            self.close()
            raise ResultError(f"{name} is damaged, or lacks what its format promises: {error}") from error

    def _check(self, name):
        if "format" not in self._file.attrs or "creator" not in self._file.attrs:
            raise ResultError(f"{name} is an HDF5 file, but not a result of torquescope")
        if self.format > NEWEST_FORMAT:
            raise ResultError(f"{name} has format {self.format}; this script reads up to {NEWEST_FORMAT}")
        if self.get("complete") != 1:
            raise ResultError(f"{name} was never finished")

    def _order(self):
        return _plain(self._file["runs"].attrs["order"]) if "runs" in self._file else []

    @property
    def train(self):
        """What the fit has seen: samples, regressor, where they come from; None in a file of `replay` without it."""
        return Group(self._file["data/train"]) if "data/train" in self._file else None

    @property
    def validate(self):
        """Validation data, laid out as `train`; None when the job has none."""
        return Group(self._file["data/validate"]) if "data/validate" in self._file else None

    @property
    def units(self):
        """Of the parameters; files of early versions have none."""
        return self.model.get("units", [""] * len(self.model.names))

    @property
    def diagnosis(self):
        """What `torquescope diagnose` found; None when the file holds none. Read anew each time it is asked for."""
        return read_diagnosis(Group(self._file["diagnosis"])) if "diagnosis" in self._file else None

    def replay(self):
        """Every recording beside its simulation, as the records of read_replay.py; None when the file holds none. Read
        anew each time."""
        return read_replay(Group(self._file["replay"])) if "replay" in self._file else None

    def servo(self):
        """What was found in a set of recordings of servos, as the records of read_servo.py; None when the file holds
        none. Read anew each time."""
        return read_servo(Group(self._file["servo"])) if "servo" in self._file else None

    def verify(self):
        """Read everything; ResultError unless the content is what its sha256 says."""
        if self.format < FIRST_FORMAT:
            raise ResultError(
                f"{self._file.filename} has format {self.format}; digests are known from format {FIRST_FORMAT} on"
            )
        with _told_of(self._group):
            found = content_sha256(self._file)
        if found != self.get("content_sha256"):
            raise ResultError(f"{self._file.filename} is damaged: its content does not match its sha256")
        if self.get("sealed") == 1 and check_seal(self._file.filename) != "whole":
            raise ResultError(
                f"{self._file.filename} is damaged: its seal is missing: another program wrote into it, or its end is "
                "lost"
            )

    def close(self):
        self._file.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()


def rolls_out(estimator):
    """Whether it fits simulations of the recordings, over all their samples, and not rows: its errors are of these, and
    its "gap" is the fitness itself."""
    return estimator.get("kind") == "lm" or estimator.get("fitness_used") == "rollout"


def _number(value):
    return "" if value is None or np.isnan(value) else f"{value:.6g}"


def _table(rows):
    """Rows of texts as aligned lines: the first column to the left, the others to the right."""
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        cells = [text.ljust(w) if i == 0 else text.rjust(w) for i, (text, w) in enumerate(zip(row, widths))]
        yield "  ".join(cells).rstrip()


def parameter_table(result):
    """Parameters in rows; the truth, where it is known, and the mean over runs of each estimator in columns."""
    truth = result.model.get("truth")
    truth = truth if truth is not None and not np.all(np.isnan(truth)) else None
    estimators = {name: e for name, e in result.estimators.items() if "parameters" in e}
    rows = [["parameter", "unit", *(["truth"] if truth is not None else []), *estimators]]
    for i, (name, unit) in enumerate(zip(result.model.names, result.units)):
        known = [_number(truth[i])] if truth is not None else []
        rows.append([name, unit, *known, *(_number(np.nanmean(e.parameters[:, i])) for e in estimators.values())])
    return rows


def _diagnosis_summary(diagnosis):
    """The verdict, and the parameters of each joint before and after."""
    yield f"{diagnosis.verdict}: {diagnosis.reason}"
    for joint in diagnosis.joints:
        yield ""
        rows = [[f"joint {joint.joint}", "unit", "before", "after"]]
        for name, one in {**joint.baseline, **joint.augmented}.items():
            before, after = (
                known[name].value if name in known else None for known in (joint.baseline, joint.augmented)
            )
            rows.append([name, one.unit, _number(before), _number(after)])
        yield from _table(rows)


def _servo_summary(servo):
    """The headline, errors, and the parameters before and after."""
    yield servo.headline
    rows = [["mean absolute error of the position", "recordings", "unit", "before", "after"]]
    for name, error in (("train", servo.train), ("validation", servo.validate)):
        if error.recordings:
            rows.append([name, str(error.recordings), servo.unit, _number(error.before), _number(error.after)])
    if len(rows) > 1:
        yield ""
        yield from _table(rows)
    rows = [["parameter", "unit", "before", "after"]]
    for name, one in {**servo.parameters_before, **servo.parameters}.items():
        sides = (servo.parameters_before, servo.parameters)
        values = (side[name].value if name in side else None for side in sides)
        rows.append([name, one.unit, *map(_number, values)])
    if len(rows) > 1:
        yield ""
        yield from _table(rows)


def summary(result):
    """The summary as lines of text."""
    job = result.job
    yield f"{job.get('name', '?')}: {result.creator}, format {result.format}, sha256 {result.content_sha256[:16]}"
    for name, data in (("train", result.train), ("validate", result.validate)):
        if data is not None:
            samples = len(data.torque) if "torque" in data else data.samples
            yield f"{name:9} {samples} samples of {', '.join(data.get('recordings', []))}"
    yield ""
    if result.diagnosis is not None:
        yield from _diagnosis_summary(result.diagnosis)
        yield ""
    if (servo := result.servo()) is not None:
        yield from _servo_summary(servo)
        yield ""
    if (replay := result.replay()) is not None and replay.recordings:
        yield from _table(replay_table(replay, _number))
        yield ""
    if not result.estimators:
        return
    yield from _table(parameter_table(result))
    yield ""
    columns = ["mse_median", "gap_median", "relerr_median", "validation_relerr_median"]
    rows = [["estimator", "kind", "runs", *columns, "errors of"]]
    for name, estimator in result.estimators.items():
        runs = str(estimator.get("runs", len(estimator.parameters) if "parameters" in estimator else ""))
        numbers = {column: _number(estimator.get(column)) for column in columns}
        if simulates := rolls_out(estimator):
            numbers["gap_median"] = ""
        rows.append([name, estimator.get("kind", ""), runs, *numbers.values(),
                     "simulated samples" if simulates else "rows"])
    yield from _table(rows)


def main(arguments=None):
    """0, or 1 where the result is at fault."""
    parser = argparse.ArgumentParser(description="print a summary of a Torquescope result file")
    parser.add_argument("result", help="R.h5, as torquescope run wrote it")
    parser.add_argument("--verify", action="store_true", help="read all of it and compare its digest")
    wanted = parser.parse_args(arguments)
    try:
        with Result(wanted.result) as result:
            if wanted.verify:
                result.verify()
            print("\n".join(summary(result)))
    except ResultError as error:
        print(f"error: {error}", file=sys.stderr)
        return 1
    return 0
