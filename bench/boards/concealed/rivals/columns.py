"""What the engine hands to every rival, and the answer it wants back.

    columns = read("C.h5")            of `torquescope diagnose JOB --columns C.h5` (RESULT_FORMAT.md, /columns)
    answer = METHODS["iid_f"](columns)

Rows are those the engine fits: filtered, of all samples. The columns of each effect stand at the shape
that explains most of the least-squares residual; `Candidate.df` charges a test for that search, as an
extra-sum-of-squares test of nonlinear regression does (Bates, Watts 1988, section 3.5): its linear parameters and its
shapes.

Timing comes first, as for anybody who is careful: a digital loop holds its torque for a sample, so that what is logged
at the tick acts half a sample later (measured on drawn cases: -0.5 samples wherever nothing else bends it). Replicates
of ours know that from the loop. For the rivals a delay of at most one sample of the recording, either way, is a
nuisance of the model and no finding (`aligned`); a longer one stays a candidate. Without this all of them name a delay
on every clean recording.
"""

import dataclasses

import h5py
import numpy as np


@dataclasses.dataclass
class Record:
    """One recording: rows in time order."""
    torque: np.ndarray      # [n]
    regressor: np.ndarray   # [n][R], the baseline
    candidates: dict        # {name: [n][L]}
    rate_hz: float = 100.0
    cutoff_hz: float = 0.0  # of the parallel filter
    row: np.ndarray | None = None  # [n], index among the kept samples; None: no row was left out

    def __len__(self):
        return len(self.torque)

    @property
    def guard(self):
        """Rows the filter may couple: three periods of its cut-off, as in the engine's blocked cross-validation."""
        return int(np.ceil(3.0 * self.rate_hz / self.cutoff_hz)) if self.cutoff_hz > 0.0 else 3

    @property
    def at(self):
        return np.arange(len(self)) if self.row is None else self.row


@dataclasses.dataclass
class Candidate:
    name: str
    family: str
    n_linear: int = 1
    n_shape: int = 0
    acts_on: str = "joint"  # else a fault of a channel
    is_event: bool = False  # happens at an instant of the training recording

    @property
    def df(self):
        return self.n_linear + self.n_shape


@dataclasses.dataclass
class Columns:
    train: Record
    candidates: list                 # of Candidate, in the order of the catalogue
    validation: list = dataclasses.field(default_factory=list)  # Records
    n_not_testable: int = 0          # effects that explain nothing here: they were looked for all the same
    q: float = 0.05                  # share of false names put up with, from the job
    max_effects: int = 5             # named at most, from the job

    def __getitem__(self, name):
        return next(c for c in self.candidates if c.name == name)


@dataclasses.dataclass
class Answer:
    effects: list                    # names, strongest first
    facts: dict = dataclasses.field(default_factory=dict)    # {name: {"p": ..., "q": ...}}
    ranking: list = dataclasses.field(default_factory=list)  # names, named or not, strongest first
    remark: str = ""                 # what the method chose


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


def _texts(values):
    return [_text(value) for value in values]


def _record(group, names):
    return Record(group["torque"][:], group["regressor"][:], {name: group["candidates"][name][:] for name in names},
                  float(group.attrs["kept_rate_hz"]), float(group.attrs["cutoff_hz"]), group["row"][:])


def read(path, q=0.05, max_effects=5):
    with h5py.File(path, "r", locking=False) as file:
        here = file["columns"]
        names = _texts(here.attrs.get("effects", []))
        candidates = []
        for name in names:
            effect = here["effects"][name]
            candidates.append(Candidate(name, _text(effect.attrs["family"]), len(effect.attrs["linear"]),
                                        len(effect["shape"]) if "shape" in effect else 0,
                                        _text(effect.attrs["acts_on"]), bool(effect.attrs["is_event"])))
        rate_hz = float(file["data/train"].attrs["rate_hz"])
        validation = sorted(key for key in here if key.startswith("validate_"))
        found = Columns(_record(here["train"], names), candidates, [_record(here[key], names) for key in validation],
                        len(here.attrs.get("not_testable", [])), q, max_effects)
    return aligned(found, 1.0 / rate_hz)


def aligned(columns, longest_s):
    """The same with a delay of at most longest_s in the model instead of among the candidates."""
    if not any(c.name == "delay" for c in columns.candidates):
        return columns
    # the parameter of its column is the delay in seconds
    delay_s = solve(model(columns.train, ["delay"]), columns.train.torque)[-1]
    if abs(delay_s) > longest_s:
        return columns
    records = [dataclasses.replace(r, regressor=model(r, ["delay"]),
                                   candidates={k: v for k, v in r.candidates.items() if k != "delay"})
               for r in (columns.train, *columns.validation)]
    return dataclasses.replace(columns, train=records[0], validation=records[1:],
                               candidates=[c for c in columns.candidates if c.name != "delay"])


def model(record, names):
    """Columns of the baseline, then of these effects."""
    return np.hstack([record.regressor, *(record.candidates[name] for name in names)])


def solve(matrix, target):
    """Least squares on columns of equal size, so that units do not decide what counts as dependent."""
    size = np.linalg.norm(matrix, axis=0)
    size[size == 0.0] = 1.0
    return np.linalg.lstsq(matrix / size, target, rcond=1e-9)[0] / size


def apart(matrix, beside):
    """What is left of a vector or of columns when `beside` has explained what it can (Frisch, Waugh)."""
    size = np.linalg.norm(beside, axis=0)
    q, r = np.linalg.qr(beside / np.where(size > 0.0, size, 1.0))
    q = q[:, np.abs(np.diag(r)) > 1e-9]
    return matrix - q @ (q.T @ matrix)


def validation_relerr(columns, names):
    """Relative error on the unseen recordings of the least-squares fit with these effects; None when there are none.
    An event belongs to the training recording: elsewhere it does not act."""
    if not columns.validation:
        return None
    parameters = solve(model(columns.train, names), columns.train.torque)
    at = columns.train.regressor.shape[1]
    for name in names:
        width = columns[name].n_linear
        if columns[name].is_event:
            parameters[at : at + width] = 0.0
        at += width
    left = sum(float(np.sum((r.torque - model(r, names) @ parameters) ** 2)) for r in columns.validation)
    return (left / sum(float(np.sum(r.torque**2)) for r in columns.validation)) ** 0.5


def blocks(record, count=10):
    """Contiguous blocks of rows for cross-validation: [(train rows, test rows)]. Rows that the filter couples to a test
    block are in neither."""
    at, folds = record.at, []
    for test in np.array_split(np.arange(len(record)), count):
        far = (at < at[test[0]] - record.guard) | (at > at[test[-1]] + record.guard)
        folds.append((np.flatnonzero(far), test))
    return folds
