"""Thousands of damaged inputs for every reader of foreign files, the same ones each time, in seconds (short_pass.cpp).

Use: SHORT_PASS=build/release/tests/fuzz/short_pass MAKE_SEGMENT=build/release/tests/fuzz/make_segment
     TORQUESCOPE=build/release/bin/torquescope /usr/bin/python3 tests/fuzz/short_pass.py
"""

import glob
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "jobs"))

import program  # noqa: E402
import seeds  # noqa: E402
import simulated_job  # noqa: E402

COUNTS = {"job": 10000, "csv": 4000, "hdf5": 300, "json": 4000,
          "mat5": 150, "npz": 4000, "ros_echo": 3000, "segment": 300}


class ShortPass(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="torquescope_fuzz_")
        cls.addClassCleanup(shutil.rmtree, cls.home)
        seeds.make(cls.home)
        cls.passes = {
            reader: cls.thrown(reader, os.path.join(cls.home, reader), count) for reader, count in COUNTS.items()
        }

    @classmethod
    def thrown(cls, reader, folder, count):
        done = subprocess.run(
            [os.environ["SHORT_PASS"], reader, folder, str(count)],
            cwd=cls.home,
            capture_output=True,
            text=True,
            check=False,
        )
        print(done.stdout, end="", flush=True)
        return done

    def test_each_is_read_or_refused(self):
        for reader, done in self.passes.items():
            with self.subTest(reader=reader):
                self.assertEqual(done.returncode, 0, done.stderr)
                read, refused = map(int, re.search(r"(\d+) read, (\d+) refused", done.stdout).groups())
                # most changes matter, or what is tried is the container alone; a changed segment is sealed again, and
                # one that is read has passed the digest of all its values: they are equal
                self.assertGreater(min(read, refused), 0.02 * COUNTS[reader])

    def test_segments_that_lie(self):
        done = self.thrown("segment", seeds.lying_segments(self.home), 0)
        self.assertIn(f"0 read, {len(seeds.LIES)} refused, in 0 the library", done.stdout)

    def test_the_program_outlives_what_breaks_a_library_off(self):
        folder = os.path.join(self.home, "outlived")
        parts = os.path.join(folder, "r.h5.parts")
        os.makedirs(parts)
        for path in glob.glob(os.path.join(self.home, "broke_off.*")):
            if "segment" in path:
                shutil.copy(path, os.path.join(parts, os.path.basename(path) + ".h5"))
                continue
            with self.subTest(path=os.path.basename(path)):
                self.write(folder, "job.toml", seeds.JOB % path)
                self.assertEqual(program.run("check", "job.toml", folder=folder).code, 65)
        segments = len(os.listdir(parts))
        if segments:
            self.assertEqual(program.run("status", "r.h5", folder=folder).code, 0)
        self.write(folder, "job.toml", simulated_job.job([{"name": "ols"}]))
        # of other jobs, so that nothing in them is wanted: their index is read, and no history
        ran = program.run("run", "job.toml", "--out", "r.h5", "--allow-mixed", folder=folder)
        self.assertEqual(ran.code, 0, ran.err)
        outlived = ran.said.count("while reading it; its generations run again")
        print(f"the program goes on beside {segments} segments that break HDF5 off, {outlived} of them in their index")

    def write(self, folder, name, text):
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)


if __name__ == "__main__":
    unittest.main(verbosity=1)
