"""Lines to take along, the model as code of other programs, contents of the page, titles of effects."""

import dataclasses
import math
import re
import unittest
from types import SimpleNamespace

import numpy as np
import support
from vary_diagnosis import HOSTILE_WORDS

from torquescope.page import build, diagnosed, friction_table, what_now
from torquescope.page.effect_titles import TITLES
from torquescope.reader.diagnosis_records import Parameter

FRICTION = {"inertia": 0.09, "viscous": 0.35, "coulomb": 0.6, "offset": 0.04, "stribeck": 0.34, "stribeck_speed": 0.15,
            "stribeck_exponent": 1.1, "gravity_sin": 0.8, "cogging_cos": 0.05, "cogging_order": 12.0, "spring": 0.3,
            "quadratic_drag": 0.02, "power_law_viscous": 0.1, "power_law_exponent": 0.5, "presliding": 0.2}


def model_of(values, unit="N m"):
    return {name: Parameter(name, unit, value, math.nan, math.nan) for name, value in values.items()}


class FrictionTable(unittest.TestCase):
    def test_it_holds_friction_and_nothing_else(self):
        rows = dict(re.findall(r"(\w+) = \[(.*)\];", friction_table.friction_table(model_of(FRICTION), 2.0)))
        velocity, friction = (np.array(rows[name].split(), dtype=float) for name in ("velocity", "friction"))
        self.assertTrue(np.all(np.diff(velocity) > 0))
        self.assertEqual(velocity[-1], 2.0)
        at = np.argmin(np.abs(velocity - 0.0))
        self.assertAlmostEqual(abs(friction[at]), 0.6 + 0.34, delta=0.01)  # no offset, no gravity
        np.testing.assert_allclose(friction, -friction[::-1], rtol=1e-3)

    def test_the_numbers_are_those_of_the_equations(self):
        dq = -0.2
        expected = 0.35 * dq - 0.6 - 0.8 * 0.34 * math.exp(-((0.2 / 0.15) ** 1.1)) + 0.02 * dq * 0.2 - 0.1 * 0.2**0.5
        found = friction_table.value(model_of(FRICTION | {"cubic_drag": 0.0}), dq, (1.2, -0.8))
        self.assertAlmostEqual(float(found), expected, places=12)

    def test_levels_that_are_not_in_the_file_make_no_table(self):
        unknown = (math.nan, math.nan)
        self.assertEqual(friction_table.friction_table(model_of(FRICTION), 2.0, unknown), "")
        self.assertIn("friction", friction_table.friction_table(model_of({"viscous": 0.1}), 2.0, unknown))


@support.needs_diagnoses
class Lines(unittest.TestCase):
    def blocks(self, kind, **changed):
        study = support.study(kind)
        joint = dataclasses.replace(study.diagnosis.joints[0], **changed)
        return {one["title"]: one for one in what_now.blocks_of_joint(study, joint)}

    def test_a_named_effect_can_be_simulated_and_asked_for_alone(self):
        found = self.blocks("named")
        text = found["To simulate the joint with it"]["text"]
        self.assertTrue(text.startswith("[simulate.plant]\n"))
        self.assertIn("stribeck = 0.354\n", text)
        self.assertIn('effects = ["stribeck", "presliding"', found["To ask a new recording about these alone"]["text"])

    def test_terms_of_the_model_are_no_candidates(self):
        self.assertNotIn("To ask a new recording about these alone", self.blocks("insufficient"))

    def test_an_effect_that_can_be_a_term_becomes_one(self):
        effect = dataclasses.replace(support.study("named").diagnosis.joints[0].effects[0], name="speed_drag")
        text = self.blocks("named", effects=[effect])["To fit with it from the start"]["text"]
        self.assertRegex(text, r'^\[model\]\nterms = \["inertia", .*"speed_drag"\]\n$')
        self.assertNotIn("To fit with it from the start", self.blocks("named"))

    def test_a_fault_of_a_channel_is_no_part_of_a_simulated_joint(self):
        first = support.study("named").diagnosis.joints[0].effects[0]
        found = self.blocks("named", effects=[dataclasses.replace(first, is_fault=True)])
        self.assertNotIn("To simulate the joint with it", found)

    def test_a_shape_that_was_held_is_written_for_the_simulation(self):
        first = support.study("named").diagnosis.joints[0].effects[0]
        effect = dataclasses.replace(first, name="load_dependent_friction")
        self.assertIn("load_friction_inertia_share = 1\n",
                      self.blocks("named", effects=[effect])["To simulate the joint with it"]["text"])

    def test_hostile_names_are_strings_of_toml(self):
        first = support.study("named").diagnosis.joints[0].effects[0]
        effect = dataclasses.replace(first, name='x"]\nevil = ["', equivalent=['a" b'])
        text = self.blocks("named", effects=[effect])["To ask a new recording about these alone"]["text"]
        self.assertEqual(len(text.splitlines()), 2)
        self.assertIn('"a\\" b"', text)


class Contents(unittest.TestCase):
    def test_every_entry_leads_to_a_heading(self):
        for kind in ("crs", "arm", *(("named",) if support.EXAMPLE_WRITER else ())):
            text = support.page(kind).read_text(encoding="utf-8")
            nav = re.search(r'<nav class="contents".*?</nav>', text, re.S)[0]
            targets = re.findall(r'href="#([^"]+)"', nav)
            self.assertGreater(len(targets), 3, kind)
            for target in targets:
                self.assertEqual(len(re.findall(f'<h2 id="{target}">', text)), 1, target)

    def test_joints_of_an_arm_are_listed_and_not_each_of_their_sections(self):
        body = "".join(f'<section class="joint">\n<h2>Joint {j}</h2></section><section>\n<h2>What?</h2></section>'
                       for j in (1, 2)) + '<section class="next own">\n<h2>What now?</h2></section>'
        marked, listed = build.with_contents(body)
        self.assertEqual([str(heading) for _, heading in listed], ["Joint 1", "Joint 2", "What now?"])
        self.assertEqual(re.findall(r'<h2 id="(what[^"]*)"', str(marked)), ["what", "what--2", "what-now"])

    def test_a_heading_of_a_file_stays_escaped(self):
        _, listed = build.with_contents("<section>\n<h2>&lt;script&gt;</h2></section>")
        self.assertEqual(str(listed[0][1]), "&lt;script&gt;")

    @support.needs_diagnoses
    def test_warnings_stand_above_the_contents(self):
        kinds = [kind for kind in support.KINDS + support.DIAGNOSES
                 if 'class="warned"' in support.page(kind).read_text(encoding="utf-8")]
        self.assertTrue(kinds)
        for kind in kinds:
            text = support.page(kind).read_text(encoding="utf-8")
            self.assertLess(text.index('class="warned"'), text.index('class="contents"'))
            self.assertLess(text.index('class="warned"'), text.index('class="numbers"'))

    def test_effects_have_their_titles(self):
        self.assertEqual(diagnosed.effect_name("stribeck"), "Stribeck friction")
        self.assertEqual(diagnosed.effect_name("coulomb_negative"), "Coulomb friction of the negative direction")
        self.assertEqual(diagnosed.effect_name("of_a_later_program"), "of a later program")
        self.assertEqual(diagnosed.effect_words(SimpleNamespace(title="a b: c", name="x")), "a b")
        for title in TITLES.values():
            self.assertLess(len(diagnosed._short_title(title)), 62)

    @support.needs_diagnoses
    def test_the_table_of_candidates_says_titles(self):
        text = support.page("named").read_text(encoding="utf-8")
        table = text[text.index('<table class="candidates">'):]
        self.assertIn(">Stribeck friction<", table)
        self.assertNotIn("<code>", table[:table.index("</table>")])

    @support.needs_diagnoses
    def test_hostile_words_stay_words_in_lines_to_copy(self):
        text = support.page("hostile_words").read_text(encoding="utf-8")
        self.assertNotIn(HOSTILE_WORDS, text)


if __name__ == "__main__":
    support.main()
