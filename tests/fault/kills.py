"""Killed at random moments and begun again until it is done: the file is, byte for byte, that of a run nobody
disturbed.

Counts: TORQUESCOPE_FAULTS (60 of each kind by default, 30 of merges), for example 2000 at night. FAULT_SEED repeats a
chance.
"""

import os
import shutil
import signal
import sys
import unittest

import study

KILLS = int(os.environ.get("TORQUESCOPE_FAULTS", "60"))


class Kills(study.FaultTest):
    def chain(self, kills, stop):
        """Interrupts attempt after attempt, in folder after folder, until there were enough; returns how often it was
        done."""
        count = complete = 0
        while count < kills:
            folder, before = self.folder(), (0, 0)
            while True:
                ended = stop(folder, self.chance.uniform(0.0, 1.1 * self.seconds))
                if ended.code == 0:
                    break
                count += 1
                after = folder.done()
                if after is not None:
                    self.assertGreaterEqual(after, before, "what a segment had is not lost")
                    before = after
                if count == kills:  # the last one in peace
                    self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5"), 0)
                    break
            self.assert_same(folder)
            complete += 1
        return complete

    def test_kill_9(self):
        def stop(folder, seconds):
            ended = folder.stopped_after(seconds, signal.SIGKILL, "run", "job.toml", "--out", "r.h5", *self.options())
            self.assertIn(ended.code, (0, -signal.SIGKILL), ended.err)
            return ended

        complete = self.chain(KILLS, stop)
        print(f"{KILLS} times kill -9, {complete} results, none differs", file=sys.stderr)

    def test_signals_that_ask(self):
        slowest, saved = 0.0, 0

        def stop(folder, seconds):
            nonlocal slowest, saved
            number = self.chance.choice(study.SIGNALS)
            ended = folder.stopped_after(seconds, number, "run", "job.toml", "--out", "r.h5", *self.options())
            if ended.code == -number:  # before the program had begun to listen
                self.assertEqual(ended.err, "")
                return ended
            self.assertIn(ended.code, (0, 75), ended.err)
            slowest = max(slowest, ended.seconds)
            self.assertLess(ended.seconds, 5.0)
            if ended.code == 75:
                saved += 1
                self.assertRegex(
                    ended.said, r"stopped by .*SIG.*: \d+ of 14 runs are safe .*run the same command again"
                )
            return ended

        complete = self.chain(KILLS, stop)
        self.assertGreater(saved, KILLS // 2)
        print(f"{KILLS} signals, exit 75 within {slowest:.2f} s, {complete} results, none differs", file=sys.stderr)

    def test_kills_during_a_merge(self):
        shards = self.folder()
        for index in range(3):
            ended = shards.run(
                "run", "job.toml", "--out", "r.h5", "--shard", f"{index}/3", "--threads", str(1 + index % 2)
            )
            self.assert_ended(ended, 0)
        kills = completed = 0
        while kills < max(1, KILLS // 2):
            folder = self.folder()
            shutil.copytree(shards / "r.h5.parts", folder / "r.h5.parts")
            for _ in range(5):
                ended = folder.stopped_after(self.chance.uniform(0.0, 0.8 * self.seconds), signal.SIGKILL, "merge",
                                             "job.toml", "--out", "r.h5")
                self.assertIn(ended.code, (0, -signal.SIGKILL), ended.err)
                kills += ended.code != 0
            self.assert_ended(folder.run("merge", "job.toml", "--out", "r.h5"), 0)
            self.assert_same(folder)
            completed += 1
        print(f"{kills} merges killed, {completed} results, none differs", file=sys.stderr)

    def test_shards_killed_and_divided_anew(self):
        folder = self.folder()
        for _ in range(max(1, KILLS // 10)):
            count = self.chance.choice((1, 2, 3, 7))
            shard = f"{self.chance.randrange(count)}/{count}"
            ended = folder.stopped_after(
                self.chance.uniform(0.0, self.seconds),
                signal.SIGKILL,
                "run",
                "job.toml",
                "--out",
                "r.h5",
                "--shard",
                shard,
                *self.options(),
            )
            self.assertIn(ended.code, (0, -signal.SIGKILL), ended.err)
            if os.path.exists(folder / "r.h5"):
                break
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5"), 0)
        self.assert_same(folder)


if __name__ == "__main__":
    unittest.main(verbosity=2)
