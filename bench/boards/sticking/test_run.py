#!/usr/bin/python3
"""Grades of verdicts whose worth is known, and jobs whose settings are."""

import unittest

from grade import Grade, grade, summary
from run import with_settings


def truth(hidden=None, family=None, besides=()):
    effects = [{"name": hidden, "family": family, "form": "", "relative_size": 0.01}] if hidden else []
    return {"effects": effects, "besides": list(besides), "sticking": {"law": "dahl"}}


def said(word, *effects):
    """effects: (name, family) or (name, family, equivalent, ...)"""
    named = [{"name": name, "family": family, "equivalent": list(more)} for name, family, *more in effects]
    return {"verdict": word, "joints": [{"effects": named}]}


STRIBECK, DRAG, BEND = ("stribeck", "reversal"), ("speed_drag", "velocity_law"), ("presliding", "reversal")


class Grades(unittest.TestCase):
    def test_clean(self):
        self.assertEqual(grade(truth(), said("none")), Grade("none"))
        self.assertEqual(grade(truth(), said("unexplained")), Grade("unexplained"))
        self.assertEqual(grade(truth(), said("named", DRAG)), Grade("false"))
        self.assertEqual(grade(truth(), None), Grade("no answer"))

    def test_what_is_there_besides_is_no_false_name(self):
        bends = truth(besides=["presliding"])
        self.assertEqual(grade(bends, said("named", BEND)), Grade("besides", (), ("presliding",)))
        self.assertEqual(grade(truth(), said("named", BEND)), Grade("false"))
        # a class that holds it claims nothing else
        self.assertEqual(grade(bends, said("class", (*STRIBECK, "presliding"))).word, "besides")
        self.assertEqual(grade(bends, said("partly", BEND, DRAG)), Grade("false", (), ("presliding",)))
        late = truth(besides=["delay"])
        self.assertEqual(grade(late, said("data_fault", ("delay", "acceleration"))).word, "besides")

    def test_single(self):
        hidden = truth("stribeck", "reversal")
        self.assertEqual(grade(hidden, said("named", STRIBECK)), Grade("right"))
        self.assertEqual(grade(hidden, said("class", (*STRIBECK, "presliding"))), Grade("class"))
        self.assertEqual(grade(hidden, said("class", (*BEND, "stribeck"))), Grade("class"))
        self.assertEqual(grade(hidden, said("named", BEND)), Grade("family"))
        self.assertEqual(grade(hidden, said("named", DRAG)), Grade("wrong"))
        for word in ("none", "unexplained", "insufficient", "data_fault"):
            self.assertEqual(grade(hidden, said(word)), Grade(word))

    def test_a_law_too_many(self):
        hidden = truth("stribeck", "reversal")
        self.assertEqual(grade(hidden, said("named", DRAG, STRIBECK)), Grade("right", ("speed_drag",)))
        self.assertEqual(grade(hidden, said("partly", BEND, DRAG)), Grade("family", ("speed_drag",)))
        # its own name counts before a class that holds it, and a relative beside it is one too many
        self.assertEqual(grade(hidden, said("named", (*BEND, "stribeck"), STRIBECK)), Grade("right", ("presliding",)))

    def test_the_hidden_law_before_what_is_there_besides(self):
        hidden = truth("stribeck", "reversal", besides=["presliding"])
        self.assertEqual(grade(hidden, said("class", (*STRIBECK, "presliding"))), Grade("class"))
        self.assertEqual(grade(hidden, said("named", BEND)), Grade("besides", (), ("presliding",)))
        self.assertEqual(grade(hidden, said("named", BEND, STRIBECK)), Grade("right", (), ("presliding",)))
        late = truth("delay", "acceleration", besides=["actuator_lag", "delay"])
        self.assertEqual(grade(late, said("data_fault", ("delay", "acceleration"))), Grade("right"))

    def test_counts(self):
        text = summary([(truth(), Grade("false")), (truth(), Grade("none")),
                        (truth("stribeck", "reversal"), Grade("right", ("speed_drag",))),
                        (truth("stribeck", "reversal"), Grade("unexplained"))])
        self.assertIn("clean: falsely named 1 of 2; none 1,", text)
        self.assertIn("right alone 1 of 2, ", text)
        self.assertIn("missed 1 (none 0, unexplained 1,", text)
        self.assertIn("a law too many: 1 in 1 cases", text)


class Settings(unittest.TestCase):
    def test_lines_are_replaced_or_added(self):
        job = "[model]\nterms = []\n\n[diagnose]\ntwins = 60\n"
        self.assertEqual(with_settings(job, ["twins=200", "q=0.02"]),
                         '[model]\nterms = []\n\n[diagnose]\ntwins = 200\nq = 0.02\n')
        self.assertEqual(with_settings(job, []), job)


if __name__ == "__main__":
    unittest.main()
