"""Address space that is limited (`ulimit -v`): a clean message and the exit code 70, or the whole result; no hang, and
no process left behind.

Limits begin where the program can only just say its version.
"""

import os
import resource
import subprocess
import sys
import time
import unittest

import shimmed
import study

MB = 1_000_000
BEYOND = (0, 1, 2, 3, 5, 8, 12, 20, 40, 80)  # MB
REFUSED = 70
SECONDS = 4 * study.SECONDS


class Limited(study.Ended):
    """One process under a limit, with a session of its own; `left`: whether anybody of it outlived it."""

    def __init__(self, folder, limit, *arguments):
        process = subprocess.Popen(
            [study.PROGRAM, *arguments], cwd=folder.path, env=study.environment(), stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
            preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit)))
        began = time.monotonic()
        out, err = process.communicate(timeout=SECONDS)
        self.seconds = time.monotonic() - began
        self.code, self.out, self.err = process.returncode, out.decode(), err.decode()
        self.left = not self.is_gone(process.pid)

    def is_gone(self, group, seconds=5):
        """Who is killed with its parent takes a moment."""
        for _ in range(100 * seconds):
            try:
                os.killpg(group, 0)
            except ProcessLookupError:
                return True
            time.sleep(0.01)
        return False


@unittest.skipIf("TORQUESCOPE_SANITIZED" in os.environ, "a sanitizer reserves all memory there is")
class MemoryLimits(study.FaultTest):
    JOB = shimmed.JOB

    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.least = next(limit for limit in range(10 * MB, 1000 * MB, MB)
                         if Limited(cls.whole, limit, "--version").code == 0)

    def refused(self, ended, words):
        """Whether it was; then it said so cleanly, and otherwise it has done its work."""
        self.assertFalse(ended.left, ended.err)
        self.assertIn(ended.code, (0, REFUSED), ended.err)
        if ended.code == 0:
            return False
        self.assertIn(words, ended.said)
        self.assertIn("help: ", ended.err)
        self.assertNotIn("Traceback", ended.err)
        self.assertNotIn("libgomp", ended.err)
        return True

    def ladder(self, command, job=None):
        """How many of the limits were refused; the last one is none of them."""
        refused = 0
        for beyond in BEYOND:
            folder = self.folder(job)
            ended = Limited(folder, self.least + beyond * MB, command, "job.toml", "--out", "r.h5", "--threads", "2")
            if self.refused(ended, "out of memory"):
                self.assertFalse(os.path.exists(folder / "r.h5"))
                refused += 1
            elif job is None:
                self.assert_same(folder)
        self.assertEqual(ended.code, 0, ended.err)
        return refused

    def test_a_run(self):
        print(f"run: {self.ladder('run')} of {len(BEYOND)} limits refused", file=sys.stderr)

    def test_a_diagnosis(self):
        job = study.simulated_job.job(simulate={"duration_s": 12}, diagnose={"twins": 60, "effects": ["stribeck"]})
        print(f"diagnose: {self.ladder('diagnose', job)} of {len(BEYOND)} limits refused", file=sys.stderr)

    def test_a_page(self):
        for limit in (self.least, 60 * MB, 100 * MB, 200 * MB, 290 * MB):
            ended = Limited(self.whole, limit, "report", "r.h5", "--out", "r.html")
            self.assertTrue(self.refused(ended, "memory" if "out of memory" in ended.err else "of address space"))
            self.assertLess(ended.seconds, study.SECONDS)
        self.assertFalse(os.path.exists(self.whole / "r.html"))
        ended = Limited(self.whole, 600 * MB, "report", "r.h5", "--out", "r.html")
        self.assertFalse(self.refused(ended, ""), ended.err)


if __name__ == "__main__":
    unittest.main(verbosity=2)
