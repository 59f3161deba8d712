"""The power goes at any moment: no run that the program called safe is lost, nothing has its final name and other
bytes, and the same command makes the file that nobody disturbed.

Counts: TORQUESCOPE_IMAGES (200 by default; with TORQUESCOPE_FAULTS above 60 two and a half times that). FAULT_SEED
repeats a chance.
"""

import os
import re
import signal
import sys
import unittest

import shimmed
import study
from power_log import Disk, read_log, write_image

FAULTS = int(os.environ.get("TORQUESCOPE_FAULTS", "60"))
IMAGES = int(os.environ.get("TORQUESCOPE_IMAGES", "200" if FAULTS <= 60 else str(FAULTS * 5 // 2)))


class Story:
    """Commands in one folder, one after the other, and what they did to the disk."""

    def __init__(self, folder, commands, steps):
        self.folder, self.commands, self.steps = folder, commands, steps

    def disk_after(self, count):
        disk = Disk(self.folder.path, {"job.toml": PowerLoss.JOB.encode()})
        for step in self.steps[:count]:
            disk.do(step)
        return disk

    def claims_on(self, disk):
        """How many runs were called safe so far, and whether a result was announced."""
        runs, complete = {}, False
        for command, said in zip(self.commands, disk.said):
            share = command[command.index("--shard") + 1] if "--shard" in command else "all"
            count, wrote = claimed(said)
            runs[share] = max(runs.get(share, 0), count)
            complete = complete or wrote
        return max(runs.pop("all", 0), sum(runs.values())), complete


def claimed(said):
    """Of what one process said: how many runs are safe, and whether the result is there."""
    words = " ".join(said.decode().split())
    counts = re.findall(r"safe (\d+) of \d+ runs|: (\d+) of \d+ runs are safe|: (\d+) runs are safe in", words)
    return max((int("".join(count)) for count in counts), default=0), "wrote r.h5" in words


class PowerLoss(shimmed.ShimmedTest):
    JOB = shimmed.JOB.replace("generations = 20", "generations = 200")  # so that runs are cut into several segments

    def story(self, *commands):
        """commands: words, or (words, seconds) for one that is told to stop then."""
        folder = self.folder()
        asked = []
        log = os.path.join(self.home, "log")
        settings = shimmed.changes(folder, log=log)
        for command in commands:
            words, seconds = command if isinstance(command[0], tuple) else (command, None)
            asked.append(words)
            process = folder.start(*words, changes=settings)
            if seconds is not None:
                try:
                    process.wait(timeout=seconds)
                except study.subprocess.TimeoutExpired:
                    process.send_signal(signal.SIGTERM)
            ended = study.Ended(process)
            # told to stop before it listens, a process ends as any: on a busy machine that may take as long as a run
            early = () if seconds is None else (-signal.SIGTERM,)
            self.assertIn(ended.code, (0, 75, *early), ended.err)
        steps = read_log(log)
        os.remove(log)
        return Story(folder, asked, steps)

    def stories(self):
        long = ("run", "job.toml", "--out", "r.h5", "--threads", "2", "--save-every", "0.003")
        yield self.story(shimmed.RUN)
        yield self.story(shimmed.shard(0, 2), shimmed.shard(1, 2), shimmed.MERGE)
        yield self.story(shimmed.shard(2, 3), shimmed.RUN)
        yield self.story((*shimmed.RUN, "--save-every", "0.003"))
        yield self.story((long, 0.6 * self.seconds), (long, 0.8 * self.seconds), shimmed.RUN)

    def assert_nothing_final_is_torn(self, image, disk_names, story):
        """What has a final name is, byte for byte, what was meant to have it."""
        meant = {os.path.relpath(path, story.folder.path): bytes(file.now) for path, file in disk_names}
        for name, content in image.items():
            if content is None or ".tmp." in name or name.endswith(".lock"):
                continue
            self.assertTrue(content == meant[name], f"{name} has its name, but not its bytes")

    def check_image(self, story, count):
        disk = story.disk_after(count)
        ever = [(path, file) for path, file in disk.ever.items() if not isinstance(file, str)]
        image = disk.image(self.chance)
        self.assert_nothing_final_is_torn(image, ever, story)
        folder = study.Folder(self.new_path(), self.JOB)
        write_image({name: content for name, content in image.items() if name != "job.toml"}, folder.path)
        runs, complete = story.claims_on(disk)
        if complete:
            self.assertIn("r.h5", image, "a result that was announced")
        ended = self.run_in(folder, shimmed.RUN)
        self.assert_ended(ended, 0)
        self.assertNotIn("damaged", ended.said)
        if "already complete" not in ended.said:
            done = re.search(r"(\d+) of \d+ runs were done", ended.said)
            self.assertGreaterEqual(int(done.group(1)) if done else 0, runs,
                                    f"{runs} runs were called safe\n{ended.err}")
        self.assert_same(folder)
        study.shutil.rmtree(folder.path)
        return runs, "already complete" in ended.said

    def test_the_power_goes(self):
        stories = list(self.stories())
        # every moment of every story once, as far as the count goes; the rest by chance
        moments = [(story, count) for story in stories for count in range(len(story.steps) + 1)]
        self.chance.shuffle(moments)
        safe = complete = 0
        for i in range(IMAGES):
            story, count = moments[i % len(moments)]
            with self.subTest(image=i, step=count, of=len(story.steps)):
                runs, whole = self.check_image(story, count)
                safe += runs
                complete += whole
        print(
            f"{IMAGES} power cuts ({len(moments)} moments of {len(stories)} stories): {safe} runs were called safe "
            "and are, "
            f"{complete} results were whole, none differs",
            file=sys.stderr,
        )


if __name__ == "__main__":
    print(f"FAULT_SEED={study.SEED}", file=sys.stderr)
    unittest.main(verbosity=2)
