"""Recordings and jobs that were made to do harm, and recordings that were damaged: each is refused in a sentence.

A recording: exit code 65 (66: not there, or not a file; 78: the job asks for what is not in it), never a signal, never
more than seconds or a few hundred MiB. The files are made here; h5py and scipy come from Debian's Python.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/hostile/recordings_and_jobs.py
"""

import gzip
import os
import random
import resource
import shutil
import subprocess
import sys
import tempfile
import time
import unittest

import h5py
import numpy as np
import scipy.io

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "jobs"))

import program  # noqa: E402
import recordings  # noqa: E402

SEED = 20140607
JOB = """
[experiment]
name = "hostile"
runs = %s

[recording]
train = "%s"
columns = {time = "t_s", position = "q_rad", torque = "tau_Nm"}

[filter]
cutoff_hz = 20

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]

[[estimator]]
name = "%s"
"""
ROWS = recordings.good_rows(seconds=5.0)
TEXT = recordings.text_of(ROWS).encode()
DATA = np.array([[float(cell) for cell in row] for row in ROWS])
N = len(DATA)
MOST_BYTES = 2 << 30  # of address space beyond what a program with its libraries has


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_hostile_")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return name

    def check(self, name, runs="2", estimator="ols", more=""):
        self.write("job.toml", (JOB % (runs, name, estimator) + more).encode())
        return program.run("check", "job.toml", folder=self.folder)

    def check_bounded(self, name):
        """The same with little memory; returns also the seconds."""
        self.write("job.toml", (JOB % ("2", name, "ols")).encode())
        begin = time.monotonic()
        done = subprocess.run([program.PROGRAM, "check", "job.toml"], cwd=self.folder, env=program.environment(),
                              stdin=subprocess.DEVNULL, capture_output=True, timeout=program.SECONDS, check=False,
                              preexec_fn=None if os.environ.get("TORQUESCOPE_SANITIZED") else
                              lambda: resource.setrlimit(resource.RLIMIT_DATA, (MOST_BYTES, MOST_BYTES)))
        return program.Outcome(done.returncode, "", done.stderr.decode()), time.monotonic() - begin

    def assert_refused(self, outcome, code, words, what=""):
        self.assertEqual(outcome.code, code, f"{what}: {outcome.err}")
        self.assertIn(words, outcome.said, what)
        self.assertNotIn("HDF5-DIAG", outcome.err)


class Hdf5Recordings(Folder):
    def recording(self, make):
        with h5py.File(self.path("rec.h5"), "w") as file:
            file["t_s"], file["q_rad"] = DATA[:, 0], DATA[:, 1]
            make(file)
        return "rec.h5"

    def test_a_good_one_in_the_working_folder_is_read(self):
        # HDF5 refuses an image in memory when a file of its name lies in the working folder
        def good(file):
            file["tau_Nm"] = DATA[:, 2]

        outcome = self.check(self.recording(good))
        self.assertEqual(outcome.code, 0, outcome.err)

    def test_numbers_from_elsewhere(self):
        with h5py.File(self.path("other.h5"), "w") as file:
            file["tau_Nm"] = DATA[:, 2]
        os.mkfifo(self.path("pipe.h5"))

        def virtual(file):
            layout = h5py.VirtualLayout(shape=(N,), dtype="f8")
            layout[:] = h5py.VirtualSource(self.path("other.h5"), "tau_Nm", shape=(N,))
            file.create_virtual_dataset("tau_Nm", layout)

        for make, words in [
            (
                lambda f: f.__setitem__("tau_Nm", h5py.ExternalLink("other.h5", "/tau_Nm")),
                "is a link into another file",
            ),
            (lambda f: f.__setitem__("tau_Nm", h5py.ExternalLink("pipe.h5", "/tau_Nm")), "is a link into another file"),
            (lambda f: f.__setitem__("tau_Nm", h5py.SoftLink("/q_rad")), "is a soft link"),
            (
                lambda f: f.create_dataset("tau_Nm", shape=(8,), dtype="f8", external=[("/etc/passwd", 0, 64)]),
                "keeps its numbers in another file",
            ),
            (virtual, "is a virtual dataset over other files"),
        ]:
            with self.subTest(words=words):
                self.assert_refused(self.check(self.recording(make)), 65, words)

    def test_shapes_types_and_filters(self):
        for make, words in [
            (lambda f: f.__setitem__("tau_Nm", 1.0), "has rank 0"),
            (lambda f: f.__setitem__("tau_Nm", DATA[:, 2].reshape(-1, 10, 1)), "has rank 3"),
            (lambda f: f.create_dataset("tau_Nm", data=[b"abc"] * N), "is text"),
            (lambda f: f.create_dataset("tau_Nm", data=np.zeros(N, dtype="V8")), "not made of plain real numbers"),
            (
                lambda f: f.create_dataset("tau_Nm", shape=(N,), dtype=h5py.vlen_dtype("f8")),
                "not made of plain real numbers",
            ),
            (
                lambda f: f.create_dataset("tau_Nm", data=DATA[:, 2], compression="lzf"),
                "is packed by lzf (filter 32000), which is not part of HDF5",
            ),
        ]:
            with self.subTest(words=words):
                self.assert_refused(self.check(self.recording(make)), 65, words)

    def test_very_many_groups_are_listed_once(self):
        # asking for the k-th link of a group walks over all before it: 30 000 took 13 s of the processor
        def empty_groups(file):
            for i in range(30_000):
                file.create_group(f"a{i:05}")

        with h5py.File(self.path("empty.h5"), "w") as file:
            empty_groups(file)
        refused = self.check("empty.h5")
        self.assert_refused(refused, 65, "holds no columns of numbers")
        self.assertIn("30001 groups and 0 datasets were looked at", " ".join(refused.err.split()))

        def behind_them(file):
            empty_groups(file)
            file["tau_Nm"] = DATA[:, 2]

        outcome = self.check(self.recording(behind_them))
        self.assertEqual(outcome.code, 0, outcome.err)

    def test_sizes_beyond_the_file_cost_nothing(self):
        for shape in [(1 << 62,), (1 << 40,), (1 << 27,), (1 << 40, 1 << 20)]:
            def huge(file, shape=shape):
                file.create_dataset("tau_Nm", shape=shape, dtype="f8", chunks=(1024,) + (1,) * (len(shape) - 1))

            with self.subTest(shape=shape):
                outcome, seconds = self.check_bounded(self.recording(huge))
                self.assert_refused(outcome, 65, "far more than its bytes can hold")
                self.assertLess(seconds, 10)

    def test_groups_without_end(self):
        def loops(file):
            file["tau_Nm"] = DATA[:, 2]
            group = file
            for _ in range(30):
                child = group.create_group("a")
                group["b"], child["up"] = child, file["/"]
                group = child

        outcome, seconds = self.check_bounded(self.recording(loops))
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertLess(seconds, 10)


class DamagedRecordings(Folder):
    """Formats without checksums: damage may go unseen, but never ends or blocks the program."""

    def test_no_damage_crashes_the_program(self):
        with h5py.File(self.path("rec.h5"), "w") as file:
            table = file.create_dataset("table", data=DATA[:200], chunks=(50, 3), compression="gzip", shuffle=True)
            table.attrs["columns"] = ["t_s", "q_rad", "tau_Nm"]  # of variable length: in a heap
            file.create_group("g")["x"] = DATA[:, 0]
        cell = np.array([1, "x"], dtype=object)
        scipy.io.savemat(
            self.path("rec.mat"), {"t_s": DATA[:, 0], "q_rad": DATA[:, 1], "tau_Nm": DATA[:, 2], "s": {"a": cell}}
        )
        draw = random.Random(SEED)
        marks = [b"GCOL", b"TREE", b"HEAP", b"SNOD", b"\x89HDF", b"q_rad", b"tau_Nm", b"MATLAB"]
        for name, count in [("rec.h5", 80), ("rec.mat", 60)]:
            with open(self.path(name), "rb") as file:
                whole = file.read()
            places = [place for place in map(whole.find, marks) if place >= 0]
            codes = {}
            broke_off = 0
            for _ in range(count):
                damaged = bytearray(whole)
                for _ in range(draw.choice([1, 2, 4])):
                    place = min(len(damaged) - 1, max(0, draw.choice(places) - 60) + draw.randrange(300))
                    damaged[place] = draw.choice([damaged[place] ^ 1 << draw.randrange(8), 255, 0])
                outcome = self.check(self.write("damaged" + name[3:], damaged))
                self.assertIn(outcome.code, [0, 65, 78], outcome.err)
                codes[outcome.code] = codes.get(outcome.code, 0) + 1
                broke_off += "while reading it" in outcome.said
            print(
                f"{name}: {count} damaged, exit codes {codes}; the library crashed or looped in {broke_off}, we did not"
            )


class DamagedTexts(Folder):
    """Flipped bits in a job, a recording of text and a robot: a sentence or numbers, never a signal."""

    COUNT = 400 if os.environ.get("TORQUESCOPE_FAULTS") else 20
    ROBOT = """<robot name="two"><link name="base"/>
      <link name="upper"><inertial><origin xyz="0 0 0.1"/><mass value="2"/>
        <inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial></link>
      <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 0 1"/>
        <limit lower="-1" upper="1" effort="10" velocity="3"/></joint></robot>"""
    ARM = """
[experiment]
name = "arm"
[recording]
train = "arm.csv"
columns = {time = "t_s", position = "q_{j}", torque = "tau_{j}"}
[filter]
cutoff_hz = 20
[model]
robot = "robot.urdf"
[[estimator]]
name = "ols"
"""

    def test_no_flipped_bit_crashes_the_program(self):
        draw = random.Random(SEED)
        job = (JOB % ("2", "rec.csv", "ols")).encode()
        parts = {"job.toml": ("job.toml", job), "rec.csv": ("job.toml", TEXT), "robot.urdf": ("arm.toml",
                                                                                             self.ROBOT.encode())}
        self.write("arm.toml", self.ARM.encode())
        self.write("arm.csv", TEXT.replace(b"q_rad", b"q_1").replace(b"tau_Nm", b"tau_1"))
        codes = {}
        for damaged_name, (command, whole) in parts.items():
            for name, (_, content) in parts.items():
                self.write(name, content)
            self.assertEqual(program.run("check", command, folder=self.folder).code, 0, damaged_name)
            for _ in range(self.COUNT):
                damaged = bytearray(whole)
                for _ in range(draw.choice([1, 1, 3])):
                    damaged[draw.randrange(len(damaged))] ^= 1 << draw.randrange(8)
                self.write(damaged_name, damaged)
                outcome = program.run("check", command, folder=self.folder)
                self.assertIn(outcome.code, [0, 65, 66, 78], f"{damaged_name}: {outcome.err}")
                if outcome.code:
                    self.assertIn("error:", outcome.err)
                codes[outcome.code] = codes.get(outcome.code, 0) + 1
        print(f"jobs, texts and robots with flipped bits: exit codes {codes}")


class TextRecordings(Folder):
    def test_text_that_is_none(self):
        for content, words in [
            (TEXT + b"1" * (3 << 20) + b"\n", "bytes; a line may have 1048576"),
            (b"#" + b"x" * (3 << 20) + b"\n" + TEXT, "bytes; a line may have 1048576"),
            (b",".join(b"c%d" % k for k in range(100000)) + b"\n", "100000 columns; a recording may have 4096"),
            (TEXT + b"\0\0,1\n", "it holds zero bytes"),
            (TEXT[:50] + b"\0" + TEXT[50:], "is in no format known here"),
            (random.Random(SEED).randbytes(100000), "is in no format known here"),
            (b"\n" * (4 << 20), "is empty"),
        ]:
            with self.subTest(words=words):
                outcome, seconds = self.check_bounded(self.write("rec.csv", content))
                self.assert_refused(outcome, 65, words)
                self.assertLess(seconds, 10)

    def test_bombs(self):
        block = b"0,0,0\n" * (1 << 17)
        with gzip.open(self.path("rec.csv.gz"), "wb", 9) as file:
            file.write(b"t_s,q_rad,tau_Nm\n")
            for _ in range(400):
                file.write(block)
        outcome, seconds = self.check_bounded("rec.csv.gz")
        self.assert_refused(outcome, 65, "unpacks to more than 200 times its size")
        self.assertIn("gunzip", outcome.said)
        self.assertLess(seconds, 10)
        np.savez_compressed(self.path("rec.npz"), q=np.zeros(1 << 25))
        outcome, seconds = self.check_bounded("rec.npz")
        self.assert_refused(outcome, 65, "unpacks to more than 200 times its size")
        self.assertLess(seconds, 10)
        with open(self.path("rec.csv"), "wb") as file:
            file.write(TEXT)
            file.truncate(1 << 30)
        outcome, seconds = self.check_bounded("rec.csv")
        self.assert_refused(outcome, 65, "of zero bytes or more")
        self.assertLess(seconds, 10)
        self.write("nest.csv.gz", gzip.compress(gzip.compress(TEXT)))
        self.assert_refused(self.check("nest.csv.gz"), 65, "what it holds is not text")

    def test_what_is_no_file(self):
        os.mkfifo(self.path("pipe"))
        os.symlink("pipe", self.path("link"))
        os.symlink("loop", self.path("loop"))
        for name, words in [
            ("pipe", "is a pipe"),
            ("link", "is a pipe"),
            (".", "is a folder"),
            ("/dev/zero", "is a device"),
            ("loop", "cannot open"),
        ]:
            with self.subTest(name=name):
                self.assert_refused(self.check(name), 66, words)


class Jobs(Folder):
    def setUp(self):
        super().setUp()
        self.write("good.csv", TEXT)

    def test_sizes_that_overflow(self):
        for runs, more in [("10000000", "population = 100000\ngenerations = 4000000000\n"),
                           ("1", "population = 100000\ngenerations = 4000000000\n")]:
            outcome = self.check("good.csv", runs=runs, estimator="de", more=more)
            self.assert_refused(outcome, 78, "TiB of history; a job may have 1024")
            self.assertIn("--> job.toml:20:", outcome.said)

    def test_numbers_that_are_none(self):
        for number in ["1e400", "nan", "inf", "-inf", "9999999999999999999999"]:
            with self.subTest(number=number):
                self.write("job.toml", (JOB % ("2", "good.csv", "ols")).replace("= 20", f"= {number}").encode())
                outcome = program.run("check", "job.toml", folder=self.folder)
                self.assertEqual(outcome.code, 78, outcome.err)
                self.assertIn("--> job.toml:11:", outcome.said)

    def test_depth_and_size(self):
        for text, words in [("x = " + "[" * 40 + "]" * 40, "nested deeper than 32 levels"),
                            ("x = " + "{a=" * 100000, "nested deeper than 32 levels"),
                            ("[" + "a." * 5000 + "a]", "nested deeper than 32 levels"),
                            ("#" * (1 << 21), "larger than 1 MiB"),
                            ("\0" * 100, "")]:
            with self.subTest(words=words):
                self.write("job.toml", text.encode())
                self.assert_refused(program.run("check", "job.toml", folder=self.folder), 78, words)


if __name__ == "__main__":
    unittest.main(verbosity=1)
