"""The page of an arm says what the file says, joint by joint."""

import shutil
import unittest

import h5py
import numpy as np
import support
import make_arm_result
from torquescope.page import tables_of_arm, words_of_arm
from torquescope.page.figures import all_cases
from torquescope.page.study import Study


def changed(change):
    """A Study of a copy of the file after change(h5py.File)."""
    path = support.FOLDER / "arm_changed.h5"
    shutil.copy(support.result("arm"), path)
    with h5py.File(path, "r+") as file:
        change(file)
    return Study(path)


def without_truth(file):
    file["model/truth"][:] = np.nan


class Arm(unittest.TestCase):
    def test_the_sentence_says_how_well_a_validation_motion_is_reproduced(self):
        study = support.study("arm")
        error = study.estimators[1].validation_relerr_median
        verdict = words_of_arm.verdict(study)
        self.assertEqual(verdict["word"], "Identified")
        self.assertEqual(verdict["sentence"], "Ten parameters of two joints reproduce the torques of a validation "
                                              f"motion to within {100 * error:.2f} %.")

    def test_every_joint_has_its_picture_and_every_parameter_its_row(self):
        study = support.study("arm")
        found = all_cases(study)
        for number in (1, 2):
            self.assertIn(f"joint_torque_{number}", found)
            self.assertIn(f"joint_residual_by_speed_{number}", found)
        rows = tables_of_arm.parameters(study)["rows"]
        self.assertEqual([row[0] for row in rows], make_arm_result.NAMES)
        self.assertEqual(rows[1][4], f"{2.6:.{len(rows[1][4]) - 2}f}")

    def test_the_residual_of_a_joint_is_that_of_its_own_parameters(self):
        study = support.study("arm")
        e = study.arm.reference(study)
        for joint, error in zip(study.arm.joints, e.validation_joint_relerr):
            left = joint.validate.torque - joint.validate.prediction(e.chosen)
            self.assertAlmostEqual(np.linalg.norm(left) / np.linalg.norm(joint.validate.torque), error, places=12)

    def test_a_line_has_a_gap_where_rows_were_left_out(self):
        rows = support.study("arm").arm.joints[0].validate
        time, torque = rows.with_gaps(rows.torque)
        self.assertTrue((np.diff(time) > 0).all())
        turns = int((np.diff(np.sign(rows.velocity)) != 0).sum())
        self.assertGreater(turns, 5)
        self.assertGreaterEqual(int(np.isnan(torque).sum()), turns)

    def test_without_truth_the_robot_file_is_compared_with(self):
        study = changed(without_truth)
        known, origin = study.arm.known_values(study)
        self.assertEqual(origin, "robot file")
        table = tables_of_arm.parameters(study)
        self.assertIn("robot file", table["head"])
        # the file's moment of link 1 is another than the arm's
        away = [abs(float(row[5].replace("−", "-"))) for row in table["rows"][:len(make_arm_result.BASE)]]
        self.assertEqual(int(np.argmax(away)), 1)
        self.assertEqual(table["rows"][-1][4], "–")
        self.assertTrue(np.isnan(known[-1]))

    def test_without_either_no_column_pretends_to_know(self):
        def change(file):
            without_truth(file)
            del file["robot/file_values"]
        study = changed(change)
        self.assertNotIn("arm_parameters", all_cases(study))
        self.assertEqual(tables_of_arm.parameters(study)["head"][4:], ["OLS"])

    def test_negative_friction_is_not_physical(self):
        def change(file):
            file["runs/wls/ci95"][0, make_arm_result.NAMES.index("viscous_2")] = [-0.2, -0.1]
        verdict = words_of_arm.verdict(changed(change))
        self.assertEqual((verdict["word"], verdict["tone"]), ("Not physical", "ochre"))
        self.assertIn("viscous_2", verdict["evidence"])

    def test_training_alone_says_so(self):
        def change(file):
            del file["data/validate"]
            for e in ("ols", "wls"):
                file["runs"][e].attrs["validation_relerr_median"] = np.nan
        study = changed(change)
        self.assertIn("the training motion", words_of_arm.verdict(study)["sentence"])
        self.assertIn("joint_torque_2", all_cases(study))
        self.assertNotIn("WLS, validation", tables_of_arm.errors(study)["head"])


if __name__ == "__main__":
    support.main()
