"""Do the tests of this folder have teeth? Five faults are put into the program, one after the other, and each must be
caught; and the same program without any of them must pass, or they would be caught for another reason.
"""

import os
import re
import subprocess
import sys
import unittest

HERE = os.path.dirname(os.path.abspath(__file__))
TESTS = ("damage", "power_loss")
MUTANTS = {1: "no fsync", 2: "no verification of segments", 3: "acknowledged before fsync", 4: "rename before fsync",
           5: "no checksum"}


def tested(number, tests, images):
    environment = {**os.environ, "TORQUESCOPE": os.environ["TORQUESCOPE_MUTANTS"], "TORQUESCOPE_MUTANT": str(number),
                   "TORQUESCOPE_IMAGES": str(images), "TORQUESCOPE_FAULTS": "20"}
    return subprocess.run([sys.executable, "-m", "unittest", "--failfast", *tests], cwd=HERE, env=environment,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=600)


class Mutants(unittest.TestCase):
    def test_none_of_them_is_none(self):
        ended = tested(0, TESTS, 100)
        self.assertEqual(ended.returncode, 0, ended.stderr)

    def test_each_is_caught(self):
        caught = 0
        for number, name in MUTANTS.items():
            ended = tested(number, TESTS, 400)
            # by what a test asserts, not by a test that cannot cope
            failures = re.findall(r"^FAIL: (\S+) \((\w+)\.", ended.stderr, re.MULTILINE)
            with self.subTest(name):
                self.assertNotEqual(ended.returncode, 0, f"{name} was not noticed\n{ended.stderr}")
                self.assertTrue(failures, ended.stderr)
                self.assertNotIn("ERROR:", ended.stderr)
                caught += 1
            reason = re.findall(r"^AssertionError: (.*)", ended.stderr, re.MULTILINE)
            print(
                f"mutant {number}, {name}: {failures[0][1] if failures else '?'}.py: "
                f"{reason[0][:100] if reason else ''}",
                file=sys.stderr,
            )
        print(f"{caught} of {len(MUTANTS)} mutants caught", file=sys.stderr)
        self.assertEqual(caught, len(MUTANTS))


if __name__ == "__main__":
    unittest.main(verbosity=2)
