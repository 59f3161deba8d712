"""Every system call of a three-run job fails once: the exit code says so, what is published is whole, and the same
command again makes the file that nobody disturbed.

Counts: every call of every phase each time the tests run, in one of the ways it can fail, the next call of that name in
the next way; of those that read twelve, and of a larger result some of its blocks. Every second call of a name is where
a disk stays broken. With TORQUESCOPE_FAULTS above 60 all calls in all ways, and a job of 20 runs in seven shards too.
"""

import collections
import json
import os
import re
import sys
import unittest

import shimmed
import study

MANY = int(os.environ.get("TORQUESCOPE_FAULTS", "60")) > 60

NEEDS_ROOM, CAN_BE_INTERRUPTED, CAN_BE_SHORT = 1, 2, 4
READS = ("read", "pread")
# what makes a file safe: where such a call fails, the exit code must say so
VITAL = ("write", "pwrite", "writev", "fsync", "fdatasync", "ftruncate", "rename")


class Call:
    def __init__(self, line):
        self.hit = line.startswith("!")
        number, self.name, can, self.path = line.lstrip("!").rstrip("\n").split(" ", 3)
        self.number, self.can = int(number), int(can)

    @property
    def is_vital(self):
        return self.name in VITAL and not self.path.endswith(".lock")

    def errors(self):
        yield "EIO"
        if self.can & NEEDS_ROOM:
            yield from ("ENOSPC", "EDQUOT")
        if self.can & CAN_BE_INTERRUPTED:
            yield "EINTR"
        if self.can & CAN_BE_SHORT:
            yield "short"


class Failing(shimmed.ShimmedTest):
    def shimmed(self, folder, command, **settings):
        log = os.path.join(self.home, "calls." + os.path.basename(folder.path))
        ended = folder.run(*command, changes=shimmed.changes(folder, calls=log, **settings))
        with open(log, encoding="utf-8") as file:
            calls = [Call(line) for line in file]
        os.remove(log)
        return ended, calls

    def assert_failed_well(self, ended, call, error, folder):
        """Exit 74 and words that help; or the call did not matter, and everything is as it should be."""
        said = f"{call.name} {call.path} {error}: {ended.code}\n{ended.err}"
        if ended.code == 0:
            self.assertFalse(call.is_vital, said)
            return
        self.assertEqual(ended.code, 74, said)
        words = {"EIO": "input/output error", "ENOSPC": "no space left on device", "EDQUOT": "disk quota exceeded"}[
            error
        ]
        told = ended.said.replace("[74] ", "")
        self.assertIn(words, told.lower(), said)
        self.assertRegex(told, r"(cannot write|cannot read) \S*(r\.h5|job\.toml)", said)
        if error != "EIO":
            self.assertRegex(told, r"\d+ bytes are free there", said)
            if "r.h5.parts:" not in told:  # a folder needs what it needs
                self.assertRegex(told, r"\d+ bytes or more are needed", said)
        self.assertIn("the same command again", told, said)
        if os.path.exists(folder / "r.h5"):
            self.assertTrue(self.same_bytes(folder), "what is published is whole")

    def same_bytes(self, folder):
        with open(self.whole / "r.h5", "rb") as one, open(folder / "r.h5", "rb") as other:
            return one.read() == other.read()

    def left_in(self, folder):
        """Names (without numbers of processes) and bytes."""
        found = []
        for path, _, names in os.walk(folder.path):
            found.append(re.sub(r"\d+", "#", os.path.relpath(path, folder.path)))
            for name in names:
                with open(os.path.join(path, name), "rb") as file:
                    content = file.read()
                if name.endswith(".made.json"):
                    content = sorted(json.loads(content))  # when and by whom is never the same
                found.append((re.sub(r"\d+", "#", name), b"" if name.endswith(".lock") else content))
        return hash(tuple(sorted(map(repr, found))))

    def assert_finishes(self, folder, command, finish):
        # most failures leave the same behind: what ended well once ends well again
        left = (self.left_in(folder), command)
        if left in self.finished:
            return
        self.finished.add(left)
        for again in (command, finish):
            if again is None:
                continue
            ended = self.run_in(folder, again)
            self.assert_ended(ended, 0)
            self.assertNotIn("damaged", ended.said)
        self.assert_same(folder)

    def some(self, calls, between):
        """The first, the last, and some between."""
        return calls[:2] + self.chance.sample(calls[2:-2], between) + calls[-2:] if len(calls) > between + 4 else calls

    def fewer_reads(self, calls):
        """All that change something, and some of those that only read, of which there are many."""
        kept = self.some([call for call in calls if call.name in READS], 8)
        return [call for call in calls if call.name not in READS or call in kept]

    def numbered(self, calls):
        """Each with how many of its name came before: calls of two names take turns, and none of them may always fail
        alike."""
        before = collections.Counter()
        for call in calls:
            yield before[call.name], call
            before[call.name] += 1

    def in_turn(self, errors, number):
        return errors if MANY else [errors[number % len(errors)]]

    def check_every_call(self, prepared, command, finish=None, names=None):
        """finish: what makes the result, when the command does not; names: only six of the calls of these names
        fail."""
        ended, calls = self.shimmed(self.copy_of(prepared), command)
        self.assert_ended(ended, 0)
        calls = [call for call in calls if not names or call.name in names]
        n_calls = len(calls)
        if not MANY:
            calls = self.some(calls, 2) if names else self.fewer_reads(calls)
        self.finished = set()
        tried = failed = 0
        for number, call in self.numbered(calls):
            for error in self.in_turn(list(call.errors()), number):
                folder = self.copy_of(prepared)
                ended, made = self.shimmed(folder, command, nth=call.number, error=error)
                hit = [c for c in made if c.hit]
                self.assertEqual(len(hit), 1, f"call {call.number} of {call.name}")
                with self.subTest(call=call.number, name=hit[0].name, path=os.path.basename(hit[0].path), error=error):
                    tried += 1
                    if error in ("EINTR", "short"):
                        self.assert_ended(ended, 0)
                        self.assert_finishes(folder, finish or command, None)
                        continue
                    failed += ended.code != 0
                    self.assert_failed_well(ended, hit[0], error, folder)
                    self.assert_finishes(folder, command, finish)
        # and a disk that stays as it is from there on
        for number, call in [one for one in self.numbered(calls) if MANY or one[0] % 2 == 0]:
            for error in self.in_turn(["EIO", "ENOSPC"] if call.can & NEEDS_ROOM else ["EIO"], number // 2):
                folder = self.copy_of(prepared)
                ended, made = self.shimmed(folder, command, nth=call.number, error=error, on=1)
                hit = [c for c in made if c.hit]
                with self.subTest(from_call=call.number, name=hit[0].name, error=error):
                    tried += 1
                    failed += ended.code != 0
                    self.assert_failed_well(ended, hit[0], error, folder)
                    self.assert_finishes(folder, command, finish)
        print(f"{' '.join(command)}: {len(calls)} of {n_calls} calls, {tried} failures, {failed} times exit 74, "
              f"{len(self.finished)} different folders, none differs", file=sys.stderr)


class FailingCalls(Failing):
    JOB = shimmed.JOB.replace("runs = 3", "runs = 20") if MANY else shimmed.JOB

    def test_run(self):
        self.check_every_call(self.prepared(), shimmed.RUN)

    def test_run_that_goes_on_from_segments(self):
        self.check_every_call(self.prepared(shimmed.shard(0, 2)), shimmed.RUN)

    def test_shard(self):
        self.check_every_call(self.prepared(shimmed.shard(1, 2)), shimmed.shard(0, 2), finish=shimmed.MERGE)

    @unittest.skipUnless(MANY, "at night: TORQUESCOPE_FAULTS=2000")
    def test_shards_of_many(self):
        before = [shimmed.shard(index, 7) for index in range(1, 7)]
        self.check_every_call(self.prepared(*before), shimmed.shard(0, 7), finish=shimmed.MERGE)
        self.check_every_call(self.prepared(shimmed.shard(0, 7), *before), shimmed.MERGE)

    def test_merge(self):
        self.check_every_call(self.prepared(shimmed.shard(0, 2), shimmed.shard(1, 2)), shimmed.MERGE)


class Blocks(Failing):
    """A result of several blocks: they are written past the page cache."""

    JOB = shimmed.JOB.replace("generations = 20", "generations = 1500")
    LEAST_BYTES = 3 * 2**19

    def test_blocks(self):
        whole = os.path.getsize(self.whole / "r.h5")
        self.assertGreater(whole, self.LEAST_BYTES)
        folder = self.prepared()
        _, calls = self.shimmed(self.copy_of(folder), shimmed.RUN)
        self.assertGreater(sum(call.name == "pwrite" and ".tmp." in call.path for call in calls), 4)
        self.check_every_call(folder, shimmed.RUN, names=("pwrite",))


class WriterThread(Blocks):
    """So many that another thread writes them (engine/store/temp_file.cpp)."""

    JOB = shimmed.JOB.replace("generations = 20", "generations = 7500")
    LEAST_BYTES = 9 * 2**20


if __name__ == "__main__":
    unittest.main(verbosity=2)
