"""`torquescope show R.h5 --verify` against damage: no flipped bit and no missing end of a result file passes in
silence.

A flip is either reported (exit code 65, with the place and the cure) or proved harmless: then everything in the file
was read and has the digests it had, so the bit lies in bytes that no object uses. Another exit code, a signal or
another digest is a failure. What another program changes on purpose, checksums renewed, is reported too.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/hostile/verify_result.py
"""

import json
import os
import random
import re
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "jobs"))

import program  # noqa: E402
import recordings  # noqa: E402

SEED = 20140606
ABOUT_SCALES = {"CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST"}  # of dimension scales: not part of the digest
JOB = """
[experiment]
name = "small"
seed = 11
runs = 3

[recording]
train = "good.csv"
validate = "good.csv"
columns = {time = "t_s", position = "q_rad", torque = "tau_Nm"}

[filter]
cutoff_hz = 20

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]

[output]
compression = "%s"

[[estimator]]
name = "ols"

[[estimator]]
name = "fade"
population = 20
generations = 30
"""


def content_of(name):
    with open(name, "rb") as file:
        return file.read()


class Folder(unittest.TestCase):
    """A folder with a result file of a real run, plain and packed."""

    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="torquescope_verify_")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        with open(os.path.join(cls.folder, "good.csv"), "w", encoding="utf-8") as file:
            file.write(recordings.text_of(recordings.good_rows(seconds=5.0)))
        for compression in ["none", "gzip"]:
            with open(os.path.join(cls.folder, f"{compression}.toml"), "w", encoding="utf-8") as file:
                file.write(JOB % compression)
            made = program.run("run", f"{compression}.toml", "--out", f"{compression}.h5", "--quiet", folder=cls.folder)
            if made.code != 0:
                raise AssertionError(made.err)

    def verify(self, name, *more):
        return program.run("show", name, "--verify", *more, folder=self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)

    def assert_reported(self, outcome, what):
        self.assertEqual(outcome.code, 65, f"{what}: {outcome.err}")
        self.assertEqual(outcome.out, "", what)
        self.assertRegex(
            outcome.err, r"^error: .*(damaged|not an HDF5 file|not a result|never finished|has format)", what
        )
        self.assertIn("help: ", outcome.err, what)
        self.assertNotIn("HDF5-DIAG", outcome.err, what)


class WholeFile(Folder):
    def test_says_what_was_checked_and_what_was_not(self):
        outcome = self.verify("none.h5")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertTrue(outcome.out.startswith("verified none.h5, "), outcome.out)
        said = " ".join(outcome.out.split())
        self.assertRegex(said, r"\d+ datasets, \d+ attributes, [0-9.]+ [kM]B of values: all read, every checksum holds")
        self.assertRegex(said, r"its text has the sha256 stored, [0-9a-f]{16} ")
        self.assertIn("/provenance", said)
        for line in outcome.out.splitlines():
            self.assertLessEqual(len(line), 80)

    def test_counts_are_those_of_another_reader(self):
        document = json.loads(self.verify("none.h5", "--json", "-").out)
        self.assertIs(document["verified"], True)
        counts = {"datasets": 0, "groups": 1, "attributes": 0, "value_bytes": 0}
        with h5py.File(self.path("none.h5"), locking=False) as file:
            counts["attributes"] += len(file.attrs)

            def visit(name, item):
                if name.split("/")[0] == "provenance":
                    return
                counts["attributes"] += len(set(item.attrs) - ABOUT_SCALES)
                counts["datasets" if isinstance(item, h5py.Dataset) else "groups"] += 1
                counts["value_bytes"] += getattr(item, "nbytes", 0) or 0

            file.visititems(visit)
            self.assertEqual(document["content"]["sha256"], file.attrs["content_sha256"].decode())
            self.assertEqual(document["provenance"]["attributes"], len(file["provenance"].attrs))
        for key, count in counts.items():
            self.assertEqual(document["content"][key], count, key)

    def test_quiet_leaves_the_exit_code(self):
        outcome = self.verify("none.h5", "--quiet")
        self.assertEqual((outcome.code, outcome.out + outcome.err), (0, ""))


class DamagedFile(Folder):
    FLIPS = {"none": 100, "gzip": 60}
    CUTS = {"none": 100, "gzip": 30}

    def test_no_flipped_bit_is_silent(self):
        draw = random.Random(SEED)
        for kind, flips in self.FLIPS.items():
            whole = content_of(self.path(f"{kind}.h5"))
            truth = json.loads(self.verify(f"{kind}.h5", "--json", "-").out)
            reported = harmless = 0
            for k in range(flips):
                # spread: one in each of `flips` equal parts, a random bit of it
                place = len(whole) * k // flips + draw.randrange(max(1, len(whole) // flips))
                bit = draw.randrange(8)
                damaged = bytearray(whole)
                damaged[place] ^= 1 << bit
                self.write("damaged.h5", damaged)
                outcome = self.verify("damaged.h5", "--json", "-")
                what = f"{kind}: bit {bit} of byte {place} of {len(whole)}"
                if outcome.code == 0:
                    document = json.loads(outcome.out)
                    for key in ["content", "provenance", "job", "creator"]:
                        self.assertEqual(document[key], truth[key], f"silent: {what}")
                    harmless += 1
                else:
                    self.assertEqual(json.loads(outcome.out)["error"]["code"], 65, what)
                    self.assert_reported(program.Outcome(outcome.code, "", outcome.err), what)
                    reported += 1
            print(
                f"{kind}: {flips} flipped bits: {reported} reported, {harmless} harmless (in bytes that nothing "
                "uses), 0 silent"
            )
            self.assertGreater(reported, flips // 2)

    def test_provenance_changed_by_another_program_is_told(self):
        self.write("damaged.h5", content_of(self.path("none.h5")))
        with h5py.File(self.path("damaged.h5"), "r+", locking=False) as file:
            file["provenance"].attrs.modify("build_type", np.bytes_("another"))
        outcome = self.verify("damaged.h5")
        self.assert_reported(outcome, "build_type")
        self.assertIn("/provenance", outcome.err)

    def test_first_and_last_bytes_are_covered(self):
        # where unchecked metadata of other versions of the format would lie
        draw = random.Random(SEED + 1)
        whole = content_of(self.path("none.h5"))
        truth = json.loads(self.verify("none.h5", "--json", "-").out)
        harmless = 0
        for k in range(60):
            place = draw.randrange(1024) if k % 2 else len(whole) - 1 - draw.randrange(1024)
            damaged = bytearray(whole)
            damaged[place] ^= 1 << draw.randrange(8)
            self.write("damaged.h5", damaged)
            outcome = self.verify("damaged.h5", "--json", "-")
            self.assertIn(outcome.code, [0, 65], f"byte {place}: {outcome.err}")
            if outcome.code == 0:
                self.assertEqual(dict(json.loads(outcome.out), file=""), dict(truth, file=""), f"silent: byte {place}")
                harmless += 1
        print(f"ends: 60 flipped bits: {60 - harmless} reported, {harmless} harmless, 0 silent")

    def test_no_missing_end_is_silent(self):
        draw = random.Random(SEED + 2)
        for kind, cuts in self.CUTS.items():
            whole = content_of(self.path(f"{kind}.h5"))
            lengths = [0, 1, 8, 48, len(whole) - 1] + [draw.randrange(len(whole)) for _ in range(cuts - 5)]
            for length in lengths:
                self.write("damaged.h5", whole[:length])
                self.assert_reported(self.verify("damaged.h5"), f"{kind}: the first {length} of {len(whole)} bytes")
            print(f"{kind}: {cuts} truncations: all reported")


class ChangedOnPurpose(Folder):
    """By a program that renews the checksums: only the digests can tell."""

    def changed(self, change):
        shutil.copy(self.path("none.h5"), self.path("changed.h5"))
        with h5py.File(self.path("changed.h5"), "r+", locking=False) as file:
            change(file)
        return self.verify("changed.h5")

    def test_every_kind_of_change_is_reported(self):
        def value(file):
            file["runs/fade/mse"][0] *= 0.5

        def attribute(file):
            file["runs/ols"].attrs["mse_best"] = 0.0

        def removed(file):
            del file["data/validate"]

        def added(file):
            file["data/train/torque_2"] = [1.0, 2.0]

        for change in [value, attribute, removed, added]:
            with self.subTest(change=change.__name__):
                outcome = self.changed(change)
                self.assert_reported(outcome, change.__name__)

    def test_the_place_is_named(self):
        def virtual(file):
            layout = h5py.VirtualLayout(shape=(3,), dtype="<f8")
            layout[:] = h5py.VirtualSource("elsewhere.h5", "x", shape=(3,))
            file["runs/ols"].create_virtual_dataset("more", layout)

        def linked(file):
            file["runs/ols/more"] = h5py.ExternalLink("/etc/passwd", "/x")

        def soft(file):
            file["runs/ols/more"] = h5py.SoftLink("/runs/fade/mse")

        def itself(file):
            file["runs/ols/more"] = file["runs"]

        def variable_text(file):
            file["runs/ols"].attrs["more"] = "text of any length"

        for change, words in [
            (virtual, "in /runs/ols/more: its values lie in another file"),
            (linked, '"more" is a link to elsewhere'),
            (soft, '"more" is a link to elsewhere'),
            (itself, "it has two names"),
            (variable_text, 'in /runs/ols: attribute "more": it has a type'),
        ]:
            with self.subTest(change=change.__name__):
                outcome = self.changed(change)
                self.assert_reported(outcome, change.__name__)
                self.assertIn(words, outcome.said)

    def test_sizes_that_no_file_can_hold(self):
        def one(file):
            file.create_dataset("runs/huge", shape=(1 << 40,), dtype="<f8", chunks=(1024,))

        def many(file):  # each one bearable, all of them hours
            for k in range(50):
                file.create_dataset(f"runs/large_{k}", shape=(1 << 24,), dtype="<f8", chunks=(1 << 16,))

        for change in [one, many]:
            with self.subTest(change=change.__name__):
                outcome = self.changed(change)
                self.assert_reported(outcome, change.__name__)
                self.assertIn("claims more values than the file can hold", outcome.said)

    def test_other_files_are_refused(self):
        os.mkfifo(self.path("pipe.h5"))
        for name, code in [("good.csv", 65), ("nothing.h5", 66), ("pipe.h5", 65), (".", 65)]:
            with self.subTest(name=name):
                outcome = self.verify(name)
                self.assertEqual(outcome.code, code, outcome.err)
                self.assertTrue(re.search("help: ", outcome.err))


if __name__ == "__main__":
    unittest.main(verbosity=1)
