"""The program as people and scripts meet it: tables, JSON, terminals, Ctrl-C, recordings that it simulates.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/run_cli.py
"""

import json
import os
import stat
import sys
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
from cli_folder import Folder, GOOD_JOB  # noqa: E402


class GoodRun(Folder):
    def setUp(self):
        super().setUp()
        self.write("good.toml", GOOD_JOB)

    def run_good(self, *arguments, **more):
        outcome = self.run_here("run", "good.toml", *arguments, **more)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def test_check_says_ok(self):
        outcome = self.run_here("check", "good.toml")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertRegex(outcome.out, r"^ok    job ")
        self.assertRegex(outcome.out, r"\n\d+ warnings?, nothing stops a run\n$")
        self.assertEqual(outcome.err, "")
        self.assert_page(outcome.out)

    def test_table_on_stdout_and_the_rest_on_stderr(self):
        outcome = self.run_good()
        self.assert_page(outcome.out)
        self.assert_page(outcome.err)
        self.assertTrue(outcome.out.startswith("good "))
        for row in [
            "inertia",
            "viscous",
            "coulomb_positive",
            "coulomb_negative",
            "MSE",
            "error, train",
            "error, validation",
            "gap to OLS, median of 3",
        ]:
            self.assertIn("\n  " + row, outcome.out)
        self.assertIn("OLS standard error", outcome.out)
        self.assertRegex(outcome.out, r"\n7 runs, [0-9 ]+ evaluations, [0-9.]+ s\n$")
        for line in [
            r"^job +good",
            r"\ndata ",
            r"\nthreads +2 \(OMP_NUM_THREADS\), \w+, seed 11",
            r"\nwrote  good.h5  [0-9.]+ [kM]B\n",
            r"\nlook   torquescope report good.h5\n$",
        ]:
            self.assertRegex(outcome.err, line)

    def test_show_begins_with_the_table_of_run(self):
        ran = self.run_good()
        shown = self.run_here("show", "good.h5")
        self.assertEqual(shown.code, 0)
        self.assertTrue(shown.out.startswith(ran.out))
        self.assertIn("FADE ended by 3 x generations", shown.out)
        self.assert_page(shown.out)

    def test_same_command_again_shows_the_same_table(self):
        first = self.run_good()
        before = os.stat(os.path.join(self.folder, "good.h5"))[stat.ST_MTIME]
        second = self.run_good()
        self.assertEqual(second.out, first.out)
        self.assertIn("already complete", second.err)
        self.assertEqual(os.stat(os.path.join(self.folder, "good.h5"))[stat.ST_MTIME], before)

    def test_another_job_does_not_overwrite(self):
        self.run_good()
        self.write("other.toml", GOOD_JOB + "# changed\n")
        self.assert_refused(
            self.run_here("run", "other.toml", "--out", "good.h5"),
            73,
            [
                "good.h5 exists and was made by another job, or from other recordings (sha256 differs)",
                "--out another name, or delete good.h5",
            ],
        )

    def test_what_is_no_result_is_not_overwritten(self):
        self.assert_refused(self.run_here("run", "good.toml", "--out", "good.csv"), 73, ["good.csv exists"])
        self.assert_refused(self.run_here("run", "good.toml", "--out", "folder.csv"), 73, ["is a folder"])

    def test_unwritable_output(self):
        outcome = self.run_here("run", "good.toml", "--out", "no_such_folder/r.h5", "--progress", "none")
        self.assertEqual(outcome.code, 74, outcome.err)
        self.assertRegex(outcome.err, r"\nerror: |^error: ")

    def test_quiet_prints_nothing(self):
        outcome = self.run_good("--quiet")
        self.assertEqual(outcome.out + outcome.err, "")

    def test_json_is_the_only_thing_on_stdout_and_equals_show(self):
        outcome = self.run_good("--json", "-")
        document = json.loads(outcome.out)
        self.assertEqual(document["schema"], 1)
        self.assertEqual([e["name"] for e in document["estimators"]], ["ols", "de", "fade"])
        inertia = document["estimators"][0]["parameters"][0]
        self.assertEqual(inertia["name"], "inertia")
        self.assertAlmostEqual(inertia["value"], 0.05, delta=0.005)
        self.assertNotEqual(inertia["value"], round(inertia["value"], 6), "numbers are unrounded")
        self.assertEqual(json.loads(self.run_here("show", "good.h5", "--json", "-").out), document)

    def test_json_file_keeps_the_table(self):
        outcome = self.run_good("--json", "good.json")
        self.assertTrue(outcome.out.startswith("good "))
        with open(os.path.join(self.folder, "good.json"), encoding="utf-8") as file:
            self.assertEqual(json.load(file)["schema"], 1)

    def test_no_estimator_beats_least_squares_on_its_own_data(self):
        document = json.loads(self.run_good("--json", "-").out)
        floor = document["estimators"][0]["mse"]["best"]
        for estimator in document["estimators"]:
            self.assertGreaterEqual(estimator["mse"]["best"], floor * (1 - 1e-12))

    def test_terminal_and_pipe_say_the_same(self):
        self.run_good()
        piped = self.run_here("show", "good.h5")
        code, on_terminal = program.run_on_terminal("show", "good.h5", folder=self.folder)
        self.assertEqual(code, 0)
        self.assertIn("\x1b[", on_terminal, "a terminal gets colour")
        self.assertEqual(program.plain(on_terminal), piped.out)

    def test_no_escape_byte_where_nobody_wants_one(self):
        for changes, options in [({"NO_COLOR": "1"}, []), ({"TERM": "dumb"}, []), ({}, ["--color", "never"])]:
            for file in os.listdir(self.folder):
                if file == "good.h5":
                    os.remove(os.path.join(self.folder, file))
            code, text = program.run_on_terminal("run", "good.toml", *options, folder=self.folder, changes=changes)
            self.assertEqual(code, 0)
            self.assertNotIn("\x1b", text)

    def test_colour_can_be_forced_into_a_pipe(self):
        self.run_good()
        self.assertIn("\x1b[", self.run_here("show", "good.h5", "--color", "always").out)
        self.assertIn("\x1b[", self.run_here("show", "good.h5", changes={"CLICOLOR_FORCE": "1"}).out)
        self.assertNotIn(
            "\x1b[", self.run_here("show", "good.h5", changes={"CLICOLOR_FORCE": "1", "NO_COLOR": "1"}).out
        )

    def test_bars_only_on_terminals_outside_batch_jobs(self):
        _, bar = program.run_on_terminal("run", "good.toml", "--out", "a.h5", folder=self.folder)
        self.assertIn("\rde ", bar)
        self.assertNotIn("progress stage=", bar)
        _, lines = program.run_on_terminal(
            "run", "good.toml", "--out", "b.h5", folder=self.folder, changes={"SLURM_JOB_ID": "1"}
        )
        self.assertNotIn("\rde ", lines)

    def test_ascii_locale_gets_ascii(self):
        _, text = program.run_on_terminal("run", "good.toml", folder=self.folder, changes={"LC_ALL": "C"})
        self.assertTrue(text.isascii())

    def test_damaged_result_is_refused(self):
        self.run_good()
        path = os.path.join(self.folder, "good.h5")
        with open(path, "rb") as file:
            content = file.read()
        with open(path, "wb") as file:
            file.write(content[: len(content) // 2])
        self.assert_refused(self.run_here("show", "good.h5"), 65, ["good.h5"])
        self.assert_refused(self.run_here("show", "good.csv"), 65, ["good.csv"])
        self.assert_refused(self.run_here("show", "nothing.h5"), 66, ["nothing.h5"])


class Interrupted(Folder):
    def start_long_run(self):
        self.write("long.toml", GOOD_JOB.replace("generations = 30", "generations = 10000000"))
        process = program.start("run", "long.toml", "--out", "long.h5", "--progress", "lines", folder=self.folder)
        self.addCleanup(process.stdout.close)
        self.addCleanup(process.stderr.close)
        self.addCleanup(process.wait)
        self.addCleanup(process.kill)
        self.assertTrue(program.wait_for_line(process, "progress stage=de"), "the long stage begins")
        return process

    def test_first_interrupt_stops_after_the_generation(self):
        process = self.start_long_run()
        program.interrupt(process)
        self.assertTrue(program.wait_for_line(process, "stopping after the running generation"))
        self.assertEqual(process.wait(timeout=program.SECONDS), 75)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "long.h5")), "nothing half is published")

    def test_termination_stops_alike(self):
        process = self.start_long_run()
        process.terminate()
        self.assertEqual(process.wait(timeout=program.SECONDS), 75)


class Simulated(Folder):
    JOB = GOOD_JOB[: GOOD_JOB.index("[recording]")] + GOOD_JOB[GOOD_JOB.index("[filter]"):] + """
[simulate]
duration_s = 5
rate_hz = 200

[simulate.plant]
inertia = 0.05
viscous = 0.1
coulomb_positive = 0.3
coulomb_negative = -0.2
"""

    def test_simulated_recording_can_be_identified(self):
        self.write("plant.toml", self.JOB)
        made = self.run_here("simulate", "plant.toml", "--out", "rec.csv")
        self.assertEqual(made.code, 0, made.err)
        self.assertRegex(made.err, r"^wrote  rec.csv  1 00[01] samples, 5 s at 200 Hz, [0-9.]+ kB\n$")
        again = self.run_here("simulate", "plant.toml", "--out", "rec.csv")
        self.assert_refused(again, 73, ["rec.csv exists"])
        self.write("lab.toml", GOOD_JOB.replace("good.csv", "rec.csv"))
        with open(os.path.join(self.folder, "rec.csv"), encoding="utf-8") as file:
            header = next(line for line in file if not line.startswith("#"))
        self.assertIn("t_s,", header)
        outcome = self.run_here("run", "lab.toml", "--json", "-", "--quiet")
        self.assertEqual(outcome.code, 0, outcome.err)
        value = json.loads(outcome.out)["estimators"][0]["parameters"][0]["value"]
        self.assertAlmostEqual(value, 0.05, delta=0.01)

    def test_without_simulate_there_is_nothing_to_do(self):
        self.write("good.toml", GOOD_JOB)
        self.assert_refused(self.run_here("simulate", "good.toml", "--out", "rec.csv"), 78, ["no [simulate] section"])


if __name__ == "__main__":
    unittest.main(verbosity=1)
