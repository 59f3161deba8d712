"""Folders of the suite become one board: shards, rivals, seals, contradictions, what is stored, what is printed."""
import contextlib
import hashlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

import h5py

import gather
import score
import shard
from example_cases import clean, drawn, effect, truth, verdict


class Folders(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.root = pathlib.Path(folder.name)

    def put(self, out, made, answer, name=None, seal=None, method=None):
        """A case in the folder `out` as run_suite.py leaves it; answer: verdict, text of a broken one, or None."""
        name = name or made["case"]
        sealed = self.root / out / "sealed" / name / "truth.json"
        sealed.parent.mkdir(parents=True, exist_ok=True)
        sealed.write_text(json.dumps(made) if isinstance(made, dict) else made)
        notes = self.root / out / "made.json"
        known = json.loads(notes.read_text()) if notes.exists() else {}
        known[name] = {"seal": seal or hashlib.sha256(sealed.read_bytes()).hexdigest(), "plant": "p" * 64,
                       "diagnosed": {"engine": "e" * 64, "seconds": 2.5, "exit_code": 0}}
        notes.write_text(json.dumps(known))
        if answer is not None:
            path = self.root / out / (f"rivals/{method}" if method else "verdicts") / f"{name}.json"
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_text(answer if isinstance(answer, str) else json.dumps(answer))

    def score(self, *words):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = score.main([str(self.root / word) if not word.startswith("--") else word for word in words])
        board = self.root / "one" / "board.json"
        return code, out.getvalue(), err.getvalue(), json.loads(board.read_text()) if board.exists() else None

    def row(self, board, key, method=gather.OURS):
        return next(row for row in board["methods"][method]["table"] if row["key"] == key)


class Board(Folders):
    def test_counts_missing_verdicts_in_the_denominator(self):
        for name, answer in (("a", verdict("none")), ("b", "not json"), ("c", None)):
            self.put("one", clean(), answer, name)
        code, text, _, board = self.score("one", "--cases")
        self.assertEqual(code, 0)
        self.assertEqual([self.row(board, "clean_none")[key] for key in ("hits", "n")], [1, 3])
        self.assertEqual(self.row(board, "no_answer")["hits"], 2)
        # silence is not caution
        self.assertEqual(self.row(board, "clean_false_name")["hits"], 2)
        self.assertIn("missing", text)

    def test_small_effects_do_not_enter_the_naming_rates(self):
        self.put("one", truth(), verdict("named", [effect()]), "a")
        self.put("one", truth(snr=0.5), None, "b")
        self.assertEqual(self.row(self.score("one")[3], "single_exact")["n"], 1)

    def test_all_right_means_every_case(self):
        self.put("one", clean(), verdict("none"), "a")
        self.put("one", truth(), verdict("named", [effect()]), "b")
        self.assertEqual(self.score("one", "--all-right")[0], 0)
        self.put("one", truth(), verdict("none"), "b")
        code, text, _, _ = self.score("one", "--all-right")
        self.assertEqual(code, 1)
        self.assertIn("not right: x", text)

    def test_no_truth_and_damaged_truth(self):
        (self.root / "one").mkdir()
        self.assertEqual(self.score("one")[0], 66)
        for damaged in ("{", json.dumps({"case": "a"})):
            self.put("one", damaged, None, "a")
            self.assertEqual(self.score("one")[0], 65)

    def test_a_plant_that_was_not_exact_is_left_out_of_every_rate_and_named(self):
        chaotic = drawn(truth(), "T1:backlash:2:300001", 2.0)
        chaotic["step_error"] = {"torque": 0.28, "position": 0.37}
        self.put("one", drawn(truth(), "T1:stribeck:2:300001", 2.0), verdict("named", [effect()]))
        whole = self.score("one")[3]
        # whatever was answered, right, wrong or nothing, and by whom
        for answer in (verdict("named", [effect()]), verdict("named", [effect("cogging", "order_locked")]), None):
            self.put("one", chaotic, answer)
            code, text, _, board = self.score("one")
            self.assertEqual((code, board["suite"]["cases"]), (0, 1))
            self.assertEqual(board["methods"], whole["methods"])
            self.assertEqual(board["suite"]["left_out"],
                             [{"case": "T1:backlash:2:300001", "folder": chaotic["case"], "step_error": 0.37}])
            said = "cases left out, plant not exact (1 of 2): T1:backlash:2:300001 (0.37 of the noise)"
            self.assertIn(said, text)
            self.assertIn(said, self.score("one", "--markdown")[1])
        with h5py.File(self.root / "one" / "board.h5") as file:
            self.assertEqual(file.attrs["left_out"], "T1:backlash:2:300001")
            self.assertEqual(list(file["cases/drawn"].asstr()), ["T1:stribeck:2:300001"])
        # what cannot be judged is not right
        code, text, _, _ = self.score("one", "--all-right")
        self.assertEqual(code, 1)
        self.assertIn("not right: T1:backlash:2:300001 (left out)", text)

    def test_a_suite_without_an_exact_plant_has_no_board(self):
        self.put("one", {**clean(), "step_error": {"torque": None, "position": 0.0}}, verdict("none"))
        code, _, error, _ = self.score("one")
        self.assertEqual(code, 66)
        self.assertIn("no exact truth", error)

    def test_names_of_an_earlier_command_stay_out(self):
        self.put("one", clean(), verdict("none"), "a")
        self.put("one", clean(), verdict("none"), "b")
        self.assertEqual(list(gather.find([self.root / "one"], {"b"})), ["b"])

    def test_prints_the_table_for_a_terminal_and_as_markdown(self):
        self.put("one", drawn(clean(), "T0:300001"), verdict("none"))
        self.put("one", drawn(truth(), "T1:stribeck:2:300001", 2.0), verdict("named", [effect()]))
        code, text, _, board = self.score("one")
        self.assertEqual((code, board["suite"]["suite_seeds"]), (0, [3]))
        self.assertIn(board["suite"]["truths_sha256"], text)
        self.assertRegex(text, r"family of the first name +100.0 %  \(1 of 1\) +5.0 % to 100.0 % +≥ 92.5 % +\?")
        markdown = self.score("one", "--markdown")[1].splitlines()
        rows = [line for line in markdown if line.startswith("|")]
        self.assertEqual(len(rows), 2 + len(board["methods"][gather.OURS]["table"]))
        self.assertEqual({line.count("|") for line in rows}, {8})


class Shards(Folders):
    def test_shards_make_one_board(self):
        self.put("one", clean(), verdict("none"), "a")
        self.put("two", clean(), verdict("none"), "b")
        self.put("two", clean(), verdict("none"), "a")  # the same case with the same answer
        code, _, _, board = self.score("one", "two")
        self.assertEqual((code, board["suite"]["cases"]), (0, 2))
        whole = gather.seal_of_all(gather.find([self.root / "one", self.root / "two"]).values())
        self.assertEqual(gather.seal_of_all(gather.find([self.root / "two", self.root / "one"]).values()), whole)

    def test_an_answer_is_taken_from_the_shard_that_has_it(self):
        self.put("one", clean(), None, "a")
        self.put("two", clean(), verdict("none"), "a")
        for folders in (("one", "two"), ("two", "one")):
            board = self.score(*folders, "--board", "one")[3]
            self.assertEqual(self.row(board, "no_answer")["hits"], 0)

    def test_contradictions_say_which_case(self):
        self.put("one", clean(), verdict("none"), "a")
        self.put("two", clean(), verdict("unexplained"), "a")
        code, _, error, _ = self.score("one", "two")
        self.assertEqual(code, 65)
        self.assertRegex(error, "a: another verdict in .*two than in .*one")
        self.put("two", truth(), verdict("none"), "a")
        code, _, error, _ = self.score("one", "two")
        self.assertEqual(code, 65)
        self.assertRegex(error, "a: sealed as .* in .*one and as .* in .*two")

    def test_a_truth_changed_after_sealing_is_refused(self):
        self.put("one", clean(), verdict("none"), "a", seal="0" * 64)
        code, _, error, _ = self.score("one")
        self.assertEqual(code, 65)
        self.assertIn("not the truth that was sealed", error)

    def test_every_case_belongs_to_one_shard(self):
        cases = list(range(10))
        shares = [shard.share(cases, shard.of(f"{i}/3", {})) for i in range(3)]
        self.assertEqual(sorted(sum(shares, [])), cases)
        self.assertEqual([len(one) for one in shares], [4, 3, 3])
        self.assertTrue(all(one == sorted(one) for one in shares))
        self.assertEqual(shard.share(cases, shard.of(None, {})), cases)
        for wrong in ("3/3", "1", "a/b", "-1/3"):
            with self.assertRaises(ValueError):
                shard.of(wrong, {})

    def test_a_share_has_every_size(self):
        pairs = [f"T2:a+b:{size}:{seed}" for seed, size in enumerate([1, 2, 4] * 67)]
        for index in range(18):
            sizes = {name.split(":")[2] for name in shard.share(pairs, (index, 18))}
            self.assertEqual(sizes, {"1", "2", "4"}, index)

    def test_slurm_says_which_share(self):
        array = {
            "SLURM_ARRAY_TASK_COUNT": "5",
            "SLURM_ARRAY_TASK_ID": "10",
            "SLURM_ARRAY_TASK_MIN": "2",
            "SLURM_ARRAY_TASK_STEP": "4",
        }
        self.assertEqual(shard.of(None, array), (2, 5))
        self.assertEqual(shard.of("1/2", array), (1, 2))
        step = {"SLURM_PROCID": "3", "SLURM_NTASKS": "8", "SLURM_STEP_ID": "0"}
        self.assertEqual(shard.of(None, step), (3, 8))
        # the batch script runs alone, whatever its number of tasks
        self.assertIsNone(shard.of(None, {"SLURM_PROCID": "0", "SLURM_NTASKS": "8"}))


class Rivals(Folders):
    def test_rivals_are_judged_by_the_same_functions(self):
        named = {"case": "a", "verdict": "named", "effects": [{"name": "cogging", "family": "order_locked"}]}
        self.put("one", clean(), verdict("none"), "a")
        self.put("one", clean(), named, "a", method="lasso")
        self.put("one", truth(), verdict("named", [effect()]), "b")
        code, text, _, board = self.score("one")
        self.assertEqual((code, list(board["methods"])), (0, ["torquescope", "lasso"]))
        self.assertEqual([self.row(board, "clean_false_name", method)["hits"] for method in board["methods"]], [0, 1])
        # a rival without a file for a case did not answer it
        self.assertEqual(self.row(board, "no_answer", "lasso")["hits"], 1)
        self.assertRegex(text, r"(?m)^Clean records with a false name +0.0 % +100.0 %$")
        self.assertIn("lasso |", self.score("one", "--markdown")[1])
        with h5py.File(self.root / "one" / "board.h5") as file:
            self.assertEqual(sorted(file["methods"]), ["lasso", "torquescope"])
            self.assertEqual(list(file["methods/lasso/cases/verdict"].asstr()), ["named", "missing"])


class Stored(Folders):
    def test_the_file_holds_every_case_and_the_table(self):
        self.put("one", drawn(clean(), "T0:7"), verdict("none"))
        self.put("one", drawn(truth(), "T1:stribeck:2:4", 2.0), verdict("named", [{**effect(), "q": 0.02}]))
        board = self.score("one")[3]
        with h5py.File(self.root / "one" / "board.h5") as file:
            self.assertEqual(file.attrs["truths_sha256"], board["suite"]["truths_sha256"])
            self.assertEqual((file.attrs["programs_sha256"], file.attrs["plants_sha256"]), ("e" * 64, "p" * 64))
            self.assertEqual(list(file.attrs["suite_seeds"]), [0])
            cases, ours = file["cases"], file["methods/torquescope"]
            self.assertEqual(list(cases["drawn"].asstr()), ["T0:7", "T1:stribeck:2:4"])
            self.assertEqual((list(cases["seed"]), list(cases["snr_eff"])), ([7, 4], [0.0, 3.0]))
            self.assertEqual(
                list(cases["seal"].asstr()), [case["seal"] for case in board["methods"]["torquescope"]["cases"]]
            )
            self.assertEqual(list(ours["cases/names"].asstr()), ["", "stribeck"])
            self.assertAlmostEqual(ours["cases/iou"][1], 1.0)
            self.assertEqual(list(ours["cases/seconds"]), [2.5, 2.5])
            table = {key: ours["table/value"][i] for i, key in enumerate(ours["table/key"].asstr())}
            self.assertEqual((table["single_exact"], table["clean_false_name"]), (1.0, 0.0))
            self.assertEqual(ours["confusion/effects/counts"][()].tolist(), [[1]])
            self.assertAlmostEqual(ours["confidence"].attrs["brier"], 0.0004)
            described = []
            file.visititems(
                lambda name, one: described.append((name, set(one.attrs))) if isinstance(one, h5py.Dataset) else None
            )
            self.assertEqual([name for name, attributes in described if not {"unit", "long_name"} <= attributes], [])


if __name__ == "__main__":
    sys.exit(unittest.main())
