"""The runner of the suite with a stand-in for the engine: what it keeps, what it makes again, what counts as failure.

    test_run_suite.py MAKE_CASE

The stand-in says "none" to everything, writes down each call, and sees its folder: no truth may lie there.
"""
import contextlib
import io
import json
import os
import pathlib
import stat
import sys
import tempfile
import unittest

import run_suite
import score

MAKE_CASE = None
STAND_IN = """#!{python}
import json, os, sys
assert sys.argv[1:4] == ["diagnose", "job.toml", "--json"] and sys.argv[5] == "--out", sys.argv
seen = sorted(os.listdir("."))
with open("{calls}", "a") as calls:
    calls.write(json.dumps([os.path.basename(os.getcwd()), seen]) + "\\n")
if "{mode}" == "fails":
    sys.exit("cannot")
joint = {{"joint": 1, "effects": [], "baseline": {{"validation_relerr": 0.1}}}}
json.dump({{"schema": 1, "verdict": "none", "joints": [joint]}}, open(sys.argv[4], "w"))
"""


class RunSuite(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = pathlib.Path(folder.name)
        self.calls = self.folder / "calls.txt"
        self.out = self.folder / "out"

    def program(self, mode):
        path = self.folder / "stand_in"
        path.write_text(STAND_IN.format(python=sys.executable, calls=self.calls, mode=mode))
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return path

    def run_suite(self, mode="none", *options):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = run_suite.main([str(self.program(mode)), MAKE_CASE, str(self.out), *options])
        return code, out.getvalue(), err.getvalue()

    def called(self):
        return [json.loads(line) for line in self.calls.read_text().splitlines()] if self.calls.exists() else []

    def test_a_clean_suite_goes_right_and_is_not_run_twice(self):
        code, text, _ = self.run_suite("none", "--clean", "1..2", "--jobs", "2", "--all-right")
        self.assertEqual(code, 0, text)
        self.assertIn("clean_2", text)
        # the program saw the job and the recordings, nothing else
        self.assertEqual(sorted(self.called()), [["clean_1", list(run_suite.OPEN)], ["clean_2", list(run_suite.OPEN)]])
        board = json.loads((self.out / "board.json").read_text())
        table = {row["key"]: row for row in board["methods"]["torquescope"]["table"]}
        self.assertEqual((table["clean_none"]["hits"], table["clean_none"]["n"]), (2, 2))

        code, text, _ = self.run_suite("none", "--clean", "1..2", "--all-right")
        self.assertEqual((code, len(self.called())), (0, 2))
        self.assertIn("(kept)", text)

        # another program, a lost verdict, a lost recording: made again
        self.run_suite("none ", "--clean", "1..1")
        self.assertEqual(len(self.called()), 3)
        (self.out / "verdicts" / "clean_1.json").unlink()
        self.run_suite("none ", "--clean", "1..1")
        self.assertEqual(len(self.called()), 4)
        (self.out / "open" / "clean_1" / "train.csv").unlink()
        self.run_suite("none ", "--clean", "1..1")
        self.assertTrue((self.out / "open" / "clean_1" / "train.csv").exists())

    def test_drawn_cases_come_from_a_list_and_stay_neutral(self):
        names = self.folder / "names.txt"
        names.write_text("T0:3\nT6:late:1\n")
        code, text, error = self.run_suite("none", "--drawn", str(names), "--all-right")
        self.assertEqual(code, 0, text + error)
        self.assertRegex(text, r"T6 measurement decoys +1 +1 +0 +0")
        folders = [folder for folder, _ in self.called()]
        self.assertEqual([len(set(folders)), [len(folder) for folder in folders]], [2, [12, 12]])
        truths = [json.loads((self.out / "sealed" / folder / "truth.json").read_text()) for folder in folders]
        self.assertEqual([truth["drawn"] for truth in truths], ["T0:3", "T6:late:1"])
        for folder in folders:
            # what the program sees says nothing about tier, fault or effect
            job = (self.out / "open" / folder / "job.toml").read_text()
            for word in ("late", "T0", "T6", "clean", "drawn"):
                self.assertNotIn(word, job)
        self.run_suite("none", "--drawn", "T0:3,T6:late:1")
        self.assertEqual(len(self.called()), 2)
        code, _, error = self.run_suite("none", "--drawn", "T1:nothing:1:1")
        self.assertEqual(code, 64)
        self.assertIn("no effect named nothing", error)

    def test_silence_about_a_concealed_effect_is_not_right(self):
        code, text, _ = self.run_suite("none", "--cases", "oak", "--all-right")
        self.assertEqual(code, 1)
        self.assertIn("not right: oak", text)
        self.assertEqual(self.run_suite("none", "--cases", "oak")[0], 0)

    def test_a_program_that_fails_leaves_a_case_without_verdict(self):
        code, text, _ = self.run_suite("fails", "--clean", "1..1", "--all-right")
        self.assertEqual(code, 1)
        self.assertIn("FAILED with exit code 1", text)
        self.assertIn("missing", text)
        self.assertIn("cannot", (self.out / "logs" / "clean_1.txt").read_text())

    def test_a_shard_runs_its_share_and_the_shards_make_one_board(self):
        # one case for two shards: the second has nothing to do, which is no mistake
        for index in range(2):
            self.out = self.folder / f"shard_{index}"
            code, text, _ = self.run_suite("none", "--clean", "1..1", "--shard", f"{index}/2")
            self.assertEqual(code, 0)
            self.assertIn(f"shard {index} of 2: {1 - index} of 1 cases", text)
        self.assertEqual([folder for folder, _ in self.called()], ["clean_1"])
        with contextlib.redirect_stdout(io.StringIO()) as printed:
            code = score.main(
                [str(self.folder / "shard_0"), str(self.folder / "shard_1"), "--board", str(self.folder / "whole")]
            )
        self.assertEqual(code, 0)
        self.assertIn("1 cases", printed.getvalue())
        self.assertTrue((self.folder / "whole" / "board.h5").exists())
        self.assertEqual(self.run_suite("none", "--clean", "1..1", "--shard", "2/2")[0], 64)

    def test_words_it_does_not_understand(self):
        self.assertEqual(self.run_suite("none", "--clean", "5..1")[0], 64)
        code, _, error = self.run_suite("none", "--cases", "oak,nothing")
        self.assertEqual(code, 64)
        self.assertIn("no sealed case nothing", error)


if __name__ == "__main__":
    MAKE_CASE = os.path.abspath(sys.argv.pop())
    sys.exit(unittest.main())
