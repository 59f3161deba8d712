"""No room, or no locks: what is told before a job begins, what happens on a disk that is really full, and who may work
at once."""

import contextlib
import fcntl
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import shimmed
import study


def mounted(folder, size):
    return subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", folder], capture_output=True,
                          check=False).returncode == 0


class DiskRoom(shimmed.ShimmedTest):
    def test_a_job_that_does_not_fit_is_not_begun(self):
        whole = os.path.getsize(self.whole / "r.h5")
        shards = self.prepared(shimmed.shard(0, 2), shimmed.shard(1, 2))
        for prepared, command in ((self.prepared(), shimmed.RUN), (self.prepared(), shimmed.shard(0, 2)),
                                  (shards, shimmed.MERGE)):
            folder = self.copy_of(prepared)
            before = sorted(folder.segments())
            ended = folder.run(*command, changes=shimmed.changes(folder, free=20480))
            self.assert_ended(ended, 74)
            said = ended.said.replace("[74] ", "")
            needed = re.search(r"r\.h5(?:\.parts)? needs up to (\d+) bytes, and 20480 are free there", said)
            self.assertTrue(needed, said)
            self.assertIn("--allow-full-disk", said)
            self.assertLess(int(needed.group(1)), 1.1 * whole)
            self.assertEqual(sorted(folder.segments()), before)
            self.assertFalse(os.path.exists(folder / "r.h5"))
            if command != shimmed.shard(0, 2):
                self.assertGreater(int(needed.group(1)), 0.8 * whole)
                ended = folder.run(*command, "--allow-full-disk", changes=shimmed.changes(folder, free=20480))
                self.assert_ended(ended, 0)
                self.assertIn("warning", ended.said)
                self.assert_same(folder)

    def test_what_gzip_makes_smaller_is_not_refused(self):
        job = self.JOB + '\n[output]\ncompression = "gzip"\n'
        folder = self.folder(job)
        self.assert_ended(folder.run(*shimmed.RUN), 0)
        size = os.path.getsize(folder / "r.h5")
        os.remove(folder / "r.h5")
        self.assert_ended(folder.run(*shimmed.RUN, changes=shimmed.changes(folder, free=size)), 0)

    def test_a_diagnosis_that_does_not_fit_is_not_begun(self):
        command = ("diagnose", "job.toml", "--out", "d.h5")
        folder = self.folder(
            study.simulated_job.job(simulate={"duration_s": 12, "validate": True}, diagnose={"twins": 60})
        )
        ended = folder.run(*command, changes=shimmed.changes(folder, free=20480))
        self.assert_ended(ended, 74)
        needed = re.search(r"d\.h5 needs up to (\d+) bytes, and 20480 are free there", ended.said.replace("[74] ", ""))
        self.assertTrue(needed, ended.said)
        self.assertIn("--allow-full-disk", ended.said)
        self.assertEqual(os.listdir(folder.path), ["job.toml"])
        ended = folder.run(*command, "--allow-full-disk", changes=shimmed.changes(folder, free=20480))
        self.assert_ended(ended, 0)
        self.assertIn("warning", ended.said)
        size = os.path.getsize(folder / "d.h5")
        # the map and its lists are not counted: what would fit must never be refused
        self.assertLess(int(needed.group(1)), size)
        self.assertGreater(int(needed.group(1)), size - 700000)

    def test_a_disk_that_is_really_full(self):
        """With the preflight overruled: the disk itself refuses, at whatever byte; with room the same command ends
        well."""
        shards = self.prepared(shimmed.shard(0, 2))
        sizes = {"run": os.path.getsize(self.whole / "r.h5"), "merge": os.path.getsize(self.whole / "r.h5"),
                 "shards": os.path.getsize(shards.segments()[0])}
        commands = {"run": ((), shimmed.RUN), "shards": ((), shimmed.shard(0, 2)),
                    "merge": ((shimmed.shard(0, 2), shimmed.shard(1, 2)), shimmed.MERGE)}
        for name, (before, command) in commands.items():
            prepared = self.prepared(*before)
            taken = sum(os.path.getsize(segment) for segment in prepared.segments())
            for share in (0.1, 0.5, 0.9):
                folder = self.folder()
                size = int(taken + share * sizes[name]) // 4096 * 4096 + 2 * 4096
                if not mounted(folder.path, size):
                    self.skipTest("only root may mount a small disk")
                try:
                    study.shutil.copytree(prepared.path, folder.path, dirs_exist_ok=True)
                    ended = folder.run(*command, "--allow-full-disk")
                    self.assert_ended(ended, 74)
                    self.assertIn("no space left on device", ended.said)
                    self.assertRegex(ended.said, r"\d+ bytes or more are needed")
                    self.assertRegex(ended.said, r"\d+ bytes are free there")
                    self.assertFalse(os.path.exists(folder / "r.h5"))
                    self.assertEqual([n for n in os.listdir(folder.path) if ".tmp." in n], [], "no room is kept")
                    subprocess.run(["mount", "-o", "remount,size=4m", folder.path], check=True)
                    for again in (command, shimmed.shard(1, 2), shimmed.MERGE) if name == "shards" else (command,):
                        self.assert_ended(folder.run(*again), 0)
                    self.assert_same(folder)
                finally:
                    subprocess.run(["umount", folder.path], check=True)
        print("9 full disks, exit 74 each, none differs", file=sys.stderr)

    def test_a_disk_that_shrinks_meanwhile(self):
        """A quota that somebody else takes away while a job is under way: said, nothing published, and with room the
        same command makes the same file."""
        folder = self.folder()
        if not mounted(folder.path, "40m"):
            self.skipTest("only root may mount a small disk")
        try:
            shutil.copy(self.whole / "job.toml", folder / "job.toml")
            process = folder.start(*shimmed.RUN)
            while process.poll() is None and not any(".tmp." in name for name in os.listdir(folder.path)):
                pass
            process.send_signal(signal.SIGSTOP)
            size = 4096 * (2 + sum(-(-os.path.getsize(folder / name) // 4096) for name in os.listdir(folder.path)))
            subprocess.run(["mount", "-o", f"remount,size={size}", folder.path], check=True)
            process.send_signal(signal.SIGCONT)
            ended = study.Ended(process)
            self.assert_ended(ended, 74)
            self.assertIn("no space left on device", ended.said)
            self.assertEqual(os.listdir(folder.path), ["job.toml"])
            subprocess.run(["mount", "-o", "remount,size=40m", folder.path], check=True)
            self.assert_ended(folder.run(*shimmed.RUN), 0)
            self.assert_same(folder)
        finally:
            subprocess.run(["umount", folder.path], check=True)

    def held(self, folder, share):
        """True while a living process holds the share."""
        try:
            with open(folder / f"r.h5.parts/shard-{share}.lock", "rb") as file:
                fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            return True
        except FileNotFoundError:
            pass
        return False

    @contextlib.contextmanager
    def at_work(self, *command):
        folder = self.folder(self.JOB.replace("generations = 20", "generations = 5000000"))
        process = folder.start(*command)
        try:
            while not self.held(folder, "0000-of-0002" if "--shard" in command else "0000-of-0001"):
                self.assertIsNone(process.poll())
                time.sleep(0.01)
            yield folder, process
        finally:
            if process.poll() is None:
                process.terminate()
            study.Ended(process)

    def test_two_at_one_share(self):
        long = (*shimmed.RUN, "--save-every", "0.1", "--allow-full-disk")
        for options, name in (((), "the job of r.h5"), (("--shard", "0/2"), "shard 0/2 of r.h5")):
            with self.at_work(*long, *options) as (folder, process):
                ended = folder.run(*long, *options)
                self.assert_ended(ended, 73)
                said = ended.said.replace("[73] ", "")
                self.assertIn(f"{name} is at work already: process {process.pid} on ", said)
                self.assertIn("torquescope status r.h5", said)
                # another share is nobody's business
                other = folder.start(*long, "--shard", "1/2")
                time.sleep(0.2)
                self.assertIsNone(other.poll())
                other.terminate()
                self.assertEqual(study.Ended(other).code, 75)
                # the dead hold nothing
                process.kill()
                process.wait()
                again = folder.start(*long, *options)
                time.sleep(0.2)
                self.assertIsNone(again.poll())
                again.terminate()
                self.assertEqual(study.Ended(again).code, 75)

    def test_where_there_are_no_locks_both_go_on(self):
        for error in ("ENOLCK", "EOPNOTSUPP", "ENOSYS"):
            folder = self.folder()
            settings = shimmed.changes(folder, flock=error)
            both = [folder.start(*shimmed.shard(0, 2), changes=settings) for _ in range(2)]
            for process in both:
                self.assert_ended(study.Ended(process), 0)
            self.assert_ended(folder.run(*shimmed.shard(1, 2), changes=settings), 0)
            self.assert_ended(folder.run(*shimmed.MERGE, changes=settings), 0)
            self.assert_same(folder)


if __name__ == "__main__":
    unittest.main(verbosity=2)
