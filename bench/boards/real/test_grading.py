"""One answer against one verdict, each made by hand: the rules of the grades."""

import json
import pathlib
import tempfile
import unittest

import answers
import grading


def effect(name, equivalent=(), **parameters):
    return {"name": name, "equivalent": list(equivalent),
            "parameters": [{"name": key, "value": value} for key, value in parameters.items()]}


def said(verdict, *effects, before=0.4, after=0.1, text=""):
    return grading.Said(verdict=verdict, effects=effects, text=text, before=before, after=after)


def answer(**fields):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "answers.json"
        path.write_text(json.dumps({"cases": {"one": fields}}))
        return answers.read(path)["one"]


COGGING = {"needs": [["cogging"]], "may": ["torque_ripple"], "values": {"cogging_order": [[6.5, 7.5], [13.5, 14.5]]},
           "acceptable": ["unexplained"], "useless": ["insufficient"]}


class Grading(unittest.TestCase):
    def graded(self, one, **fields):
        return grading.grade(one, answer(**{**COGGING, **fields}))[0]

    def test_the_needed_name_is_right(self):
        self.assertEqual(self.graded(said("named", effect("cogging", cogging_order=7.1))), "right")
        self.assertEqual(self.graded(said("named", effect("cogging", cogging_order=-13.9))), "right")

    def test_a_class_that_holds_the_needed_name_is_right(self):
        self.assertEqual(self.graded(said("class", effect("periodic_disturbance", ["cogging"]))), "right")

    def test_a_name_beside_it_must_be_allowed(self):
        both = said("named", effect("cogging"), effect("torque_ripple"))
        self.assertEqual(self.graded(both), "right")
        self.assertEqual(self.graded(said("named", effect("cogging"), effect("contact"))), "wrong")

    def test_a_parameter_of_another_size_does_not_meet_the_need(self):
        self.assertEqual(self.graded(said("named", effect("cogging", cogging_order=9.0))), "acceptable")

    def test_an_allowed_name_alone_is_acceptable(self):
        self.assertEqual(self.graded(said("named", effect("torque_ripple"))), "acceptable")

    def test_a_name_whose_error_is_no_lower_is_wrong_whatever_it_is(self):
        for after in (0.4, 0.385, 0.6):
            grade, why = grading.grade(said("named", effect("cogging"), after=after), answer(**COGGING))
            self.assertEqual((grade, why), ("wrong", "the held-out error is no lower"))
        self.assertEqual(self.graded(said("named", effect("cogging"), after=0.379)), "right")
        # an error that nobody measured speaks against nothing
        self.assertEqual(self.graded(said("named", effect("cogging"), after=None)), "right")

    def test_names_of_a_part_are_graded_as_names(self):
        self.assertEqual(self.graded(said("partly", effect("cogging"))), "right")
        self.assertEqual(self.graded(said("partly", effect("torque_ripple"))), "acceptable")
        self.assertEqual(self.graded(said("partly", effect("contact"))), "wrong")
        self.assertEqual(self.graded(said("partly", effect("cogging"), after=0.39)), "wrong")
        fields = {"say": "71 %", "say_verdicts": ["partly"]}
        self.assertEqual(self.graded(said("partly", effect("torque_ripple"), text="explain 71 %"), **fields), "right")

    def test_verdicts_without_names_are_what_the_answer_calls_them(self):
        self.assertEqual(self.graded(said("unexplained")), "acceptable")
        self.assertEqual(self.graded(said("insufficient")), "useless")
        self.assertEqual(self.graded(said("none")), "wrong")
        self.assertEqual(self.graded(grading.Said()), "useless")
        broken = grading.said_of(None, "job  one\nerror: no such file      [66]\n  --> job.toml:3\n")
        self.assertEqual(grading.grade(broken, answer(**COGGING)), ("useless", "error: no such file [66]"))
        # names that were withdrawn are no names
        self.assertEqual(self.graded(said("unexplained", effect("contact"))), "acceptable")

    def test_a_class_of_five_is_acceptable_at_best(self):
        wide = effect("cogging", ["a", "b", "c", "d"])
        self.assertEqual(self.graded(said("class", wide)), "acceptable")
        wide["equivalent"].pop()
        self.assertEqual(self.graded(said("class", wide)), "right")

    def test_what_only_a_class_can_tell_must_not_stand_alone(self):
        alone = {"class_only": ["cogging"]}
        self.assertEqual(self.graded(said("named", effect("cogging")), **alone), "acceptable")
        self.assertEqual(self.graded(said("class", effect("cogging", ["torque_ripple"])), **alone), "right")

    def test_a_text_can_be_the_answer(self):
        fields = {"say": "one way|between recordings", "say_verdicts": ["insufficient"]}
        self.assertEqual(self.graded(said("insufficient", text="It turned One\n  way."), **fields), "right")
        self.assertEqual(self.graded(said("unexplained", text="one way"), **fields), "acceptable")

    def test_a_data_fault_that_the_answer_knows_is_graded_by_its_verdict(self):
        self.assertEqual(self.graded(said("data_fault", effect("delay")), right=["data_fault"]), "right")
        self.assertEqual(self.graded(said("data_fault", effect("delay"))), "wrong")


class Said(unittest.TestCase):
    def test_errors_are_those_of_validation_recordings_else_cross_validated(self):
        joint = {"effects": [], "baseline": {"validation_relerr": 0.3, "cv_relerr": 0.2},
                 "augmented": {"validation_relerr": 0.25, "cv_relerr": 0.1}}
        one = grading.said_of({"verdict": "none", "joints": [joint]})
        self.assertEqual((one.rows, one.before, one.after), ("unseen", 0.3, 0.25))
        joint["baseline"]["validation_relerr"] = None
        one = grading.said_of({"verdict": "none", "joints": [joint]})
        self.assertEqual((one.rows, one.before, one.after), ("cross-validated", 0.2, 0.1))

    def test_the_share_that_is_explained_may_be_unknown_or_absent(self):
        joint = {"effects": [], "baseline": {}, "explained": {"share": 0.71}}
        one = grading.said_of({"verdict": "partly", "joints": [joint]})
        self.assertEqual(one.explained, 0.71)
        del joint["explained"]  # a document of an earlier version
        one = grading.said_of({"verdict": "named", "joints": [joint]})
        self.assertIsNone(one.explained)

    def test_no_verdict_is_no_answer(self):
        for document in (None, {}, {"error": {"problem": "no file"}}, {"verdict": "none", "joints": []}):
            self.assertEqual(grading.said_of(document, "killed").verdict, "no answer")


class Answers(unittest.TestCase):
    def refused(self, **fields):
        with self.assertRaises(answers.Unusable) as refused:
            answer(**fields)
        return str(refused.exception)

    def test_what_cannot_be_graded_by_is_refused_with_its_place(self):
        self.assertIn("cases.one.neds: no such key", self.refused(neds=[]))
        self.assertIn("cases.one.right: no verdict is called nothing", self.refused(right=["nothing"]))
        self.assertEqual(answer(acceptable=["partly"]).verdicts, {"partly": "acceptable"})
        self.assertIn("cases.one.values.delay", self.refused(values={"delay": [0.1, 0.2]}))
        self.assertIn("cases.one.needs: a list", self.refused(needs=["cogging"]))
        self.assertIn("no regular expression", self.refused(say="("))


if __name__ == "__main__":
    unittest.main()
