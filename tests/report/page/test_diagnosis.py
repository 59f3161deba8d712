"""Python reads the diagnosis the C++ store wrote, and the page says of it what the file says: no more, no less."""

import dataclasses
import json
import math
import re
import shutil
import types
import unittest

import support
from torquescope.errors import DataError
from torquescope.page import build, diagnosed
import h5py
import numpy as np
from torquescope.page import tables_of_diagnosis, words_of_diagnosis
from torquescope.page.figures import all_cases, diagnosed_trace, mismatch_map, parameters_before_after
from torquescope.reader.read_result import Result, summary
from torquescope.page.study import Study
from vary_diagnosis import HOSTILE_WORDS

LEAST_P = 1 / 201


def diagnosis(kind):
    return support.study(kind).diagnosis


def joint(kind):
    return diagnosis(kind).joints[0]


def read_by_a_person(kind):
    """The text of the page outside tags, scripts and files that are shown verbatim."""
    body = support.page(kind).read_text(encoding="utf-8").split("<body>")[1]
    return re.sub(r"<[^>]*>", " ", re.sub(r"<(script|pre)\b.*?</\1>", " ", body, flags=re.S))


class EmbeddedJson(unittest.TestCase):
    def test_neither_ends_its_script_element_nor_hides_the_end(self):
        hostile = json.dumps({"reason": "<!--<script> </script> --> & \u2028 <\\/script>"}, ensure_ascii=False)
        escaped = str(build.script_json(hostile))
        self.assertFalse(set(escaped) & set("<>&\u2028\u2029"), escaped)
        self.assertEqual(json.loads(escaped), json.loads(hostile))


@support.needs_diagnoses
class HostileVerdict(unittest.TestCase):
    """Words of a file are words, wherever the page puts them."""

    def test_the_page_keeps_its_scripts(self):
        page = support.page("hostile_words").read_text(encoding="utf-8")
        bodies = re.findall(r"<script\b[^>]*>(.*?)</script>", page, flags=re.S)
        self.assertEqual(len(bodies), page.count("<script"), "each element that begins also ends")
        self.assertEqual(page.count("<script"), page.count("</script>"))
        self.assertFalse([body for body in bodies if "<!--" in body])
        self.assertNotIn("alert(1)</script>", page.replace("\\u003c", ""))
        kept = re.search(r'id="verdict-json">(.*?)</script>', page, flags=re.S)[1]
        self.assertEqual(json.loads(kept)["reason"], HOSTILE_WORDS)


class OtherRows(unittest.TestCase):
    """Errors of Torquescope 0.1 are not of all samples."""

    def read(self, **attributes):
        with h5py.File(support.FOLDER / "R.h5", "w") as file:
            file.attrs.update({"format": 3, "creator": "torquescope 0.1", "complete": 1})
            file.create_group("diagnosis").attrs.update({"joints": 1, "seed": 7, "q": 0.05})
            file.create_group("diagnosis/joint_1").attrs.update(attributes)
        with Result(support.FOLDER / "R.h5", is_ours=True) as result:
            return result.diagnosis.joints[0]

    def test_they_are_refused_with_the_way_out(self):
        for rows in ({"rows": "moving one way"}, {"rows": "with reversals"}, {}):
            with self.assertRaises(DataError) as refused:
                self.read(train_relerr=0.12, **rows)
            of = rows.get("rows", "moving one way")
            self.assertTrue(str(refused.exception).endswith(
                f"R.h5 are of rows {of}: it was made by Torquescope 0.1; delete it and run torquescope diagnose again "
                "with the job"), refused.exception)

    def test_a_joint_without_errors_is_read_whatever_its_rows(self):
        for rows in ({"rows": "all"}, {"rows": "moving one way"}, {}):
            self.assertTrue(math.isnan(self.read(train_relerr=math.nan, **rows).train_relerr))
        self.assertTrue(math.isnan(self.read().train_relerr))

    def test_errors_of_all_samples_are_read(self):
        self.assertEqual(self.read(train_relerr=0.12, rows="all").train_relerr, 0.12)


@support.needs_diagnoses
class Reader(unittest.TestCase):
    def test_every_verdict_is_read(self):
        self.assertEqual([diagnosis(kind).verdict for kind in support.VERDICTS], list(support.VERDICTS))

    def test_a_file_without_runs_has_no_estimators(self):
        with Result(support.result("named")) as result:
            self.assertEqual(result.estimators, {})
            self.assertIsNotNone(result.diagnosis)

    def test_an_identification_has_no_diagnosis(self):
        with Result(support.result("crs")) as result:
            self.assertIsNone(result.diagnosis)

    def test_parameters_come_by_name_with_their_intervals(self):
        viscous = joint("named").augmented["viscous"]
        self.assertEqual((viscous.unit, viscous.value, viscous.lower, viscous.upper), ("N m s/rad", 0.64, 0.628, 0.652))
        self.assertAlmostEqual(viscous.half_interval, 0.012)
        self.assertEqual(list(joint("named").baseline), ["inertia", "viscous", "coulomb", "offset"])

    def test_the_map_keeps_its_order_though_one_row_is_called_order(self):
        rows = joint("named").map
        self.assertEqual(
            list(rows),
            [
                "velocity",
                "since_velocity_reversal",
                "since_torque_reversal",
                "load",
                "position",
                "acceleration",
                "time",
                "order",
                "frequency",
            ],
        )
        self.assertEqual([axis for axis, row in rows.items() if row.is_spectrum], ["order", "frequency"])
        self.assertEqual(rows["velocity"].unit, "rad/s")
        self.assertEqual(rows["velocity"].z.shape, (54,))
        region, = rows["velocity"].regions
        self.assertEqual((region.where.start, region.where.stop, region.energy_share), (-0.12, 0.12, 0.46))
        self.assertEqual(rows["time"].regions, [])

    def test_effects_are_in_the_order_of_acceptance(self):
        stribeck, cogging = joint("named").effects
        self.assertEqual((stribeck.name, stribeck.equivalent, stribeck.p_is_bound), ("stribeck", ["presliding"], True))
        self.assertEqual(
            (cogging.name, cogging.region.axis, cogging.curve.range.axis), ("cogging", "order", "position")
        )
        self.assertEqual(stribeck.parameters["stribeck"].value, 0.354)
        self.assertEqual(stribeck.curve.at.shape, (40,))

    def test_lists_without_entries_are_empty(self):
        poor = joint("insufficient")
        self.assertEqual(
            (poor.map, poor.candidates, poor.effects, poor.traces, poor.forward, poor.augmented),
            ({}, [], [], [], [], {}),
        )
        self.assertTrue(math.isnan(poor.validation_relerr))
        self.assertEqual(poor.advice[0].would_separate, ["viscous", "coulomb"])

    def test_residuals_are_nan_where_the_joint_turns_round(self):
        trace = joint("named").traces[0]
        masked = np.abs(trace.velocity) < 0.02
        self.assertGreater(masked.sum(), 10)
        np.testing.assert_array_equal(np.isnan(trace.before), masked)

    def test_a_joint_prints_as_a_screen(self):
        for kind in support.DIAGNOSES:
            lines = str(joint(kind)).split("\n")
            self.assertLessEqual(len(lines), 24, kind)
            self.assertLessEqual(max(map(len, lines)), 100, kind)
        text = str(joint("named"))
        for words in ("<Joint 1", "named: stribeck, cogging>", "stribeck_speed",
                      "error in validation, all samples: 12.1 -> 6.23 %"):
            self.assertIn(words, text)
        self.assertRegex(repr(diagnosis("named")), "^<Diagnosis: named: Stribeck friction 0.35 N m")

    def test_the_records_agree_with_the_json_beside_them(self):
        found = diagnosis("named")
        told = json.loads(found.verdict_json)
        self.assertEqual((told["verdict"], told["reason"]), (found.verdict, found.reason))
        for one, effect in zip(told["joints"][0]["effects"], found.joints[0].effects):
            self.assertEqual((one["name"], one["z"], one["gain"]["cv"]), (effect.name, effect.z, effect.gain_cv))

    def test_the_share_that_is_explained_is_read(self):
        self.assertEqual(joint("partly").explained_share, 0.71)
        told = json.loads(diagnosis("partly").verdict_json)["joints"][0]["explained"]
        self.assertEqual(told, {"share": 0.71})
        self.assertTrue(math.isnan(joint("named").explained_share))

    def test_a_result_of_an_earlier_version_has_no_such_share(self):
        path = support.FOLDER / "earlier.h5"
        shutil.copy(support.result("named"), path)
        with h5py.File(path, "r+") as file:
            del file["diagnosis/joint_1"].attrs["explained_share"]
        found = Study(path).diagnosis.joints[0]
        self.assertTrue(math.isnan(found.explained_share))
        self.assertEqual(words_of_diagnosis.big_numbers(found), words_of_diagnosis.big_numbers(joint("named")))

    def test_the_summary_has_the_verdict_and_both_models(self):
        with Result(support.result("named")) as result:
            text = "\n".join(summary(result))
        for word in ("named: Joint 1 loses 0.35 N m", "stribeck_speed", "before", "after"):
            self.assertIn(word, text)


@support.needs_diagnoses
class Verdict(unittest.TestCase):
    def test_each_verdict_has_its_mark(self):
        marks = [words_of_diagnosis.verdict(support.study(kind))["mark"] for kind in support.VERDICTS]
        self.assertEqual(marks, ["●", "◍", "◐", "○", "◌", "▽", "✕"])

    def test_what_comes_first_and_how_sure_below(self):
        verdict = words_of_diagnosis.verdict(support.study("named"))
        self.assertEqual(
            verdict["sentence"],
            "Stribeck friction 0.35 N m [0.34, 0.37], speed 0.060 rad/s [0.055, 0.065] or presliding; "
            "cogging 0.060 N m [0.057, 0.063], 12 a turn, p < 0.005",
        )
        evidence = verdict["evidence"].replace("\u00a0", " ")
        for words in (
            "Stribeck friction (p < 0.005; presliding cannot be excluded).",
            "cogging torque of the motor (p < 0.005).",
            "Validation error 12.1 % to 6.2 %.",
            "200 simulated replicates",
        ):
            self.assertIn(words, evidence)

    def test_nothing_of_the_reason_is_lost(self):
        for kind in support.DIAGNOSES:
            verdict = words_of_diagnosis.verdict(support.study(kind))
            shown = (verdict["sentence"] + verdict["evidence"]).replace("\u00a0", " ").lower()
            for word in diagnosis(kind).reason.lower().replace("(", " ").replace(")", " ").replace(".", " ").split():
                self.assertIn(word, shown, kind)

    def test_the_class_is_counted(self):
        self.assertEqual(words_of_diagnosis.verdict(support.study("class"))["word"], "Missing physics: one of two")

    def test_numbers_are_those_of_the_file(self):
        shown = [(number, unit) for number, unit, _ in words_of_diagnosis.big_numbers(joint("named"))]
        self.assertEqual(shown, [("12 → 6.1 %", ""), ("12 → 6.2 %", ""), ("0", "of 200")])
        answer = words_of_diagnosis.fit_answer(support.study("named"), joint("named"))
        self.assertIn("12 % before, 6.2 % after.", answer)

    def test_a_part_says_how_much_and_shows_what_is_left(self):
        verdict = words_of_diagnosis.verdict(support.study("partly"))
        self.assertEqual((verdict["word"], verdict["tone"]), ("Missing physics partly explained", "blue"))
        self.assertTrue(verdict["sentence"].startswith("71 % of the mismatch by Stribeck friction 0.35"),
                        verdict["sentence"])
        self.assertIn(("71 %", "", "of what is missing on held-out rows is explained"),
                      words_of_diagnosis.big_numbers(joint("partly")))
        for words in ("stribeck speed", "What is left", "and is not explained"):
            self.assertTrue(words in read_by_a_person("partly"), words)
        self.assertFalse("What is left" in read_by_a_person("named"))

    def test_errors_are_of_all_samples(self):
        self.assertEqual([caption for *_, caption in words_of_diagnosis.big_numbers(joint("named"))],
                         ["error in training, all samples", "error in validation, all samples",
                          "simulated replicates look like this"])

    def test_headlines_are_short(self):
        for kind in support.DIAGNOSES:
            words = words_of_diagnosis.verdict(support.study(kind))["sentence"].split()
            self.assertLessEqual(len([word for word in words if word not in ("|", "N", "m")]), 25, kind)

    def test_a_fault_of_a_channel_beside_physics_is_called_one(self):
        self.assertNotIn("fault", words_of_diagnosis.verdict(support.study("named"))["word"])
        named = diagnosis("named")
        both = dataclasses.replace(named, joints=[dataclasses.replace(
            named.joints[0], effects=named.joints[0].effects[:1] + joint("data_fault").effects)])
        verdict = words_of_diagnosis.verdict(types.SimpleNamespace(diagnosis=both))
        self.assertEqual(verdict["word"], "Missing physics named, and a fault of the recording")
        self.assertIn(
            "A fault of the recording", words_of_diagnosis.effect_line(both.joints[0], both.joints[0].effects[1])
        )
        self.assertNotIn("fault", words_of_diagnosis.effect_line(both.joints[0], both.joints[0].effects[0]))

    def test_every_candidate_that_is_not_named_has_a_reason(self):
        for kind in ("named", "class", "partly", "none", "unexplained"):
            for row in tables_of_diagnosis.candidates(joint(kind)):
                self.assertTrue(row["decision"] == "named" or row["reason"] != row["decision"], row)

    def test_what_was_not_tested_is_none_of_the_strongest(self):
        tested, term = joint("none").candidates, dataclasses.replace(
            joint("none").candidates[0], name="coulomb_positive", decision="not tested"
        )
        rows = tables_of_diagnosis.candidates(dataclasses.replace(joint("none"), candidates=[term] + tested))
        self.assertEqual([row["name"] for row in rows[:3]], [one.name for one in tested[:3]])
        self.assertEqual(rows[-1]["name"], "coulomb_positive")

    def test_shares_beyond_the_whole_are_readable(self):
        said = [
            row["cv_gain"]
            for gain in (0.284, 106.7, -5.8, math.nan)
            for row in tables_of_diagnosis.candidates(
                dataclasses.replace(
                    joint("named"), candidates=[dataclasses.replace(joint("named").candidates[0], cv_gain=gain)]
                )
            )
        ]
        self.assertEqual(said, ["28.4 %", "> 100 %", "none", "–"])

    def test_the_ends_of_a_range_are_told_apart(self):
        self.assertEqual(diagnosed.range_words(18.93, 19.31, "s"), "18.9 … 19.3 s")
        self.assertEqual(diagnosed.range_words(-0.12, 0.12, "rad/s"), "−0.12 … 0.12 rad/s")
        self.assertEqual(diagnosed.range_words(0.0, 0.3, "m"), "0 … 0.3 m")

    def test_a_recording_like_its_twins_says_how_many_are_like_it(self):
        self.assertEqual(diagnosed.twins_as_far(joint("none")), round(0.4129 * 201) - 1)

    def test_what_was_not_measured_is_left_out(self):
        self.assertEqual(
            words_of_diagnosis.big_numbers(joint("insufficient")),
            [("12 %", "", "error in training, all samples")],
        )
        for kind in support.DIAGNOSES:
            found = re.findall(r"\b[nN][aA][nN]\b|\bNone\b|\binf\b", read_by_a_person(kind))
            self.assertEqual(found, [], kind)

    def test_never_p_equals_zero(self):
        for kind in support.VERDICTS:
            for row in tables_of_diagnosis.candidates(joint(kind)):
                self.assertNotIn(row["p"], ("0", "0.0", "0.00"))
        self.assertEqual(diagnosed.counted_p_cell(LEAST_P, 200), "<0.005")
        self.assertEqual(diagnosed.counted_p_cell(0.0, 200), "<0.005")
        self.assertEqual(diagnosed.counted_p_cell(0.4129, 200), "0.41")
        self.assertEqual(diagnosed.counted_p_cell(0.0, 400), "<0.003")  # 1/401 rounded up, as in the terminal

    def test_p_is_the_same_in_json_and_python(self):
        for kind in support.VERDICTS:
            told = json.loads(diagnosis(kind).verdict_json)["joints"][0]
            for records, rows in ((joint(kind).effects, told["effects"]), (joint(kind).candidates, told["candidates"])):
                self.assertEqual([(one.name, one.p, one.p_is_bound, one.p_extrapolated) for one in records],
                                 [(row["name"], row["p"], row["p_is_bound"], row["p_extrapolated"]) for row in rows])

    def test_forbidden_words_are_not_ours(self):
        for kind in support.VERDICTS:
            self.assertEqual(re.findall(r"\bsignificant|\blikely|\bAI\b", read_by_a_person(kind)), [], kind)

    def test_two_joints_have_two_of_everything(self):
        text = support.page("two_joints").read_text(encoding="utf-8")
        self.assertEqual(text.count('id="mismatch_map_joint_'), 2)
        self.assertIn('id="trace_2_joint_2"', text)
        self.assertEqual(text.count('id="copy-verdict"'), 1)


@support.needs_diagnoses
class Map(unittest.TestCase):
    def rows(self, kind="named", figure="mismatch_map"):
        return {name: row for row in all_cases(support.study(kind))[figure].arguments["rows"] for name in [row[0]]}

    def test_quiet_rows_stay(self):
        for kind in ("named", "none", "unexplained"):
            self.assertEqual(len(self.rows(kind)), 9)

    def test_a_cell_without_samples_has_no_colour(self):
        line = mismatch_map._Line(self.rows()["velocity"], narrow=False)
        self.assertTrue(np.isnan(line.level[40]))
        self.assertEqual(np.isnan(line.level).sum(), 1)

    def test_levels_follow_the_limits_of_the_legend(self):
        z = np.array([0.0, 2.4, 2.6, -2.6, 5.1, -11.0, 21.0, -300.0, np.nan])
        np.testing.assert_array_equal(mismatch_map._levels(z), [0, 0, 1, -1, 2, -3, 4, -4, np.nan])

    def test_spectra_have_one_side(self):
        row = list(self.rows()["frequency"])
        row[4] = np.where(np.arange(54) < 20, -9.0, 9.0)
        np.testing.assert_array_equal(mismatch_map._Line(row, narrow=False).level, np.where(np.arange(54) < 20, 0, 2))

    def test_a_phone_sees_the_strongest_of_the_cells_in_its_place(self):
        row = list(self.rows()["velocity"])
        row[4] = np.zeros(54)
        row[4][30] = -25.0
        line = mismatch_map._Line(row, narrow=True)
        self.assertEqual(len(line.level), 22)
        where, = np.flatnonzero(line.level)
        self.assertEqual(line.level[where], -4)
        self.assertTrue(line.bounds[where] <= 30 < line.bounds[where + 1])

    def test_names_that_do_not_fit_are_counted(self):
        self.assertEqual(mismatch_map._written(["stribeck", "presliding"], 348), "stribeck, presliding")
        self.assertEqual(
            mismatch_map._written(["stribeck", "position dependent friction", "load dependent friction"], 348),
            "stribeck and 2 more",
        )

    def test_the_region_of_an_effect_is_framed_with_its_name(self):
        frames = self.rows()["velocity"][6]
        self.assertIn((-0.12, 0.12, "Stribeck friction", "effect"), frames)
        self.assertIn((0.95, 1.29, "unexplained", "unexplained"), self.rows()["load"][6])
        self.assertEqual(self.rows("none")["velocity"][6], [])

    def test_what_is_left_is_drawn_with_the_effects_in_the_model(self):
        left = self.rows("partly", "mismatch_left")
        row = joint("partly").map["position"]
        np.testing.assert_array_equal(left["position"][4], np.where(row.samples > 0, row.after_z, np.nan))
        self.assertEqual(left["position"][5:7], (0.21, [(0.4, 0.9, "unexplained", "unexplained")]))
        self.assertEqual(left["velocity"][6], [], "an effect that is named is not left")
        self.assertTrue(math.isnan(left["velocity"][5]))
        self.assertNotIn("mismatch_left", all_cases(support.study("named")))


@support.needs_diagnoses
class Figures(unittest.TestCase):
    def test_three_figures_per_effect(self):
        names = all_cases(support.study("named"))
        for effect in (1, 2):
            for part in ("residual", "missing", "not_here"):
                self.assertIn(f"effect_{effect}_{part}", names)

    def test_an_effect_located_in_a_spectrum_is_drawn_over_its_curve(self):
        self.assertEqual(diagnosed.effect_row(joint("named"), joint("named").effects[1]).axis, "position")

    def test_not_here_is_another_axis_for_every_effect(self):
        cases = all_cases(support.study("named"))
        self.assertNotEqual(cases["effect_1_not_here"].title, cases["effect_2_not_here"].title)

    def test_not_here_is_quiet(self):
        for effect in joint("named").effects:
            row, _ = diagnosed.quiet_rival(joint("named"), effect)
            self.assertEqual(row.regions, [])
            self.assertGreaterEqual(row.p, 0.05)
        # what was not measured is not called quiet
        self.assertNotIn("effect_1_not_here", all_cases(support.study("hardly_measured")))

    def test_no_after_is_drawn_where_nothing_was_put_in(self):
        cases = all_cases(support.study("none"))
        self.assertIsNone(cases["trace_1"].arguments["after"])
        self.assertTrue(all(np.isnan(after) for *_, after in cases["error_before_after"].arguments["rows"]))
        self.assertTrue(all(np.isnan(at) for at, _ in cases["parameters_before_after"].arguments["after"]))

    def test_dots_are_what_lies_outside_the_band_of_the_twins(self):
        given = all_cases(support.study("named"))["effect_1_residual"].arguments
        row = joint("named").map["velocity"]
        expected = (np.abs(row.mean_residual - row.twin_mean) > 1.96 * row.twin_std) & (row.samples > 0)
        np.testing.assert_array_equal(given["outside"], expected)

    def test_a_trace_opens_on_the_six_seconds_that_gain_most(self):
        time = np.arange(6000) / 100
        before = np.where((time > 31) & (time < 36), 1.0, 0.1)
        before[2000:2050] = np.nan
        start, stop = diagnosed_trace.window_of_most_gain(time, before, 0.1 * np.ones(6000))
        self.assertTrue(start <= 31 and stop >= 36)
        self.assertAlmostEqual(stop - start, 6.0)

    def test_parameters_are_differences_from_the_truth_where_it_is_known(self):
        names, before, after = parameters_before_after.differences(joint("named"), {})
        self.assertAlmostEqual(after[names.index("viscous")][0], 100 * (0.64 / 0.41 - 1))
        self.assertEqual(before[names.index("viscous")][0], 0.0)
        self.assertTrue(math.isnan(before[names.index("stribeck")][0]))
        names, before, after = parameters_before_after.differences(joint("named"), {"viscous": 0.5})
        self.assertAlmostEqual(before[names.index("viscous")][0], -18.0)
        self.assertAlmostEqual(after[names.index("viscous")][0], 28.0)

    def test_what_was_not_measured_has_no_figure(self):
        names = all_cases(support.study("hardly_measured"))
        for absent in ("trace_1", "twin_energy", "effect_1_missing"):
            self.assertNotIn(absent, names)
        self.assertNotIn("mismatch_map", all_cases(support.study("insufficient")))
        self.assertNotIn("residual_budget", all_cases(support.study("insufficient")))


if __name__ == "__main__":
    support.main()
