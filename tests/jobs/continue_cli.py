"""run --continue: a search that ended goes on under a larger budget, or is refused with the way out.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/continue_cli.py
"""

import json
import os
import sys
import unittest

import h5py

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
import cli_folder  # noqa: E402
import simulated_job  # noqa: E402


def searches(generations, **more):
    return [{"name": "ols"}, *({"name": name, "population": 12, "generations": generations, **more}
                               for name in ("de", "fade", "cmaes"))]


SHORT, LONG = simulated_job.job(searches(30)), simulated_job.job(searches(60))


class Continue(cli_folder.Folder):
    def bytes_of(self, name):
        with open(os.path.join(self.folder, name), "rb") as file:
            return file.read()

    def made(self, name, job, *more):
        self.write("job.toml", job)
        outcome = self.run_here("run", "job.toml", "--out", name, *more)
        self.assertEqual(outcome.code, 0, outcome.err)
        return outcome

    def test_thirty_generations_and_thirty_more_are_sixty(self):
        self.made("whole.h5", LONG, "--quiet")
        self.made("lab.h5", SHORT, "--quiet")
        short = self.bytes_of("lab.h5")
        # without being asked nothing goes on, and the way is told
        self.write("job.toml", LONG)
        self.assert_refused(self.run_here("run", "job.toml", "--out", "lab.h5"), 73,
                            ["--continue lab.h5 when only stop rules changed"])
        told = self.made("longer.h5", LONG, "--continue", "lab.h5", "--threads", "1")
        self.assert_page(told.err)
        for method in ("de", "fade", "cmaes"):
            self.assertIn(f"continue {method}: 3 runs go on from generation 30\n", told.err)
        self.assertEqual(self.bytes_of("lab.h5"), short)
        self.assertEqual(self.bytes_of("longer.h5"), self.bytes_of("whole.h5"))
        # under its own name it is replaced; then there is nothing left to do
        self.made("lab.h5", LONG, "--continue", "lab.h5")
        self.assertEqual(self.bytes_of("lab.h5"), self.bytes_of("whole.h5"))
        self.assertIn("nothing runs again", self.made("lab.h5", LONG, "--continue", "lab.h5").err)
        with open(os.path.join(self.folder, "lab.h5.made.json"), encoding="utf-8") as file:
            self.assertRegex(json.load(file)["continued"], "^[0-9a-f]{64}$")
        self.assertEqual(self.run_here("show", "lab.h5", "--verify").code, 0)

    def test_killed_and_stopped_it_leaves_the_old_result_and_ends_as_one_search(self):
        short, long = (simulated_job.job(searches(generations, fitness="direct"), output={"populations": keeps})
                       for generations, keeps in ((30, True), (20000, False)))
        self.made("whole.h5", long, "--quiet")
        self.made("lab.h5", short, "--quiet")
        old = self.bytes_of("lab.h5")
        self.write("job.toml", long)
        command = ("run", "job.toml", "--out", "lab.h5", "--continue", "lab.h5", "--save-every", "0.05")
        process = program.start(*command, folder=self.folder)
        self.assertTrue(program.wait_for_line(process, "continue cmaes"))
        process.kill()
        process.communicate(timeout=program.SECONDS)
        self.assertEqual(self.bytes_of("lab.h5"), old)
        stopped = self.run_here(*command, "--time-budget", "0.1")
        self.assertEqual(stopped.code, 75, stopped.err)
        self.assertEqual(self.bytes_of("lab.h5"), old)
        self.made("lab.h5", long, "--continue", "lab.h5")
        self.assertEqual(self.bytes_of("lab.h5"), self.bytes_of("whole.h5"))

    def test_without_another_name_it_grows_in_place(self):
        self.made("whole.h5", LONG, "--quiet")
        self.made("old.h5", SHORT, "--quiet")
        self.write("job.toml", LONG)
        outcome = self.run_here("run", "job.toml", "--continue", "old.h5")
        self.assertEqual(outcome.code, 0, outcome.err)
        self.assertEqual(self.bytes_of("old.h5"), self.bytes_of("whole.h5"))

    def test_shards_go_on_and_merge(self):
        self.made("whole.h5", LONG, "--quiet")
        self.made("old.h5", SHORT, "--quiet")
        for shard in ("0/2", "1/2"):
            self.made("r.h5", LONG, "--continue", "old.h5", "--shard", shard)
        self.assertEqual(self.run_here("merge", "job.toml", "--out", "r.h5").code, 0)
        self.assertEqual(self.bytes_of("r.h5"), self.bytes_of("whole.h5"))

    def refused(self, job, code, words, result="old.h5"):
        self.write("job.toml", job)
        outcome = self.run_here("run", "job.toml", "--out", "new.h5", "--continue", result, "--quiet")
        self.assert_refused(outcome, code, words)
        self.assertFalse([name for name in os.listdir(self.folder) if name.startswith("new.h5")])

    def test_another_search_is_refused_with_what_differs(self):
        self.made("old.h5", SHORT, "--quiet")
        self.refused(LONG.replace("seed = 7", "seed = 8"), 78,
                     ["old.h5 is of another search", "experiment.seed: 7 then, 8 now", "only stop rules may change"])
        self.refused(simulated_job.job(searches(60, fitness="direct")), 78, ['write fitness = "gram" for de'])
        self.refused(simulated_job.job(searches(20)), 78, ["job.toml:", "generations of de is stricter than it was"])
        self.refused(LONG, 66, ["none.h5"], result="none.h5")
        self.refused(LONG, 65, ["good.csv"], result="good.csv")

    def test_what_holds_no_state_is_refused(self):
        self.made("old.h5", SHORT.replace("[filter]", "[output]\npopulations = false\n[filter]"), "--quiet")
        self.refused(LONG, 78, ["old.h5 keeps no states of de to go on from", "populations = true"])
        self.made("old2.h5", simulated_job.job([{"name": "lshade", "generations": 30}]), "--quiet")
        self.refused(simulated_job.job([{"name": "lshade", "generations": 60}]), 78,
                     ["lshade spends its budget by a plan"], result="old2.h5")
        self.made("old3.h5", SHORT, "--quiet")
        with h5py.File(os.path.join(self.folder, "old3.h5"), "r+", locking=False) as file:
            file["runs/de/last_state/numbers"][0] += 1
        self.refused(LONG, 65, ["old3.h5"], result="old3.h5")


if __name__ == "__main__":
    unittest.main(verbosity=1)
