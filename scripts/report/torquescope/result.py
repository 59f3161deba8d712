"""A result file as an object: what was found, as attributes, frames, pictures and a page."""

from __future__ import annotations

import html
import os
import shutil
import tempfile
import weakref
from types import SimpleNamespace
from typing import TYPE_CHECKING

from . import frames
from .errors import UsageError
from .reader import read_result, summary
from .reader.diagnosis_records import Diagnosis, Joint, NamedEffect, Parameter
from .reader.read_replay import Replay
from .reader.read_servo import Servo

if TYPE_CHECKING:
    import pandas
    import xarray

    from .plots import Plots


FILES = ("", ".made.json")  # of a result: itself, and what says when and where it was made


class Result(read_result.Result):
    """What ts.identify(), ts.diagnose() and ts.open() give.

    Of a diagnosis       verdict ("named", "class", ...), reason, effects [NamedEffect], joints [Joint]
                         (reader/diagnosis_records.py)
    Of an identification estimators {name: group}; verdict is None
    Of both              parameters {name: Parameter}, job, model, train, validate, provenance: the groups of the file
    Of a replay, alone or beside them    replay() (reader/read_replay.py)
    Of a set of recordings of servos     servo() (reader/read_servo.py); verdict, reason, parameters are its own
    """

    def __init__(self, path: str | os.PathLike[str], is_ours: bool = False):
        super().__init__(path, is_ours)
        self._found = self._servo = None

    @property
    def diagnosis(self) -> Diagnosis | None:
        """The records of reader/diagnosis_records.py; None of an identification."""
        if self._found is None:
            self._found = super().diagnosis
        return self._found

    @property
    def verdict(self) -> str | None:
        found = self.diagnosis or self.servo()
        return found.verdict if found else None

    @property
    def reason(self) -> str:
        if self.diagnosis:
            return self.diagnosis.reason
        servo = self.servo()
        return servo.headline if servo else ""

    @property
    def joints(self) -> list[Joint]:
        return self.diagnosis.joints if self.diagnosis else []

    @property
    def effects(self) -> list[NamedEffect]:
        """Of the whole arm, then of all joints, in the order of acceptance."""
        arm = self.diagnosis.arm if self.diagnosis else None
        return [*(arm.effects if arm else []), *(effect for joint in self.joints for effect in joint.effects)]

    @property
    def parameters(self) -> dict[str, Parameter]:
        """{name: Parameter} of the fitted model: with the effects of a diagnosis, of the first estimator of a run. Of
        several joints the names begin with joint_N."""
        if servo := self.servo():
            return servo.parameters
        if not self.diagnosis:
            return _of_estimator(self, next(iter(self.estimators.values()))) if self.estimators else {}
        found = {}
        for joint in self.joints:
            lead = f"joint_{joint.joint}." if len(self.joints) > 1 else ""
            found.update({lead + name: one for name, one in (joint.augmented or joint.baseline).items()})
        return found

    def replay(self) -> Replay | None:
        """Every recording beside its simulation, before and after: the records of reader/read_replay.py; None where the
        file holds none."""
        return super().replay()

    def servo(self) -> Servo | None:
        """What was found in a set of recordings of servos: the records of reader/read_servo.py; None where the file
        holds none."""
        if self._servo is None:
            self._servo = super().servo()
        return self._servo

    @property
    def plot(self) -> Plots:
        """plot.map(), plot.trace(), plot.names(), plot("convergence"): matplotlib figures. Needs matplotlib."""
        from .plots import Plots
        return Plots(self)

    def to_frame(self, table: str = "parameters") -> pandas.DataFrame:
        """A pandas DataFrame: "parameters"; of a diagnosis "effects", "candidates", "map"; of a run "estimators"; of a
        set of recordings of servos "recordings"."""
        return frames.frame(self, table)

    def to_xarray(self, part: str = "train", joint: int | None = None) -> xarray.Dataset:
        """An xarray Dataset: "train" or "validate" (rows of the fit; of an arm those of one joint), "trace_1" (of a
        diagnosis: residuals before and after), or the name of an estimator (its histories)."""
        return frames.dataset(self, part, joint)

    def report(self, path: str | os.PathLike[str] | None = None) -> str:
        """Writes the page (one HTML file; needs matplotlib and jinja2); returns its path."""
        from .page import build
        from .page.study import Study
        path = os.fspath(path) if path is not None else f"{self.job.name}.html"
        text = build.page(Study(self))
        with open(path, "w", encoding="utf-8") as file:
            file.write(text)
        return path

    def save(self, path: str | os.PathLike[str]) -> str:
        """Copies the file, and what says when and where it was made; never over another file."""
        if os.path.exists(path):
            raise UsageError(f"error: {os.fspath(path)} exists\n  help: give another name, or delete it")
        shutil.copyfile(self.path, path)
        if os.path.exists(self.path + ".made.json"):
            shutil.copyfile(self.path + ".made.json", f"{os.fspath(path)}.made.json")
        return os.fspath(path)

    def summary(self) -> str:
        """Lines of text: the verdict, parameters, errors."""
        return "\n".join(summary(self))

    def goes_with(self, folder: str) -> Result:
        """The folder of its file is deleted with the object."""
        weakref.finalize(self, shutil.rmtree, folder, True)
        return self

    def __reduce__(self):
        """A pickle holds the whole file, so that it can be opened anywhere: by another process, on another machine."""
        sides = {}
        for ending in FILES:
            if os.path.exists(self.path + ending):
                with open(self.path + ending, "rb") as file:
                    sides[ending] = file.read()
        return _from_bytes, (os.path.basename(self.path), sides)

    def __repr__(self):
        if self.diagnosis:
            return f"<Result {self.job.name!r}: {self.verdict}: {self.reason}>"
        if servo := self.servo():
            return f"<Result {self.job.name!r}: {servo.headline}>"
        if not self.estimators:
            return f"<Result {self.job.name!r}: replay of {_recordings(self)}>"
        names = ", ".join(self.estimators)
        return f"<Result {self.job.name!r}: {len(self.model.names)} parameters; {names}>"

    def _repr_html_(self):
        if self.diagnosis:
            return _verdict_block(self)
        return _parameter_block(self) if self.estimators else f"<pre>{html.escape(self.summary())}</pre>"


def _from_bytes(name, files):
    folder = tempfile.mkdtemp(prefix="torquescope_")
    path = os.path.join(folder, name)
    for ending, content in files.items():
        with open(path + ending, "wb") as file:
            file.write(content)
    return Result(path).goes_with(folder)


def _recordings(result):
    replay = result.replay()
    count = len(replay.recordings) if replay else 0
    return f"{count} recording{'' if count == 1 else 's'}"


def _of_estimator(result, estimator):
    run = int(estimator.get("median_run", 0))
    values = estimator.parameters[run]
    ci95 = estimator.ci95[run] if "ci95" in estimator else [(float("nan"),) * 2] * len(values)
    return {str(name): Parameter(str(name), str(unit), float(value), float(low), float(high))
            for name, unit, value, (low, high) in zip(result.model.names, result.units, values, ci95)}


_COLOUR = {"blue": "#0067a8", "ink": "#5c6369", "ochre": "#8a6a00"}


def _verdict_block(result):
    """The verdict as the page has it: a bar, mark and word, sentence, evidence, at most four numbers."""
    from .page import words_of_diagnosis
    said = words_of_diagnosis.verdict(SimpleNamespace(diagnosis=result.diagnosis))
    numbers = words_of_diagnosis.big_numbers(result.joints[0]) if len(result.joints) == 1 else []
    cells = "".join(
        f'<div style="margin-right:2.5em"><div style="font-size:1.4em">{html.escape(f"{number} {unit}".strip())}</div>'
        f'<div style="opacity:.7;max-width:14em">{html.escape(caption)}</div></div>'
        for number, unit, caption in numbers[:4])
    return (f'<div style="border-left:4px solid {_COLOUR[said["tone"]]};padding:.2em 1em;margin:.5em 0">'
            f'<div style="font-weight:600">{html.escape(said["mark"])} {html.escape(said["word"])}</div>'
            f'<div style="font-size:1.3em;margin:.3em 0">{html.escape(said["sentence"])}</div>'
            f'<div style="opacity:.7">{html.escape(said["evidence"])}</div>'
            f'<div style="display:flex;flex-wrap:wrap;margin-top:.8em">{cells}</div></div>')


def _parameter_block(result):
    """Parameters in rows, estimators in columns."""
    head, *rows = read_result.parameter_table(result)
    cells = [f"<tr>{''.join(f'<th>{html.escape(text)}</th>' for text in head)}</tr>"]
    cells += [f"<tr>{''.join(f'<td>{html.escape(text)}</td>' for text in row)}</tr>" for row in rows]
    return f"<div><b>{html.escape(result.job.name)}</b><table>{''.join(cells)}</table></div>"
