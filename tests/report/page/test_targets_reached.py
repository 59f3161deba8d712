"""The share of targets reached is what its definition says, counted pair by pair."""

import unittest

import numpy as np
import support
from torquescope.page import style
from torquescope.page.figures import targets_reached as figure


def search(*runs, label="DE"):
    """runs: [(gaps, evaluations)]."""
    return figure.Search(label, style.LIGHT["de"], "solid", [np.array(gaps, dtype=float) for gaps, _ in runs],
                         [np.array(spent) for _, spent in runs])


def drawn(searches, targets):
    """{label: (evaluations, percent)} of the lines."""
    with style.look():
        lines = figure.draw(searches, targets).axes[0].lines
    return {line.get_label(): line.get_data() for line in lines if not line.get_label().startswith("_")}


class TargetsReached(unittest.TestCase):
    def test_targets_go_from_the_median_beginning_to_the_best_end(self):
        targets = figure.targets_of([search(([8, 1], [10, 20]), ([2, 0.5], [10, 20])), search(([4, 3], [5, 10]))])
        self.assertEqual(len(targets), 51)
        self.assertAlmostEqual(targets[0], 4.0)
        self.assertEqual(targets[-1], 0.5)
        np.testing.assert_allclose(np.diff(np.log(targets)), np.log(0.5 / 4) / 50)

    def test_targets_span_ten_decades_at_most(self):
        self.assertAlmostEqual(figure.targets_of([search(([3, 1e-30], [10, 20]))])[-1], 3e-10)
        self.assertAlmostEqual(figure.targets_of([search(([3, 0.0], [10, 20]))])[-1], 3e-10)

    def test_without_progress_there_is_nothing_to_draw(self):
        self.assertEqual(len(figure.targets_of([search(([3, 3], [10, 20]))])), 0)

    def test_a_pair_counts_from_the_generation_that_reached_it(self):
        one = search(([4, 2, 2, 0.5], [10, 20, 30, 40]), ([4, 4, 1], [10, 20, 30]))
        np.testing.assert_array_equal(figure.first_hits(one, np.array([4, 2, 1, 0.5])), [10, 10, 20, 30, 30, 40, 40])

    def test_lines_are_the_share_of_pairs_of_run_and_target(self):
        """Beside a count without any sorting: two searches of a result file, thirty runs each."""
        study = support.study("crs")
        searches = [figure.search_of(e) for e in study.searches]
        targets = figure.targets_of(searches)
        lines = drawn(searches, targets)
        self.assertEqual(set(lines), {e.short for e in study.searches})
        for e in study.searches:
            at, percent = lines[e.short]
            for k in (0, 60, 170, 250, len(at) - 1):
                pairs = [np.any((gaps <= target) & (spent <= at[k]))
                         for gaps, spent in zip(e.gap_history, e.evaluations) for target in targets]
                self.assertAlmostEqual(percent[k], 100 * np.mean(pairs))
            self.assertTrue(np.all(np.diff(percent) >= 0))
        self.assertGreater(max(percent[-1] for _, percent in lines.values()), 50)

    def test_a_run_that_stopped_keeps_what_it_reached(self):
        lines = drawn([search(([4, 1], [10, 20])), search(([4, 3, 2], [10, 200, 1000]), label="FADE")],
                      np.array([4, 3, 2, 1]))
        self.assertEqual([lines["DE"][1][0], lines["DE"][1][-1]], [25, 100])
        self.assertEqual(lines["FADE"][1][-1], 75)

    def test_runs_that_are_missing_are_left_out(self):
        class Partial:
            gap_history = np.array([[4, 2, np.nan], [np.nan] * 3, [4, np.nan, 1]])
            evaluations = np.array([[10, 20, 0], [0, 0, 0], [10, 20, 30]])
            draws_histories = True
            short, ink, dashes = "DE", style.LIGHT["de"], "solid"

        found = figure.search_of(Partial)
        np.testing.assert_array_equal(np.concatenate(found.gaps), [4, 2, 4, 4, 1])
        np.testing.assert_array_equal(np.concatenate(found.evaluations), [10, 20, 10, 20, 30])

    def test_the_words_below_say_which_targets(self):
        sentence = figure.cases(support.study("crs"))["targets_reached"].sentence
        targets = figure.targets_of([figure.search_of(e) for e in support.study("crs").searches])
        self.assertIn("51 targets", sentence)
        self.assertIn(f"from {figure.quantities.number(targets[0], 2)} (N m)²", sentence)
        self.assertIn(f"to {figure.quantities.number(targets[-1], 2)} (N m)²", sentence)

    def test_every_search_has_its_own_colour_or_dashes(self):
        kinds = ("ols", "wls", "irls", "de", "fade", "jde", "jade", "lshade", "cmaes", "fade", "fade")
        looks = [str(look) for look in style.estimator_looks(kinds)]
        self.assertEqual(len(set(looks)), len(looks))


if __name__ == "__main__":
    support.main()
