#!/usr/bin/python3
"""Grades of verdicts whose worth is known."""

import unittest

from grade import Grade, grade, kept_names, summary
from run import KINDS, LAWS, drawn_laws, with_settings

DELAY, SPEED = "command_delay", "goal_speed_limit"


class Grades(unittest.TestCase):
    def test_clean(self):
        self.assertEqual(grade([], []), Grade("clean"))
        self.assertEqual(grade([], [["punch"]]).word, "false")
        self.assertEqual(grade([], None).word, "no answer")

    def test_all_laws_by_their_names_are_right(self):
        self.assertEqual(grade([DELAY, SPEED], [[SPEED], [DELAY]]).word, "right")

    def test_a_law_among_equivalents_is_in_a_class(self):
        graded = grade([DELAY, SPEED], [[SPEED], ["torque_lag", DELAY]])
        self.assertEqual((graded.word, graded.right, graded.in_class, graded.false), ("class", (SPEED,), (DELAY,), ()))

    def test_a_law_that_no_name_has_is_missed(self):
        self.assertEqual(grade([DELAY], []).word, "missed")
        self.assertEqual(grade([DELAY, SPEED], [[DELAY]]), Grade("missed", (DELAY,), (), (SPEED,), ()))

    def test_other_names_only_are_wrong_and_names_beside_are_counted(self):
        self.assertEqual(grade([DELAY], [["punch"]]).word, "wrong")
        beside = grade([DELAY], [[DELAY], ["punch"]])
        self.assertEqual((beside.word, beside.false), ("right", ("punch",)))

    def test_names_are_read_from_kept_or_from_effects(self):
        self.assertEqual(kept_names({"kept": [DELAY, {"name": SPEED, "equivalent": ["punch"]}]}),
                         [[DELAY], [SPEED, "punch"]])
        joints = [{"effects": [{"name": "load_dependent_friction", "equivalent": []}]}]
        self.assertEqual(kept_names({"verdict": "named", "joints": joints}), [["load_friction"]])
        self.assertEqual(kept_names({"kept": [], "joints": joints}), [])

    def test_the_summary_counts_cases_and_laws(self):
        text = summary([([], grade([], [["punch"]])), ([], grade([], [])),
                        ([DELAY, SPEED], grade([DELAY, SPEED], [[DELAY], ["punch"]]))])
        self.assertIn("falsely named 1 of 2", text)
        self.assertIn("missed 1, no answer 0; false names beside in 1", text)
        self.assertIn("laws: right 1 of 2, in a class 0, missed 1; false names 1", text)


class Cases(unittest.TestCase):
    def test_cases_take_turns_and_are_the_same_each_time(self):
        self.assertEqual([len(drawn_laws(1, number)) for number in range(KINDS)], [0, 1, 2, 3])
        self.assertEqual(drawn_laws(1, 7), drawn_laws(1, 7))
        drawn = {law for number in range(100) for law in drawn_laws(1, number)}
        self.assertEqual(drawn, set(LAWS))

    def test_settings_replace_lines_of_the_job(self):
        job = "[experiment]\nseed = 1\n[diagnose]\neffects = \"all\"\n"
        self.assertEqual(with_settings(job, ["max_effects = 3"]), job + "max_effects = 3\n")
        self.assertEqual(with_settings(job, ["effects = []"]), "[experiment]\nseed = 1\n[diagnose]\neffects = []\n")


if __name__ == "__main__":
    unittest.main()
