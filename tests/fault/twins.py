"""One diagnosis of several processes: whatever happens to some of them, the result is, byte for byte, that of one
process."""

import contextlib
import fcntl
import glob
import hashlib
import json
import os
import signal
import time
import unittest

import h5py

import study

RECORDED = {"mode": "closed_loop", "rate_hz": 3200, "duration_s": 5}
MORE = {"simulate__plant": {"spring": 0.8}, "simulate__controller": {"kind": "pd"},
        "simulate__reference": {"kind": "multisine", "max_speed": 1.5},
        "simulate__encoder": {"counts_per_revolution": 131072}}
# one effect to find, so that nearly all of the time is that of twins
JOB = study.simulated_job.job(experiment={"name": "twins"}, model={"terms": ["inertia", "viscous", "coulomb"]},
                              filter={"cutoff_hz": 20, "decimate_to_hz": 100}, simulate=RECORDED,
                              diagnose={"twins": 60, "effects": ["spring"], "decider": "moving_rows"}, **MORE)


KILLS = min(200, int(os.environ.get("TORQUESCOPE_FAULTS", "6")))


def shard(index, count):
    return ("diagnose", "job.toml", "--out", "r.h5", "--threads", "1", "--shard", f"{index}/{count}")


class Twins(study.FaultTest):
    JOB = JOB
    COMMAND = "diagnose"

    def parts(self, folder):
        return sorted(glob.glob(folder / "r.h5.parts/*.twins"))

    @classmethod
    def job_letters(cls):
        """What the names of this job's replicates end with (engine/store/RESULT_FORMAT.md)."""
        with h5py.File(cls.whole / "r.h5", "r", locking=False) as file:
            inputs = file["job"].attrs["inputs_sha256"]
        texts = [b"torquescope work", inputs]
        return hashlib.sha256(b"".join(len(t).to_bytes(8, "little") + t for t in texts)).hexdigest()[:8]

    @contextlib.contextmanager
    def at_work(self, folder, batch):
        """Shard 0/2, which cannot get beyond a batch: the second half of it is being computed, as far as it can see."""
        os.makedirs(folder / "r.h5.parts", exist_ok=True)
        part = folder / f"r.h5.parts/batch-{batch:04}.part-00%d-of-002.{self.job_letters()}.twins"
        with open(part % 1 + ".lock", "w", encoding="utf-8") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            process = folder.start(*shard(0, 2))
            while process.poll() is None and not os.path.exists(part % 0):
                time.sleep(0.002)
            yield process
            if process.poll() is None:
                process.kill()
            study.Ended(process)

    def half_done(self, batch=4):
        """A folder with some parts, whose shard was killed: and no result."""
        folder = self.folder()
        with self.at_work(folder, batch) as process:
            process.kill()
            self.assertEqual(process.wait(), -signal.SIGKILL)
        self.assertGreaterEqual(len(self.parts(folder)), 2 * batch - 1)
        self.assertFalse(os.path.exists(folder / "r.h5"))
        return folder

    def made_here(self, ended):
        """Parts simulated by this process, and all."""
        told = ended.said.split(" parts of the replicates were simulated here")[0].split()
        return int(told[-3]), int(told[-1])

    def test_three_tasks_of_an_array_at_once(self):
        folder = self.folder()
        array = {"SLURM_ARRAY_TASK_MIN": "1", "SLURM_ARRAY_TASK_MAX": "3", "SLURM_ARRAY_TASK_COUNT": "3"}
        processes = [folder.start("diagnose", "job.toml", "--out", "r.h5", "--threads", "1",
                                  changes={"SLURM_ARRAY_TASK_ID": str(task), **array}) for task in (1, 2, 3)]
        accounts = []
        for process in processes:
            ended = study.Ended(process)
            self.assert_ended(ended, 0)
            if "nothing runs again" in ended.said:
                continue  # began when all was done
            self.assertIn("(SLURM_ARRAY_TASK_ID): replicates are shared", ended.said)
            if "another shard was first" not in ended.said:
                accounts.append(self.made_here(ended))
        self.assertTrue(accounts)
        made, parts = max(accounts)
        self.assertGreater(parts, 20)
        print(f"{made} of {parts} parts at most were made by one of three", file=study.sys.stderr)
        self.assert_same(folder)

    def test_killed_again_and_again_beside_one_that_is_not(self):
        folder = self.folder()
        beside = folder.start(*shard(1, 2))
        kills = 0
        while beside.poll() is None and kills < KILLS:
            ended = folder.stopped_after(self.chance.uniform(0.05, 0.4 * self.seconds), signal.SIGKILL, *shard(0, 2))
            self.assertIn(ended.code, (0, -signal.SIGKILL), ended.err)
            kills += ended.code != 0
        self.assert_ended(study.Ended(beside), 0)
        self.assert_ended(folder.run(*shard(0, 2)), 0)
        self.assert_same(folder)
        print(f"{kills} kills of one of two", file=study.sys.stderr)

    def test_the_same_command_goes_on(self):
        folder = self.half_done()
        before = len(self.parts(folder))
        with self.at_work(folder, 8) as process:
            process.terminate()
            said = " ".join(process.stderr.read().decode().split())
            self.assertEqual(process.wait(), 75, said)
        self.assertIn("replicates so far are safe in r.h5.parts", said)
        self.assertGreater(len(self.parts(folder)), before)
        before = len(self.parts(folder))
        ended = folder.run(*shard(0, 2))
        self.assert_ended(ended, 0)
        made, parts = self.made_here(ended)
        self.assertEqual(made, parts - before)
        self.assert_same(folder)

    def test_damaged_twins_and_those_of_another_place_are_simulated_again(self):
        folder = self.half_done()
        parts = self.parts(folder)
        for name in parts[:2]:
            with open(name, "r+b") as file:
                file.seek(self.chance.randrange(72, os.path.getsize(name)))  # beyond magic, job and key
                byte = file.read(1)[0]
                file.seek(-1, os.SEEK_CUR)
                file.write(bytes([byte ^ 1 << self.chance.randrange(8)]))
        os.replace(parts[2], parts[3])
        ended = folder.run(*shard(1, 2))
        self.assert_ended(ended, 0)
        self.assertEqual(ended.said.count("its replicates are simulated again"), 2)
        made, count = self.made_here(ended)
        self.assertGreaterEqual(made, count - len(parts) + 4)
        self.assert_same(folder)

    def test_a_share_is_held_by_one(self):
        folder = self.folder()
        with self.at_work(folder, 2):
            ended = folder.run(*shard(0, 2))
            self.assert_ended(ended, 73)
            self.assertIn("shard 0/2 of r.h5 is at work already", ended.said)
            ended = folder.run("status", "r.h5")
            self.assert_ended(ended, 0)
            self.assertIn("3 parts of its replicates are safe in r.h5.parts", ended.out)
            self.assertIn("at work", ended.out)

    def test_one_process_alone_says_how_far_it_is_and_takes_the_dead_ones_word_away(self):
        folder = self.folder()
        os.mkdir(folder / "r.h5.parts")
        with open(os.path.join(folder / "r.h5.parts", "shard-0000-of-0001.lock"), "w", encoding="utf-8") as dead:
            dead.write("process 1 on nowhere\nits last word")
        process = folder.start("diagnose", "job.toml", "--out", "r.h5", "--threads", "1", "--progress", "lines")
        self.read_until(process, b"stage=replicates")
        status = folder.run("status", "r.h5", "--json", "-")
        ended = study.Ended(process)
        self.assert_ended(ended, 0)
        told, = json.loads(status.out)["processes"]
        self.assertEqual((told["shards"], told["alive_here"]), (1, True))
        self.assertFalse(os.path.exists(folder / "r.h5.parts"))
        self.assertIn("is complete: a diagnosis", folder.run("status", "r.h5").out)

    def test_one_process_alone_leaves_no_more_than_how_far_it_was(self):
        job = self.JOB.replace("twins = 60", "twins = 100000")
        for number, code in ((signal.SIGTERM, 75), (signal.SIGINT, 75), (signal.SIGKILL, -signal.SIGKILL)):
            folder = self.folder(job)
            process = folder.start("diagnose", "job.toml", "--out", "r.h5", "--threads", "1", "--progress", "lines")
            self.read_until(process, b"stage=replicates")
            process.send_signal(number)
            ended = study.Ended(process)
            self.assertEqual(ended.code, code, ended.said)
            status = folder.run("status", "r.h5", "--json", "-")
            if number == signal.SIGKILL:
                # its lock says how far it was; the next one takes it away
                self.assertEqual(os.listdir(folder / "r.h5.parts"), ["shard-0000-of-0001.lock"])
                self.assert_ended(status, 0)
                told, = json.loads(status.out)["processes"]
                self.assertEqual((told["stage"], told["alive_here"]), ("replicates", False))
                self.assertIn("begins anew", folder.run("status", "r.h5").out)
            else:
                self.assertFalse(glob.glob(folder / "r.h5*"), "however it ended")
                self.assertIn("stopping after the running step of the search", ended.said)
                self.assertIn("nothing was written", ended.said)
                self.assertIn("the same command begins anew", ended.said)
                self.assertNotIn("generation", ended.said)

    def test_a_quiet_one_says_why_it_stopped(self):
        folder = self.folder(self.JOB.replace("twins = 60", "twins = 100000"))
        process = folder.start("diagnose", "job.toml", "--out", "r.h5", "--threads", "1", "--quiet")
        told = lambda: json.loads(folder.run("status", "r.h5", "--json", "-").out or "{}")  # noqa: E731
        while '"stage": "replicates"' not in json.dumps(told()):
            self.assertIsNone(process.poll(), "ended before a stage of replicates began")
            time.sleep(0.01)
        process.terminate()
        ended = study.Ended(process)
        self.assert_ended(ended, 75)
        self.assertIn("nothing was written", ended.said)
        self.assertIn("the same command begins anew", ended.said)
        self.assertFalse(glob.glob(folder / "r.h5*"))


if __name__ == "__main__":
    print(f"FAULT_SEED={study.SEED}", file=study.sys.stderr)
    unittest.main(verbosity=2)
