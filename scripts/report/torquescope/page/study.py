"""What the page and the figures need from a result file, in plain arrays. Beside the readers the only file that knows
the layout.

Source     engine/store/RESULT_FORMAT.md
"""

import numpy as np

from . import seed, style
from .arm import Arm
from ..errors import ResultError
from ..reader.read_result import Result, rolls_out

# the others are searches of several runs
ONE_RUN = ("ols", "wls", "irls", "essential", "consistent", "iv", "tls", "lm")


class View:
    """A group of the file in which what is absent is None: sections of the page come and go with the data."""

    def __init__(self, group):
        self._group = group

    def __getattr__(self, key):
        if key.startswith("_"):
            raise AttributeError(key)
        return self._group.get(key) if self._group is not None else None

    def unit_of(self, dataset):
        return self._group.unit(dataset)

    def has(self, dataset):
        return self._group is not None and dataset in self._group


class Recording(View):
    """/data/train or /data/validate."""

    @property
    def rows(self):
        return len(self.time) if self.has("time") else int(self.samples)  # an arm's are with its joints

    @property
    def warned(self):
        """Everything `check` would say: list of "topic: text"."""
        return [] if self.warnings is None else list(self.warnings)

    @property
    def laid_end_to_end(self):
        """Time [n] of recordings put one after the other, in s: what a trace is drawn over."""
        time, number = np.array(self.time, dtype=float), np.asarray(self.recording)
        begins = np.flatnonzero(np.diff(number, prepend=number[0] - 1))
        offset = 0.0
        for begin, end in zip(begins, [*begins[1:], len(time)]):
            step = np.median(np.diff(time[begin:end])) if end - begin > 1 else 0.0
            length = time[end - 1] - time[begin] + step
            time[begin:end] += offset - time[begin]
            offset += length
        return time

    @property
    def seams(self):
        """Indices where a new recording begins (the first one left out)."""
        return np.flatnonzero(np.diff(self.recording)) + 1

    def prediction(self, parameters):
        return self.regressor @ parameters


class Estimator(View):
    """/runs/<name>: kind, title, options and summary as attributes, one row per run in the datasets."""

    def __init__(self, name, group):
        super().__init__(group)
        self.name = name
        self.controller = View(group.controller) if "controller" in group else None
        self.rolls_out = rolls_out(group)  # fits simulations of all samples, not rows
        self.colour = self.dashes = None  # given by Study, which knows its neighbours

    @property
    def label(self):
        return self.title or self.name.upper()

    @property
    def short(self):
        """For crowded places; the name is what the job file calls it."""
        plain = self.name.upper()
        return plain if len(plain) <= 12 else plain[:11] + "…"

    @property
    def is_search(self):
        return self.kind not in ONE_RUN

    @property
    def generations(self):
        """That its histories hold; earlier files do not say."""
        return np.arange(np.shape(self.gap_history)[1]) if self.generation is None else np.asarray(self.generation)

    @property
    def draws_histories(self):
        """Not where [output] history stores too few generations for a curve."""
        return self.gap_history is not None and (self.last_generation is None or len(self.generations) > 2)

    @property
    def chosen(self):
        """Parameters [R] of the median run."""
        return self.parameters[int(self.median_run or 0)]

    @property
    def ink(self):
        return style.LIGHT[self.colour]


class Study:
    """One result file, by its path or opened already. Estimators in the order of the job; none in the file of a
    diagnosis, of a replay alone or of a set of recordings of servos."""

    def __init__(self, source):
        self._result = source if isinstance(source, Result) else Result(source)
        self.path = self._result.path
        self.creator, self.digest = self._result.get("creator", ""), self._result.get("content_sha256", "")
        self.job, self.model = View(self._result.job), View(self._result.get("model"))
        self.job_text = str(np.atleast_1d(self.job.text)[0]) if self.job.has("text") else ""
        self.provenance = View(self._result.get("provenance"))
        self.diagnosis = self._result.diagnosis  # diagnosis_records.py; None for an identification
        replay = self._result.replay()  # read_replay.py; None where there is nothing to show
        self.replay = replay if replay and any(one.channels for one in replay.recordings) else None
        self.servo = self._result.servo()  # read_servo.py; None of other kinds
        self.train = Recording(self._result.train) if self._result.train is not None else None
        self.validate = Recording(self._result.validate) if self._result.validate is not None else None
        is_arm = "arm" in self._result
        self.is_replay_alone = bool(self.replay) and not self._result.estimators and not self.diagnosis
        self.is_replay_alone = self.is_replay_alone and not self.servo
        has_rows = not self.is_replay_alone and not self.servo
        if has_rows:
            if self.train is None:
                raise ResultError(f"{self.path} has nothing to draw: neither rows of a fit nor a replay")
            if not self.train.has("joint_1" if is_arm else "torque"):
                raise ResultError(f"{self.path} keeps no samples to draw: its job says [output] samples = false")
        self.arm = Arm(self._result) if is_arm and has_rows else None
        self.health = View(self._result.data.get("regressor_health")) if "data" in self._result else View(None)
        self.estimators = [Estimator(name, group) for name, group in self._result.estimators.items()]
        for estimator, look in zip(self.estimators, style.estimator_looks([e.kind for e in self.estimators])):
            estimator.colour, estimator.dashes = look

    @property
    def joint(self):
        """"revolute", "prismatic", "arm"."""
        return self.model.joint or (self.replay.joint if self.replay else "")

    @property
    def effort(self):
        return "force" if self.joint == "prismatic" else "torque"

    @property
    def symbol(self):
        return "F" if self.joint == "prismatic" else "τ"

    @property
    def effort_unit(self):
        return "1" if self.arm else self.train.unit_of("torque")

    @property
    def truth_known(self):
        return self.model.truth is not None and bool(np.all(np.isfinite(self.model.truth)))

    @property
    def ols(self):
        """The ordinary least squares: floor of every gap, unit of every difference; None when the job has none."""
        return next((e for e in self.estimators if e.kind == "ols"), None)

    @property
    def lead(self):
        """The estimator that sentences and pictures of one are about: OLS, else the first; where all fit simulations,
        the one whose simulation is closest."""
        if not self.estimators or not all(e.rolls_out for e in self.estimators):
            return self.ols or next((e for e in self.estimators if not e.rolls_out), None)
        return min(self.estimators, key=lambda e: e.mse_median if np.isfinite(e.mse_median) else np.inf)

    @property
    def searches(self):
        return [e for e in self.estimators if e.is_search]

    @property
    def to_floor(self):
        """Searches in rows, whose distance from the least-squares optimum is known."""
        return [e for e in self.searches if not e.rolls_out]

    @property
    def rolled(self):
        """Those that fit simulations."""
        return [e for e in self.estimators if e.rolls_out]

    def error_unit(self, estimator):
        """Of its errors: those of simulations are of the position where nothing else could be simulated."""
        return estimator.rollout_error_unit or self.effort_unit

    def error_of(self, estimator):
        """"torque", "force" or "position"."""
        return "position" if self.error_unit(estimator) in ("rad", "m") else self.effort

    @property
    def is_seed_study(self):
        if tuple(self.model.names) != seed.PARAMETERS:
            return False
        if self.job.study is not None:
            return self.job.study == "crs_a465"
        return self.truth_known and bool(np.allclose(self.model.truth, seed.TABLE_3["OLS"], rtol=1e-9, atol=0))


def held(history):
    """History [run][generation] with the last value kept after a run has stopped."""
    filled = np.array(history, dtype=float)
    for run in filled:
        known = np.flatnonzero(np.isfinite(run))
        if len(known):
            run[known[-1] + 1:] = run[known[-1]]
    return filled
