"""usage: test_package.py SOURCE

The installed package: arrays in, results, frames and pictures out; errors, Ctrl-C, threads.
"""

import contextlib
import importlib.resources
import io
import os
import pathlib
import pickle
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings

import numpy as np
import torquescope as ts
from torquescope import _engine

SOURCE = pathlib.Path(sys.argv.pop(1))
FILTER = {"cutoff_hz": 30, "parallel_cutoff_hz": 15, "decimate_to_hz": 50}
MODEL = {"joint": "revolute", "terms": ["inertia", "viscous", "coulomb", "offset"]}
SECONDS_TO_STOP = 10.0  # of a step of the search on a loaded machine; the whole would take minutes

# friction that rises as the joint comes to rest, as in jobs/concealed_stribeck.toml
PLANT = {"inertia": 0.09, "viscous": 0.35, "coulomb": 0.6, "offset": 0.04, "stribeck": 0.35, "stribeck_speed": 0.15,
         "stribeck_exponent": 1.0}


def simulated(seed, **plant):
    return ts.simulate({"experiment": {"seed": seed}, "model": MODEL, "simulate": {
        "mode": "closed_loop", "rate_hz": 500, "duration_s": 12, "plant": {**PLANT, **plant},
        "reference": {"kind": "multisine", "max_speed": 3.0}, "controller": {"kind": "pd", "rate_hz": 500},
        "encoder": {"counts_per_revolution": 131072}, "noise": {"torque_std": 0.02}}})


def renamed(recording, name):
    return ts.Recording(**recording.signals, name=name)


MOTION, VALIDATION = renamed(simulated(11), "motion"), renamed(simulated(12), "unseen")


class ADiagnosisOfArrays(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.found = ts.diagnose(MOTION, validate=VALIDATION, model=MODEL, filter=FILTER, diagnose={"twins": 60},
                                experiment={"seed": 11})

    def test_names_what_was_concealed(self):
        self.assertIn(self.found.verdict, ("named", "class"))
        self.assertEqual(self.found.effects[0].name, "stribeck")
        self.assertIn("Joint 1", self.found.reason)
        self.assertAlmostEqual(self.found.parameters["inertia"].value, PLANT["inertia"], delta=0.003)

    def test_says_the_verdict_of_its_one_joint(self):
        self.assertEqual((self.found.joints[0].verdict, self.found.joints[0].reason),
                         (self.found.verdict, self.found.reason))

    def test_can_be_pickled(self):
        again = pickle.loads(pickle.dumps(self.found))
        self.assertNotEqual(again.path, self.found.path)
        again.verify()
        self.assertEqual(again.parameters, self.found.parameters)
        self.assertEqual(again.provenance.finished, self.found.provenance.finished)
        folder = os.path.dirname(again.path)
        del again
        self.assertFalse(os.path.exists(folder))

    def test_is_told_in_one_line_and_in_a_block(self):
        self.assertRegex(repr(self.found), r"^<Result 'motion': (named|class): Joint 1 loses")
        block = self.found._repr_html_()
        self.assertIn("Missing physics", block)
        self.assertIn("simulated replicates look like this", block)

    def test_has_frames(self):
        parameters = self.found.to_frame()
        self.assertEqual(parameters.loc[(1, "inertia"), "unit"], "kg m2")
        self.assertTrue(np.isnan(parameters.loc[(1, "stribeck"), "before"]))
        candidates = self.found.to_frame("candidates")
        self.assertIn(candidates.loc[(1, "stribeck"), "decision"], ("named", "class"))
        self.assertEqual(len(self.found.to_frame("effects")), len(self.found.effects))
        self.assertIn("velocity", self.found.to_frame("map").index.get_level_values("axis"))
        with self.assertRaisesRegex(ts.UsageError, "it has: parameters, effects"):
            self.found.to_frame("effect")

    def test_has_datasets_with_units(self):
        rows = self.found.to_xarray()
        self.assertEqual(rows.torque.attrs["units"], "N m")
        self.assertEqual(list(rows.parameter.values), MODEL["terms"])
        trace = self.found.to_xarray("trace_1")
        kept = np.isfinite(trace.before) & np.isfinite(trace.after)
        self.assertLess(float((trace.after[kept] ** 2).sum()), float((trace.before[kept] ** 2).sum()))

    def test_draws_figures_and_leaves_matplotlib_as_it_was(self):
        import matplotlib
        before = dict(matplotlib.rcParams)
        for figure in (self.found.plot.map(), self.found.plot.trace(), self.found.plot("residual_budget")):
            self.assertTrue(figure._repr_png_().startswith(b"\x89PNG"))
            self.assertTrue(figure.axes)
        self.assertEqual(before, dict(matplotlib.rcParams))
        with self.assertRaisesRegex(ts.UsageError, "it has: .*mismatch_map"):
            self.found.plot("map")

    def test_is_saved_opened_verified_and_made_a_page(self):
        with tempfile.TemporaryDirectory() as folder:
            path = self.found.save(os.path.join(folder, "r.h5"))
            with ts.open(path) as opened:
                opened.verify()
                self.assertEqual(opened.verdict, self.found.verdict)
                self.assertEqual(opened.parameters, self.found.parameters)
                page = pathlib.Path(opened.report(os.path.join(folder, "r.html"))).read_text(encoding="utf-8")
            self.assertIn("Missing physics", page)
            with self.assertRaisesRegex(ts.UsageError, "exists"):
                self.found.save(path)

    def test_lives_in_a_file_that_goes_with_it(self):
        fitted = ts.identify(MOTION, model=MODEL, filter=FILTER)
        folder = os.path.dirname(fitted.path)
        self.assertTrue(os.path.exists(folder))
        del fitted
        self.assertFalse(os.path.exists(folder))


class AnIdentification(unittest.TestCase):
    def test_of_arrays_is_that_of_their_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = os.path.join(folder, "motion.csv")
            np.savetxt(file, np.column_stack([MOTION.time, MOTION.position, MOTION.torque, MOTION.reference]),
                       fmt="%.17g", delimiter=",", header="t_s,q_rad,tau_Nm,q_ref_rad", comments="")
            job = os.path.join(folder, "job.toml")
            terms = ", ".join(f'"{term}"' for term in MODEL["terms"])
            pathlib.Path(job).write_text(
                f"[recording]\ntrain = \"motion.csv\"\n"
                "columns = {time = \"t_s\", position = \"q_rad\", torque = \"tau_Nm\", reference = \"q_ref_rad\"}\n"
                f"[model]\nterms = [{terms}]\n[[estimator]]\nname = \"ols\"\n"
                "[filter]\ncutoff_hz = 30\nparallel_cutoff_hz = 15\ndecimate_to_hz = 50\n")
            of_file = ts.identify(job, out=os.path.join(folder, "r.h5"))
            guessed = ts.Recording.from_csv(file)
            self.assertEqual(guessed.joint, "q_rad")
            self.assertTrue(guessed.remarks)
            named = ts.Recording.from_csv(file, joint="q_rad")
            np.testing.assert_array_equal(named.position, guessed.position)
            for recording in (MOTION, guessed):
                of_arrays = ts.identify(recording, model=MODEL, filter=FILTER)
                self.assertEqual(of_arrays.parameters, of_file.parameters)

    def test_of_masked_arrays_is_that_of_arrays_with_holes(self):
        hole = np.zeros(len(MOTION), dtype=bool)
        hole[400:403] = hole[2000:2040] = True
        filled, holed = MOTION.torque.copy(), MOTION.torque.copy()
        filled[hole], holed[hole] = 9.96921e36, np.nan  # what netCDF4 puts there
        rest = {"time": MOTION.time, "position": MOTION.position, "reference": MOTION.reference, "gaps": "fill"}
        masked = ts.Recording(torque=np.ma.masked_array(filled, hole), **rest)
        np.testing.assert_array_equal(masked.torque, holed)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            of_masked, of_holes = (ts.identify(one, model=MODEL, filter=FILTER, estimators={"name": "ols"})
                                   for one in (masked, ts.Recording(torque=holed, **rest)))
        self.assertEqual(of_masked.parameters, of_holes.parameters)

    def test_tells_parameters_intervals_and_histories(self):
        estimators = ["ols", {"name": "de", "generations": 20}]
        fitted = ts.identify([MOTION, VALIDATION], model=MODEL, filter=FILTER, estimators=estimators,
                             experiment={"runs": 3})
        frame = fitted.to_frame()
        self.assertLess(frame.loc["inertia", "ols_low"], frame.loc["inertia", "ols"])
        self.assertEqual(list(fitted.to_frame("estimators").index), ["ols", "de"])
        histories = fitted.to_xarray("de")
        self.assertEqual(dict(histories.best.sizes), {"run": 3, "generation": 21})
        self.assertEqual(list(histories.generation.values), list(range(21)))
        self.assertIn("inertia", fitted._repr_html_())
        self.assertRegex(repr(fitted), "4 parameters; ols, de")
        self.assertTrue(fitted.plot.trace().axes)

    def test_knows_which_generations_it_stores(self):
        def identified(history):
            return ts.identify(MOTION, model=MODEL, filter=FILTER, estimators={"name": "de", "generations": 25},
                               experiment={"runs": 2}, output={"history": history}).to_xarray("de")

        whole, some = identified("full"), identified("every 10")
        self.assertEqual(list(some.generation.values), [0, 10, 20, 25])
        self.assertEqual(list(some.last_generation.values), [25, 25])
        for name in ("population", "fitness", "best", "F", "evaluations"):
            np.testing.assert_array_equal(some[name], whole[name].sel(generation=some.generation))
        self.assertNotIn("last_generation", whole)
        with self.assertRaisesRegex(ts.JobError, 'history = "some" names no generations'):
            identified("some")

    def test_of_an_arm_takes_one_column_a_joint(self):
        robot = ts.Robot(SOURCE / "jobs/robots/crs_a465.toml")
        motion = ts.simulate(SOURCE / "jobs/crs_a465_five_joints.toml")
        self.assertEqual(motion.joints, len(robot.joints))
        fitted = ts.identify(motion, model={"robot": robot, "friction": ["viscous", "coulomb"]}, estimators="wls",
                             filter={"cutoff_hz": 20, "parallel_cutoff_hz": 10, "decimate_to_hz": 25})
        self.assertEqual(len(fitted.parameters), len(fitted.model.names))
        self.assertIn("sample", fitted.to_xarray(joint=2).torque.dims)

    def test_shows_progress(self):
        told = io.StringIO()
        with contextlib.redirect_stderr(told):
            ts.identify(MOTION, model=MODEL, filter=FILTER, estimators={"name": "de", "generations": 20},
                        progress=True)
        self.assertIn("de", told.getvalue())
        self.assertIn("30/30", told.getvalue())


class Errors(unittest.TestCase):
    def refusal(self, kind, call, *arguments, **options):
        with self.assertRaises(kind) as caught:
            call(*arguments, **options)
        return caught.exception

    def test_have_the_words_and_the_code_of_the_program(self):
        error = self.refusal(ts.JobError, ts.diagnose, MOTION, model=MODEL, filter={"cutof_hz": 40},
                             diagnose={"twins": 3})
        self.assertEqual(error.exit_code, 78)
        self.assertIsInstance(error, ValueError)
        self.assertEqual([one.key for one in error.problems], ["filter.cutof_hz", "diagnose.twins"])
        self.assertIn("did you mean \"cutoff_hz\"?", str(error))
        self.assertIn("twins takes 20 to 100000", str(error))

    def test_of_data_say_which_channel(self):
        still = ts.Recording(time=MOTION.time, position=0 * MOTION.position, torque=MOTION.torque)
        error = self.refusal(ts.DataError, ts.identify, still, model=MODEL)
        self.assertEqual(error.exit_code, 65)
        self.assertIn("position", str(error))
        short = dict(time=MOTION.time[:-1], position=MOTION.position, torque=MOTION.torque)
        self.assertIn("time has", str(self.refusal(ts.DataError, ts.Recording, **short)))

    def test_of_keys_of_a_recording_are_those_of_a_job(self):
        wrong = ts.Recording(**MOTION.signals, torque_per_unt=2.0)
        self.assertIn("torque_per_unit", str(self.refusal(ts.JobError, ts.identify, wrong, model=MODEL)))

    def test_of_a_call_say_what_to_write(self):
        self.assertIn("whole job", str(self.refusal(ts.UsageError, ts.diagnose, "job.toml", model=MODEL)))
        self.assertIn("no sampling", str(self.refusal(ts.UsageError, ts.Recording, position=[1], torque=[1]))
                      .replace("nor a sampling", "no sampling"))
        other = ts.Recording(**MOTION.signals, torque_per_unit=2.0)
        self.assertIn("SI units", str(self.refusal(ts.UsageError, ts.diagnose, [MOTION, other], model=MODEL)))
        for threads in (-1, 1.5, True):
            for call in (ts.diagnose, ts.check):
                self.assertIn("threads = ", str(self.refusal(ts.UsageError, call, MOTION, model=MODEL,
                                                             threads=threads)))
        self.assertIn("no Recording", str(self.refusal(ts.UsageError, ts.diagnose, [np.zeros(3)], model=MODEL)))

    def test_of_files_are_told(self):
        self.assertEqual(self.refusal(ts.Error, ts.identify, "absent.toml").exit_code, 66)
        self.refusal(ts.ResultError, ts.open, "absent.h5")
        self.assertEqual(self.refusal(ts.Error, ts.Robot.from_urdf, "absent.urdf").exit_code, 66)

    def test_of_a_recording_that_can_be_used_are_warnings(self):
        one_way = np.abs(np.sin(np.linspace(0, 60, len(MOTION))))
        odd = ts.Recording(time=MOTION.time, position=np.cumsum(one_way) / 500, torque=MOTION.torque)
        with warnings.catch_warnings(record=True) as told:
            warnings.simplefilter("always")
            with contextlib.suppress(ts.Error):
                ts.identify(odd, model=MODEL)
        self.assertTrue([one for one in told if one.category is ts.RecordingWarning])

    def test_check_tells_everything_before_a_run(self):
        lines = ts.check(MOTION, validate=VALIDATION, model=MODEL, filter=FILTER)
        self.assertEqual([line.topic for line in lines[:3]], ["job", "recording", "rows"])
        self.assertFalse([line for line in lines if line.level == "fault"])


LONG = """
import sys
import torquescope as ts
motion = ts.simulate({job!r})
print("begun", flush=True)
ts.identify(motion, model={model!r}, out={out!r}, experiment={{"runs": 4000}}, output={{"populations": False}},
            estimators={{"name": "de", "generations": 2000, "fitness": "direct"}})
"""


class Stopping(unittest.TestCase):
    def test_ctrl_c_ends_a_run_and_the_same_call_goes_on(self):
        with tempfile.TemporaryDirectory() as folder:
            code = LONG.format(job=str(SOURCE / "jobs/concealed_stribeck.toml"), model=MODEL,
                               out=os.path.join(folder, "r.h5"))
            child = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                                     text=True)
            self.assertEqual(child.stdout.readline(), "begun\n")
            time.sleep(3.0)
            pressed = time.monotonic()
            child.send_signal(signal.SIGINT)
            _, told = child.communicate(timeout=120)
            self.assertLess(time.monotonic() - pressed, SECONDS_TO_STOP)
            self.assertIn("KeyboardInterrupt", told)
            if sys.version_info >= (3, 11):
                self.assertIn("are safe", told)
            self.assertTrue(os.path.isdir(os.path.join(folder, "r.h5.parts")))
            self.assertFalse(os.path.exists(os.path.join(folder, "r.h5")))

    def test_an_interrupted_diagnosis_leaves_nothing(self):
        folders = set(os.listdir(tempfile.gettempdir()))
        threading.Timer(1.5, signal.raise_signal, [signal.SIGINT]).start()
        began = time.monotonic()
        with self.assertRaises(KeyboardInterrupt):
            ts.diagnose(MOTION, validate=VALIDATION, model=MODEL, filter={"cutoff_hz": 30}, diagnose={"twins": 20000})
        self.assertLess(time.monotonic() - began, 1.5 + SECONDS_TO_STOP)
        left = set(os.listdir(tempfile.gettempdir())) - folders
        self.assertFalse([name for name in left if name.startswith("torquescope_")])

    def test_other_threads_go_on(self):
        counted, done = [0], threading.Event()

        def count():
            while not done.is_set():
                counted[0] += 1
                time.sleep(0.01)
        thread = threading.Thread(target=count)
        thread.start()
        began = time.monotonic()
        ts.diagnose(MOTION, model=MODEL, filter=FILTER, diagnose={"twins": 60}, threads=1)
        seconds = time.monotonic() - began
        done.set()
        thread.join()
        # with the GIL held there would be next to none
        self.assertGreater(counted[0], 10.0 * seconds)


class ThePackage(unittest.TestCase):
    def test_is_typed(self):
        files = importlib.resources.files(ts)
        self.assertTrue((files / "py.typed").is_file())
        stub = (files / "_engine.pyi").read_text(encoding="utf-8")
        for name in dir(_engine):
            if not name.startswith("_"):
                self.assertRegex(stub, rf"\b{name}\b")

    def test_has_the_version_of_the_engine(self):
        self.assertEqual(ts.__version__, _engine.__version__)

    def test_describes_what_a_job_can_name(self):
        told = io.StringIO()
        with contextlib.redirect_stdout(told):
            ts.describe("filter")
        self.assertIn("parallel_cutoff_hz", told.getvalue())


if __name__ == "__main__":
    unittest.main(verbosity=2)
