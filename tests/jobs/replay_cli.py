"""replay, and fits by rollouts, end to end: a joint that was simulated here, by plain loops that share nothing with the
engine, is found, replayed from job, run and diagnosis, on every sample; what cannot be simulated is refused.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/replay_cli.py
"""

import csv
import json
import math
import os
import random
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import cli_folder  # noqa: E402

RATE_HZ, SECONDS = 500, 6
TRUTH = {"inertia": 0.08, "viscous": 0.3, "coulomb": 0.4, "offset": 0.05}
KP, KD = 40.0, 2.5
ENCODER_STEP = 2 * math.pi / 65536


def reference(t, phase):
    return 0.8 * math.sin(1.7 * t + phase) + 0.3 * math.sin(4.1 * t) - 0.8 * math.sin(phase)


def recorded(phase, seed, pulses=False):
    """Rows of t, reference, position, torque, added command: steps of a twentieth of a tick, friction that holds."""
    noise, rows = random.Random(seed), []
    q = before = dq = 0.0
    for k in range(SECONDS * RATE_HZ):
        t = k / RATE_HZ
        read = ENCODER_STEP * math.floor(q / ENCODER_STEP + 0.5)
        added = 3.0 if pulses and 2.0 <= t < 2.4 else 0.0
        u = KP * (reference(t, phase) - read) - KD * (read - before) * RATE_HZ + 1.5 * added
        before = read
        rows.append((t, reference(t, phase), read, u + noise.gauss(0.0, 0.01), added))
        h = 1 / RATE_HZ / 20
        for _ in range(20):
            drive = u - TRUTH["offset"] - TRUTH["viscous"] * dq
            if dq == 0.0 and abs(drive) <= TRUTH["coulomb"]:
                continue
            way = math.copysign(1.0, dq) if dq != 0.0 else math.copysign(1.0, drive)
            after = dq + h * (drive - way * TRUTH["coulomb"]) / TRUTH["inertia"]
            if after * way < 0.0:
                after = 0.0
            q += h * 0.5 * (dq + after)
            dq = after
    return rows


def table(columns):
    return "{" + ", ".join(f'{key} = "{value}"' for key, value in columns.items()) + "}"


class Replay(cli_folder.Folder):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.recordings = {"a.csv": recorded(0.0, 1), "b.csv": recorded(1.0, 2), "pulses.csv": recorded(2.0, 3, True)}

    def setUp(self):
        super().setUp()
        for name, rows in self.recordings.items():
            with open(os.path.join(self.folder, name), "w", newline="", encoding="utf-8") as file:
                writer = csv.writer(file)
                writer.writerow(["t_s", "r_rad", "q_rad", "u_Nm"] + (["added_V"] if name == "pulses.csv" else []))
                writer.writerows(row if name == "pulses.csv" else row[:4] for row in rows)

    def job(self, *sections, columns=None, validate="b.csv", terms=("inertia", "viscous", "coulomb", "offset"),
            name="job.toml"):
        columns = columns or {"time": "t_s", "reference": "r_rad", "position": "q_rad", "torque": "u_Nm"}
        text = "\n".join([
            '[experiment]\nname = "lab"\nseed = 3\nruns = 2',
            f'[recording]\ntrain = "a.csv"\nvalidate = "{validate}"\ncolumns = {table(columns)}',
            "[filter]\ncutoff_hz = 40\nparallel_cutoff_hz = 20\ndecimate_to_hz = 100",
            f'[model]\njoint = "revolute"\nterms = {json.dumps(list(terms))}', *sections]) + "\n"
        self.write(name, text)
        return name

    def replayed(self, *arguments):
        outcome = self.run_here("replay", *arguments, "--json", "r.json")
        self.assertEqual(outcome.code, 0, outcome.err)
        with open(os.path.join(self.folder, "r.json"), encoding="utf-8") as file:
            return json.load(file)

    def test_the_true_joint_in_its_loop_moves_as_recorded_on_every_sample(self):
        given = "[model.given]\n" + "".join(f"{key} = {value}\n" for key, value in TRUTH.items())
        made = self.replayed(self.job(given, f'[loop]\ncontroller = "pd"\nkp = {KP}\nkd = {KD}\n'), "--csv", "r.csv")
        self.assertEqual(made["models"], ["as given"])
        for one in made["recordings"]:
            torque, position = one["channels"]["torque"], one["channels"]["position"]
            self.assertEqual([m["n"] for m in torque["models"] + position["models"]], [SECONDS * RATE_HZ] * 2)
            self.assertEqual(one["loop"], "given")
            # noise of 0.01, and what a step of the encoder makes of the speed
            self.assertLess(torque["models"][0]["rms"], 0.15)
            self.assertLess(position["models"][0]["rms"], 4 * ENCODER_STEP)
        # the numbers are those of the samples
        with open(os.path.join(self.folder, "r.csv"), encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["recording"] == "2"]
        left = np.array([float(row["torque_measured"]) - float(row["torque_model_1"]) for row in rows])
        validation = next(one for one in made["recordings"] if one["purpose"] == "validate")
        rms = validation["channels"]["torque"]["models"][0]["rms"]
        self.assertAlmostEqual(math.sqrt(np.mean(left**2)), rms, places=6)
        with h5py.File(os.path.join(self.folder, "lab_replay.h5")) as file:
            group = file["replay/recording_2/torque"]
            self.assertEqual(group["simulated"].shape, (1, SECONDS * RATE_HZ))
            self.assertAlmostEqual(group["rms"][0], rms, places=12)

    def test_lm_finds_joint_and_gains_and_a_run_is_replayed(self):
        job = self.job('[loop]\ncontroller = "pd"\n', '[[estimator]]\nname = "lm"\n')
        outcome = self.run_here("run", job, "--out", "lab.h5")
        self.assertEqual(outcome.code, 0, outcome.err)
        with h5py.File(os.path.join(self.folder, "lab.h5")) as file:
            names = [name.decode() for name in file["model/names"][()]]
            found = dict(zip(names, file["runs/lm/parameters"][0]))
            bounds = dict(zip(names, file["runs/lm/ci95"][0]))
            self.assertIn("replay", file)
        self.assertEqual(names, [*TRUTH, "loop_kp", "loop_kd"])
        truth = {**TRUTH, "loop_kp": KP, "loop_kd": KD}
        for name, value in truth.items():
            self.assertLess(abs(found[name] - value), max(0.02 * abs(value), 0.005), name)
            self.assertLess(bounds[name][0], bounds[name][1])
        made = self.replayed("lab.h5", "--job", job)
        self.assertEqual((made["before"], made["after"]), ("by least squares", "lm"))
        for one in made["recordings"]:
            before, after = one["channels"]["position"]["models"]
            self.assertLessEqual(after["rms"], 1.05 * before["rms"])
        # a result does not know where its job stood
        os.mkdir(os.path.join(self.folder, "elsewhere"))
        os.rename(os.path.join(self.folder, "lab.h5"), os.path.join(self.folder, "elsewhere", "lab.h5"))
        os.rename(os.path.join(self.folder, "a.csv"), os.path.join(self.folder, "elsewhere", "a.csv"))
        self.assert_refused(self.run_here("replay", "elsewhere/lab.h5"), 66,
                            ["a.csv, which is not here", "--job JOB.toml"])
        for name in ("lab.h5", "a.csv"):
            os.rename(os.path.join(self.folder, "elsewhere", name), os.path.join(self.folder, name))
        # on a recording that the job does not name
        made = self.replayed("lab.h5", "pulses.csv", "--job", job)
        self.assertEqual([one["name"] for one in made["recordings"]], ["a.csv", "pulses.csv"])

    def test_populations_search_by_rollouts_with_the_same_bits_on_any_threads(self):
        searches = "".join(f'[[estimator]]\nname = "{name}"\nfitness = "rollout"\npopulation = 12\ngenerations = 4\n'
                           for name in ("de", "fade", "lshade"))
        job = self.job(f'[loop]\ncontroller = "pd"\nkp = {KP}\nkd = {KD}\n', searches)
        for name, threads in (("one.h5", "1"), ("two.h5", "2")):
            outcome = self.run_here("run", job, "--out", name, "--threads", threads)
            self.assertEqual(outcome.code, 0, outcome.err)
        with open(os.path.join(self.folder, "one.h5"), "rb") as one, \
                open(os.path.join(self.folder, "two.h5"), "rb") as two:
            self.assertEqual(one.read(), two.read())
        with h5py.File(os.path.join(self.folder, "one.h5")) as file:
            self.assertEqual(file["runs/fade/population"].shape, (2, 5, 12, 4))
            self.assertTrue(np.all(np.diff(file["runs/de/best"][0]) <= 0))
            self.assertEqual(file["runs/de"].attrs["fitness_used"], b"rollout")

    def test_a_population_that_stops_early_has_the_error_it_stopped_at(self):
        self.job('[[estimator]]\nname = "de"\nfitness = "rollout"\npopulation = 8\ngenerations = 9\nevaluations = 20\n')
        self.assertEqual(self.run_here("run", "job.toml", "--out", "early.h5", "--quiet").code, 0)
        with h5py.File(os.path.join(self.folder, "early.h5"), locking=False) as file:
            found = file["runs/de"]
            self.assertEqual(set(found["stop_reason"]), {b"evaluations"})
            np.testing.assert_array_equal(found["gap"], np.nanmin(found["gap_history"], axis=1))
            self.assertTrue(np.isfinite(found.attrs["gap_median"]))

    def test_added_commands_act_where_they_are_added(self):
        columns = {"time": "t_s", "reference": "r_rad", "position": "q_rad", "torque": "u_Nm",
                   "added_command": "added_V"}
        given = "[model.given]\n" + "".join(f"{key} = {value}\n" for key, value in TRUTH.items())
        loop = f'[loop]\ncontroller = "pd"\nkp = {KP}\nkd = {KD}\n'
        with_it = self.replayed(self.job(given, loop + "added_command_gain = 1.5\n", columns=columns,
                                         validate="pulses.csv"))
        without = self.replayed(self.job(given, loop, validate="pulses.csv"))

        def error(made):
            return made["recordings"][1]["channels"]["torque"]["models"][0]["rms"]

        self.assertLess(error(with_it), 0.5 * error(without))

    def test_a_diagnosis_is_replayed_before_and_after(self):
        job = self.job("[diagnose]\ntwins = 60\n", terms=("inertia", "viscous", "offset"))
        outcome = self.run_here("diagnose", job, "--out", "d.h5")
        self.assertEqual(outcome.code, 0, outcome.err)
        with h5py.File(os.path.join(self.folder, "d.h5")) as file:
            self.assertIn("replay", file)
        made = self.replayed("d.h5", "--job", job)
        self.assertEqual(made["before"], "as identified")
        if made["after"] != made["before"]:
            before, after = made["recordings"][1]["channels"]["position"]["models"]
            self.assertLess(after["rms"], before["rms"])

    def test_without_a_reference_windows_begin_anew_and_say_so(self):
        columns = {"time": "t_s", "position": "q_rad", "torque": "u_Nm"}
        made = self.replayed(self.job(columns=columns))
        for one in made["recordings"]:
            self.assertEqual((one["drive"], one["window_s"], one["loop"]), ("windows", 0.05, "none"))
            self.assertIn("record the commanded position", one["loop_words"])
            self.assertNotIn("torque", one["channels"])

    def test_a_loop_that_is_not_stable_is_told_and_no_number_of_it(self):
        made = self.replayed(self.job('[loop]\ncontroller = "pd"\nkp = 400000.0\nkd = 2.5\n'))
        for one in made["recordings"]:
            self.assertEqual(one["diverged"], [True])
            self.assertEqual([m["rms"] for m in one["channels"]["position"]["models"]], [None])

    def test_mistakes_are_refused_at_their_place(self):
        cases = [
            ('[loop]\ncontroller = "pd"\nkv = 3.0\n', ["kv is no gain of controller", "job.toml:"]),
            ('[loop]\ncontroller = "pdd"\n', ["controller", "p_velocity"]),
            ('[loop]\nfit = ["kq"]\n', ['nothing of a loop is called "kq"']),
            ('[loop]\ncontroller = "p"\nfit = ["goal_speed_limit"]\n', ["no value to begin at"]),
            ('[loop]\nchannels = ["speed"]\n', ['"speed" is none']),
            ('[[model.effects]]\nname = "strybeck"\n', ["no effect of such a joint"]),
            ('[[model.effects]]\nname = "cogging"\ncogging_phase = 1.0\n', ["cogging_phase"]),
            ("[model.given]\nmass = 1.0\n", ["mass"]),
        ]
        for text, words in cases:
            outcome = self.run_here("replay", self.job(text))
            self.assert_refused(outcome, 78, words)
        # effects without values are no model to replay
        self.assert_refused(self.run_here("replay", self.job('[[model.effects]]\nname = "stribeck"\n')), 78,
                            ["has no stribeck"])
        # least squares of rows knows nothing of what is searched by rollouts
        mixed = self.job('[[model.effects]]\nname = "stribeck"\n', '[[estimator]]\nname = "ols"\n',
                         '[[estimator]]\nname = "lm"\n')
        self.assert_refused(self.run_here("run", mixed), 78, ["fits rows"])
        columns = {"time": "t_s", "reference": "r_rad", "position": "q_rad", "torque": "u_Nm", "enabled": "on"}
        self.assert_refused(self.run_here("replay", self.job(columns=columns)), 78,
                            ['no recording has the column "on"'])

    def test_arms_are_refused_with_the_way_out(self):
        robot = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "robots", "crs_a465.toml")
        arm = (f'[model]\nrobot = "{robot}"\nfriction = ["viscous"]\n'
               '[recording]\ntrain = "a.csv"\ncolumns = {time = "t_s", position = "q_rad", torque = "u_Nm"}\n')
        self.write("arm.toml", arm + '[loop]\ncontroller = "pd"\n[[estimator]]\nname = "lm"\n')
        self.assert_refused(self.run_here("run", "arm.toml"), 78,
                            ["[loop] in the job of an arm", "lm simulates the recordings", "rollouts are of one joint"])

    def test_other_files_under_the_name_of_the_result_stay(self):
        job = self.job('[loop]\ncontroller = "pd"\n', '[[estimator]]\nname = "lm"\n')
        self.assertEqual(self.run_here("run", job, "--out", "lab.h5").code, 0)
        outcome = self.run_here("replay", job, "--out", "lab.h5")
        self.assert_refused(outcome, 73, ["is no earlier replay"])
        self.assert_refused(self.run_here("replay", "nothing.toml"), 66, ["nothing.toml"])


if __name__ == "__main__":
    unittest.main()
