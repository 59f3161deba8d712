"""The rivals on small made-up columns whose answer is known by construction, and the runner with a stand-in for the
engine."""

import contextlib
import io
import json
import pathlib
import stat
import sys
import tempfile
import unittest

import h5py
import numpy as np

import rivals
import run_rivals
from rivals import columns as rival_columns
from rivals import hac_wald, iid_f, lasso_cv, nested_friction, stepwise, stlsq_ensemble
from rivals.columns import Candidate, Columns, Record

FRICTION = ("stribeck", "load_dependent_friction", "directional_efficiency", "speed_drag")


def autoregression(random, n, rho):
    noise = random.normal(size=n)
    for k in range(1, n):
        noise[k] += rho * noise[k - 1]
    return noise / noise.std()


def made(seed=1, n=1500, effects=(), noise=1.0, rho=0.0, names=("spring", *FRICTION, "cogging"), colour=0.0):
    """Independent smooth columns; the torque is the baseline, these effects {name: size} and noise."""
    effects = dict(effects)

    def record(random, n):
        regressor = np.column_stack([np.ones(n), random.normal(size=n)])
        candidates = {
            name: np.column_stack([autoregression(random, n, colour) for _ in range(2 if name == "cogging" else 1)])
            for name in names
        }
        torque = regressor @ [0.3, 2.0] + noise * autoregression(random, n, rho)
        for name, size in effects.items():
            torque = torque + size * candidates[name].sum(axis=1)
        return Record(torque, regressor, candidates, 100.0, 50.0)

    random = np.random.default_rng(seed)
    return Columns(
        record(random, n),
        [Candidate(name, "family of " + name, 2 if name == "cogging" else 1, int(name == "cogging")) for name in names],
        [record(random, n // 2)],
    )


class EveryRival(unittest.TestCase):
    def methods(self):
        for name, method in rivals.METHODS.items():
            if run_rivals.missing_library(name):
                print(run_rivals.missing_library(name), file=sys.stderr)
                continue
            yield name, method

    def test_finds_a_large_friction_term_and_says_nothing_else(self):
        for name, method in self.methods():
            with self.subTest(name):
                self.assertEqual(method(made(effects={"stribeck": 0.8})).effects, ["stribeck"])

    def test_is_silent_where_its_own_assumptions_hold_and_nothing_is_there(self):
        for name, method in self.methods():
            with self.subTest(name):
                named = sum(bool(method(made(seed, 600)).effects) for seed in range(10))
                # 5 % each, and the selection rules of the others are cautious: 3 of 10 has a chance of 1 %
                self.assertLessEqual(named, 3)

    def test_puts_the_stronger_of_two_first(self):
        for name, method in self.methods():
            with self.subTest(name):
                found = method(made(effects={"stribeck": 0.7, "load_dependent_friction": 1.4}))
                self.assertEqual(found.effects, ["load_dependent_friction", "stribeck"])

    def test_says_the_same_twice(self):
        for name, method in self.methods():
            with self.subTest(name):
                self.assertEqual(method(made(effects={"spring": 0.3})), method(made(effects={"spring": 0.3})))

    def test_names_no_more_than_the_job_allows(self):
        for name, method in self.methods():
            with self.subTest(name):
                found = made(effects={name: 0.9 for name in ("spring", *FRICTION, "cogging")})
                found.max_effects = 4
                self.assertLessEqual(len(method(found).effects), 4)


class Tests(unittest.TestCase):
    def test_benjamini_hochberg_by_hand(self):
        np.testing.assert_allclose(stepwise.benjamini_hochberg([0.04, 0.01, 0.5, 0.02]), [0.16 / 3, 0.04, 0.5, 0.04])

    def test_effects_that_cannot_be_tested_were_looked_for(self):
        found = made(effects={"spring": 0.1}, n=600)
        few = iid_f.answer(found)
        self.assertEqual(few.effects, ["spring"])
        found.n_not_testable = 100000
        self.assertEqual(iid_f.answer(found).effects, [])

    def test_the_f_test_is_the_one_of_two_nested_fits(self):
        found = made(effects={"cogging": 0.1})
        record, candidate = found.train, found["cogging"]
        left = lambda names: np.sum((record.torque - rival_columns.model(record, names) @ np.linalg.lstsq(
            rival_columns.model(record, names), record.torque, rcond=None)[0]) ** 2)
        from scipy import stats
        free = len(record) - 2 - candidate.df
        wanted = stats.f.sf(
            (left([]) - left(["cogging"])) / candidate.df / (left(["cogging"]) / free), candidate.df, free
        )
        residual = rival_columns.apart(record.torque, record.regressor)
        group = rival_columns.apart(record.candidates["cogging"], record.regressor)
        self.assertAlmostEqual(iid_f.p_value(residual, group, candidate, 2) / wanted, 1.0, places=6)

    def test_p_values_of_white_noise_are_uniform_and_of_red_noise_only_with_newey_west(self):
        def rejected(method, rho):
            count = 0
            for seed in range(200):
                found = made(seed, 800, rho=rho, names=("spring",), colour=rho)
                residual = rival_columns.apart(found.train.torque, found.train.regressor)
                group = rival_columns.apart(found.train.candidates["spring"], found.train.regressor)
                count += method.p_value(residual, group, found["spring"], 2) <= 0.05
            return count / 200
        self.assertLess(rejected(iid_f, 0.0), 0.10)
        self.assertLess(rejected(hac_wald, 0.0), 0.12)
        self.assertGreater(rejected(iid_f, 0.8), 0.25)
        self.assertLess(rejected(hac_wald, 0.8), 0.15)

    def test_the_long_run_variance_of_an_autoregression(self):
        noise = autoregression(np.random.default_rng(5), 200000, 0.5)[:, None]
        lags = hac_wald.andrews_lags(noise)
        # (1 + rho) / (1 - rho) = 3 times the variance
        self.assertAlmostEqual(float(hac_wald.long_run_covariance(noise, lags)[0, 0]) / len(noise), 3.0, delta=0.15)


class Penalties(unittest.TestCase):
    def test_one_standard_error_takes_the_sparsest_that_is_as_good(self):
        paths = np.array([[9.0, 9.2], [1.05, 1.1], [1.0, 1.2]])
        self.assertEqual(lasso_cv.one_standard_error(np.array([3.0, 2.0, 1.0]), paths), 2.0)

    def test_the_largest_penalty_names_nothing_whatever_rounding_leaves(self):
        if run_rivals.missing_library("lasso_cv"):
            self.skipTest(run_rivals.missing_library("lasso_cv"))
        # nothing is there, so the largest penalty is within one standard error of the best in nearly all of them
        silent = [lasso_cv.answer(made(seed, 600)) for seed in range(10)]
        silent = [answer for answer in silent if answer.remark.startswith("penalty 1 ")]
        self.assertGreaterEqual(len(silent), 5)
        self.assertEqual([answer.effects for answer in silent], [[]] * len(silent))

    def test_thresholding_drops_what_is_small_and_refits_the_rest(self):
        gram = np.eye(3)
        found = stlsq_ensemble.thresholded(gram, np.array([1.05, 0.02, 0.5]), 0.1)
        np.testing.assert_allclose(found, [1.0, 0.0, 0.5 / 1.05])

    def test_thresholding_goes_on_until_nothing_falls(self):
        # without the first column the second is below the threshold too
        gram = np.array([[1.0, -0.9], [-0.9, 1.0]])
        self.assertTrue((stlsq_ensemble.thresholded(gram, np.array([0.02, 0.07]), 0.4) == 0.0).all())

    def test_folds_are_whole_stretches_with_a_guard(self):
        record = made(n=1000).train
        for train, test in rival_columns.blocks(record):
            self.assertEqual(list(test), list(range(test[0], test[-1] + 1)))
            self.assertGreater(np.min(np.abs(train[:, None] - test[None, :])), record.guard)


class NestedModels(unittest.TestCase):
    def test_the_simplest_of_equals(self):
        random = np.random.default_rng(1)
        errors = np.abs(random.normal(size=(1, 1000))) + np.zeros((3, 1))
        self.assertEqual(nested_friction.choose(errors + 1e-3 * random.normal(size=errors.shape)), 0)
        errors[2] *= 0.5
        self.assertEqual(nested_friction.choose(errors), 2)

    def test_is_blind_to_what_is_no_friction(self):
        self.assertEqual(nested_friction.answer(made(effects={"spring": 1.0})).effects, [])

    def test_without_a_validation_recording_the_end_of_the_training_stands_in(self):
        found = made(effects={"stribeck": 0.8})
        found.validation = []
        self.assertEqual(nested_friction.answer(found).effects, ["stribeck"])


class Timing(unittest.TestCase):
    def delayed(self, delay_s):
        found = made(names=("spring", "delay"), effects={"delay": delay_s}, noise=1e-5)
        return rival_columns.aligned(found, 1e-3)

    def test_a_delay_of_the_loop_is_a_nuisance_and_a_long_one_a_candidate(self):
        short, long = self.delayed(-0.5e-3), self.delayed(8e-3)
        self.assertEqual([c.name for c in short.candidates], ["spring"])
        self.assertEqual(short.train.regressor.shape[1], 3)
        self.assertEqual(short.validation[0].regressor.shape[1], 3)
        self.assertEqual([c.name for c in long.candidates], ["spring", "delay"])


class Validation(unittest.TestCase):
    def test_error_of_a_perfect_model_is_the_noise_and_events_do_not_act(self):
        found = made(effects={"spring": 2.0}, noise=1e-9)
        self.assertGreater(rival_columns.validation_relerr(found, []), 0.5)
        self.assertLess(rival_columns.validation_relerr(found, ["spring"]), 1e-6)
        found["spring"].is_event = True
        self.assertGreater(rival_columns.validation_relerr(found, ["spring"]), 0.5)


STAND_IN = """#!{python}
import shutil, sys
assert sys.argv[1:4] == ["diagnose", "job.toml", "--columns"], sys.argv
open("{calls}", "a").write("x")
if {code}:
    sys.exit({code})
shutil.copy("{columns}", sys.argv[4])
"""


def write_columns(path, found):
    text = lambda words: np.array([word.encode() for word in words])
    with h5py.File(path, "w") as file:
        file.create_group("data/train").attrs["rate_hz"] = 1000.0
        here = file.create_group("columns")
        here.attrs["effects"] = text([c.name for c in found.candidates])
        here.attrs["not_testable"] = text(["gravity"])
        for candidate in found.candidates:
            effect = here.create_group("effects/" + candidate.name)
            effect.attrs.update(
                {"family": candidate.family, "acts_on": candidate.acts_on, "is_event": int(candidate.is_event)}
            )
            effect.attrs["linear"] = text(["a", "b"][: candidate.n_linear])
            if candidate.n_shape:
                effect["shape"] = np.zeros(candidate.n_shape)
        for key, record in (("train", found.train), ("validate_1", found.validation[0])):
            group = here.create_group(key)
            group.attrs.update({"kept_rate_hz": record.rate_hz, "cutoff_hz": record.cutoff_hz})
            group["torque"], group["regressor"], group["row"] = record.torque, record.regressor, np.arange(len(record))
            for name, values in record.candidates.items():
                group["candidates/" + name] = values


class Runner(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.out, self.calls = self.folder / "out", self.folder / "calls"
        for name in ("one", "two"):
            (self.out / "open" / name).mkdir(parents=True)
            (self.out / "open" / name / "job.toml").write_text("[diagnose]\nq = 0.05\nmax_effects = 5\n")

    def run_rivals(self, found=None, *options, code=0):
        program, columns = self.folder / "program", self.folder / "columns.h5"
        if found is not None:
            write_columns(columns, found)
        program.write_text(STAND_IN.format(python=sys.executable, calls=self.calls, columns=columns, code=code))
        program.chmod(program.stat().st_mode | stat.S_IXUSR)
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            result = run_rivals.main([str(program), str(self.out), *options])
        return result, out.getvalue(), err.getvalue()

    def answer(self, method, name="one"):
        return json.loads((self.out / "rivals" / method / f"{name}.json").read_text())

    def called(self):
        return len(self.calls.read_text())

    def test_writes_what_the_scorer_reads_and_runs_nothing_twice(self):
        code, text, _ = self.run_rivals(made(effects={"spring": 0.8}), "--methods", "iid_f,hac_wald")
        self.assertEqual(code, 0, text)
        one = self.answer("iid_f")
        self.assertEqual((one["case"], one["verdict"]), ("one", "named"))
        self.assertEqual([(e["name"], e["family"]) for e in one["effects"]], [("spring", "family of spring")])
        self.assertLess(one["effects"][0]["q"], 0.05)
        self.assertLess(one["unseen"]["after"], one["unseen"]["before"])
        self.assertGreater(one["seconds"], 0.0)
        self.assertEqual(self.called(), 2)
        self.run_rivals(None, "--methods", "iid_f,hac_wald")
        self.assertEqual(self.called(), 2)
        self.run_rivals(None, "--methods", "iid_f,nested_friction")
        self.assertEqual(self.called(), 4)
        self.assertFalse(list((self.out / "columns").iterdir()))

    def test_a_changed_recording_is_answered_again(self):
        self.run_rivals(made(), "--methods", "iid_f")
        (self.out / "open" / "one" / "train.csv").write_text("another")
        self.run_rivals(None, "--methods", "iid_f")
        self.assertEqual(self.called(), 3)

    def test_faults_of_a_channel_are_no_physics(self):
        found = made(effects={"spring": 0.8})
        found["spring"].acts_on = "recorded_torque"
        self.run_rivals(found, "--methods", "iid_f")
        self.assertEqual(self.answer("iid_f")["verdict"], "data_fault")

    def test_a_refused_recording_is_insufficient_for_everybody(self):
        code, _, _ = self.run_rivals(None, "--methods", "iid_f", code=65)
        self.assertEqual(code, 0)
        self.assertEqual(self.answer("iid_f")["verdict"], "insufficient")

    def test_a_program_that_fails_stops_it(self):
        code, _, err = self.run_rivals(None, "--methods", "iid_f", code=70)
        self.assertEqual(code, 70)
        self.assertIn("ended with 70", err)

    def test_refuses_unknown_methods_and_empty_folders(self):
        self.assertEqual(self.run_rivals(None, "--methods", "oracle")[0], 64)
        self.out = self.folder / "empty"
        self.out.mkdir()
        self.assertEqual(self.run_rivals(None)[0], 66)

    def test_a_missing_library_is_said_in_words(self):
        lasso_cv.NEEDS = "no_such_library", "python3-no-such-library"
        self.addCleanup(setattr, lasso_cv, "NEEDS", ("sklearn", "python3-sklearn"))
        code, _, err = self.run_rivals(made(), "--methods", "iid_f,lasso_cv")
        self.assertEqual(code, 0)
        self.assertIn("python3-no-such-library", err)
        self.assertIn("lasso_cv was not run", json.loads((self.out / "rivals" / "words.json").read_text())["lasso_cv"])
        self.assertFalse((self.out / "rivals" / "lasso_cv").exists())


if __name__ == "__main__":
    unittest.main()
