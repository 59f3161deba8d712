"""Thousands of damaged inputs for every reader of foreign files, the same ones each time, in seconds (short_pass.cpp).

Use: SHORT_PASS=build/release/tests/fuzz/short_pass MAKE_SEGMENT=build/release/tests/fuzz/make_segment
     /usr/bin/python3 tests/fuzz/short_pass.py
"""

import os
import re
import shutil
import subprocess
import tempfile
import unittest

import seeds

COUNTS = {"job": 10000, "csv": 4000, "hdf5": 250, "mat5": 250, "segment": 1000}


class ShortPass(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.home = tempfile.mkdtemp(prefix="torquescope_fuzz_")
        cls.addClassCleanup(shutil.rmtree, cls.home)
        seeds.make(cls.home)

    def said(self, reader, folder, count):
        done = subprocess.run([os.environ["SHORT_PASS"], reader, folder, str(count)], cwd=self.home, capture_output=True, text=True,
                              check=False)
        print(done.stdout, end="", flush=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_each_is_read_or_refused(self):
        for reader, count in COUNTS.items():
            with self.subTest(reader=reader):
                said = self.said(reader, os.path.join(self.home, reader), count)
                read, refused = map(int, re.search(r"(\d+) read, (\d+) refused", said).groups())
                # most changes matter, or what is tried is the container alone
                self.assertGreater(min(read, refused), 0.02 * count, said)

    def test_segments_that_lie(self):
        said = self.said("segment", seeds.lying_segments(self.home), 0)
        self.assertIn(f"0 read, {len(seeds.LIES)} refused, in 0 the library", said)


if __name__ == "__main__":
    unittest.main(verbosity=1)
