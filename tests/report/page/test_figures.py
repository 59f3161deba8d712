"""Every figure of every kind of result can be a PDF or a PNG, tried in turns; the same numbers give the same bytes."""

import itertools
import subprocess
import sys
import unittest
from pathlib import Path

import support
from torquescope.page import build, style
from torquescope.page.figures import DIAGNOSIS_MODULES, RECORDING_MODULES, STUDY_MODULES, all_cases

SCRIPT = Path(__file__).resolve().parents[3] / "scripts/report/figure.py"


class Figures(unittest.TestCase):
    def test_every_figure_is_written_as_pdf_or_png_in_turns(self):
        endings = itertools.cycle(((".pdf", b"%PDF"), (".png", b"\x89PNG")))
        kinds = ("crs", "named", "none") if support.DIAGNOSES else ("crs",)
        drawn = set()
        for name, case in [one for kind in kinds for one in all_cases(support.study(kind)).items()]:
            if case.draw.__module__ in drawn and not support.FULL:
                continue  # one of each kind of figure
            drawn.add(case.draw.__module__)
            with self.subTest(name=name):
                ending, magic = next(endings)
                out = support.FOLDER / f"{name}{ending}"
                style.save(case.figure(style.SMALL), out)
                self.assertEqual(out.read_bytes()[:4], magic)
                self.assertGreater(out.stat().st_size, 2000)

    def test_the_seed_study_uses_every_figure_module(self):
        used = {case.draw.__module__ for case in all_cases(support.study("crs")).values()}
        self.assertEqual(used, {f"torquescope.page.figures.{module}" for module in STUDY_MODULES + RECORDING_MODULES})

    @support.needs_diagnoses
    def test_a_diagnosis_uses_every_figure_module(self):
        used = {case.draw.__module__ for kind in ("named", "none") for case in all_cases(support.study(kind)).values()}
        expected = DIAGNOSIS_MODULES + RECORDING_MODULES
        self.assertEqual(used, {f"torquescope.page.figures.{module}" for module in expected})

    @support.needs_diagnoses
    def test_the_command_writes_the_map_of_a_diagnosis(self):
        for ending, magic in ((".pdf", b"%PDF"), (".png", b"\x89PNG")):
            out = support.FOLDER / f"map{ending}"
            subprocess.run([sys.executable, "-B", SCRIPT, "mismatch_map", support.result("named"), out], check=True)
            self.assertEqual(out.read_bytes()[:4], magic)

    def test_the_command_lists_and_writes_a_figure(self):
        result = support.result("de_only")
        listed = subprocess.run(
            [sys.executable, "-B", SCRIPT, "--list", result], capture_output=True, text=True, check=True
        )
        self.assertIn("convergence", listed.stdout)
        out = support.FOLDER / "convergence.pdf"
        subprocess.run([sys.executable, "-B", SCRIPT, "convergence", result, out], check=True)
        self.assertEqual(out.read_bytes()[:4], b"%PDF")

    def test_an_unknown_figure_is_refused_with_the_cure(self):
        told = subprocess.run([sys.executable, "-B", SCRIPT, "convergnce", support.result("de_only"), "a.pdf"],
                              capture_output=True, text=True)
        self.assertEqual(told.returncode, 64)
        self.assertIn("--list", told.stderr)

    def test_a_file_that_is_no_result_is_refused_in_one_line(self):
        path = support.FOLDER / "text.h5"
        path.write_text("not HDF5")
        for script, arguments in (("build.py", [path]), ("figure.py", ["--list", path])):
            told = subprocess.run(
                [sys.executable, "-B", SCRIPT.with_name(script), *arguments], capture_output=True, text=True
            )
            self.assertEqual(told.returncode, 65)
            self.assertRegex(told.stderr, r"^error: .*text\.h5.*\n$")

    def test_equal_results_give_equal_pages(self):
        self.assertEqual(build.page(support.study("de_only")), support.page("de_only").read_text(encoding="utf-8"))

    def test_a_figure_is_absent_where_there_is_nothing_to_draw(self):
        names = all_cases(support.study("prismatic"))
        self.assertNotIn("convergence", names)
        self.assertNotIn("torque_trace_validate", names)
        self.assertFalse([name for name in all_cases(support.study("de_only")) if "decision" in name])


if __name__ == "__main__":
    support.main()
