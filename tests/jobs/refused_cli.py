"""What the program refuses: bad jobs, files that are none, wrong command lines; with exit code, place and way out.

Every bad/*.toml begins with what must happen:   # expect: 78 | words of the message | more words
Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/refused_cli.py
"""

import json
import os
import shutil
import subprocess
import sys
import time
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
from cli_folder import Folder, GOOD_JOB  # noqa: E402

BAD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "bad")


def expectation(path):
    with open(path, encoding="utf-8") as file:
        first = file.readline()
    if not first.startswith("# expect: "):
        raise ValueError(f"{path} does not say what to expect")
    code, *words = first[len("# expect: "):].strip().split(" | ")
    return int(code), words


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


if __name__ == "__main__":
    unittest.main(verbosity=1)
