"""The program as people and scripts meet it: bad input, exit codes, tables, JSON, terminals, Ctrl-C.

Every bad/*.toml begins with what must happen:   # expect: 78 | words of the message | more words
Use: TORQUESCOPE=build/dev/bin/torquescope /usr/bin/python3 tests/jobs/run_cli.py
"""

import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
import recordings  # noqa: E402

BAD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bad")

GOOD_JOB = """
[experiment]
name = "good"
seed = 11
runs = 3

[recording]
train = "good.csv"
validate = "good.csv"
columns = {time = "t_s", position = "q_rad", torque = "tau_Nm"}

[filter]
cutoff_hz = 20

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]

[[estimator]]
name = "ols"

[[estimator]]
name = "de"
population = 20
generations = 30

[[estimator]]
name = "fade"
population = 20
generations = 30
"""


def expectation(path):
    with open(path, encoding="utf-8") as file:
        first = file.readline()
    if not first.startswith("# expect: "):
        raise ValueError(f"{path} does not say what to expect")
    code, *words = first[len("# expect: "):].strip().split(" | ")
    return int(code), words


class Folder(unittest.TestCase):
    """A folder of its own with all recordings in it."""

    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_cli_")
        self.addCleanup(shutil.rmtree, self.folder)
        recordings.write_recordings(self.folder)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
        return name

    def run_here(self, *arguments, **more):
        return program.run(*arguments, folder=self.folder, **more)

    def assert_page(self, text):
        """The laws of everything printed into a pipe."""
        self.assertNotIn("\x1b", text)
        for line in text.splitlines():
            self.assertLessEqual(len(line), 80, line)

    def assert_refused(self, outcome, code, words):
        self.assertEqual(outcome.code, code, outcome.err)
        self.assertEqual(outcome.out, "")
        for word in words:
            self.assertIn(" ".join(word.split()), outcome.said)
        self.assertRegex(outcome.err, rf"^error: .*\[{code}\]\n")
        self.assert_page(outcome.err)
        self.assertRegex(outcome.err, r"help: |did you mean", "it says what to do")


class BadJobs(Folder):
    """Made below, one test for every file in bad/."""


def add_bad_job(name):
    def test(self):
        path = os.path.join(BAD, name)
        code, words = expectation(path)
        shutil.copy(path, self.folder)
        self.assert_refused(self.run_here("check", name), code, words)
        # a run refuses the same, before it writes anything
        self.assertEqual(self.run_here("run", name).code, code)
        self.assertFalse([file for file in os.listdir(self.folder) if file.startswith("bad.h5")])

    setattr(BadJobs, "test_" + os.path.splitext(name)[0], test)


for bad_name in sorted(os.listdir(BAD)):
    add_bad_job(bad_name)


class Limits(Folder):
    """What would end in numbers that are none, in a crash, or in an error after hours."""

    def setUp(self):
        super().setUp()
        self.write("job.toml", GOOD_JOB)

    def test_a_sample_that_no_machine_has_is_refused_with_its_row(self):
        with open(os.path.join(self.folder, "good.csv"), encoding="utf-8") as file:
            lines = file.read().splitlines()
        for column, value, words in ((2, "1e308", '"tau_Nm" is 1e+308 in line 301'),
                                     (1, "-1e160", '"q_rad" is -1e+160 in line 301'),
                                     (0, "1e70", '"t_s" is 1e+70 in line 301')):
            cells = lines[300].split(",")
            cells[column] = value
            self.write("huge.csv", "\n".join([*lines[:300], ",".join(cells), *lines[301:]]) + "\n")
            self.write("job.toml", GOOD_JOB.replace('train = "good.csv"', 'train = "huge.csv"'))
            for command in ("check", "run"):
                self.assert_refused(self.run_here(command, "job.toml"), 65, [words])

    def test_a_small_stack_is_told_of(self):
        limited = subprocess.run(["bash", "-c", 'ulimit -s 64 && exec "$0" run job.toml --out r.h5', program.PROGRAM],
                                 cwd=self.folder, stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False)
        self.assertEqual(limited.returncode, 70, limited.stderr)
        self.assertIn("the stack is limited to 64 KiB here; 1024 are needed", limited.stderr)
        self.assertIn("help: ulimit -s 8192", limited.stderr)

    def test_a_name_too_long_for_the_files_beside_it_is_refused_before_anything_runs(self):
        name = 236 * "x" + ".h5"
        outcome = self.run_here("run", "job.toml", "--out", name, "--quiet")
        self.assert_refused(outcome, 64, ["the name of the result has 239 bytes; 229 are the most here"])
        self.assertFalse([file for file in os.listdir(self.folder) if file.startswith("xxx")])
        name = 226 * "x" + ".h5"
        self.assertEqual(self.run_here("run", "job.toml", "--out", name, "--quiet").code, 0)
        self.assertTrue(os.path.exists(os.path.join(self.folder, name + ".made.json")))

    def test_report_refuses_what_show_refuses(self):
        def linked(name):
            with h5py.File(name, "r+", locking=False) as file:
                del file["runs/ols/parameters"]
                file["runs/ols/parameters"] = h5py.ExternalLink("other.h5", "/runs/ols/parameters")

        def flipped(name):
            with open(name, "r+b") as file:
                file.seek(os.path.getsize(name) // 2)
                byte = file.read(1)[0]
                file.seek(-1, os.SEEK_CUR)
                file.write(bytes([byte ^ 1]))

        self.assertEqual(self.run_here("run", "job.toml", "--out", "other.h5", "--quiet").code, 0)
        for change, words in ((linked, '"parameters" is a link to elsewhere'), (flipped, "r.h5 is damaged")):
            shutil.copy(os.path.join(self.folder, "other.h5"), os.path.join(self.folder, "r.h5"))
            change(os.path.join(self.folder, "r.h5"))
            for command in (("report", "r.h5"), ("show", "r.h5", "--verify"), ("compare", "other.h5", "r.h5")):
                self.assert_refused(self.run_here(*command), 65, [words])
            for page in ("r.html", "compare.html"):
                self.assertFalse(os.path.exists(os.path.join(self.folder, page)))
        self.assert_refused(self.run_here("compare", "other.h5"), 64, ["compare needs two results or more"])

    def test_groups_in_groups_without_end_are_refused_soon(self):
        self.assertEqual(self.run_here("run", "job.toml", "--out", "r.h5", "--quiet").code, 0)
        with h5py.File(os.path.join(self.folder, "r.h5"), "r+", locking=False) as file:
            group = file
            for _ in range(3000):
                group = group.create_group("g")
        began = time.monotonic()
        for command in (("show", "r.h5", "--verify"), ("report", "r.h5")):
            self.assert_refused(self.run_here(*command), 65, ["it lies deeper than anything in a result"])
        self.assertLess(time.monotonic() - began, 5.0)

    def test_nothing_of_a_job_gets_out_of_its_word_in_a_script_of_submit(self):
        for name in ("two\nlines.toml", "job\nresult=x.toml"):
            shutil.copy(os.path.join(self.folder, "job.toml"), os.path.join(self.folder, name))
            self.assert_refused(self.run_here("submit", name, "--shards", "2", "--dry-run"), 64,
                                ["which no batch script can carry"])
        self.assert_refused(self.run_here("submit", "job.toml", "--shards", "2", "--dry-run", "--out", "a\n#b.h5"), 64,
                            ["which no batch script can carry"])
        self.assert_refused(self.run_here("submit", "job.toml", "--shards", "2", "--dry-run", "--out", "a\\b.h5"), 64,
                            ["has a backslash"])
        for option in ("--array=0-1", "-d", "word"):
            self.assertEqual(self.run_here("submit", "job.toml", "--shards", "2", "--dry-run", "--", option).code, 64)
        told = self.run_here("submit", "job.toml", "--shards", "2", "--dry-run", "--out", "ä b/100% 'r'.h5", "--",
                             "--account=a b", "--qos=long")
        self.assertEqual(told.code, 0, told.err)
        self.assertIn("\n#SBATCH --output=\"ä b/100%% 'r'.h5.shard-%a.log\"\n", told.out)
        self.assertIn("# sbatch --parsable '--account=a b' --qos=long ", told.out)


class BadJobFiles(Folder):
    """Jobs that cannot stand in a text file of their own."""

    def test_missing_job_names_its_neighbour(self):
        self.write("lab_joint.toml", GOOD_JOB)
        self.assert_refused(
            self.run_here("check", "lab_jiont.toml"), 66, ["no such file", "did you mean lab_joint.toml?"]
        )

    def test_fifo_does_not_hang(self):
        os.mkfifo(os.path.join(self.folder, "job.toml"))
        self.assert_refused(self.run_here("check", "job.toml"), 66, ["not a regular file"])

    def test_folder_is_no_job(self):
        self.assert_refused(self.run_here("check", "."), 66, ["not a regular file"])

    def test_huge_job(self):
        self.write("job.toml", "# " + "x" * (1 << 20))
        self.assert_refused(self.run_here("check", "job.toml"), 78, ["larger than 1 MiB"])

    def test_bytes_that_are_no_text(self):
        with open(os.path.join(self.folder, "job.toml"), "wb") as file:
            file.write(b'[experiment]\nname = "\xff\xfe"\n')
        self.assert_refused(self.run_here("check", "job.toml"), 78, ["utf-8"])

    def test_control_characters_do_not_reach_the_terminal(self):
        self.write("job.toml", '[experiment]\nname = "\x1b[31m"\n')
        self.assert_refused(self.run_here("check", "job.toml"), 78, ["control character"])

    def test_a_recording_in_place_of_the_job(self):
        words = ["good.csv is a recording (CSV), not a job", "torquescope init good.csv"]
        self.assert_refused(self.run_here("check", "good.csv"), 78, words)

    def test_twenty_problems_are_shown_and_all_are_counted(self):
        self.write("job.toml", "[experiment]\n" + "".join(f"key_{i} = {i}\n" for i in range(25)))
        outcome = self.run_here("check", "job.toml")
        self.assertEqual(outcome.code, 78)
        self.assertEqual(outcome.err.count("error: "), 20)
        self.assertRegex(outcome.err, r"\n2[0-9] problems, the first 20 are shown\n$")
        self.assert_page(outcome.err)

    def test_unreadable_job(self):
        self.write("job.toml", GOOD_JOB)
        os.chmod(os.path.join(self.folder, "job.toml"), 0)
        if os.access(os.path.join(self.folder, "job.toml"), os.R_OK):
            self.skipTest("the superuser may read everything")
        self.assert_refused(self.run_here("check", "job.toml"), 66, ["cannot read"])


class CommandLine(Folder):
    def test_usage_errors(self):
        for arguments, words in [
            (["chekc"], 'unknown command "chekc"; did you mean "check"?'),
            ([], "no command"),
            (["run"], "JOB.toml is required"),
            (["run", "a.toml", "b.toml"], "one argument too many"),
            (["run", "a.toml", "--thread", "2"], 'did you mean "--threads"?'),
            (["run", "a.toml", "--threads", "none"], "no whole number"),
            (["run", "a.toml", "--color", "red"], "is none of"),
            (["simulate", "a.toml"], "--out is required"),
            (["list", "efects"], 'did you mean "effects"?'),
            (["describe", "fadee"], 'did you mean "fade"?'),
        ]:
            with self.subTest(arguments=arguments):
                self.assert_refused(self.run_here(*arguments), 64, [words])

    def test_errors_as_data(self):
        self.write("job.toml", "[experiment]\nsed = 1\n")
        outcome = self.run_here("check", "job.toml", "--json", "-")
        document = json.loads(outcome.out)
        self.assertEqual(outcome.code, 78)
        self.assertEqual(document["schema"], 1)
        self.assertEqual(document["error"]["code"], 78)
        self.assertEqual(document["error"]["file"], "job.toml")
        self.assertEqual(document["error"]["line"], 2)
        self.assertEqual(document["error"]["key"], "experiment.sed")

    def test_pages_fit_and_name_every_command(self):
        page = self.run_here("--help")
        self.assertEqual(page.code, 0)
        self.assert_page(page.out)
        for command in ("check", "run", "diagnose", "show", "report", "compare", "simulate", "excite", "list",
                        "describe"):
            self.assertIn(f"torquescope {command}", page.out)
            self.assert_page(self.run_here(command, "--help").out)

    def test_everything_listed_is_described_in_80_columns(self):
        listed = self.run_here("list")
        self.assertEqual(listed.code, 0)
        self.assert_page(listed.out)
        names = [
            line.split()[0] for line in listed.out.splitlines() if line.startswith("  ") and not line.startswith("   ")
        ]
        self.assertGreater(len(names), 20)
        for name in names:
            described = self.run_here("describe", name)
            self.assertEqual(described.code, 0, name)
            self.assertTrue(described.out.startswith(name))
            self.assert_page(described.out)

    def test_robots_are_described_in_80_columns(self):
        robots = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs", "robots")
        names = sorted(name for name in os.listdir(robots) if name.endswith(".toml"))
        self.assertIn("crs_a465.toml", names)
        for name in names:
            described = self.run_here("describe", os.path.join(robots, name))
            self.assertEqual(described.code, 0, described.err)
            self.assert_page(described.out)
        crs = self.run_here("describe", os.path.join(robots, "crs_a465.toml")).out
        self.assertIn("base parameters: 29 of the 50 numbers of the links; 32 with drive inertias", crs)
        self.assertIn("xxr2     kg m^2  = xx2 - yy2 - 0.0929 (m3 + m4 + m5)", crs)

    def test_export_wants_a_format_and_a_result(self):
        self.write("arm.txt", "no result\n")
        self.assert_refused(self.run_here("export", "arm.txt"), 64, ["export needs a format"])
        self.assert_refused(self.run_here("export", "arm.txt", "--urdf", "arm.urdf"), 65, ["arm.txt"])

    def test_a_wrong_robot_is_refused_at_its_place(self):
        self.write("arm.toml", "[robot]\n[[joint]]\nalpha_rad = 90\n")
        self.assert_refused(self.run_here("describe", "arm.toml"), 78, ["arm.toml:3", "is it in degrees?", "1.5707963"])
        self.write("job.toml", GOOD_JOB)
        self.assert_refused(self.run_here("describe", "job.toml"), 65, ["describes no robot"])

    def test_full_disk_behind_stdout_is_an_error(self):
        if not os.path.exists("/dev/full"):
            self.skipTest("no /dev/full")
        with open("/dev/full", "w", encoding="utf-8") as full:
            done = subprocess.run([program.PROGRAM, "list"], stdout=full, stderr=subprocess.PIPE,
                                  env=program.environment(), check=False)
        self.assertEqual(done.returncode, 74)


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
