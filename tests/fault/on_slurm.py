"""A job of 40 runs in four shards on a real Slurm, which this test starts itself: engines are killed and stopped, tasks
go back into the queue, an urgent job takes the node away, and in the end one merge makes the file that nobody
disturbed.

By night also the limit of time of a task, which takes Slurm half a minute to notice.

Counts: 6 kills (TORQUESCOPE_FAULTS / 10). FAULT_SEED repeats a chance, though not Slurm's.
"""

import contextlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
import unittest

import private_slurm
import shimmed
import study

KILLS = int(os.environ.get("TORQUESCOPE_FAULTS", "60")) // 10
DIAGNOSIS = study.simulated_job.job(simulate={"duration_s": 6}, diagnose={"twins": 20, "effects": ["stribeck"]})
SHARDS = 4
SLOWER = int(os.environ.get("TORQUESCOPE_TIMES_AS_LONG", "1"))
MOST_SECONDS = 150 * SLOWER


class OnSlurm(study.FaultTest):
    # a few seconds of work for each shard, also in a slower build, and not much to store
    JOB = (
        shimmed.JOB.replace("runs = 3", "runs = 40")
        .replace('name = "tiny"', 'name = "forty"')
        .replace("population = 10", 'population = 14\nfitness = "direct"')
        .replace("generations = 20", "generations = 1000")
        .replace("duration_s = 1\n", f"duration_s = {500 // SLOWER}\n")
        + "[output]\nsamples = false\n"
    )

    @classmethod
    def setUpClass(cls):
        why_not = private_slurm.why_not()
        if why_not:
            raise unittest.SkipTest(why_not)
        super().setUpClass()
        try:
            cls.slurm = private_slurm.PrivateSlurm(SHARDS)
        except private_slurm.NotStarted as reason:
            raise unittest.SkipTest(f"Slurm does not start here: {reason}") from reason
        cls.addClassCleanup(cls.slurm.end)

    def engines(self, folder):
        """Processes of the program itself that work in this folder."""
        found = []
        for number in filter(str.isdigit, os.listdir("/proc")):
            try:
                with open(f"/proc/{number}/cmdline", "rb") as file:
                    words = file.read().split(b"\0")
                if words[0] == study.PROGRAM.encode() and b"--shard" in words and os.readlink(
                        f"/proc/{number}/cwd") == os.path.realpath(folder.path):
                    found.append(int(number))
            except (FileNotFoundError, ProcessLookupError):
                continue
        return found

    def frozen(self, engines):
        """Those that could be stopped where they are: they end no more by themselves, and only Slurm can make them go
        on."""
        stopped = []
        for engine in engines:
            with contextlib.suppress(FileNotFoundError, ProcessLookupError):  # it has ended meanwhile
                os.kill(engine, signal.SIGSTOP)
                while (state := self.state(engine)) not in "TZ":
                    time.sleep(0.001)
                if state == "T":
                    stopped.append(engine)
        return stopped

    def state(self, engine):
        with open(f"/proc/{engine}/stat", encoding="utf-8") as file:
            return file.read().rsplit(")", 1)[1].split()[0]

    def queue(self):
        return self.slurm.said("squeue", "-h", "-r", "-o", "%j %T")

    def submitted(self, folder, job, result, *more, shards=2, limit="00:10:00"):
        return study.Ended(subprocess.Popen(
            [study.PROGRAM, "submit", job, "--out", result, "--shards", str(shards), "--time", limit,
             "--save-every", "0.2", *more], cwd=folder.path, env=study.environment(
                 {"SLURM_CONF": self.slurm.environment["SLURM_CONF"], "PATH": private_slurm.PATH}),
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE))

    def submit_words(self, folder, job, result, *more, **options):
        ended = self.submitted(folder, job, result, *more, **options)
        self.assert_ended(ended, 0)
        return ended.said

    def submit(self, folder, shards, limit):
        return self.submit_words(folder, "job.toml", "r.h5", shards=shards, limit=limit)

    def finished(self, folder, result):
        """Waits for a result, and for the queue to be empty."""
        began = time.monotonic()
        while not os.path.exists(folder / result) or self.queue().strip():
            self.assertLess(time.monotonic() - began, MOST_SECONDS, f"{self.queue()}\n{self.logs(folder)}")
            time.sleep(0.1)

    def test_odd_names_and_options_of_the_user_reach_slurm_as_they_are(self):
        odd = "Läufe 100%a \"neu\" it's #1; $(touch hacked)"
        folder = self.folder(shimmed.JOB)
        os.mkdir(folder / odd)
        shutil.copy(folder / "job.toml", folder / f"{odd}/job %j.toml")
        result = f"{odd}/r %A.h5"
        words = self.submit_words(folder, f"{odd}/job %j.toml", result, "--", "--comment=two words", "--nice=3")
        self.assertIn("2 shards as job", words)
        self.finished(folder, result)
        self.assertEqual(set(os.listdir(folder / odd)),
                         {"job %j.toml", *("r %A.h5" + ending for ending in (
                             "", ".made.json", ".array.sbatch", ".merge.sbatch", ".shard-0.log", ".shard-1.log",
                             ".merge.log"))})
        self.assertFalse(os.path.exists(folder / "hacked"))
        plain = folder.run("run", "job.toml", "--out", "plain.h5")
        self.assert_ended(plain, 0)
        told = self.slurm.said("scontrol", "show", "job", "-o")
        self.assertEqual(told.count("Comment=two words"), 3, told)

    def test_a_diagnosis_is_one_task_without_a_merge(self):
        folder = self.folder(DIAGNOSIS)
        words = self.submit_words(folder, "job.toml", "r.h5")
        self.assertIn("the diagnosis as job", words)
        self.finished(folder, "r.h5")
        self.assertFalse(os.path.exists(folder / "r.h5.merge.sbatch"))
        self.assertFalse(os.path.exists(folder / "r.h5.parts"), self.logs(folder))
        other = folder.run("diagnose", "job.toml", "--out", "other.h5", "--shard", "1/2")
        self.assert_ended(other, 0)
        self.assertIn("a diagnosis is not divided", other.said)
        self.assertFalse(os.path.exists(folder / "other.h5"))

    def test_what_sbatch_says_is_said_as_it_said_it(self):
        folder = self.folder(shimmed.JOB)
        ended = self.submitted(folder, "job.toml", "r.h5", "--", "--partition=nosuch")
        self.assert_ended(ended, 66)
        own = subprocess.run(["sbatch", "--parsable", "--partition=nosuch", "r.h5.array.sbatch"], cwd=folder.path,
                             env=self.slurm.environment, stdin=subprocess.DEVNULL, capture_output=True, check=False)
        self.assertTrue(own.stderr.startswith(b"sbatch: error:"), own.stderr)
        self.assertIn(own.stderr.decode(), ended.err)
        self.assertIn("sbatch did not take the job: its own words stand above", ended.said)

    def restarts(self):
        """Of all tasks of the study's arrays together, and what Slurm said."""
        told = self.slurm.said("scontrol", "show", "job", "-o")
        return sum(int(n) for name, n in re.findall(r"JobName=(\S+) .*? Restarts=(\d+)", told) if name == "forty"), told

    @unittest.skipUnless(KILLS >= 60, "waits a minute or two for Slurm's clock: scripts/test --night")
    def test_a_limit_of_time_sends_the_task_back_and_it_goes_on(self):
        folder = self.folder()
        before = self.restarts()[0]
        self.submit(folder, 1, "00:01:00")
        began = time.monotonic()
        while not (folder.segments() and (frozen := self.frozen(self.engines(folder)))):
            self.assertLess(time.monotonic() - began, MOST_SECONDS, self.logs(folder))
            time.sleep(0.02)
        # a task is asked two minutes before its limit, so at once here; Slurm looks at its clock every half minute or
        # so, lets a frozen engine go on and tells it to end
        while frozen[0] in self.engines(folder):
            self.assertLess(time.monotonic() - began, MOST_SECONDS, self.logs(folder))
            time.sleep(0.2)
        asked = time.monotonic() - began
        self.assertFalse(os.path.exists(folder / "r.h5"), "the engine had ended before it was asked to")
        while not os.path.exists(folder / "r.h5"):
            self.assertLess(time.monotonic() - began, MOST_SECONDS + asked, f"{self.queue()}\n{self.logs(folder)}")
            time.sleep(0.2)
        with open(folder / "r.h5", "rb") as one, open(self.whole / "r.h5", "rb") as other:
            self.assertTrue(one.read() == other.read(), "differs from the uninterrupted one")
        self.assertGreaterEqual(self.restarts()[0], before + 1, self.logs(folder))
        print(f"real Slurm: asked after {asked:.0f} s by the limit of time, back in the queue, "
              f"{time.monotonic() - began:.0f} s, byte-identical", file=sys.stderr)

    def freeze_one(self, folder, began, most_seconds):
        while not (frozen := self.frozen(self.engines(folder)[:1])):
            self.assertLess(time.monotonic() - began, most_seconds, self.queue())
            time.sleep(0.01)
        return frozen[0]

    @unittest.skipUnless(KILLS >= 60, "200 tasks, minutes: scripts/test --night")
    def test_an_array_of_200_tasks_of_which_one_is_killed_one_preempted_and_one_cancelled(self):
        tasks, lost, most_seconds = 200, 150, 1500 * SLOWER
        folder = self.folder(self.JOB.replace("runs = 40", f"runs = {tasks}").replace("generations = 1000",
                                                                                     "generations = 200"))
        odd = "Läufe 100%a it's #1"
        os.mkdir(folder / odd)
        job, result = f"{odd}/job %j.toml", f"{odd}/r %A.h5"
        shutil.copy(folder / "job.toml", folder / job)
        self.assert_ended(folder.run("run", job, "--out", "plain.h5", "--threads", "1"), 0)
        already, began = self.restarts()[0], time.monotonic()
        array = re.search(r"as job (\d+)", self.submit_words(folder, job, result, shards=tasks)).group(1)
        self.slurm.said("scancel", f"{array}_{lost}")
        os.kill(self.freeze_one(folder, began, most_seconds), signal.SIGKILL)
        in_the_way = self.freeze_one(folder, began, most_seconds)
        self.slurm.said("sbatch", "--partition=urgent", f"--ntasks={SHARDS}", f"--chdir={folder.path}",
                        "--job-name=urgent", "--output=/dev/null", "--wrap=sleep 0.2")
        while self.slurm.said("squeue", "-h", "-r", "-o", "%j %r").split("\n")[0].split()[1:] != [
                "DependencyNeverSatisfied"]:
            self.assertLess(time.monotonic() - began, most_seconds, self.queue())
            time.sleep(0.5)
        self.assertNotIn(in_the_way, self.engines(folder))
        restarts = self.restarts()[0] - already
        self.assertGreaterEqual(restarts, 2)
        self.assertIn(f"not finished: shards {lost} of {tasks}", folder.run("status", result).out.replace("\n", " "))
        self.assert_ended(folder.run("run", job, "--out", result, "--shard", f"{lost}/{tasks}"), 0)
        self.slurm.said("scancel", "--state=PENDING", "--full")
        self.assert_ended(folder.run("merge", job, "--out", result), 0)
        with open(folder / result, "rb") as one, open(folder / "plain.h5", "rb") as other:
            self.assertTrue(one.read() == other.read(), "differs from the uninterrupted one")
        print(f"real Slurm: {tasks} tasks, 1 kill -9, 1 preempted, 1 cancelled and run by hand, {restarts} restarts, "
              f"{time.monotonic() - began:.0f} s, byte-identical", file=sys.stderr)

    def test_kills_requeues_preemption_and_one_merge(self):
        folder = self.folder()
        already = self.restarts()[0]
        self.assertIn(f"{SHARDS} shards as job", self.submit(folder, SHARDS, "00:10:00"))

        began = time.monotonic()
        kills, in_the_way = {signal.SIGKILL: 0, signal.SIGTERM: 0}, []
        while "merge" in (queue := self.queue()) or "forty" in queue:
            if os.path.exists(folder / "r.h5") and "merge" not in queue:
                break
            self.assertLess(time.monotonic() - began, MOST_SECONDS, f"{queue}\n{self.logs(folder)}")
            self.assertNotIn("merge RUNNING", queue if "forty RUNNING" in queue else "", "a merge waits for all shards")
            engines = self.engines(folder)
            if folder.segments() and not in_the_way and (in_the_way := self.frozen(engines)):
                self.slurm.said("sbatch", "--partition=urgent", f"--ntasks={SHARDS}", f"--chdir={folder.path}",
                                "--job-name=urgent", "--output=/dev/null", "--wrap=sleep 0.2")
            elif (
                engines and not set(in_the_way) & set(engines) and "urgent" not in queue and sum(kills.values()) < KILLS
            ):
                number = self.chance.choice(sorted(kills))
                try:
                    os.kill(self.chance.choice(engines), number)
                    kills[number] += 1
                except ProcessLookupError:
                    pass
            time.sleep(self.chance.uniform(0.0, 0.6))
        seconds = time.monotonic() - began

        self.assertEqual(sum(kills.values()), KILLS, self.logs(folder))
        with open(folder / "r.h5", "rb") as one, open(self.whole / "r.h5", "rb") as other:
            self.assertTrue(one.read() == other.read(), "differs from the uninterrupted one")
        self.assertFalse(os.path.exists(folder / "r.h5.parts"))
        with open(folder / "r.h5.merge.log", encoding="utf-8") as file:
            merged = file.read()
        self.assertEqual(merged.count("wrote"), 1, merged)
        self.assertIn("40 of 40 runs were done", " ".join(merged.split()))
        restarts, told = self.restarts()
        restarts -= already
        # the urgent job wanted all of the node, where engines were frozen: it ran because Slurm took the node from each
        # of them, and each had to begin again
        urgent = re.search(r"JobName=urgent .*?JobState=(\S+) .*?NumCPUs=(\d+)", told)
        self.assertEqual(urgent and urgent.groups(), ("COMPLETED", str(SHARDS)), told)
        self.assertGreater(len(in_the_way), 0)
        self.assertGreaterEqual(restarts, len(in_the_way), told)
        print(
            f"real Slurm: {SHARDS} shards, 40 runs, {kills[signal.SIGKILL]} kill -9, {kills[signal.SIGTERM]} SIGTERM, "
            f"{len(in_the_way)} tasks preempted by an urgent job, {restarts} restarts, one merge, "
            f"{seconds:.0f} s, byte-identical",
            file=sys.stderr,
        )

    def logs(self, folder):
        words = ""
        for name in sorted(os.listdir(folder.path)):
            if name.endswith(".log"):
                with open(folder / name, encoding="utf-8", errors="replace") as file:
                    words += f"--- {name}\n{file.read()}"
        return words


if __name__ == "__main__":
    print(f"FAULT_SEED={study.SEED}", file=sys.stderr)
    unittest.main(verbosity=2)
