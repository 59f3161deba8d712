"""One verdict against one truth, made by hand: perfect, wrong, abstaining, missing, broken."""
import sys
import unittest

import judge
from example_cases import clean, effect, true_effect, truth, verdict


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
        self.assertAlmostEqual(
            judge.region_iou({"axis": "velocity", "from": 0.0, "to": 2.0}, true_effect()["regions"]), 1 / 3
        )
        self.assertAlmostEqual(
            judge.region_iou({"axis": "velocity", "from": -0.5, "to": 0.5}, true_effect()["regions"]), 0.5
        )
        self.assertIsNone(judge.region_iou({"axis": "time", "from": 0, "to": 1}, true_effect()["regions"]))

    def test_missing_and_broken_verdicts_are_failures(self):
        self.assertEqual(judge.judge(clean(), None).verdict, "missing")
        self.assertFalse(judge.judge(clean(), None).right)
        for broken in (
            {},
            {"schema": 2, "verdict": "none", "joints": []},
            {"schema": 1, "verdict": "maybe", "joints": []},
            {"schema": 1, "verdict": "none", "joints": [{}]},
        ):
            self.assertEqual(judge.judge(clean(), broken).verdict, "invalid")
            self.assertFalse(judge.judge(clean(), broken).right)

    def test_unknown_numbers_are_no_broken_verdict(self):
        vague = effect(low=None, high=None)
        vague["parameters"][0]["ci95"] = [None, None]
        answer = verdict("named", [vague])
        answer["joints"][0]["baseline"]["validation_relerr"] = answer["joints"][0]["augmented"]["validation_relerr"] = (
            None
        )
        j = judge.judge(truth(), answer)
        self.assertEqual(
            (j.verdict, j.right, j.gap_closed, j.found[0].iou, j.found[0].intervals), ("named", True, None, None, ())
        )
        vague["parameters"][0]["value"] = None
        self.assertIsNone(judge.judge(truth(), verdict("named", [vague])).found[0].parameter_error)

    def test_refuses_a_coarse_truth(self):
        coarse = clean()
        # null: the loop lost its joint, and JSON knows no infinity
        for error in (0.02, None):
            coarse["step_error"]["torque"] = error
            with self.assertRaises(judge.Inexact):
                judge.judge(coarse, verdict("none"))


class OtherTiers(unittest.TestCase):
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

    def test_names_of_a_part_are_names(self):
        pair = truth(effects=[true_effect(), true_effect("spring", ("static_position",))])
        both = [effect("spring", "static_position"), effect()]
        self.assertTrue(judge.judge(truth(), verdict("partly", [effect()])).right)
        self.assertTrue(judge.judge(pair, verdict("partly", both)).right)
        self.assertFalse(judge.judge(pair, verdict("partly", [effect()])).right, "half of it")
        self.assertEqual(judge.judge(truth(), verdict("partly", [effect("cogging", "order_locked")])).false_names,
                         ("cogging",))
        outside = truth("unexplained", [true_effect("", ())])
        self.assertFalse(judge.judge(outside, verdict("partly", [effect()])).right)
        self.assertFalse(judge.judge(clean(), verdict("partly", [effect()])).right)
        self.assertTrue(judge.judge(self.decoy(), verdict("partly", [effect("delay", "acceleration")])).right)

    def test_weak_motion_wants_a_class_or_no_answer(self):
        weak = lambda snr=3.0: truth("insufficient", snr=snr)
        self.assertTrue(judge.judge(weak(), verdict("insufficient")).right)
        self.assertTrue(judge.judge(weak(), verdict("class", [effect("presliding", equivalent=["stribeck"])])).right)
        self.assertFalse(judge.judge(weak(), verdict("class", [effect("cogging", "order_locked")])).right)
        self.assertFalse(judge.judge(weak(), verdict("named", [effect()])).right)
        self.assertFalse(judge.judge(weak(), verdict("partly", [effect()])).right)
        self.assertFalse(judge.judge(weak(), verdict("none")).right)
        self.assertTrue(judge.judge(weak(0.1), verdict("none")).right)


class OtherAnswers(unittest.TestCase):
    def test_a_region_on_both_sides_of_zero_is_two_intervals(self):
        places = [[-1.0, -0.5], [0.5, 1.0]]
        one, regions = {"axis": "velocity", "from": 0.5, "to": 1.0}, true_effect()["regions"]
        self.assertAlmostEqual(judge.region_iou(one, regions), 0.25)
        self.assertAlmostEqual(judge.region_iou({**one, "places": places}, regions), 0.5)
        beside = {**verdict("named", [effect(low=0.5)]), "places": {"stribeck": places}}
        self.assertAlmostEqual(judge.judge(truth(), beside).found[0].iou, 0.5)

    def test_a_pair_of_sine_and_cosine_is_one_vector(self):
        # 0.3 off a vector of length 5, however small its sine is
        true = true_effect("gravity", ["static_position"])
        true["parameters"] = [{"name": "gravity_sin", "value": 0.0}, {"name": "gravity_cos", "value": -5.0}]
        said = effect("gravity", "static_position")
        said["parameters"] = [{"name": "gravity_sin", "value": 0.3}, {"name": "gravity_cos", "value": -5.0}]
        self.assertAlmostEqual(
            judge.judge(truth(effects=[true]), verdict("named", [said])).found[0].parameter_error, 0.06
        )
        del said["parameters"][1]
        self.assertIsNone(judge.judge(truth(effects=[true]), verdict("named", [said])).found[0].parameter_error)

    def test_the_main_parameter_is_the_first_of_the_truth(self):
        true = true_effect()
        true["parameters"].append({"name": "stribeck_time", "value": 2.0})
        said = effect()
        said["parameters"].append({"name": "stribeck_time", "value": 9.0, "ci95": [8.0, 10.0]})
        found = judge.judge(truth(effects=[true]), verdict("named", [said])).found[0]
        self.assertAlmostEqual(found.parameter_error, 0.1)
        self.assertEqual(found.intervals, (True, False))

    def test_guesses_are_names_and_then_the_ranking_without_repeats(self):
        answer = {
            **verdict("named", [effect("cogging", "order_locked")]),
            "ranking": [
                {"name": "cogging", "family": "order_locked"},
                {"name": "spring", "family": "static_position"},
                {"name": "presliding", "family": "reversal"},
            ],
        }
        self.assertEqual(judge.judge(truth(), answer).found[0].rank, 3)
        self.assertIsNone(judge.judge(truth(), {**answer, "ranking": []}).found[0].rank)
        self.assertEqual(judge.judge(truth(), {**verdict("none"), "ranking": answer["ranking"]}).found[0].rank, 3)

    def test_three_blind_guesses_from_four_miss_one_of_two_right_ones_never(self):
        self.assertEqual(judge.blind_chance(4, 2), 1.0)
        self.assertAlmostEqual(judge.blind_chance(4, 1), 0.75)  # 3 of 4
        self.assertAlmostEqual(judge.blind_chance(30, 5), 1 - 25 * 24 * 23 / (30 * 29 * 28))
        self.assertEqual(judge.blind_chance(5, 0), 0.0)
        self.assertIsNone(judge.blind_chance(2, 1))

    def test_a_fault_of_the_instruments_that_is_named_so_is_found(self):
        drift = truth(effects=[true_effect("sensor_drift", ["time"])])
        self.assertTrue(judge.judge(drift, verdict("data_fault", [effect("sensor_drift", "time")])).right)
        self.assertFalse(judge.judge(drift, verdict("data_fault")).right)
        self.assertFalse(judge.judge(drift, verdict("data_fault", [effect("thermal_friction", "time")])).right)

    def test_a_rival_needs_no_more_than_names_and_families(self):
        rival = {"case": "x", "verdict": "named", "effects": [{"name": "stribeck", "family": "reversal"}]}
        j = judge.judge(truth(), rival)
        self.assertEqual((j.right, j.found[0].level, j.found[0].iou, j.gap_closed), (True, "exact", None, None))
        self.assertEqual(j.names, (("stribeck", "reversal", None, True),))
        self.assertAlmostEqual(
            judge.judge(truth(), {**rival, "unseen": {"before": 0.11, "after": 0.02}}).gap_closed, 0.9
        )
        for broken in (
            {"verdict": "named"},
            {"verdict": "perhaps", "effects": []},
            {"verdict": "named", "effects": [{"name": "stribeck"}]},
        ):
            self.assertEqual(judge.judge(truth(), broken).verdict, "invalid")

    def test_a_name_states_one_minus_its_false_discovery_rate(self):
        said = [{**effect(), "q": 0.04}, {**effect("spring", "static_position"), "confidence": 0.7, "q": 0.01}]
        self.assertEqual(judge.judge(truth(), verdict("named", said)).names,
                         (("stribeck", "reversal", 0.96, True), ("spring", "static_position", 0.7, False)))


if __name__ == "__main__":
    sys.exit(unittest.main())
