"""What the page says follows from the numbers of the file, and how it writes them."""

import shutil
import types
import unittest

import h5py
import numpy as np
import support
from torquescope.page import quantities as q, seed, tables, words
from torquescope.page.study import Study


def changed(kind, change):
    """A Study of a copy of the file after change(h5py.File)."""
    path = support.FOLDER / f"{kind}_changed.h5"
    shutil.copy(support.result(kind), path)
    with h5py.File(path, "r+") as file:
        change(file)
    return Study(path)


class Numbers(unittest.TestCase):
    def test_minus_is_the_minus_sign_and_powers_are_written_out(self):
        self.assertEqual(q.number(-0.2582), "−0.258")
        self.assertEqual(q.number(8.1e-12), "8.1 × 10⁻¹²")
        self.assertEqual(q.number(0.09999, 2), "0.10")
        self.assertEqual(q.number(float("nan")), "–")

    def test_units_are_si_with_a_space(self):
        self.assertEqual(q.with_unit("0.354", "N m"), "0.354 N m")
        self.assertEqual(q.unit("kg m2"), "kg m²")
        self.assertEqual(q.unit("kg m^2"), "kg m²")
        self.assertEqual(q.unit("m/s2"), "m/s²")
        self.assertEqual(q.unit("N s2 m-1"), "N s² m⁻¹")
        self.assertEqual(q.square("N m"), "(N m)²")
        self.assertEqual(q.square("N"), "N²")
        self.assertEqual(q.unit("1"), "")

    def test_an_uncertainty_is_shown_with_two_digits(self):
        self.assertEqual(q.decimals_for(0.0123), 3)
        self.assertEqual(q.decimals_for(3.21), 1)
        self.assertEqual(q.decimals_for(57.0), 0)

    def test_thousands_are_set_apart_from_ten_thousand_on(self):
        self.assertEqual(q.whole(2000), "2000")
        self.assertEqual(q.whole(60000), "60\u202f000")


class Verdict(unittest.TestCase):
    def sentence(self, de, fade):
        def change(file):
            file["runs/de"].attrs["gap_median"] = de
            file["runs/fade"].attrs["gap_median"] = fade
            for name, gap in (("de", de), ("fade", fade)):
                file["runs"][name].attrs["mse_median"] = 0.0926 + gap
        return words.verdict(changed("crs", change))

    def test_decades_between_the_searches_are_those_of_the_file(self):
        self.assertEqual(self.sentence(8e-12, 2e-7)["sentence"],
                         "DE and FADE both arrive at the least-squares optimum; DE is closer by four decades.")
        self.assertEqual(self.sentence(2e-9, 2e-10)["sentence"],
                         "DE and FADE both arrive at the least-squares optimum; FADE is closer by one decade.")

    def test_nobody_is_called_closer_within_a_decade(self):
        self.assertEqual(self.sentence(2e-9, 3e-9)["sentence"], "DE and FADE both arrive at the least-squares optimum.")

    def test_a_search_that_has_not_arrived_is_said_to_stop_above(self):
        verdict = self.sentence(1e-12, 0.00926)
        self.assertEqual(verdict["sentence"], "DE arrives at the least-squares optimum; FADE stops 10 % above it.")
        self.assertEqual((verdict["word"], verdict["tone"]), ("Not converged", "ochre"))

    def test_least_squares_alone_says_how_well_it_reproduces_the_force(self):
        def change(file):
            file["runs/ols"].attrs["relerr_median"] = 0.0417
        self.assertEqual(words.verdict(changed("prismatic", change))["sentence"],
                         "Four parameters reproduce the force to within 4.2 %.")

    def test_nothing_to_warn_of_never_stands_beside_columns_that_nearly_agree(self):
        study = support.study("crs")
        for correlation, is_close in ((0.99, True), (-0.96, True), (0.6, False)):
            matrix = np.eye(len(study.model.names))
            matrix[0, 1] = matrix[1, 0] = correlation
            health = types.SimpleNamespace(correlation=matrix, condition_number=20.0, words="")
            said = words.health_answer(types.SimpleNamespace(health=health, model=study.model))
            self.assertEqual("Nothing to warn of" in said, not is_close, said)
            self.assertEqual("together is known better" in said, is_close, said)

    def test_a_warning_about_the_regressor_is_in_the_opening(self):
        verdict = words.verdict(support.study("prismatic"))
        self.assertIn("poorly separable", verdict["word"])
        self.assertIn("wider speeds would help", verdict["evidence"])

    def test_a_parameter_the_recording_does_not_prove_is_named(self):
        def change(file):
            file["runs/ols/ci95"][0] = [[0.1, 0.2], [-0.1, 0.2], [0.1, 0.2], [-0.2, -0.1]]
        self.assertEqual(words.parameters_answer(changed("crs", change)),
                         "The 95 % interval of viscous includes zero: this recording does not prove it.")

    def test_there_are_four_numbers_whatever_was_estimated(self):
        for kind in support.KINDS:
            with self.subTest(kind=kind):
                self.assertEqual(len(words.big_numbers(support.study(kind))), 4)


class BesideThePaper(unittest.TestCase):
    def test_it_is_shown_for_a_study_of_the_seed_only(self):
        self.assertIsNotNone(tables.beside_the_paper(support.study("crs")))
        self.assertIsNone(tables.beside_the_paper(support.study("many")))
        self.assertIsNone(tables.beside_the_paper(support.study("prismatic")))

    def test_without_the_attribute_the_truth_decides(self):
        def change(file):
            del file["job"].attrs["study"]
        self.assertTrue(changed("crs", change).is_seed_study)

    def test_no_published_deviation_fits_its_mean_square(self):
        for label, (mse, deviation) in seed.TABLE_4.items():
            self.assertGreater(deviation**2, mse)
        self.assertEqual(
            [q.fixed(seed.largest_deviation(label), 3) for label in seed.TABLE_4], ["0.304", "0.298", "0.229"]
        )


if __name__ == "__main__":
    support.main()
