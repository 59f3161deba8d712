"""Every command of an installed program, away from the tree it was built in.

The build is installed, the prefix is moved elsewhere and used in an empty folder: whatever the program needs at run
time has to have come with it. Use: every_command.py BUILD_FOLDER SOURCE_FOLDER CMAKE
"""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest

BUILD, SOURCE, CMAKE = sys.argv[1:4]
# far beyond what any of these commands needs; presets with a sanitizer say how many times as long
SECONDS = 120 * int(os.environ.get("TORQUESCOPE_TIMES_AS_LONG", "1"))

STUDY = """
[experiment]
name = "study"
seed = 3
runs = 2
[filter]
cutoff_hz = 20
[model]
terms = ["inertia", "viscous", "coulomb", "offset"]
[model.bounds]
every = [-2, 2]
[[estimator]]
name = "ols"
[[estimator]]
name = "de"
population = 10
generations = 5
[simulate]
rate_hz = 500
duration_s = 6
[simulate.plant]
inertia = 0.09
viscous = 0.35
coulomb = 0.6
offset = 0.04
[simulate.controller]
kind = "pd"
rate_hz = 500
[simulate.noise]
torque_std = 0.02
[diagnose]
effects = ["stribeck"]
twins = 60
"""


class EveryCommand(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.root = tempfile.mkdtemp(prefix="torquescope_installed_")
        cls.addClassCleanup(shutil.rmtree, cls.root)
        first = os.path.join(cls.root, "first")
        subprocess.run([CMAKE, "--install", BUILD, "--prefix", first], check=True, stdout=subprocess.DEVNULL)
        cls.prefix = os.path.join(cls.root, "moved")
        os.rename(first, cls.prefix)
        cls.folder = os.path.join(cls.root, "empty")
        os.mkdir(cls.folder)
        with open(os.path.join(cls.folder, "study.toml"), "w", encoding="utf-8") as file:
            file.write(STUDY)

    def run_command(self, *words):
        environment = {key: value for key, value in os.environ.items() if not key.startswith(("TORQUESCOPE", "PYTHON"))}
        done = subprocess.run([os.path.join(self.prefix, "bin", "torquescope"), *words], cwd=self.folder,
                              env=environment, stdin=subprocess.DEVNULL, capture_output=True, timeout=SECONDS,
                              check=False, text=True)
        self.assertEqual(done.returncode, 0, f"{words}: {done.stderr}")
        return done.stdout

    def size(self, name):
        return os.path.getsize(os.path.join(self.folder, name))

    def assert_page(self, name, words):
        with open(os.path.join(self.folder, name), encoding="utf-8") as file:
            page = file.read()
        self.assertIn("</html>", page)
        self.assertIn("<svg", page)
        self.assertIn(words, page)

    def test_nothing_points_into_the_tree(self):
        """The program knows no path of the scripts it was built beside, and the prefix lies outside of it."""
        with open(os.path.join(self.prefix, "bin", "torquescope"), "rb") as file:
            self.assertNotIn(os.path.join(SOURCE, "scripts").encode(), file.read())
        self.assertFalse(os.path.realpath(self.root).startswith(os.path.realpath(SOURCE) + os.sep))

    def test_an_own_recording_to_its_page(self):
        self.run_command("simulate", "study.toml", "--out", "rec.csv")
        self.run_command("init", "rec.csv", "--out", "rec.toml")
        self.assertIn("0 warnings", self.run_command("check", "rec.toml"))
        self.run_command("run", "rec.toml", "--out", "rec.h5")
        self.assertIn("inertia", self.run_command("show", "rec.h5"))
        self.assertIn("rec.html", self.run_command("report", "rec.h5"))
        self.assert_page("rec.html", "inertia")

    def test_a_diagnosis_to_its_page(self):
        self.assertIn("NOTHING MISSING", self.run_command("diagnose", "study.toml", "--out", "diagnosis.h5"))
        self.run_command("report", "diagnosis.h5")
        self.assert_page("diagnosis.html", "Nothing missing")
        self.run_command("run", "study.toml", "--out", "identified.h5")
        self.assertIn("both.html", self.run_command("compare", "diagnosis.h5", "identified.h5", "--out", "both.html"))
        self.assert_page("both.html", "Do the estimates agree?")

    def test_shards_of_a_study(self):
        for shard in ("0/2", "1/2"):
            self.run_command("run", "study.toml", "--shard", shard, "--out", "shards.h5")
        self.assertIn("de", self.run_command("status", "shards.h5"))
        self.run_command("merge", "study.toml", "--out", "shards.h5")
        self.assertGreater(self.size("shards.h5"), 0)
        self.assertIn("#SBATCH", self.run_command("submit", "study.toml", "--shards", "2", "--dry-run"))

    def test_an_arm_from_its_motion_to_a_robot_file(self):
        jobs = os.path.join(self.prefix, "share", "torquescope", "jobs")
        with open(os.path.join(jobs, "crs_a465_five_joints.toml"), encoding="utf-8") as file:
            text = file.read().replace("evaluations = 20000", "evaluations = 300")
        for folder in ("robots/", "motions/"):
            text = text.replace(f'= "{folder}', f'= "{jobs}/{folder}')
        with open(os.path.join(self.folder, "arm_job.toml"), "w", encoding="utf-8") as file:
            file.write(text)
        self.run_command("excite", "arm_job.toml", "--out", "motion.csv")
        self.run_command("run", "arm_job.toml", "--out", "arm.h5")
        self.run_command("export", "arm.h5", "--urdf", "arm.urdf", "--toml", "arm.toml")
        self.assertIn("base parameters", self.run_command("describe", "arm.urdf"))
        self.run_command("report", "arm.h5")
        self.assert_page("arm.html", "five joints")

    def test_completions_and_man_pages_are_this_program_s(self):
        share = os.path.join(self.prefix, "share")
        for shell, place in (("bash", "bash-completion/completions/torquescope"),
                             ("zsh", "zsh/site-functions/_torquescope"),
                             ("fish", "fish/vendor_completions.d/torquescope.fish")):
            with open(os.path.join(share, place), encoding="utf-8") as file:
                self.assertEqual(file.read(), self.run_command("completion", shell))
        pages = os.path.join(share, "man", "man1")
        self.assertGreater(len(os.listdir(pages)), 14)
        for name in os.listdir(pages):
            command = name.removeprefix("torquescope").removeprefix("-").removesuffix(".1")
            with open(os.path.join(pages, name), encoding="utf-8") as file:
                self.assertEqual(file.read(), self.run_command("man", *command.split()), name)

    def test_catalogue_and_jobs(self):
        self.assertIn("stribeck", self.run_command("list", "effects"))
        self.assertIn("Stribeck friction", self.run_command("describe", "stribeck"))
        jobs = os.path.join(self.prefix, "share", "torquescope", "jobs")
        for job in sorted(name for name in os.listdir(jobs) if name.endswith(".toml")):
            self.assertIn("nothing stops a run", self.run_command("check", os.path.join(jobs, job)), job)
        robots = os.path.join(jobs, "robots")
        for robot in sorted(os.listdir(robots)):
            self.assertIn("base parameters", self.run_command("describe", os.path.join(robots, robot)), robot)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
