"""Estimators that fit simulations: more parameters than rows have columns, errors of all samples, no floor."""

import re
import shutil
import unittest

import h5py
import make_replay
import numpy as np
import support
from torquescope.page import compare, quantities as q, residuals, tables, what_now, words, words_of_rollouts
from torquescope.page.figures import all_cases
from torquescope.page.figures.convergence import draw
from torquescope.page.study import Study

KINDS = tuple(make_replay.ROLLED)
OF_ROWS = ("torque_trace_train", "torque_trace_validate")
OF_RESIDUALS = ("residual_by_speed", "residual_autocorrelation", "residual_distribution")


def text_of(kind):
    return support.page(kind).read_text(encoding="utf-8")


def said(kind):
    """What a reader reads."""
    body = re.sub(r"<(script|pre|svg|title)\b.*?</\1>", " ", text_of(kind).split("<body>")[1], flags=re.S)
    return re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", body))


def changed(kind, change):
    path = support.FOLDER / f"{kind}_changed.h5"
    shutil.copy(support.result(kind), path)
    with h5py.File(path, "r+") as file:
        change(file)
    return Study(path)


def of_lm(kind):
    return next(e for e in support.study(kind).estimators if e.kind == "lm")


class Pages(unittest.TestCase):
    def test_all_of_them_have_one(self):
        for kind in KINDS:
            self.assertIn('id="parameters"', text_of(kind))
            self.assertEqual(re.findall(r"\b[nN][aA][nN]\b|\bNone\b|\binf\b", said(kind)), [], kind)

    def test_they_are_told_apart_by_kind_and_by_fitness(self):
        self.assertEqual([(e.name, e.rolls_out) for e in support.study("rolled_several").estimators],
                         [("ols", False), ("de", False), ("fade", True), ("lm", True)])
        self.assertEqual(support.study("crs").rolled, [])

    def test_nothing_says_floor_where_nobody_knows_it(self):
        for kind in ("rolled", "rolled_windows", "rolled_away"):
            self.assertNotRegex(said(kind), r"floor|least-squares optimum|OLS|problem is linear")

    def test_a_file_without_a_replay_has_a_page_too(self):
        def older(file):
            del file["replay"], file["runs/lm"].attrs["rollout_error_unit"], file["runs/lm"].attrs["at_bounds"]

        study = changed("rolled", older)
        self.assertFalse(set(all_cases(study)) & {*OF_ROWS, *OF_RESIDUALS})
        self.assertIn("on all samples, simulated.", words.verdict(study)["evidence"])

    def test_figures_of_rows_are_those_of_estimators_that_fit_rows(self):
        self.assertFalse(set(all_cases(support.study("rolled"))) & set(OF_ROWS))
        found = all_cases(support.study("rolled_several"))["torque_trace_train"]
        self.assertEqual([label for label, *_ in found.arguments["predictions"]], ["OLS", "DE"])


class Residuals(unittest.TestCase):
    def test_they_are_of_every_simulated_training_sample(self):
        study = support.study("rolled")
        first, second, _ = study.replay.recordings
        left = all_cases(study)["residual_distribution"].arguments["residual"]
        np.testing.assert_array_equal(
            left, np.concatenate([first.torque.difference(1)[:300], first.torque.difference(1)[400:],
                                  second.torque.difference(1)]))
        self.assertAlmostEqual(left.std(), study.lead.residual_std[0])
        self.assertEqual(len(left), sum(one.torque.samples[1] for one in (first, second)))

    def test_products_do_not_reach_over_what_was_left_out(self):
        found = residuals.of_training(support.study("rolled"))
        numbers, counts = np.unique(found.stretch, return_counts=True)
        self.assertEqual((len(numbers), counts.tolist()), (3, [300, 1200, 1200]))
        self.assertTrue(np.all(np.diff(found.stretch) >= 0))
        self.assertAlmostEqual(found.step_s, 1 / 200)

    def test_the_velocity_is_that_of_the_same_samples(self):
        arguments = all_cases(support.study("rolled"))["residual_by_speed"].arguments
        self.assertEqual(len(arguments["velocity"]), len(arguments["residual"]))

    def test_captions_say_so(self):
        cases = all_cases(support.study("rolled"))
        for name in OF_RESIDUALS:
            self.assertIn("what LM, simulated, leaves of all training samples", cases[name].sentence)
            self.assertNotRegex(cases[name].sentence, "naive|robust loss")

    def test_of_what_fits_rows_they_are_of_rows(self):
        study = support.study("rolled_several")
        left = all_cases(study)["residual_distribution"].arguments["residual"]
        np.testing.assert_array_equal(left, study.train.torque - study.train.regressor @ study.ols.chosen)

    def test_without_a_simulated_torque_there_are_none(self):
        for kind in ("rolled_windows", "rolled_away"):
            self.assertFalse(set(all_cases(support.study(kind))) & set(OF_RESIDUALS), kind)

    def test_recordings_of_several_rates_have_no_autocorrelation(self):
        def slower(file):
            file["replay/recording_2"].attrs["rate_hz"] = 100.0

        cases = all_cases(changed("rolled", slower))
        self.assertNotIn("residual_autocorrelation", cases)
        self.assertIn("residual_distribution", cases)


class Words(unittest.TestCase):
    def test_the_title_counts_what_was_fitted_and_has_the_error_of_the_simulation(self):
        e = of_lm("rolled")
        self.assertEqual(words.verdict(support.study("rolled"))["sentence"],
                         "Nine parameters, simulated in closed loop, reproduce a validation torque to within "
                         f"{q.percent(e.validation_relerr_median)}.")

    def test_the_evidence_is_of_all_samples_and_names_the_bounds(self):
        e = of_lm("rolled")
        self.assertEqual(words.verdict(support.study("rolled"))["evidence"],
                         f"LM leaves {q.number(e.residual_std_median)} N m of the torque (standard deviation) on 2700 "
                         "samples, simulated in closed loop. LM ends on the bound of stribeck exponent: the recordings "
                         "do not say what it is.")

    def test_without_a_reference_errors_are_of_the_position(self):
        study = support.study("rolled_windows")
        self.assertIn("reproduce a validation position to within", words.verdict(study)["sentence"])
        self.assertIn(" rad of the position (standard deviation) on 2700 samples, simulated from the recorded torque, "
                      "in windows.", words.verdict(study)["evidence"])
        self.assertIn("Does the model follow the position?", said("rolled_windows"))
        self.assertIn("rad²", tables.estimators(study)["head"][1])

    def test_what_ran_away_is_no_result(self):
        verdict = words.verdict(support.study("rolled_away"))
        self.assertEqual((verdict["word"], verdict["tone"]), ("Not simulated", "ochre"))
        self.assertIn("The simulation of LM ran away", verdict["evidence"])
        self.assertNotIn("relative_error", all_cases(support.study("rolled_away")))

    def test_beside_rows_both_are_told_with_what_they_are_of(self):
        study = support.study("rolled_several")
        self.assertEqual(study.lead, study.ols)
        lm = of_lm("rolled_several")
        self.assertIn(f"LM: {q.percent(lm.relerr_median)} relative error of the torque in training, "
                      f"{q.percent(lm.validation_relerr_median)} in validation, over all samples, simulated in "
                      "closed loop.",
                      words.fit_answer(study))
        self.assertRegex(words.verdict(study)["sentence"], "^DE (arrives|stops)", "of searches in rows alone")
        self.assertNotIn("(FADE)", words.verdict(study)["evidence"])

    def test_of_several_simulations_the_closest_leads(self):
        def rows_go(file):
            del file["runs/ols"], file["runs/de"]
            file["runs"].attrs["order"] = np.array([b"fade", b"lm"])
            file["runs/fade"].attrs["mse_median"] = 9.0

        self.assertEqual(changed("rolled_several", rows_go).lead.name, "lm")

    def test_a_parameter_without_an_interval_is_not_called_proven(self):
        answer = words.parameters_answer(support.study("rolled"))
        self.assertIn("intervals of loop kp and loop torque delay s include zero", answer)
        self.assertTrue(answer.endswith("LM has no interval for stribeck exponent."))

    def test_without_any_interval_none_excludes_zero(self):
        def unknown(file):
            file["runs/lm/ci95"][...] = np.nan

        self.assertNotIn("zero", words.parameters_answer(changed("rolled", unknown)))

    def test_there_are_four_numbers(self):
        for kind in KINDS:
            self.assertEqual(len(words.big_numbers(support.study(kind))), 4, kind)
        for number, _, caption in words.big_numbers(support.study("rolled")):
            self.assertNotIn("floor", caption)

    def test_rows_are_not_said_to_be_what_it_was_fitted_to(self):
        study = support.study("rolled")
        self.assertIn("LM simulates every sample, not these rows.", words.recording_answer(study))
        self.assertNotIn("the fit has used", all_cases(study)["recording_trace"].sentence)
        self.assertEqual(words_of_rollouts.recording_note(support.study("crs")), "")


class Tables(unittest.TestCase):
    def test_every_parameter_has_a_row_and_units_may_be_empty(self):
        table = tables.parameters(support.study("rolled"))
        self.assertEqual(table["head"], ["parameter", "unit", make_replay.LM_TITLE, "± 95 %, HAC"])
        rows = {row[0]: row[1:] for row in table["rows"]}
        self.assertEqual(len(rows), 9)
        self.assertEqual(rows["loop kp"], ["", "4.1 × 10⁷", "1.6 × 10⁸"])
        self.assertEqual(rows["stribeck exponent"], ["", "2.000", "–"])

    def test_only_columns_of_the_regressor_correlate(self):
        table = tables.correlation(support.study("rolled"))
        self.assertEqual([row[0] for row in table["rows"]],
                         ["inertia", "viscous", "coulomb positive", "coulomb negative"])
        self.assertEqual({len(row) for row in [table["head"], *table["rows"]]}, {5})

    def test_fitness_is_no_distance_from_the_floor(self):
        table = tables.estimators(support.study("rolled"))
        self.assertNotIn("above the floor", table["head"])
        self.assertEqual(table["rows"][0][table["head"].index("fitness")], "0.3140")
        table = tables.estimators(support.study("rolled_several"))
        floor, fitness = (table["head"].index(name) for name in ("above the floor", "fitness"))
        self.assertEqual([(row[floor] == "–", row[fitness] == "–") for row in table["rows"]],
                         [(False, True), (False, True), (True, False), (True, False)])
        self.assertNotIn("fitness", tables.estimators(support.study("crs"))["head"])

    def test_below_it_stands_what_errors_are_of(self):
        self.assertIn("FADE and LM fit simulations of the recordings: errors are of all samples, simulated in closed "
                      "loop. Other errors are of rows.", said("rolled_several"))
        self.assertNotIn("Other errors", said("rolled"))

    def test_the_forest_has_every_parameter_and_wide_bars_leave_it(self):
        found = all_cases(support.study("rolled"))["parameters"]
        self.assertEqual(len(found.arguments["names"]), 9)
        self.assertEqual(found.arguments["values"][6], "2.000")
        self.assertIn("What leaves the frame is wider than ±150 %.", found.sentence)
        axes = found.figure(1080).axes[0]
        self.assertLess(axes.get_xlim()[1], 170)

    def test_a_comparison_says_what_errors_are_of(self):
        text = compare.page([support.result("rolled"), support.result("crs")])
        self.assertIn("errors are of", text)
        self.assertIn("all samples, simulated", text)
        self.assertNotIn("errors are of", compare.page([support.result("crs"), support.result("de_only")]))

    def test_what_to_paste_takes_the_leading_estimator(self):
        titles = [block["title"] for block in what_now.blocks_of_study(support.study("rolled"))]
        self.assertEqual(titles, ["What does the model lack?", "As a table for Simulink"])


class Convergence(unittest.TestCase):
    def test_searches_in_rows_and_of_simulations_have_pictures_of_their_own(self):
        cases = all_cases(support.study("rolled_several"))
        self.assertEqual([label for label, *_ in cases["convergence"].arguments["histories"]], ["DE"])
        self.assertEqual([label for label, *_ in cases["convergence_simulated"].arguments["histories"]], ["FADE"])
        self.assertNotIn("floor", cases["convergence_simulated"].title + cases["convergence_simulated"].sentence)
        self.assertEqual([one.label for one in cases["targets_reached"].arguments["searches"]], ["DE"])

    def test_generations_that_ran_away_leave_a_gap(self):
        gaps = np.array([[np.inf, 2.0, 1.0], [np.inf, np.inf, 4.0]])
        figure = draw([("FADE", np.arange(3), gaps, "#000000", "solid")], "", "what")
        low, high = figure.axes[0].get_ylim()
        self.assertTrue(0 < low <= 1.0 and 4.0 <= high < 100)

    def test_lm_has_no_generations(self):
        self.assertFalse({"convergence", "convergence_simulated"} & set(all_cases(support.study("rolled"))))


if __name__ == "__main__":
    support.main()
