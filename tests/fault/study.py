"""A small job of several estimators, run in a folder of its own, interrupted in every way, and compared byte by
byte."""

import contextlib
import hashlib
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest

import h5py

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "..", "..", "scripts", "report"))
sys.path.insert(0, os.path.join(HERE, "..", "jobs"))

import simulated_job  # noqa: E402
from torquescope.reader.file_seal import FOOTER  # noqa: E402

PROGRAM = os.environ["TORQUESCOPE"]
SEED = int(os.environ.get("FAULT_SEED", time.time_ns() % 1_000_000))
# far beyond what any of these commands needs; presets with a sanitizer say how many times as long
SECONDS = 60 * int(os.environ.get("TORQUESCOPE_TIMES_AS_LONG", "1"))

JOB = simulated_job.job(
    [{"name": "ols"}, {"name": "de", "population": 14, "generations": 250, "fitness": "direct"},
     {"name": "fade", "population": 12, "generations": 120, "stagnation": 25, "fitness": "direct"}],
    experiment={"name": "fault", "runs": 7}, simulate={"duration_s": 15, "validate": True})


def environment(changes=None):
    dropped = ("CI", "NO_COLOR", "CLICOLOR_FORCE", "OMP_NUM_THREADS")
    kept = {key: value for key, value in os.environ.items()
            if key not in dropped and not key.startswith(("SLURM_", "OMPI_"))}
    kept["LC_ALL"] = "C.UTF-8"
    kept.update(changes or {})
    return kept


@contextlib.contextmanager
def changed(name):
    """A file of ours, to be changed through h5py; then the seal at its end fits again."""
    with open(name, "rb") as file:
        letters, _, _, job, _ = FOOTER.unpack(file.read()[-FOOTER.size:])
    with h5py.File(name, "r+", locking=False) as file:
        yield file
    with open(name, "rb") as file:
        whole = file.read()
    said = FOOTER.pack(letters, len(whole), 0, job, b"")[:-32]  # no ranges are left out
    with open(name, "ab") as file:
        file.write(said + hashlib.sha256(said + whole).digest())


class Ended:
    """How one process ended: code (negative: by that signal), what it said, how long after `since` it took."""

    def __init__(self, process, since=None):
        out, err = process.communicate(timeout=SECONDS)
        self.seconds = time.monotonic() - since if since is not None else None
        self.code, self.out, self.err = process.returncode, out.decode(), err.decode()

    @property
    def said(self):
        return " ".join(self.err.split())


class Folder:
    """One folder with the job in it."""

    def __init__(self, path, job=JOB):
        self.path = path
        self.write("job.toml", job)

    def __truediv__(self, name):
        return os.path.join(self.path, name)

    def write(self, name, text):
        with open(self / name, "w", encoding="utf-8") as file:
            file.write(text)

    def start(self, *arguments, changes=None):
        return subprocess.Popen(
            [PROGRAM, *arguments],
            cwd=self.path,
            env=environment(changes),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
        )

    def run(self, *arguments, changes=None):
        return Ended(self.start(*arguments, changes=changes))

    def stopped_after(self, seconds, number, *arguments):
        """Starts, waits, sends the signal (nothing when it has ended by then), waits for its end."""
        process = self.start(*arguments)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(timeout=seconds)
        since = time.monotonic()
        if process.poll() is None:
            process.send_signal(number)
        return Ended(process, since)

    def segments(self, result="r.h5"):
        folder = self / (result + ".parts")
        try:
            names = os.listdir(folder)
        except FileNotFoundError:  # not yet, or no longer
            return []
        return sorted(os.path.join(folder, name) for name in names if name.endswith(".h5"))

    def done(self, result="r.h5"):
        """How many runs segments have to their end, and how many generations; None when the result is there."""
        if os.path.exists(self / result):
            return None
        if not self.segments(result):
            return 0, 0
        told = json.loads(self.run("status", result, "--json", "-").out)
        return (sum(e["done"] for e in told["estimators"]), sum(e["generations_done"] for e in told["estimators"]))


class FaultTest(unittest.TestCase):
    """Folders that go away, one result to compare with (made once, uninterrupted, by one thread), and the chance
    used."""

    JOB = JOB
    COMMAND = "run"

    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="torquescope_fault_")
        cls.addClassCleanup(shutil.rmtree, cls.home)
        cls.whole = Folder(cls.new_path(), cls.JOB)
        began = time.monotonic()
        ended = cls.whole.run(cls.COMMAND, "job.toml", "--out", "r.h5", "--threads", "1")
        if ended.code != 0:
            raise AssertionError(ended.err)
        cls.seconds = time.monotonic() - began  # of one uninterrupted run
        cls.chance = random.Random(SEED)
        print(f"{cls.__name__}: FAULT_SEED={SEED}, one run takes {cls.seconds:.2f} s", file=sys.stderr)

    @classmethod
    def new_path(cls):
        return tempfile.mkdtemp(dir=cls.home)

    def folder(self, job=None):
        return Folder(self.new_path(), job or self.JOB)

    def options(self):
        """Whatever may differ from one attempt to the next."""
        return ("--threads", self.chance.choice("12"), "--save-every", self.chance.choice(("0.005", "0.02", "0.1")))

    def assert_same(self, folder, result="r.h5", ended=None):
        """`cmp` says nothing; nothing unfinished is left, but what `ended` says that it left, as it cannot tell whose
        it is."""
        with open(self.whole / "r.h5", "rb") as one, open(folder / result, "rb") as other:
            self.assertTrue(one.read() == other.read(), f"{result} differs from the uninterrupted one")
        left = set(os.listdir(folder.path)) - {"job.toml", result, result + ".made.json"}
        if ended is not None and "was left there" in ended.said:
            self.assertEqual(len(os.listdir(folder / (result + ".parts"))), 1)
            left.discard(result + ".parts")
        self.assertFalse(left, "nothing else is left")

    def read_until(self, process, word):
        """Up to a line of its messages that holds this word; a process that ends without one is a failure."""
        while word not in (line := process.stderr.readline()):
            self.assertTrue(line, f"ended with {process.poll()} before it said {word}")

    def assert_ended(self, ended, code):
        self.assertEqual(ended.code, code, ended.err)


SIGNALS = [signal.SIGTERM, signal.SIGINT, signal.SIGUSR1, signal.SIGXCPU, signal.SIGHUP]
