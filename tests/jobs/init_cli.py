"""A stranger with a CSV of one's own: init, check, diagnose, report in an empty folder; and files given to the wrong
command.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/init_cli.py
"""

import json
import os
import shutil
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
import recordings  # noqa: E402
import simulated_job  # noqa: E402

JOBS = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "jobs")


class EmptyFolder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_init_")
        self.addCleanup(shutil.rmtree, self.folder)

    def write(self, name, text):
        with open(os.path.join(self.folder, name), "w", encoding="utf-8") as file:
            file.write(text)
        return name

    def read(self, name):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            return file.read()

    def run_here(self, *arguments):
        return program.run(*arguments, folder=self.folder)

    def succeed(self, *arguments):
        done = self.run_here(*arguments)
        self.assertEqual(done.code, 0, f"{arguments}: {done.err}")
        return done

    def draft(self, *recording, job="job.toml"):
        """`torquescope init ... > job.toml`: the job, and what was said."""
        done = self.succeed("init", *recording)
        self.write(job, done.out)
        return done

    def good(self, name="good.csv", header=recordings.HEADER, separator=",", cell=lambda text: text):
        rows = [separator.join(map(cell, row)) for row in recordings.good_rows()]
        return self.write(name, "\n".join([header, *rows]) + "\n")


class OwnRecording(EmptyFolder):
    def test_a_good_csv_leaves_nothing_to_edit(self):
        """The way on from here, to a verdict and a page, is in structure/readme_commands.py."""
        self.good("good.csv")
        said = self.draft("good.csv", job="good.toml")
        self.assertNotIn("warning", said.err)
        self.assertIn("0 warnings", self.succeed("check", "good.toml").out)

    def test_files_as_spreadsheets_and_matlab_write_them(self):
        dialects = {
            "semicolons.csv": {"separator": ";"},
            "tabs.txt": {"separator": "\t"},
            "blanks.dat": {"separator": "  "},
            "commas.csv": {"separator": ";", "cell": lambda text: text.replace(".", ",")},
        }
        for name, how in dialects.items():
            self.good(name, recordings.HEADER.replace(",", how["separator"]), **how)
            said = self.draft(name)
            self.assertNotIn("warning", said.err, name)
            self.assertIn("0 warnings", self.succeed("check", "job.toml").out, name)

    def test_the_jobs_paths_are_relative_to_where_it_is_written(self):
        self.good("good.csv")
        os.mkdir(os.path.join(self.folder, "jobs"))
        self.succeed("init", "good.csv", "--out", "jobs/good.toml")
        self.assertIn('train = "../good.csv"', self.read("jobs/good.toml"))
        self.succeed("check", "jobs/good.toml")
        with open(os.path.join(self.folder, "jobs", "again.toml"), "wb") as file:
            program.subprocess.run([program.PROGRAM, "init", "good.csv"], cwd=self.folder, stdout=file, check=True,
                                   stderr=program.subprocess.DEVNULL, env=program.environment())
        self.assertIn('train = "../good.csv"', self.read("jobs/again.toml"))

    def test_out_never_overwrites(self):
        self.good("good.csv")
        self.write("mine.toml", "a day's work")
        refused = self.run_here("init", "good.csv", "--out", "mine.toml")
        self.assertEqual(refused.code, 73)
        self.assertIn("mine.toml exists", refused.err)
        self.assertEqual(self.read("mine.toml"), "a day's work")

    def test_quiet_says_nothing_but_the_job(self):
        self.good("good.csv")
        done = self.succeed("init", "good.csv", "--quiet")
        self.assertEqual(done.err, "")
        self.assertIn("[recording]", done.out)

    def test_what_a_person_must_say_is_a_warning_and_a_line_to_edit(self):
        self.good("drive.csv", "t_s,q_rad,i_A")
        said = self.draft("drive.csv")
        self.assertIn('torque "i_A" is a current in A: write recording.torque_per_unit, N m per A', said.said)
        self.assertIn("# torque_per_unit = <N m per A>", said.out)
        self.succeed("check", "job.toml")

    def test_a_job_that_does_not_run_yet_is_written_and_ends_with_its_code(self):
        self.write("odd.csv", "t_s,a,b\n" + "".join(f"{k},{k},{k}\n" for k in range(50)))
        said = self.run_here("init", "odd.csv", "--out", "odd.toml")
        self.assertEqual(said.code, 78)
        self.assertIn("this job does not run yet", said.said)
        self.assertIn("EDIT", self.read("odd.toml"))
        self.good("counts.csv", "t_s,pos_cnt,tau_Nm")
        said = self.run_here("init", "counts.csv", "--out", "counts.toml")
        self.assertEqual(said.code, 78 if self.run_here("check", "counts.toml").code else 0, said.err)

    def test_a_file_that_cannot_be_read_keeps_its_own_error(self):
        self.assertEqual(self.run_here("init", "nothing.csv").code, 66)
        self.write("empty.csv", "")
        self.assertEqual(self.run_here("init", "empty.csv").code, 65)


class RecordingsOfServos(EmptyFolder):
    """jobs/servo_records by their names alone, as somebody else's would be."""

    def setUp(self):
        super().setUp()
        self.records = os.path.join(self.folder, "records")
        shutil.copytree(os.path.join(JOBS, "servo_records"), self.records,
                        ignore=lambda folder, names: [name for name in names if not name.startswith("m")])
        self.files = [f"records/{name}" for name in sorted(os.listdir(self.records)) if name.startswith("m")]

    def test_the_draft_passes_check_and_is_diagnosed(self):
        self.assertEqual(len(self.files), 25)  # and the manifest
        said = self.draft(*self.files)
        self.assertIn("manifest.csv is left out", said.said)
        self.assertIn("enabled torque_enabled", said.said)
        for line in ('files = "records/m0.5_l{length_mm}_kp{kp}_{motion}.csv"', "mass_kg = 0.75", 'role = "validate"',
                     'gravity_moment = "9.80665 * mass_kg * 0.001 * length_mm"', 'drive = "position servo"'):
            self.assertIn(line, said.out)
        self.assertIn("16 to fit, 8 to judge", self.succeed("check", "job.toml").out)
        self.write("job.toml", said.out.replace("[diagnose]", "[diagnose]\nmax_effects = 1"))
        self.succeed("diagnose", "job.toml")

    def test_a_part_of_the_files_is_taken_alone(self):
        self.draft(*[name for name in self.files if "kp8_steps" in name or "kp8_two" in name])
        self.assertIn("4 to fit, 2 to judge", self.succeed("check", "job.toml").out)


class WrongKindOfFile(EmptyFolder):
    def test_a_recording_is_no_job(self):
        self.good("good.csv")
        for command in (["check"], ["diagnose"], ["run"], ["simulate", "--out", "x.csv"]):
            refused = self.run_here(command[0], "good.csv", *command[1:])
            self.assertEqual(refused.code, 78, command)
            self.assertIn("good.csv is a recording (CSV), not a job", refused.said)
            self.assertIn("torquescope init good.csv > good.toml", refused.said)

    def test_so_is_a_damaged_one(self):
        self.write("cut.csv", "t_s,q_rad,tau_Nm\n0,0,0\n0.1,1\n")
        refused = self.run_here("check", "cut.csv")
        self.assertEqual(refused.code, 78)
        self.assertIn("torquescope init cut.csv > cut.toml", refused.said)

    def test_a_result_is_no_job_and_no_recording(self):
        self.write("study.toml", simulated_job.job([{"name": "ols"}]))
        self.succeed("run", "study.toml", "--out", "study.h5")
        for command, code in (("check", 78), ("init", 65)):
            refused = self.run_here(command, "study.h5")
            self.assertEqual(refused.code, code)
            self.assertIn("study.h5 is a result", refused.said)
            self.assertIn("torquescope show study.h5", refused.said)

    def test_a_job_is_no_recording(self):
        self.write("study.toml", simulated_job.job([{"name": "ols"}]))
        refused = self.run_here("init", "study.toml")
        self.assertEqual(refused.code, 65)
        self.assertIn("torquescope check study.toml", refused.said)

    def test_a_job_with_a_mistake_keeps_its_place(self):
        self.write("bad.toml", "[experiment]\nname = lab\n")
        refused = self.run_here("check", "bad.toml")
        self.assertEqual(refused.code, 78)
        self.assertIn("bad.toml:2", refused.err)


class JobsForEveryone(EmptyFolder):
    """What their first comment promises."""

    def diagnosis(self, job):
        self.succeed("diagnose", os.path.join(JOBS, job), "--out", "r.h5", "--json", "r.json", "--quiet")
        return json.loads(self.read("r.json"))

    def test_the_concealed_joint_is_named(self):
        found = self.diagnosis("concealed_stribeck.toml")
        self.assertEqual(found["verdict"], "named")
        self.assertEqual([effect["name"] for effect in found["joints"][0]["effects"]], ["stribeck"])

    def test_nothing_is_named_in_the_clean_joint(self):
        found = self.diagnosis("clean_joint.toml")
        self.assertEqual(found["verdict"], "none")
        self.assertEqual(found["joints"][0]["effects"], [])


if __name__ == "__main__":
    unittest.main()
