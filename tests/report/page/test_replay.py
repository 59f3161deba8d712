"""Recordings beside their simulation: the first pictures of a page whose file has them, and numbers as the file has
them."""

import itertools
import json
import re
import shutil
import subprocess
import sys
import unittest
from pathlib import Path

import browser
import h5py
import make_replay
import numpy as np
import support
from torquescope.page import build, compare, quantities as q, traces, words_of_replay
from torquescope.page.figures import all_cases, replay_trace
from torquescope.page.study import Study

ALONE = tuple(make_replay.ALONE)
SCRIPT = Path(__file__).resolve().parents[3] / "scripts/report/figure.py"


def text_of(kind):
    return support.page(kind).read_text(encoding="utf-8")


def figures_of(kind):
    return re.findall(r'<figure class="\w+" id="([^"]+)"', text_of(kind))


def case(kind, name="replay_1"):
    return all_cases(support.study(kind))[name]


def channel(kind, number=0, name="replay_1"):
    return case(kind, name).arguments["channels"][number]


def table(kind):
    return words_of_replay.table(support.study(kind))["rows"]


def changed(kind, change):
    """A Study of a copy of the file after change(group of the first recording)."""
    path = support.FOLDER / f"{kind}_changed.h5"
    shutil.copy(support.result(kind), path)
    with h5py.File(path, "r+") as file:
        change(file["replay/recording_1"])
    return Study(path)


class Order(unittest.TestCase):
    def test_validation_recordings_come_first(self):
        self.assertEqual(figures_of("replayed"), ["replay_2", "replay_2_velocity", "replay_1", "replay_1_velocity"])
        self.assertEqual([name for name, _ in words_of_replay.named_recordings(support.study("replayed_four").replay)],
                         ["replay_3", "replay_4", "replay_1", "replay_2"])

    def test_they_are_the_first_pictures_of_any_page(self):
        for kind in support.BESIDE:
            figures = figures_of(kind)
            self.assertEqual(figures[:4], ["replay_2", "replay_2_velocity", "replay_1", "replay_1_velocity"], kind)
            self.assertGreater(len(figures), 8, kind)
            text = text_of(kind)
            self.assertLess(text.index('<dl class="numbers">'), text.index('id="replay_2"'), "below the numbers")

    def test_beside_other_results_nothing_else_changes(self):
        for kind in support.BESIDE:
            self.assertEqual(figures_of(kind)[4:], figures_of(make_replay.BESIDE[kind]))

    @support.needs_diagnoses
    def test_beside_a_diagnosis_the_replay_stands_for_its_table_of_closed_loops(self):
        self.assertIn("Simulated from the reference, without noise", text_of("named"))
        self.assertNotIn("Simulated from the reference, without noise", text_of("named_replayed"))

    def test_an_older_file_has_none(self):
        self.assertIsNone(support.study("crs").replay)
        self.assertNotIn('id="replay_', text_of("crs"))

    def test_beyond_two_recordings_they_are_folded(self):
        text = text_of("replayed_four")
        self.assertLess(text.index('id="replay_4"'), text.index("2 more recordings</summary>"))
        self.assertLess(text.index("2 more recordings</summary>"), text.index('id="replay_1"'))

    def test_a_replay_alone_has_a_title_its_pictures_and_the_words_of_the_loop(self):
        for kind in ALONE:
            text = text_of(kind)
            verdict = words_of_replay.verdict(support.study(kind))
            self.assertIn(f"<title>{verdict['sentence']}</title>", text)
            self.assertEqual(text.count("<section"), 3, "verdict, pictures, where it comes from")
        read = re.sub(r"<svg\b.*?</svg>", "", text_of("replayed"), flags=re.S)
        self.assertEqual(read.count("The loop is a PD law with friction feed-forward"), 3,
                         "below the title, and of every recording")


class Numbers(unittest.TestCase):
    def test_the_table_has_the_numbers_of_the_file(self):
        rows = iter(table("replayed"))
        with h5py.File(support.result("replayed"), locking=False) as file:
            for number, called in ((2, "lab_2.csv, validation"), (1, "lab_1.csv, training")):
                one = file[f"replay/recording_{number}"]
                for name in ("position", "velocity", "torque"):
                    (rms, mae, relerr), samples = (one[name][key][()] for key in ("rms", "mae", "relerr")), (
                        one[name]["samples"][()])
                    unit = q.unit(one[name].attrs["unit"].decode())
                    ours, yours = next(rows), next(rows)
                    self.assertEqual(ours[:6], [
                        called, f"{name} ({unit})", q.whole(samples[0]), f"{q.number(rms[0])} → {q.number(rms[1])}",
                        f"{q.number(mae[0])} → {q.number(mae[1])}",
                        f"{q.number(100 * relerr[0], 2)} → {q.percent(relerr[1])}"])
                    self.assertEqual(yours[:6], [called, f"{name}, yours ({unit})", q.whole(samples[2]),
                                                 q.number(rms[2]), q.number(mae[2]), q.percent(relerr[2])])
                    self.assertEqual(ours[6:], ["identified", "21 s" if number == 2 else "its end"])
        self.assertIsNone(next(rows, None))

    def test_every_cell_stands_in_the_page(self):
        for kind in ALONE:
            text = text_of(kind).replace("\u00a0", " ")
            for row in table(kind):
                for cell in row:
                    self.assertIn(f">{cell}<", text, kind)

    def test_a_label_of_an_estimator_follows_its_number_with_a_by(self):
        said = words_of_replay.answer(support.study("rolled"))
        self.assertRegex(said, r"the position is off by [\d.]+ % by least squares and [\d.]+ % by lm;")

    def test_every_model_has_its_errors_in_the_table(self):
        rows = {(row[0], row[1]): row for row in table("rolled_several")}
        one = support.study("rolled_several").replay.recordings[2]
        self.assertEqual(rows["lab_3.csv, validation", "torque, fade (N m)"][3:6],
                         [q.number(one.torque.rms[1]), q.number(one.torque.mae[1]), q.percent(one.torque.relerr[1])])
        self.assertEqual(rows["lab_3.csv, validation", "torque (N m)"][3],
                         f"{q.number(one.torque.rms[0])} → {q.number(one.torque.rms[2])}")

    def test_the_title_has_the_error_of_the_validation_recording(self):
        error = support.study("replayed").replay.recordings[1].position.relerr
        self.assertEqual(words_of_replay.verdict(support.study("replayed"))["sentence"],
                         "On the validation recording lab_2.csv the simulated position is off by "
                         f"{q.percent(error[0])} as identified, {q.percent(error[1])} with what was named and "
                         f"{q.percent(error[2])} in your simulator.")

    def test_the_lines_are_the_samples_of_the_file(self):
        one = support.study("replayed").replay.recordings[1]
        shown = {part.name: part for part in case("replayed", "replay_2").arguments["channels"]}
        for name, drawn in shown.items():
            of = one.channels[name]
            np.testing.assert_array_equal(drawn.measured, of.measured)
            for model, (_, label, values, difference) in enumerate(drawn.sims):
                self.assertEqual(label, support.study("replayed").replay.models[model])
                np.testing.assert_array_equal(values, of.simulated[model])
                np.testing.assert_array_equal(difference, of.measured - of.simulated[model])
        self.assertEqual([len(drawn.sims) for drawn in shown.values()], [3, 2], "yours says nothing of the torque")

    def test_small_differences_have_a_finer_unit(self):
        self.assertEqual(replay_trace.finer("rad", 0.0019), ("mrad", 1e3))
        self.assertEqual(replay_trace.finer("rad", 1.9e-5), ("µrad", 1e6))
        self.assertEqual(replay_trace.finer("N m", 0.3), ("N m", 1.0))
        self.assertEqual(replay_trace.finer("1/s", 1e-3), ("1/s", 1.0))
        drawn = channel("replayed", 0, "replay_2")
        rms = support.study("replayed").replay.recordings[1].position.rms
        self.assertEqual(drawn.rms, f"{q.number(1e3 * rms[0])} → {q.number(1e3 * rms[1])}, yours "
                                    f"{q.number(1e3 * rms[2])}")
        self.assertIn(f"measured minus simulated (mrad), rms {drawn.rms}", text_of("replayed"))


class Captions(unittest.TestCase):
    def caption(self, kind, number=0):
        replay = support.study(kind).replay
        return words_of_replay.caption(replay, replay.recordings[number])

    def test_they_say_which_samples_which_loop_and_until_when(self):
        self.assertEqual(self.caption("replayed", 1),
                         "Simulated in closed loop from the commanded position: all 6000 samples at 200 Hz. The loop "
                         "is a PD law with friction feed-forward, identified from the recording. The loop’s controller "
                         "leaves "
                         "3.1 % of the recorded torque. Believe it until 21 s; what comes after is shaded.")
        self.assertTrue(self.caption("replayed", 0).endswith("It can be believed to its end."))

    def test_what_was_driven_otherwise_says_so(self):
        self.assertEqual(self.caption("replayed_once"),
                         "No reference was recorded: driven by the recorded torque, in windows of 0.5 s that begin "
                         "anew at the measured state: all 1200 samples at 200 Hz. It can be believed to its end.")
        self.assertIn("Driven by the drive’s recorded command: all 1600", self.caption("replayed_four", 2))

    def test_what_cannot_be_believed_is_shaded(self):
        self.assertEqual(case("replayed", "replay_2").arguments["beyond"], [(21.0, 29.995)])
        self.assertEqual(case("replayed", "replay_1").arguments["beyond"], [])

    def test_it_opens_on_neither_the_best_nor_the_worst_of_what_can_be_believed(self):
        start, stop = case("replayed", "replay_2").arguments["window"]
        self.assertAlmostEqual(stop - start, traces.OPENED_S)
        self.assertLessEqual(stop, 21.0)
        self.assertEqual(case("replayed_once").arguments["window"], (0.0, 5.995))


class Unusual(unittest.TestCase):
    def test_one_model_has_one_number_and_one_line(self):
        row, = table("replayed_once")
        error = support.study("replayed_once").replay.recordings[0].position
        self.assertEqual(row[3:6], [q.number(error.rms[0]), q.number(error.mae[0]), q.percent(error.relerr[0])])
        self.assertEqual([role for role, *_ in channel("replayed_once").sims], ["before"])
        self.assertEqual(figures_of("replayed_once"), ["replay_1"])

    def test_a_model_that_diverged_has_no_number_and_does_not_widen_the_picture(self):
        self.assertTrue(table("replayed_diverged")[0][3].startswith("diverged → "))
        drawn = channel("replayed_diverged")
        span = drawn.measured.max() - drawn.measured.min()
        self.assertLess(drawn.high - drawn.low, 1.5 * span)
        self.assertLess(np.nanmax(np.abs(drawn.sims[0][2])), 6 * span)
        self.assertIn("As identified it ran away", case("replayed_diverged").sentence)

    def test_when_all_diverged_there_is_still_a_picture(self):
        self.assertEqual(table("replayed_all_diverged")[0][3:6], ["diverged"] * 3)
        self.assertIn("Replayed, and a simulation ran away", text_of("replayed_all_diverged"))
        self.assertNotIn("believed to its end", case("replayed_all_diverged").sentence)

    def test_what_no_model_says_anything_of_is_drawn_as_measured(self):
        position, torque = case("replayed_four", "replay_4").arguments["channels"]
        self.assertEqual((len(position.sims), torque.sims), (2, []))

    def test_no_number_is_nan(self):
        for kind in (*ALONE, *support.BESIDE):
            body = text_of(kind).split("<body>")[1]
            drawings = re.findall(r"<svg\b.*?</svg>", body, flags=re.S)
            self.assertFalse([one[:200] for one in drawings if re.search(r"\b(nan|inf|infinity)\b", one, flags=re.I)])
            read = re.sub(r"<[^>]*>", " ", re.sub(r"<(script|pre)\b.*?</\1>", " ", body, flags=re.S))
            self.assertEqual(re.findall(r"\b[nN][aA][nN]\b|\bNone\b|\binf\b", read), [], kind)

    def test_the_layout_is_json(self):
        for kind in ALONE:
            layouts = re.findall(r'data-layout="([^"]*)"', text_of(kind))
            self.assertTrue(layouts)
            for layout in layouts:
                json.loads(layout.replace("&quot;", '"'), parse_constant=self.fail)

    def test_a_peak_leaves_the_frame_and_is_told(self):
        def peak(one):
            one["torque/simulated"][1, 500] += 400.0

        study = changed("replayed_diverged", peak)
        found = all_cases(study)["replay_1"]
        self.assertLess(found.arguments["channels"][1].limit, 1.0)
        self.assertRegex(found.sentence, r" Outside of the frames: 1 value of simulations or differences\.$")

    def test_a_joint_at_rest_can_be_drawn(self):
        def rest(one):
            for name in ("position", "velocity", "torque"):
                one[name]["measured"][...] = 0.5
                one[name]["simulated"][...] = 0.5

        drawn = all_cases(changed("replayed_diverged", rest))["replay_1"].arguments["channels"][0]
        self.assertLess(drawn.low, drawn.high)
        self.assertGreater(drawn.limit, 0)

    def test_a_result_without_anything_to_draw_is_refused(self):
        path = support.FOLDER / "nothing.h5"
        shutil.copy(support.result("replayed_once"), path)
        with h5py.File(path, "r+") as file:
            del file["replay"]
        with self.assertRaisesRegex(build.ResultError, "has nothing to draw"):
            Study(path)

    def test_a_replay_alone_is_not_compared(self):
        with self.assertRaisesRegex(build.ResultError, "has no estimates to compare"):
            compare.page([support.result("replayed_once"), support.result("crs")])

    def test_the_figure_can_be_written_for_a_paper(self):
        out = support.FOLDER / "replay.pdf"
        subprocess.run([sys.executable, "-B", SCRIPT, "replay_1", support.result("replayed_once"), out], check=True)
        self.assertEqual(out.read_bytes()[:4], b"%PDF")


DRAWN = """
const svg = document.querySelector('#replay_2 svg.wide'), layout = JSON.parse(svg.dataset.layout);
return [...layout.rows.keys()].map((row) => layout.rows[row].lines.map((part) =>
  svg.querySelector(`[data-part="${part}"] path`).getAttribute('d')));
"""


@browser.needs_browser
class Zoomed(browser.Browser):
    def test_the_table_of_errors_is_never_cut_off(self):
        for kind, width in itertools.product(("replayed", "rolled"), (400, 800, 1130, 1280)):
            self.open(kind, width=width)
            cut = self.script("return [...document.querySelectorAll('table.wraps :is(td, th)')].map((cell) => "
                              "cell.getBoundingClientRect().right).filter((right) => right > innerWidth)")
            self.assertEqual(cut, [], f"{kind} at {width}")
            self.assertGreater(self.script("return document.querySelectorAll('table.wraps td').length"), 40)

    def test_zooming_draws_the_samples_of_the_file(self):
        self.open("replayed")
        self.browser.execute_async_script(
            "const done = arguments[0]; document.getElementById('replay_2').zoomTo(17, 18).then(() => done())")
        layout = self.script("return JSON.parse(document.querySelector('#replay_2 svg.wide').dataset.layout)")
        one = support.study("replayed").replay.recordings[1]
        inside = (one.time >= 17) & (one.time <= 18)
        # row, line: what is drawn there
        expected = {(0, 0): one.position.measured, (0, 2): one.position.simulated[1],
                    (1, 1): one.position.difference(1), (2, 1): one.torque.simulated[0],
                    (3, 0): one.torque.difference(0)}
        paths = self.script(DRAWN)
        for (row, line), values in expected.items():
            box = layout["rows"][row]
            heights = [float(y) for y in re.findall(r" (-?[\d.]+)", paths[row][line])]
            for wanted, drawn in ((values[inside].max(), min(heights)), (values[inside].min(), max(heights))):
                pixel = box["bottom"] - (wanted - box["low"]) / (box["high"] - box["low"]) * (
                    box["bottom"] - box["top"])
                self.assertAlmostEqual(pixel, drawn, delta=1.0, msg=f"row {row}, line {line}")


if __name__ == "__main__":
    support.main()
