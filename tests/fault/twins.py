"""One diagnosis of several processes: whatever happens to some of them, the result is, byte for byte, that of one process."""

import glob
import os
import signal
import time
import unittest

import study

RECORDED = {"mode": "closed_loop", "rate_hz": 3200, "duration_s": 5}
MORE = {"simulate__plant": {"spring": 0.8}, "simulate__controller": {"kind": "pd"},
        "simulate__reference": {"kind": "multisine", "max_speed": 1.5},
        "simulate__encoder": {"counts_per_revolution": 131072}}
# one effect to find, so that nearly all of the time is that of twins
JOB = study.simulated_job.job(experiment={"name": "twins"}, model={"terms": ["inertia", "viscous", "coulomb"]},
                              filter={"cutoff_hz": 20, "decimate_to_hz": 100}, simulate=RECORDED,
                              diagnose={"twins": 60, "effects": ["spring"]}, **MORE)


KILLS = min(200, int(os.environ.get("TORQUESCOPE_FAULTS", "6")))


def shard(index, count):
    return ("diagnose", "job.toml", "--out", "r.h5", "--threads", "1", "--shard", f"{index}/{count}")


class Twins(study.FaultTest):
    JOB = JOB
    COMMAND = "diagnose"

    def parts(self, folder):
        return sorted(glob.glob(folder / "r.h5.parts/*.twins"))

    def half_done(self, index=0, count=2, at_least=6):
        """A folder with some parts, whose shard was killed: and no result."""
        folder = self.folder()
        process = folder.start(*shard(index, count))
        while process.poll() is None and len(self.parts(folder)) < at_least:
            time.sleep(0.002)
        process.kill()
        self.assertEqual(study.Ended(process).code, -signal.SIGKILL)
        self.assertFalse(os.path.exists(folder / "r.h5"))
        return folder

    def made_here(self, ended):
        """Parts simulated by this process, and all."""
        told = ended.said.split(" parts of the twins were simulated here")[0].split()
        return int(told[-3]), int(told[-1])

    def test_three_at_once(self):
        folder = self.folder()
        processes = [folder.start(*shard(index, 3)) for index in range(3)]
        accounts = []
        for process in processes:
            ended = study.Ended(process)
            self.assert_ended(ended, 0)
            if "another shard was first" in ended.said:
                self.assertIn("kept r.h5", ended.said)
            elif "nothing runs again" not in ended.said:
                accounts.append(self.made_here(ended))
        self.assertTrue(accounts)
        made, parts = max(accounts)
        self.assertGreater(parts, 20)
        self.assertLess(made, parts, "nobody made all of them")
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
        folder = self.half_done(at_least=10)
        before = len(self.parts(folder))
        process = folder.start(*shard(0, 2))
        while process.poll() is None and len(self.parts(folder)) < before + 5:
            time.sleep(0.002)
        process.terminate()
        ended = study.Ended(process)
        self.assert_ended(ended, 75)
        self.assertIn("twins so far are safe in r.h5.parts", ended.said)
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
                file.seek(self.chance.randrange(48, os.path.getsize(name)))  # beyond the key
                byte = file.read(1)[0]
                file.seek(-1, os.SEEK_CUR)
                file.write(bytes([byte ^ 1 << self.chance.randrange(8)]))
        os.replace(parts[2], parts[3])
        ended = folder.run(*shard(1, 2))
        self.assert_ended(ended, 0)
        self.assertEqual(ended.said.count("its twins are simulated again"), 2)
        made, count = self.made_here(ended)
        self.assertGreaterEqual(made, count - len(parts) + 4)
        self.assert_same(folder)

    def test_a_share_is_held_by_one(self):
        folder = self.folder()
        process = folder.start(*shard(0, 2))
        while not self.parts(folder):
            time.sleep(0.002)
        ended = folder.run(*shard(0, 2))
        self.assert_ended(ended, 73)
        self.assertIn("shard 0/2 of r.h5 is at work already", ended.said)
        ended = folder.run("status", "r.h5")
        self.assert_ended(ended, 0)
        self.assertRegex(ended.out, r"a diagnosis: \d+ parts of its twins are safe in r\.h5\.parts")
        process.kill()
        study.Ended(process)


if __name__ == "__main__":
    print(f"FAULT_SEED={study.SEED}", file=study.sys.stderr)
    unittest.main(verbosity=2)
