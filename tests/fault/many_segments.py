"""Ten thousand small segments, as programs left them that did not gather theirs yet: `status` and the run that goes on
take seconds of a processor, and the run leaves the result that nobody disturbed."""

import json
import os
import resource
import shutil
import signal
import sys
import unittest

import study

MANY = 10_000
KINDS = 16  # of different content; a run reads all that segments know of it, and equal ones are one
study.SECONDS = 900  # until a command is given up: other work may have most of the machine
MOST_SECONDS = 120.0  # of a processor: what "minutes" begins with


def processor_seconds():
    """Of all processes that have ended: unlike the clock's, they are the same beside other work."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


class ManySegments(study.FaultTest):
    def folder_of_many(self, shard="0/1"):
        """Killed while it wrote segments; then as many copies of the small ones as there are to be."""
        while True:
            folder = self.folder()
            folder.stopped_after(self.chance.uniform(0.4, 0.8) * self.seconds, signal.SIGKILL, "run", "job.toml",
                                 "--out", "r.h5", "--threads", "1", "--save-every", "0.001", "--shard", shard)
            small = sorted(folder.segments(), key=os.path.getsize)[:KINDS]
            if small:
                break
        for i in range(MANY):
            shutil.copy(small[i % len(small)], folder / f"r.h5.parts/shard-old.node.1.0.{i:06}.h5")
        return folder

    def timed(self, folder, *arguments):
        before = processor_seconds()
        ended = folder.run(*arguments)
        seconds = processor_seconds() - before
        print(f"{arguments[0]}: {seconds:.1f} s, {len(folder.segments())} segments behind it", file=sys.stderr)
        self.assert_ended(ended, 0)
        self.assertLess(seconds, MOST_SECONDS)
        return ended

    def test_status_and_the_run_that_goes_on_take_seconds(self):
        folder = self.folder_of_many()
        before = folder.done()
        told = json.loads(self.timed(folder, "status", "r.h5", "--json", "-").out)
        self.assertEqual((sum(e["done"] for e in told["estimators"]),
                          sum(e["generations_done"] for e in told["estimators"])), before)
        self.assertGreaterEqual(sum(one["segments"] for one in told["writers"]), MANY)
        self.timed(folder, "run", "job.toml", "--out", "r.h5")
        self.assert_same(folder)

    def test_a_shard_gathers_what_it_finds(self):
        folder = self.folder_of_many(shard="0/2")
        self.timed(folder, "run", "job.toml", "--out", "r.h5", "--shard", "0/2")
        self.assertLess(len(folder.segments()), MANY / KINDS)
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5", "--shard", "1/2"), 0)
        self.timed(folder, "merge", "job.toml", "--out", "r.h5")
        self.assert_same(folder)


if __name__ == "__main__":
    unittest.main(verbosity=2)
