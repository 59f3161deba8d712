"""Segments that a disk, or somebody, has changed: they count as absent, and the file is that of an undisturbed run.

Counts: 60 flipped bits, or TORQUESCOPE_FAULTS. FAULT_SEED repeats a chance.
"""

import os
import sys
import unittest

import shimmed
import study

FLIPS = int(os.environ.get("TORQUESCOPE_FAULTS", "60"))


class Damage(shimmed.ShimmedTest):
    def check(self, folder):
        """True when the damage was noticed; where it was not, it must not matter."""
        ended = self.run_in(folder, shimmed.RUN)
        self.assert_ended(ended, 0)
        self.assert_same(folder, ended=ended)
        return "its generations run again" in ended.said

    def test_flipped_bits(self):
        shards = self.prepared(shimmed.shard(0, 2), shimmed.shard(1, 2))
        noticed = 0
        for _ in range(FLIPS):
            folder = self.copy_of(shards)
            name = self.chance.choice(folder.segments())
            place, bit = self.chance.randrange(os.path.getsize(name)), self.chance.randrange(8)
            with self.subTest(place=place, bit=bit), open(name, "r+b") as file:
                file.seek(place)
                byte = file.read(1)[0]
                file.seek(place)
                file.write(bytes([byte ^ 1 << bit]))
                file.flush()
                noticed += self.check(folder)
        print(f"{FLIPS} flipped bits of segments, {noticed} noticed, the others where nothing is, none differs",
              file=sys.stderr)
        self.assertGreater(noticed, FLIPS // 2)

    def test_numbers_changed_by_another_program(self):
        """Every checksum of HDF5 fits again, and the seal; only the digest of the content does not."""
        shards = self.prepared(shimmed.shard(0, 2), shimmed.shard(1, 2))
        for what in ("fitness", "best", "population"):
            folder = self.copy_of(shards)
            with study.changed(folder.segments()[0]) as file:
                values = file["parts/fade/" + what]
                values[0] = values[0] * 1.5
            self.assertTrue(self.check(folder), what)


if __name__ == "__main__":
    print(f"FAULT_SEED={study.SEED}", file=sys.stderr)
    unittest.main(verbosity=2)
