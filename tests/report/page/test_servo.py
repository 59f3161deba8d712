"""The page of many recordings of servos: the worst validation recordings first, and numbers as the file has them."""

import html
import re
import subprocess
import sys
import unittest
from pathlib import Path

import make_servo
import support
from torquescope.page import build, quantities as q, tables_of_servo, words_of_servo
from torquescope.page.figures import all_cases
from torquescope.page.study import Study

MOST_BYTES, MANY = 6e6, 60  # of a page of so many recordings of six seconds
BUILD = Path(__file__).resolve().parents[3] / "scripts/report/build.py"


def text_of(kind):
    return support.page(kind).read_text(encoding="utf-8")


def read(kind):
    """Words of the page, without its pictures, as a person reads them."""
    body = text_of(kind).split("<body>")[1].split('<script type="application/json"')[0]
    body = re.sub(r"<(svg|script|style)\b.*?</\1>", "", body, flags=re.S)
    return re.sub(r"\s+", " ", html.unescape(re.sub(r"<[^>]+>", " ", body)))


def figures_of(text):
    return re.findall(r'<figure class="\w+" id="([^"]+)"', text)


def before_folds(text):
    """The page up to its first fold."""
    return text.split("<details>")[0]


def servo(kind="servo"):
    return support.study(kind).servo


class Order(unittest.TestCase):
    def test_sections_stand_in_their_order(self):
        found = re.findall(r"<h2[^>]*>(.*?)</h2>|<summary>(.*?)</summary>", text_of("servo"))
        self.assertEqual([one or other for one, other in found], [
            "Does the simulated servo move as the recorded one did?", "12 training recordings",
            "The errors of 18 recordings as a table", "What does the model lack?", "How large are the errors?",
            "Do the effects hold where no number was fitted?", "All parameters", "Notes", "Every effect that was tried",
            "The job file", "Where this page comes from"])

    def test_validation_recordings_come_first_the_worst_of_them_at_the_top(self):
        shown = words_of_servo.named_recordings(support.study("servo"))
        self.assertEqual([one.is_validation for _, _, one in shown], 6 * [True] + 12 * [False])
        for some in (shown[:6], shown[6:]):
            errors = [one.after for _, _, one in some]
            self.assertEqual(errors, sorted(errors, reverse=True))
        self.assertEqual(figures_of(text_of("servo")), [name for name, _, _ in shown])
        for name, replay, one in shown:
            self.assertEqual((replay.name, replay.purpose), (one.name, one.role), name)

    def test_a_few_are_unfolded(self):
        self.assertEqual(len(figures_of(before_folds(text_of("servo")))), words_of_servo.FIRST_SHOWN)

    def test_a_recording_that_ran_away_is_the_worst(self):
        study = Study(support.result("servo"))
        study.servo.recordings[6].after = float("nan")
        self.assertIs(words_of_servo.named_recordings(study)[0][2], study.servo.recordings[6])
        self.assertEqual(words_of_servo.error(study.servo, float("nan")), "diverged")


class Words(unittest.TestCase):
    def test_the_headline_is_that_of_the_file(self):
        said = words_of_servo.verdict(support.study("servo"))
        self.assertEqual(said["sentence"][1:-1], servo().headline[1:])
        self.assertIn(f"<title>{said['sentence']}</title>", text_of("servo"))
        self.assertIn("one of two", said["word"])

    def test_four_numbers(self):
        numbers = words_of_servo.big_numbers(support.study("servo"))
        expected = [servo().train.before, servo().train.after, servo().validate.before, servo().validate.after]
        self.assertEqual([number for number, _, _ in numbers], [q.number(1e3 * value) for value in expected])
        self.assertEqual({unit for _, unit, _ in numbers}, {"mrad"})
        self.assertIn("12 training recordings, before", numbers[0][2])

    def test_laws_have_equation_interval_rivals_d_and_p(self):
        said = read("servo")
        for text in ("goal(t) = reference(t − command_delay)", "0.040180 … 0.040220", "rad/s", "41593", "0.020",
                     "cannot be told from load stribeck friction",
                     "Easily confused with torque lag and torque delay at a low gain; a faster motion tells."):
            self.assertIn(text, said)
        rows = tables_of_servo.effect_parameters(servo())["rows"]
        self.assertEqual([row[1] for row in rows], ["command_delay_s", "load_friction", "stribeck_speed"])
        self.assertEqual(rows[2][2:], ["16.70", "rad/s", "–", "", ""], "nothing is known of its interval")

    def test_units_of_the_command_are_named(self):
        self.assertIn("N m per V", read("servo"))
        self.assertNotIn("per unit", read("servo"))

    def test_notes_steps_and_the_job_are_there(self):
        said = read("servo")
        for text in (*servo().notes.values(), "With command delay and load friction, 48 replicates", "its fit failed",
                     "validation recordings are not predicted better", 'name = "servo_loads"'):
            self.assertIn(text, said)

    def test_words_of_a_manifest_are_no_markup(self):
        self.assertIn("lift &amp; drop", text_of("servo"))
        self.assertNotIn("lift & drop", text_of("servo"))

    def test_captions_have_what_tells_recordings_apart_and_errors_of_the_file(self):
        study = support.study("servo")
        name, _, one = words_of_servo.named_recordings(study)[0]
        said = all_cases(study)[name].sentence.replace("\u00a0", " ")
        self.assertIn(f"kp {one.quantities['kp']:g}, mass_kg 0.75, motion {one.quantities['motion']}.", said)
        self.assertIn(f"{q.number(1e3 * one.before)} → {q.number(1e3 * one.after)} mrad, all 400 samples", said)


class Tables(unittest.TestCase):
    def test_every_error_is_that_of_the_file(self):
        for quantity, rows in servo().tables.items():
            table = tables_of_servo.errors(servo(), quantity, rows)
            self.assertEqual(table["groups"], ["training", "validation"])
            for row, (value, cells) in zip(rows, table["rows"]):
                self.assertEqual(value, row.value)
                for of, cell in zip((row.train, row.validate), cells):
                    if not of.recordings:
                        self.assertIsNone(cell)
                        continue
                    self.assertEqual((cell["recordings"], cell["before"], cell["after"]),
                                     (str(of.recordings), q.number(1e3 * of.before), q.number(1e3 * of.after)))

    def test_bars_are_as_long_as_errors_are_large(self):
        rows = servo().tables["kp"]
        table = tables_of_servo.errors(servo(), "kp", rows)
        bars = [(of.before, cell["bars"][0]) for row, (_, cells) in zip(rows, table["rows"])
                for of, cell in zip((row.train, row.validate), cells)]
        largest = max(value for value, _ in bars)
        for value, width in bars:
            self.assertAlmostEqual(width, tables_of_servo.BAR_WIDTH * value / largest, delta=0.1)

    def test_what_was_left_out_has_a_mean(self):
        rows = servo().left_out["kp"]
        value, (cell,) = tables_of_servo.left_out(servo(), "kp", rows)["rows"][-1]
        mean = sum(row.left_out.after for row in rows) / len(rows)
        self.assertEqual((value, cell["after"]), ("mean", q.number(1e3 * mean)))

    def test_parameters_stand_before_and_after(self):
        rows = {row[0]: row for row in tables_of_servo.parameters(servo())["rows"]}
        self.assertEqual(list(rows), list(servo().parameters))
        self.assertEqual(rows["command_delay_s"][2:4], ["–", "–"])
        self.assertNotIn("–", rows["inertia"])


class Kinds(unittest.TestCase):
    def test_nothing_missing_has_no_after(self):
        said = read("servo_none")
        for text in ("Nothing is missing", "No effect of drive or gear was kept.",
                     'No recording has role = "validate".'):
            self.assertIn(text, said)
        for text in ("validation", "after", "before"):
            self.assertNotIn(f" {text} ", said)
        self.assertEqual(len(words_of_servo.big_numbers(support.study("servo_none"))), 1)

    def test_a_model_that_ran_away_has_a_page_with_its_reason(self):
        self.assertIn("runs away; check the gains", read("servo_ran_away"))
        self.assertEqual(figures_of(text_of("servo_ran_away")), [])

    def test_a_page_of_sixty_recordings_is_light(self):
        """Each picture has its share; the whole page is built in full runs alone."""
        study = support.study("servo")
        cases = dict(list(all_cases(study).items())[:2])
        alone = {name: len(build.render({name: case}, parts=[], verdict=words_of_servo.verdict(study), head=[],
                                        numbers=[], verdict_json="")) for name, case in cases.items()}
        bare = len(build.render({}, parts=[], verdict=words_of_servo.verdict(study), head=[], numbers=[],
                                verdict_json=""))
        for name, length in alone.items():
            self.assertLess(length - bare, 0.9 * MOST_BYTES / MANY, name)
        if support.FULL:
            self.assertLess(support.page("servo_60").stat().st_size, MOST_BYTES)

    def test_beyond_the_most_the_table_alone_has_them(self):
        path = support.FOLDER / "servo_70.h5"
        make_servo.servo(path, 70, 0.5)
        study = Study(path)
        self.assertEqual(len(all_cases(study)), words_of_servo.MOST_DRAWN)
        self.assertEqual(len(tables_of_servo.recordings(study)["rows"]), 70)
        self.assertIn("10 recordings more are in the table alone.", words_of_servo.motion_answer(study))

    def test_the_command_writes_it_and_says_what_is_damaged(self):
        out = support.FOLDER / "servo_none_made.html"
        told = subprocess.run([sys.executable, "-B", BUILD, support.result("servo_none"), "--out", out],
                              capture_output=True, text=True)
        self.assertEqual((told.returncode, told.stderr), (0, ""))
        self.assertIn("Nothing is missing", out.read_text(encoding="utf-8"))
        damaged = support.FOLDER / "servo_damaged.h5"
        make_servo.write(damaged, {"verdict": "named", "headline": "explained"}, [])
        told = subprocess.run([sys.executable, "-B", BUILD, damaged, "--out", out], capture_output=True, text=True)
        self.assertEqual(told.returncode, 65)
        self.assertIn("damaged in /servo", told.stderr)


if __name__ == "__main__":
    support.main()
