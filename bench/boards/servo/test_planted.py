"""Sixteen seeds, one law each: what moves the servo by three counts of its encoder is named, or stands in a class with
the name, and nothing else is named.

    test_planted.py TORQUESCOPE MAKE_SERVO_RECORDS
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import unittest

from grade import grade, kept_names
from run import LAWS, moved_mrad

PROGRAM, PLANT = sys.argv[1:3]
SEEDS = range(5001, 5017)
COUNT_MRAD = 1.534
SMALL = ("--motions", "3", "--lengths", "0.15")


def planted(folder, seed):
    """The first law from the seed's place on that can be told, with its set of recordings."""
    for step in range(len(LAWS)):
        law = LAWS[(seed + step) % len(LAWS)]
        subprocess.run([PLANT, "--seed", str(seed), "--out", folder, "--with", law, *SMALL], check=True,
                       stdout=subprocess.DEVNULL)
        if moved_mrad(folder)[law] > 3 * COUNT_MRAD:
            return law
    raise AssertionError(f"seed {seed}: no law moves this servo")


class Planted(unittest.TestCase):
    def test_a_law_that_can_be_told_is_named_alone(self):
        for seed in SEEDS:
            with self.subTest(seed=seed), tempfile.TemporaryDirectory() as name:
                folder = pathlib.Path(name)
                law = planted(folder, seed)
                done = subprocess.run([PROGRAM, "diagnose", "job.toml", "--json", "-", "-q"], cwd=folder,
                                      capture_output=True, text=True, check=True)
                graded = grade([law], kept_names(json.loads(done.stdout)))
                print(seed, law, graded.word, *graded.false, flush=True)
                self.assertIn(graded.word, ("right", "class"), law)
                self.assertEqual(graded.false, (), law)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
