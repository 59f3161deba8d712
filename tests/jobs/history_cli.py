"""[output] history: a result that stores some generations is a full one without the others, however it was made.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/history_cli.py
"""

import filecmp
import os
import sys
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import cli_folder  # noqa: E402
import simulated_job  # noqa: E402

LAST = 40
# `de` stops early in some runs, `lshade` shrinks, `fade` has a controller
SEARCHES = [{"name": "ols"}, {"name": "de", "population": 12, "generations": LAST, "stagnation": 6},
            {"name": "lshade", "population": 16, "generations": LAST},
            {"name": "fade", "population": 12, "generations": LAST}]
HISTORIES = ("population", "fitness", "F", "CR", "PC", "FC", "best", "gap_history", "evaluations", "controller/F_path",
             "controller/CR_path")


def job(**output):
    return simulated_job.job(SEARCHES, experiment={"runs": 7}, output=output)


def rows_of(full, wanted, last):
    """Of a full history [run][generation] those of `wanted`, the run's last one in place of the first behind it."""
    rows = np.full((len(full), len(wanted), *full.shape[2:]), np.nan)
    for run, values in enumerate(full):
        for entry, generation in enumerate(wanted):
            rows[run, entry] = values[min(generation, last[run])]
            if generation >= last[run]:
                rows[run, entry + 1:] = values[-1]  # what stands behind the end: NaN, or the last count
                break
    return rows


class History(cli_folder.Folder):
    def made(self, name, text, *more):
        self.write("job.toml", text)
        outcome = self.run_here("run", "job.toml", "--out", name, "--quiet", *more)
        self.assertEqual(outcome.code, 0, outcome.err)

    def open(self, name):
        file = h5py.File(os.path.join(self.folder, name), locking=False)
        self.addCleanup(file.close)
        return file

    def size(self, name):
        return os.path.getsize(os.path.join(self.folder, name))

    def assert_same(self, one, other):
        self.assertTrue(filecmp.cmp(*(os.path.join(self.folder, name) for name in (one, other)), shallow=False), other)

    def assert_rows_of_the_full_one(self, full, thin, wanted):
        ended_early = 0
        for method in ("de", "lshade", "fade"):
            group, whole = thin["runs"][method], full["runs"][method]
            self.assertEqual(list(group["generation"]), wanted)
            last = np.isfinite(whole["best"][:]).sum(axis=1) - 1
            self.assertEqual(list(group["last_generation"]), list(last))
            ended_early += (last < LAST).sum()
            for name in HISTORIES:
                if name not in whole:
                    continue
                np.testing.assert_array_equal(group[name][:], rows_of(whole[name][:], wanted, last), f"{method} {name}")
            self.assertNotIn("last_state", group)
            for name in ("parameters", "mse", "gap", "stop_reason"):
                np.testing.assert_array_equal(group[name][:], whole[name][:])
        self.assertGreater(ended_early, 0)

    def test_some_generations_are_those_of_a_full_result(self):
        self.made("full.h5", job())
        full = self.open("full.h5")
        self.assertNotIn("last_generation", full["runs/de"])
        for word, wanted in (("every 9", [0, 9, 18, 27, 36, 40]), ("last", [40]), ("every 100", [0, 40])):
            self.made("thin.h5", job(history=word))
            with h5py.File(os.path.join(self.folder, "thin.h5"), locking=False) as thin:
                self.assert_rows_of_the_full_one(full, thin, wanted)
            self.assertLess(self.size("thin.h5"), self.size("full.h5"))
            self.assertEqual(self.run_here("show", "thin.h5", "--verify").code, 0)
            os.remove(os.path.join(self.folder, "thin.h5"))

    def test_full_is_the_default(self):
        self.made("full.h5", job(compression="none"))
        self.made("said.h5", job(history="full"))
        full, said = self.open("full.h5"), self.open("said.h5")
        self.assertEqual(list(full["runs/de/generation"]), list(range(LAST + 1)))
        for method in ("de", "lshade", "fade"):
            self.assertEqual(set(full["runs"][method]), set(said["runs"][method]))
            np.testing.assert_array_equal(full["runs"][method]["population"][:], said["runs"][method]["population"][:])

    def test_threads_shards_and_a_stop_change_no_byte(self):
        for word, more in (("every 9", {}), ("last", {}), ("every 4", {"populations": False, "compression": "gzip"})):
            text = job(history=word, **more)
            self.made("one.h5", text, "--threads", "1")
            self.made("three.h5", text, "--threads", "3")
            self.assert_same("one.h5", "three.h5")
            for shard in range(3):
                self.made("merged.h5", text, "--shard", f"{shard}/3")
            self.assertEqual(self.run_here("merge", "job.toml", "--out", "merged.h5", "--quiet").code, 0)
            self.assert_same("one.h5", "merged.h5")
            for shard in (0, 2):
                self.made("resumed.h5", text, "--shard", f"{shard}/3")
            self.made("resumed.h5", text)
            self.assert_same("one.h5", "resumed.h5")
            for name in ("one.h5", "three.h5", "merged.h5", "resumed.h5"):
                os.remove(os.path.join(self.folder, name))

    def test_a_partial_merge_says_which_runs_have_no_generation(self):
        self.made("some.h5", job(history="last"), "--shard", "0/2")
        self.assertEqual(self.run_here("merge", "job.toml", "--out", "some.h5", "--partial", "--quiet").code, 0)
        group = self.open("some.h5")["runs/fade"]
        self.assertEqual(list(group["last_generation"]), [LAST] * 3 + [-1] * 4)
        self.assertEqual(list(np.isfinite(group["best"][:, 0])), [True] * 3 + [False] * 4)

    def test_a_full_result_goes_on_into_a_thin_one_and_not_the_other_way(self):
        longer = [{**one, "generations": 60} if one["name"] in ("fade", "de") else one
                  for one in SEARCHES if one["name"] != "lshade"]
        shorter = [one for one in SEARCHES if one["name"] != "lshade"]
        thin = simulated_job.job(longer, output={"history": "every 7"})
        self.made("full.h5", simulated_job.job(shorter))
        self.made("whole.h5", thin)
        self.made("longer.h5", thin, "--continue", "full.h5")
        self.assert_same("whole.h5", "longer.h5")
        self.made("last.h5", simulated_job.job(shorter, output={"history": "last"}))
        self.write("job.toml", thin)
        outcome = self.run_here("run", "job.toml", "--out", "new.h5", "--continue", "last.h5", "--quiet")
        self.assert_refused(outcome, 78, ["last.h5 stores some generations of de only", 'history = "full"'])

    def test_another_word_is_refused_where_it_stands(self):
        for word in ("every", "every 0", "some"):
            text = job(history=word)
            self.write("job.toml", text)
            line = 1 + text.splitlines().index(f'history = "{word}"')
            for command in ("run", "check"):
                self.assert_refused(self.run_here(command, "job.toml"), 78,
                                    [f"job.toml:{line}:", f'history = "{word}" names no generations', '"every 10"'])


if __name__ == "__main__":
    unittest.main(verbosity=1)
