"""What the page of the scoreboard says is what the file holds, in words a person reads."""

import contextlib
import io
import json
import re
import tempfile
import unittest
from pathlib import Path

import support

from torquescope.page import board, build_board, figure
import make_board
from torquescope.page.figures import BOARD_MODULES, board_cases


def text_of(page):
    return re.sub(r"\s+", " ", re.sub(r"<(script|style|svg)\b.*?</\1>|<[^>]+>", " ", page, flags=re.S))


class BoardPage(unittest.TestCase):
    def setUp(self):
        self.board = board.Board(support.result("board"))
        self.page = support.page("board").read_text(encoding="utf-8")
        self.text = text_of(self.page)

    def test_the_table_comes_first_and_has_every_row(self):
        table = self.page.split("<table")[1].split("</table>")[0]
        self.assertEqual(table.count("<tr>"), 1 + len(self.board.ours["table"]))
        self.assertIn("1 of 30", text_of(table))  # clean records with a false name

    def test_cases_in_no_row_are_named_above_it(self):
        above = text_of(self.page.split("<table")[0])
        self.assertIn(f"One of {self.board.suite['cases'] + 1} cases is in no row", above)
        self.assertIn("another recording: T1:backlash:2:5.", above)
        self.assertNotIn("in no row", support.page("board_few").read_text(encoding="utf-8"))

    def test_every_figure_module_draws_something(self):
        used = {case.draw.__module__ for case in board_cases(self.board).values()}
        self.assertEqual(used, {f"torquescope.page.figures.{module}" for module in BOARD_MODULES})

    def test_misses_say_what_was_concealed_and_what_was_said(self):
        wrong = self.board.ours["misses"]
        self.assertGreater(len(wrong), 12)
        self.assertEqual(self.page.count('class="text said"'), len(wrong))
        # in the order of the file: what was invented stands before what was missed
        places = [self.page.index(f">{one['case']}<") for one in wrong]
        self.assertEqual(places, sorted(places))
        self.assertIn("invented: cogging", self.text)
        self.assertIn("stribeck, spring and cogging, SNR 4.0 law of two harmonics", self.text)

    def test_no_code_names_where_a_person_reads(self):
        names = {one["case"] for one in self.board.ours["misses"]}
        for name in names:
            self.text = self.text.replace(name, "")
        self.assertEqual(re.findall(r"\b[a-z]+_[a-z_]+\b", self.text), [])

    def test_rivals_stand_beside_ours(self):
        self.assertIn("lasso cross validation", self.text)
        self.assertNotIn("The same cases, other methods", support.page("board_few").read_text(encoding="utf-8"))

    def test_a_level_is_never_said_to_hold_from_too_few_cases(self):
        few = json.loads(support.result("board_few").read_text())["methods"]["torquescope"]["table"]
        self.assertEqual({row["pass_holds"] for row in few if row["pass"]}, {"too few cases to say", "not measured"})
        self.assertIn(
            "0 of 15 pass levels hold, 0 do not", text_of(support.page("board_few").read_text(encoding="utf-8"))
        )

    def test_a_figure_can_be_taken_for_a_paper(self):
        out = support.FOLDER / "power.pdf"
        self.assertEqual(figure.main(["power_T1", str(support.result("board")), str(out)]), 0)
        self.assertEqual(out.read_bytes()[:4], b"%PDF")

    def test_it_says_what_it_does_not_prove(self):
        self.assertIn("What this does not prove", self.text)


class RealRecordings(unittest.TestCase):
    def made(self, *boards):
        with tempfile.TemporaryDirectory() as folder:
            place = Path(folder)
            (place / "real").mkdir()
            (place / "real" / "real.json").write_text(json.dumps(make_board.real()))
            for kind in boards:
                (place / "board.json").write_bytes(support.result(kind).read_bytes())
            with contextlib.redirect_stdout(io.StringIO()):
                self.assertEqual(build_board.main([folder]), 0)
            return (place / "board.html").read_text(encoding="utf-8")

    def test_they_have_a_page_of_their_own_where_no_case_was_concealed(self):
        page = self.made()
        rows = page.split("<tbody>")[1].split("</tbody>")[0]
        self.assertEqual(rows.count("<tr>"), 5)
        text = text_of(rows)
        self.assertIn("cogging or torque ripple", text)
        self.assertIn("88.0 % 13.2 % validation –", text)
        self.assertIn("delay (in part)", text)
        self.assertIn("6.0 % 3.0 % validation 71 %", text)
        self.assertIn('<span class="failed">wrong</span>', rows)
        self.assertIn("too poor", text)
        self.assertIn("One of 4 verdicts with names", text_of(page))

    def test_they_stand_below_the_concealed_cases(self):
        page = self.made("board_few")
        self.assertLess(page.index("The table"), page.index("lab_joint_3"))
        self.assertIn("Real joints are in a table of their own below.", text_of(page))
        self.assertNotIn("have not been counted", page)


if __name__ == "__main__":
    support.main()
