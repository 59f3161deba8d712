"""The scorer on hand-made truths and verdicts: perfect, wrong, abstaining, missing, broken."""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import unittest

import binomial
import judge
import score


def size(snr):
    return {"snr_eff": snr, "torque_share": 0.01 * snr}


def true_effect(name="stribeck", families=("reversal", "velocity_law"), catalogue_form=True, snr=3.0):
    region = {"axis": "velocity", "edges": [-2.0, -1.0, 0.0, 1.0, 2.0], "occupancy": [0.25] * 4,
              "inside": [False, True, True, False]}
    return {"name": name, "families": list(families), "catalogue_form": catalogue_form, "size": size(snr),
            "parameters": [{"name": "stribeck", "value": 0.5}], "regions": [region]}


def truth(expected="named", effects=None, snr=3.0):
    effects = [true_effect(snr=snr)] if effects is None else effects
    return {"case": "x", "expected": expected, "size": size(snr), "effects": effects,
            "relerr": {"validate": {"baseline": 0.11, "oracle": 0.01}}, "step_error": {"torque": 1e-6, "position": 1e-6}}


def clean():
    return truth("none", [], 0.0)


def effect(name="stribeck", family="reversal", equivalent=(), low=-1.0, high=1.0):
    return {"name": name, "family": family, "equivalent": list(equivalent), "region": {"axis": "velocity", "from": low, "to": high},
            "parameters": [{"name": "stribeck", "value": 0.55, "ci95": [0.45, 0.65]}]}


def verdict(kind="named", effects=()):
    joint = {"effects": list(effects), "baseline": {"validation_relerr": 0.11}, "augmented": {"validation_relerr": 0.02}}
    return {"schema": 1, "verdict": kind, "joints": [joint]}


class Binomial(unittest.TestCase):
    def test_closed_forms_at_the_ends(self):
        self.assertAlmostEqual(binomial.upper(0, 12), 1 - 0.05 ** (1 / 12), 9)
        self.assertAlmostEqual(binomial.lower(12, 12), 0.05 ** (1 / 12), 9)
        self.assertEqual(binomial.upper(5, 5), 1.0)
        self.assertEqual(binomial.lower(0, 5), 0.0)

    def test_sample_sizes_of_the_protocol(self):
        # PHYSICS.md section 4: 16 of 500 stays below 5 %, 371 of 400 above 90 %; one more or less does not
        self.assertLess(binomial.upper(16, 500), 0.05)
        self.assertGreater(binomial.upper(17, 500), 0.05)
        self.assertGreater(binomial.lower(371, 400), 0.90)
        self.assertLess(binomial.lower(369, 400), 0.90)


class Judge(unittest.TestCase):
    def test_perfect_verdict(self):
        j = judge.judge(truth(), verdict("named", [effect()]))
        self.assertTrue(j.right and j.reached("exact") and j.found[0].first)
        self.assertEqual(j.false_names, ())
        self.assertAlmostEqual(j.found[0].iou, 1.0)
        self.assertAlmostEqual(j.found[0].parameter_error, 0.1)
        self.assertEqual(j.found[0].intervals, (True,))
        self.assertAlmostEqual(j.gap_closed, 0.9)

    def test_wrong_name_is_a_false_name_and_a_miss(self):
        j = judge.judge(truth(), verdict("named", [effect("cogging", "order_locked")]))
        self.assertFalse(j.right)
        self.assertEqual(j.false_names, ("cogging",))
        self.assertEqual(j.found[0].level, "missed")

    def test_class_and_family(self):
        j = judge.judge(truth(), verdict("class", [effect("presliding", equivalent=["stribeck"])]))
        self.assertTrue(j.right and j.reached("class") and not j.reached("exact"))
        j = judge.judge(truth(), verdict("named", [effect("backlash")]))
        self.assertEqual((j.found[0].level, j.right, j.false_names), ("family", False, ()))

    def test_family_is_enough_for_another_form(self):
        j = judge.judge(truth(effects=[true_effect(catalogue_form=False)]), verdict("named", [effect("presliding")]))
        self.assertTrue(j.right)

    def test_family_is_one_of_those_the_catalogue_puts_the_truth_into(self):
        other_form = truth(effects=[true_effect(catalogue_form=False)])
        self.assertTrue(judge.judge(other_form, verdict("named", [effect("power_law_viscous", "velocity_law")])).right)
        # the family of what is reported has to be the truth's, not the other way round
        one_sided = truth(effects=[true_effect("presliding", ["reversal"], False)])
        j = judge.judge(one_sided, verdict("named", [effect("power_law_viscous", "velocity_law")]))
        self.assertEqual((j.found[0].level, j.right, j.false_names), ("missed", False, ("power_law_viscous",)))

    def test_family_is_not_enough_for_a_law_of_the_catalogue(self):
        self.assertFalse(judge.judge(truth(), verdict("named", [effect("power_law_viscous", "velocity_law")])).right)

    def test_class_answers_by_its_name_or_by_an_equivalent(self):
        for answer in (effect("presliding", equivalent=["backlash", "stribeck"]), effect(equivalent=["presliding"])):
            self.assertTrue(judge.judge(truth(), verdict("class", [answer])).right)
        j = judge.judge(truth(), verdict("class", [effect("delay", "acceleration", equivalent=["backlash"])]))
        self.assertEqual((j.right, j.false_names), (False, ("delay",)))

    def test_class_answers_one_truth_only(self):
        pair = truth(effects=[true_effect(), true_effect("presliding", ["reversal"])])
        answer = effect("maxwell_slip", equivalent=["stribeck", "presliding"])
        j = judge.judge(pair, verdict("class", [answer]))
        self.assertEqual(([f.level for f in j.found], j.right), (["class", "missed"], False))
        self.assertEqual(j.found[0].n_equivalent, 2)

    def test_abstaining_with_a_name_is_no_abstention(self):
        outside = truth("unexplained", [true_effect(name="", families=())])
        self.assertFalse(judge.judge(outside, verdict("unexplained", [effect()])).right)
        self.assertFalse(judge.judge(clean(), verdict("none", [effect()])).right)

    def test_refuses_a_truth_of_an_older_plant(self):
        old = truth()
        del old["effects"][0]["families"]
        with self.assertRaises(ValueError):
            judge.judge(old, verdict("none"))

    def test_second_name_of_the_same_family_is_false(self):
        j = judge.judge(truth(), verdict("named", [effect("presliding"), effect()]))
        self.assertEqual(j.false_names, ("presliding",))
        self.assertEqual(j.found[0].level, "exact")
        self.assertFalse(j.found[0].first or j.right)

    def test_abstaining(self):
        for kind in ("unexplained", "insufficient", "none"):
            self.assertFalse(judge.judge(truth(), verdict(kind)).right)
        small = judge.judge(truth(snr=0.2), verdict("none"))
        self.assertTrue(small.right)
        self.assertFalse(judge.judge(truth(snr=0.2), verdict("named", [effect("spring", "static_position")])).right)

    def test_clean(self):
        self.assertTrue(judge.judge(clean(), verdict("none")).right)
        self.assertFalse(judge.judge(clean(), verdict("unexplained")).right)
        j = judge.judge(clean(), verdict("named", [effect()]))
        self.assertEqual((j.right, j.false_names), (False, ("stribeck",)))

    def test_outside_the_catalogue(self):
        outside = truth("unexplained", [true_effect(name="", families=())])
        self.assertTrue(judge.judge(outside, verdict("unexplained")).right)
        self.assertFalse(judge.judge(outside, verdict("named", [effect()])).right)
        self.assertEqual(judge.judge(outside, verdict("unexplained", [effect("x", "")])).false_names, ("x",))

    def test_pair_needs_both(self):
        pair = truth(effects=[true_effect(), true_effect("spring", ["static_position"])])
        self.assertFalse(judge.judge(pair, verdict("named", [effect()])).right)
        self.assertTrue(judge.judge(pair, verdict("named", [effect("spring", "static_position"), effect()])).right)

    def test_region_overlap_counts_samples(self):
        self.assertAlmostEqual(judge.region_iou({"axis": "velocity", "from": 0.0, "to": 2.0}, true_effect()["regions"]), 1 / 3)
        self.assertAlmostEqual(judge.region_iou({"axis": "velocity", "from": -0.5, "to": 0.5}, true_effect()["regions"]), 0.5)
        self.assertIsNone(judge.region_iou({"axis": "time", "from": 0, "to": 1}, true_effect()["regions"]))

    def test_missing_and_broken_verdicts_are_failures(self):
        self.assertEqual(judge.judge(clean(), None).verdict, "missing")
        self.assertFalse(judge.judge(clean(), None).right)
        for broken in ({}, {"schema": 2, "verdict": "none", "joints": []}, {"schema": 1, "verdict": "maybe", "joints": []},
                       {"schema": 1, "verdict": "none", "joints": [{}]}):
            self.assertEqual(judge.judge(clean(), broken).verdict, "invalid")
            self.assertFalse(judge.judge(clean(), broken).right)

    def test_unknown_numbers_are_no_broken_verdict(self):
        vague = effect(low=None, high=None)
        vague["parameters"][0]["ci95"] = [None, None]
        answer = verdict("named", [vague])
        answer["joints"][0]["baseline"]["validation_relerr"] = answer["joints"][0]["augmented"]["validation_relerr"] = None
        j = judge.judge(truth(), answer)
        self.assertEqual((j.verdict, j.right, j.gap_closed, j.found[0].iou, j.found[0].intervals), ("named", True, None, None, ()))
        vague["parameters"][0]["value"] = None
        self.assertIsNone(judge.judge(truth(), verdict("named", [vague])).found[0].parameter_error)

    def test_refuses_a_coarse_truth(self):
        coarse = clean()
        coarse["step_error"]["torque"] = 0.02
        with self.assertRaises(ValueError):
            judge.judge(coarse, verdict("none"))


class Tiers(unittest.TestCase):
    def decoy(self):
        return {**clean(), "expected": "measurement", "tier": "T6", "drawn": "T6:late:1", "may_name": ["delay"]}

    def test_a_decoy_must_not_be_called_physics(self):
        for kind in ("none", "unexplained", "insufficient", "data_fault"):
            self.assertTrue(judge.judge(self.decoy(), verdict(kind)).right)
        self.assertTrue(judge.judge(self.decoy(), verdict("named", [effect("delay", "acceleration")])).right)
        self.assertTrue(judge.judge(self.decoy(), verdict("class", [effect("backlash", equivalent=["delay"])])).right)
        j = judge.judge(self.decoy(), verdict("named", [effect("delay", "acceleration"), effect()]))
        self.assertEqual((j.right, j.false_names), (False, ("stribeck",)))
        self.assertFalse(judge.judge(self.decoy(), None).right)
        with self.assertRaises(ValueError):
            judge.judge({key: value for key, value in self.decoy().items() if key != "may_name"}, verdict("none"))

    def test_weak_motion_wants_a_class_or_no_answer(self):
        weak = lambda snr=3.0: truth("insufficient", snr=snr)
        self.assertTrue(judge.judge(weak(), verdict("insufficient")).right)
        self.assertTrue(judge.judge(weak(), verdict("class", [effect("presliding", equivalent=["stribeck"])])).right)
        self.assertFalse(judge.judge(weak(), verdict("class", [effect("cogging", "order_locked")])).right)
        self.assertFalse(judge.judge(weak(), verdict("named", [effect()])).right)
        self.assertFalse(judge.judge(weak(), verdict("none")).right)
        self.assertTrue(judge.judge(weak(0.1), verdict("none")).right)

    def judged(self, tier, size, answer, expected="named"):
        made = truth(expected, None if expected == "named" else [], size)
        return judge.judge({**made, "tier": tier, "drawn": f"{tier}:x:{size}", "wanted_snr": size}, answer)

    def test_tiers_and_sizes_are_counted_apart(self):
        right, silent = verdict("named", [effect()]), verdict("none")
        all_of = [self.judged("T1", 0.5, silent), self.judged("T1", 0.5, right), self.judged("T1", 2.0, right),
                  self.judged("T0", 0.0, silent, "none"), judge.judge(clean(), silent)]
        tiers, curve = score.by_tier(all_of), score.power_curve(all_of)
        self.assertEqual({tier: board["cases"] for tier, board in tiers.items()}, {"T0": 1, "T1": 3})
        self.assertEqual(tiers["T0"]["clean: verdict none"]["hits"], 1)
        self.assertEqual(list(curve), ["T1"])
        self.assertEqual([(size, row["family"]["hits"], row["family"]["of"]) for size, row in curve["T1"].items()],
                         [("0.5", 1, 2), ("2", 1, 1)])
        # the protocol's naming rate begins at SNR_eff 1
        self.assertEqual(tiers["T1"]["single: family"]["of"], 1)
        self.assertEqual(len(score.power_lines(curve)), 3)


class Board(unittest.TestCase):
    def run_score(self, truths, verdicts, *options):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            for case, text in truths.items():
                (folder / case).mkdir()
                (folder / case / "truth.json").write_text(text)
            (folder / "verdicts").mkdir()
            for case, text in verdicts.items():
                (folder / "verdicts" / f"{case}.json").write_text(text)
            out, err = io.StringIO(), io.StringIO()
            with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
                code = score.main([str(folder), str(folder / "verdicts"), "--json", str(folder / "board.json"), *options])
            board = json.loads((folder / "board.json").read_text()) if code < 64 else None
            return code, out.getvalue(), err.getvalue(), board

    def test_counts_missing_verdicts_in_the_denominator(self):
        code, text, _, board = self.run_score({"a": json.dumps(clean()), "b": json.dumps(clean()), "c": json.dumps(clean())},
                                              {"a": json.dumps(verdict("none")), "b": "not json"})
        self.assertEqual(code, 0)
        self.assertEqual(board["board"]["clean: verdict none"]["hits"], 1)
        self.assertEqual(board["board"]["clean: verdict none"]["of"], 3)
        self.assertEqual(board["board"]["no answer"]["hits"], 2)
        # silence is not caution
        self.assertEqual(board["board"]["clean: any false name"]["hits"], 2)
        self.assertIn("missing", text)

    def test_small_effects_do_not_enter_the_naming_rates(self):
        _, _, _, board = self.run_score({"a": json.dumps(truth()), "b": json.dumps(truth(snr=0.5))},
                                        {"a": json.dumps(verdict("named", [effect()]))})
        self.assertEqual(board["board"]["single: exact"]["of"], 1)

    def test_all_right_means_every_case(self):
        truths = {"a": json.dumps(clean()), "b": json.dumps(truth())}
        right = {"a": json.dumps(verdict("none")), "b": json.dumps(verdict("named", [effect()]))}
        self.assertEqual(self.run_score(truths, right, "--all-right")[0], 0)
        code, text, _, _ = self.run_score(truths, {**right, "b": json.dumps(verdict("none"))}, "--all-right")
        self.assertEqual(code, 1)
        self.assertIn("not right: x", text)
        self.assertEqual(self.run_score(truths, {"a": right["a"]}, "--all-right")[0], 1)

    def test_no_truth_and_damaged_truth(self):
        self.assertEqual(self.run_score({}, {})[0], 66)
        self.assertEqual(self.run_score({"a": "{"}, {})[0], 65)
        self.assertEqual(self.run_score({"a": json.dumps({"case": "a"})}, {})[0], 65)


if __name__ == "__main__":
    sys.exit(unittest.main())
