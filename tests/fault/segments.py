"""What a resume takes and what it refuses: damaged, doubled, foreign segments; shards, their merge, their status."""

import fcntl
import json
import os
import shutil
import signal
import subprocess
import sys
import time
import unittest

import h5py
import numpy as np

import study
from torquescope.reader.content_digest import content_sha256


def set_text(group, name, text):
    """Into the attribute as it is: h5py's own way would change its type."""
    attribute = h5py.h5a.open(group.id, name.encode())
    attribute.write(np.array(text.encode(), dtype=f"S{len(text)}"), mtype=attribute.get_type())


def change(name, edit):
    """Changes a segment as nobody should: edit(file), a digest that fits again, and a seal that does."""
    with study.changed(name) as file:
        edit(file)
        set_text(file, "content_sha256", content_sha256(file))


class Segments(study.FaultTest):
    def shards(self, count, *options, job=study.JOB):
        folder = self.folder(job)
        for index in range(count):
            self.assert_ended(
                folder.run("run", "job.toml", "--out", "r.h5", "--shard", f"{index}/{count}", *options), 0
            )
        return folder

    def interrupted(self):
        """A folder with some segments, and no result."""
        for _ in range(50):
            folder = self.folder()
            process = folder.start("run", "job.toml", "--out", "r.h5", "--save-every", "0.01")
            while process.poll() is None and len(folder.segments()) < 2:
                time.sleep(0.001)
            process.kill()
            study.Ended(process)
            if len(folder.segments()) >= 2 and not os.path.exists(folder / "r.h5"):
                return folder
        self.fail("never stopped between its first segments and its end")

    def test_shards_of_any_number_and_threads_merge_to_the_same_bytes(self):
        for count, threads in ((2, "1"), (3, "2"), (7, "1")):
            folder = self.shards(count, "--threads", threads)
            ended = folder.run("merge", "job.toml", "--out", "r.h5")
            self.assert_ended(ended, 0)
            self.assertIn("14 of 14 runs were done", ended.said)
            self.assert_same(folder)
            with open(folder / "r.h5.made.json", encoding="utf-8") as file:
                self.assertEqual({a["shard"] for a in json.load(file)["attempts_before"]},
                                 {f"{i}/{count}" for i in range(count)})

    def test_two_shards_with_different_threads(self):
        folder = self.folder()
        for shard, threads in (("0/2", "1"), ("1/2", "2")):
            self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5", "--shard", shard, "--threads", threads), 0)
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5"), 0)
        self.assert_same(folder)

    def test_the_batch_system_says_which_shard(self):
        places = [{"SLURM_ARRAY_TASK_ID": "3", "SLURM_ARRAY_TASK_MIN": "3", "SLURM_ARRAY_TASK_MAX": "4",
                   "SLURM_ARRAY_TASK_COUNT": "2"},
                  {"OMPI_COMM_WORLD_RANK": "1", "OMPI_COMM_WORLD_SIZE": "2"}]
        folder = self.folder()
        for changes, reason in zip(places, ("0/2 (SLURM_ARRAY_TASK_ID)", "1/2 (OMPI_COMM_WORLD_RANK)")):
            ended = folder.run("run", "job.toml", "--out", "r.h5", changes=changes)
            self.assert_ended(ended, 0)
            self.assertIn(reason, ended.said)
        self.assert_ended(folder.run("merge", "job.toml", "--out", "r.h5"), 0)
        self.assert_same(folder)

    def test_segments_of_other_folders_are_merged(self):
        folder, other = self.folder(), self.folder()
        for where, shard in ((folder, "0/2"), (other, "1/2")):
            self.assert_ended(where.run("run", "job.toml", "--out", "r.h5", "--shard", shard), 0)
        self.assert_ended(folder.run("merge", "job.toml", other / "r.h5.parts", "--out", "r.h5"), 0)
        self.assert_same(folder)
        self.assertTrue(other.segments(), "what is elsewhere stays")

    def test_missing_runs_are_named_and_a_partial_merge_is_made_whole_later(self):
        folder = self.folder()
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5", "--shard", "0/2"), 0)
        ended = folder.run("merge", "job.toml", "--out", "r.h5")
        self.assert_ended(ended, 75)
        self.assertIn("8 of 14 runs are missing", ended.said)
        self.assertIn("de 3 to 6; fade 3 to 6", ended.said)
        self.assertFalse(os.path.exists(folder / "r.h5"))

        self.assert_ended(folder.run("merge", "job.toml", "--out", "r.h5", "--partial"), 0)
        with h5py.File(folder / "r.h5", "r", locking=False) as part, h5py.File(self.whole / "r.h5", "r") as whole:
            self.assertEqual(part["runs/de"].attrs["missing_runs"], 4)
            self.assertTrue((part["runs/de/population"][:3] == whole["runs/de/population"][:3]).all())
            self.assertTrue((part["runs/de/mse"][:3] == whole["runs/de/mse"][:3]).all())
            self.assertTrue((part["runs/de/population"][3:] != part["runs/de/population"][3:]).all(), "NaN")
        told = json.loads(folder.run("status", "r.h5", "--json", "-").out)
        self.assertFalse(told["complete"])
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5"), 0)
        self.assert_same(folder)

    def test_equal_doubles_are_one(self):
        folder = self.shards(2)
        for name in folder.segments():
            shutil.copy(name, name.replace("shard-", "shard-again-"))
        self.assert_ended(folder.run("merge", "job.toml", "--out", "r.h5"), 0)
        self.assert_same(folder)

    def test_doubles_that_differ_are_refused_and_both_are_named(self):
        folder = self.shards(2)
        one = folder.segments()[0]
        other = one.replace("shard-", "shard-again-")
        shutil.copy(one, other)

        def edit(file):
            best = file["parts/de/best"]
            best[17] = best[17] * (1 + 2**-52)  # the last bit

        change(other, edit)
        for command in ("merge", "run"):
            ended = folder.run(command, "job.toml", "--out", "r.h5")
            self.assert_ended(ended, 65)
            self.assertIn("two segments disagree about generation 17 of run 0 of de", ended.said)
            for name in (one, other):
                self.assertIn(os.path.basename(name), ended.said.replace(" ", ""))
            self.assertFalse(os.path.exists(folder / "r.h5"))

    def test_damaged_segments_count_as_absent(self):
        for damage in ("flip", "cut", "empty", "text"):
            with self.subTest(damage):
                folder = self.interrupted()
                name = folder.segments()[self.chance.randrange(len(folder.segments()))]
                size = os.path.getsize(name)
                with open(name, "r+b") as file:
                    if damage == "flip":
                        file.seek(size // 2)
                        byte = file.read(1)[0]
                        file.seek(size // 2)
                        file.write(bytes([byte ^ 4]))
                    elif damage == "text":
                        file.write(b"not HDF5")
                    else:
                        file.truncate(size // 2 if damage == "cut" else 0)
                ended = folder.run("run", "job.toml", "--out", "r.h5")
                self.assert_ended(ended, 0)
                if damage != "flip":  # a bit in a gap of the file harms nothing
                    self.assertIn("its generations run again", ended.said)
                if damage in ("cut", "empty"):  # what has no end does not say whose it is
                    self.assertIn("was left there", ended.said)
                self.assert_same(folder, ended=ended)

    def test_nothing_foreign_is_touched(self):
        """A link of the folder's name to a folder of somebody else's files, and such files in the folder itself."""
        folder, other = self.folder(), self.folder(study.JOB.replace("seed = 7", "seed = 8"))
        os.mkdir(folder / "scratch")
        foreign = {"notmine.h5": b"my own words", "notes.h5.tmp.12": b"unfinished"}
        with open(self.whole / "r.h5", "rb") as file:  # the same job's result, and another job's segments
            foreign["whole.h5"] = file.read()
        self.assert_ended(other.run("run", "job.toml", "--out", "r.h5", "--shard", "0/2"), 0)
        for name in other.segments():
            with open(name, "rb") as file:
                foreign[os.path.basename(name)] = file.read()

        def in_folder(name):
            found = {}
            for each in os.listdir(folder / name):
                with open(os.path.join(folder / name, each), "rb") as file:
                    found[each] = file.read()
            return found

        for name, content in foreign.items():
            with open(os.path.join(folder / "scratch", name), "wb") as file:
                file.write(content)
        os.symlink("scratch", folder / "r.h5.parts")
        for more in ((), ("--shard", "0/2")):
            ended = folder.run("run", "job.toml", "--out", "r.h5", *more)
            self.assert_ended(ended, 73)
            self.assertIn("r.h5.parts is a symbolic link", ended.said)
            self.assertIn("help: remove the link: rm r.h5.parts", ended.said)
        self.assert_ended(folder.run("merge", "job.toml", "--out", "r.h5"), 73)
        self.assertFalse(os.path.exists(folder / "r.h5"))
        self.assertEqual(in_folder("scratch"), foreign)

        # a result that is complete already, when the link turns up
        os.remove(folder / "r.h5.parts")
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5"), 0)
        os.symlink("scratch", folder / "r.h5.parts")
        ended = folder.run("run", "job.toml", "--out", "r.h5")
        self.assert_ended(ended, 0)
        self.assertIn("nothing in it was touched", ended.said)
        self.assertEqual(in_folder("scratch"), foreign)

        # and in the folder itself
        os.remove(folder / "r.h5.parts")
        os.rename(folder / "scratch", folder / "r.h5.parts")
        ended = folder.run("run", "job.toml", "--out", "r.h5")
        self.assert_ended(ended, 0)
        words = f"{len(foreign) - 1} of the files in r.h5.parts are not, or not verifiably, of this job"
        self.assertIn(words, ended.said)
        self.assertEqual(in_folder("r.h5.parts"), foreign)

    def test_another_job_and_another_program_are_refused(self):
        folder = self.interrupted()
        folder.write("job.toml", study.JOB.replace("seed = 7", "seed = 8"))
        ended = folder.run("run", "job.toml", "--out", "r.h5")
        self.assert_ended(ended, 78)
        self.assertIn("holds runs of another job", ended.said)
        ended = folder.run("run", "job.toml", "--out", "r.h5", "--allow-mixed")
        self.assert_ended(ended, 78)
        self.assertIn("other settings", ended.said)

        # more runs, a remark, another estimator: what was done is what would have been done
        more = study.JOB.replace("runs = 7", "runs = 9") + "# a remark\n" + "[[estimator]]\nname = \"wls\"\n"
        grown, whole = self.interrupted(), self.folder(more)
        grown.write("job.toml", more)
        self.assert_ended(grown.run("run", "job.toml", "--out", "r.h5"), 78)
        self.assert_ended(grown.run("run", "job.toml", "--out", "r.h5", "--allow-mixed"), 0)
        self.assert_ended(whole.run("run", "job.toml", "--out", "r.h5"), 0)
        with open(grown / "r.h5", "rb") as one, open(whole / "r.h5", "rb") as other:
            self.assertTrue(one.read() == other.read())

        folder = self.interrupted()
        for name in folder.segments():
            change(name, lambda file: set_text(file["segment"], "numerics_sha256", "0" * 64))
        ended = folder.run("run", "job.toml", "--out", "r.h5")
        self.assert_ended(ended, 78)
        self.assertIn("written by another program", ended.said)
        self.assertIn("--allow-mixed", ended.said)
        ended = folder.run("run", "job.toml", "--out", "r.h5", "--allow-mixed")
        self.assert_ended(ended, 0)
        with open(folder / "r.h5.made.json", encoding="utf-8") as file:
            self.assertEqual({a["numerics_sha256"] for a in json.load(file)["attempts_before"]}, {"0" * 64})

    def test_the_same_command_twice_at_once(self):
        folder = self.folder()
        both = [folder.start("run", "job.toml", "--out", "r.h5", "--save-every", "0.01") for _ in range(2)]
        codes = sorted(study.Ended(process).code for process in both)
        self.assertIn(codes, ([0, 0], [0, 73]))  # one after the other, or the second one is told so
        self.assert_ended(folder.run("run", "job.toml", "--out", "r.h5"), 0)
        self.assert_same(folder)

    def test_status_of_a_living_job_changes_nothing(self):
        folder = self.folder(study.JOB.replace("generations = 250", "generations = 200000"))
        process = folder.start("run", "job.toml", "--out", "r.h5", "--save-every", "0.05")
        try:
            for _ in range(200):
                ended = folder.run("status", "r.h5", "--json", "-")
                if ended.code == 0:
                    break
            told = json.loads(ended.out)
            self.assertFalse(told["complete"])
            self.assertTrue(told["writers"][0]["alive_here"])
            self.assertEqual(told["writers"][0]["pid"], process.pid)
            self.assertEqual(told["estimators"][0]["runs"], 7)
            plain = folder.run("status", "r.h5")
            self.assertIn("at work", plain.out)
            self.assertLessEqual(max(map(len, plain.out.splitlines())), 80)
        finally:
            process.terminate()
            self.assert_ended(study.Ended(process), 75)
        self.assertFalse(json.loads(folder.run("status", "r.h5.parts", "--json", "-").out)["writers"][0]["alive_here"])
        self.assert_ended(folder.run("status", "nothing.h5"), 66)

    def test_the_scripts_of_submit_requeue_what_was_stopped(self):
        """Both scripts under bash, with Slurm's commands replaced: srun runs the rest of its line, scontrol notes its
        words."""
        folder = self.folder()
        for name, text in (("srun", 'shift; exec "$@"'), ("squeue", "echo 1:00:00"), ("sleep", "exit 0"),
                           ("scontrol", f'echo "$@" >> {folder / "requeued"}; exit 1')):
            folder.write(name, "#!/bin/sh\n" + text + "\n")
            os.chmod(folder / name, 0o755)
        said = folder.run("submit", "job.toml", "--out", "r.h5", "--shards", "2", "--dry-run")
        self.assert_ended(said, 0)
        array, merge = said.out.split("\n# r.h5.merge.sbatch\n")
        folder.write("array.sh", array)
        folder.write("merge.sh", merge)

        def start(script, task, **more):
            slurm = {"SLURM_JOB_ID": "7", "SLURM_ARRAY_JOB_ID": "7", "SLURM_ARRAY_TASK_ID": str(task), **more}
            return subprocess.Popen(["bash", script], cwd=folder.path, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                    stderr=subprocess.PIPE,
                                    env=study.environment({"PATH": folder.path + ":" + os.environ["PATH"], **slurm}))

        folder.write("job.toml", study.JOB.replace("generations = 250", "generations = 200000"))
        process = start("array.sh", 0)
        self.read_until(process, b"fitness")
        process.send_signal(signal.SIGUSR1)
        self.assert_ended(study.Ended(process), 75)
        with open(folder / "requeued", encoding="utf-8") as file:
            self.assertEqual(file.read(), "requeue 7_0\n")
        # a copy that Slurm has lost sight of holds the share: later, not never
        os.makedirs(folder / "r.h5.parts", exist_ok=True)
        with open(folder / "r.h5.parts/shard-0000-of-0002.lock", "w", encoding="utf-8") as held:
            fcntl.flock(held, fcntl.LOCK_EX)
            self.assert_ended(study.Ended(start("array.sh", 0)), 73)
        with open(folder / "requeued", encoding="utf-8") as file:
            self.assertEqual(file.read(), 2 * "requeue 7_0\n")
        shutil.rmtree(folder / "r.h5.parts", ignore_errors=True)
        folder.write("job.toml", study.JOB)
        for task in (0, 1):
            ended = study.Ended(start("array.sh", task, SLURM_RESTART_COUNT="1"))
            self.assert_ended(ended, 0)
            self.assertIn(f"{task}/2 (--shard)", ended.said)
        self.assert_ended(study.Ended(start("merge.sh", 0)), 0)
        for name in ("srun", "squeue", "sleep", "scontrol", "requeued", "array.sh", "merge.sh"):
            os.remove(folder / name)
        self.assert_same(folder)

    def test_only_a_second_interrupt_ends_at_once(self):
        for numbers, code in (
            ((signal.SIGINT, signal.SIGINT), 130),
            ((signal.SIGTERM, signal.SIGTERM, signal.SIGINT), 75),
            ((signal.SIGCONT, signal.SIGUSR1, signal.SIGCONT, signal.SIGTERM), 75),
        ):
            folder = self.folder(study.JOB.replace("generations = 250", "generations = 200000"))
            process = folder.start("run", "job.toml", "--out", "r.h5", "--progress", "none")
            self.read_until(process, b"fitness")
            process.send_signal(signal.SIGSTOP)  # so that all of them wait for it
            for number in numbers[:-1]:
                process.send_signal(number)
                if number == numbers[-1]:  # a pending signal is pending once
                    process.send_signal(signal.SIGCONT)
                    self.read_until(process, b"stopping")
            with study.contextlib.suppress(ProcessLookupError):
                process.send_signal(numbers[-1])
            process.send_signal(signal.SIGCONT)
            self.assertIn(study.Ended(process).code, {code, 75})

    def test_a_generation_that_takes_long_is_not_waited_for(self):
        folder = self.folder(
            study.JOB.replace("population = 14", "population = 100000")
            .replace("duration_s = 15", "duration_s = 4000")
            .replace("validate = true", "validate = false")
        )
        process = folder.start("run", "job.toml", "--out", "r.h5", "--threads", "1")
        self.read_until(process, b"stage=de")
        time.sleep(1.0)  # into the first generation, which takes ten seconds and more
        process.terminate()
        ended = study.Ended(process, time.monotonic())
        self.assert_ended(ended, 75)
        self.assertLess(ended.seconds, 5.0)
        self.assertIn("in the middle of a generation", ended.said)

    def test_a_time_budget_is_a_reason_to_stop(self):
        folder = self.folder()
        folder.write("job.toml", study.JOB.replace("generations = 250", "generations = 200000"))
        began = time.monotonic()
        ended = folder.run("run", "job.toml", "--out", "r.h5", "--time-budget", "0.6")
        self.assert_ended(ended, 75)
        self.assertLess(time.monotonic() - began, 3.0)
        self.assertRegex(ended.said, r"stopped by time budget \(0.6 s\): \d+ of 14 runs are safe")
        self.assertTrue(folder.segments())


if __name__ == "__main__":
    print(f"FAULT_SEED={study.SEED}", file=sys.stderr)
    unittest.main(verbosity=2)
