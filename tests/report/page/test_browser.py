"""The page in a browser, wide and on a phone, light and dark: nothing overflows, nothing comes from elsewhere."""

import base64
import itertools
import json
import re

import browser
import support
import numpy as np
from vary_diagnosis import HOSTILE_WORDS

try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    pass

ALL = (support.KINDS + support.ARMS + support.DIAGNOSES + support.BOARDS + support.COMPARED + support.REPLAYS
       + support.BESIDE + support.ROLLED + support.SERVOS)
DRAWN = ("crs", "arm", "named", "unexplained", "minute", "two_joints", "board", "compared", "replayed", "rolled",
         "servo")
KINDS = tuple(kind for kind in ALL if support.FULL or kind in DRAWN)
FEWEST_FIGURES = {"arm": 6, "insufficient": 5, "board_few": 1, "compared": 1,
                  **{kind: 1 for kind in support.REPLAYS}, "servo_none": 1, "servo_ran_away": 0}
WIDTHS, THEMES = (1280, 800, 400), ("light", "dark")
TALLEST_OF_JOINTS_PX = 6000  # of the joints of an arm on a phone, as the page opens
LEAST_TEXT_PX = 10.5
MOST_BYTES = 3e6
MANY_BYTES = {"servo_60": 6e6}  # sixty recordings
MOST_POINTS_PER_PIXEL = 4  # first, lowest, highest, last
OVERLAP_PX = 1.5  # boxes of text are taller than its letters

# of every line in every width: its part, whether it is shown, how often it was drawn, its points, its pieces, the
# pixels it has
DRAWN_BY_A_ZOOM = """
const [id, from, to, done] = arguments;
const figure = document.getElementById(id), records = [], lines = [];
const observer = new MutationObserver((more) => records.push(...more));
for (const svg of figure.querySelectorAll('svg[data-layout]')) {
  const layout = JSON.parse(svg.dataset.layout);
  for (const part of layout.rows.flatMap((row) => row.lines)) {
    const path = svg.querySelector(`[data-part="${part}"] path`);
    observer.observe(path, { attributes: true, attributeFilter: ['d'] });
    lines.push({ part, path, shown: svg.getBoundingClientRect().width > 0, pixels: layout.right - layout.left });
  }
}
figure.zoomTo(from, to).then(() => {
  records.push(...observer.takeRecords());
  const count = (text, letters) => (text.match(letters) ?? []).length;
  done(lines.map(({ part, path, shown, pixels }) => [part, shown, records.filter((one) => one.target === path).length,
    count(path.getAttribute('d'), /[ML]/g), count(path.getAttribute('d'), /M/g), pixels]));
});
"""

MEASURE = """
const seen = (e) => { const b = e.getBoundingClientRect(); return b.width > 0 && b.height > 0; };
const small = [], outside = [], overlapping = [], empty = [], tainted = [];
for (const svg of [...document.querySelectorAll('figure svg')].filter(seen)) {
  const name = svg.closest('figure').id;
  const marks = [...svg.querySelectorAll('path,use,rect,circle')].filter((e) => {
    const b = e.getBoundingClientRect();
    return b.width + b.height > 0;
  });
  if (!marks.length) empty.push(name);
  const texts = [...svg.querySelectorAll('text')].filter(seen).map((e) => {
    const b = e.getBoundingClientRect();
    return {text: e.textContent, l: b.left, r: b.right, t: b.top, b: b.bottom,
            size: parseFloat(getComputedStyle(e).fontSize) * b.height / e.getBBox().height,
            colour: getComputedStyle(e).fill};
  });
  for (const t of texts) {
    if (t.size < arguments[0]) small.push([name, t.text, t.size]);
    if (t.l < -0.5 || t.r > innerWidth + 0.5) outside.push([name, t.text]);
    const box = svg.getBoundingClientRect();
    if (t.l < box.left - 1 || t.r > box.right + 1 || t.b > box.bottom + 3) outside.push([name, t.text, 'its figure']);
    if (t.colour === 'rgb(0, 0, 0)') tainted.push([name, t.text]);
  }
  for (let i = 0; i < texts.length; i++) for (let j = i + 1; j < texts.length; j++) {
    const a = texts[i], b = texts[j];
    const across = Math.min(a.r, b.r) - Math.max(a.l, b.l), down = Math.min(a.b, b.b) - Math.max(a.t, b.t);
    if (across > arguments[1] && down > arguments[1] + 2)
      overlapping.push([name, a.text, b.text]);
  }
}
const bare = [...document.querySelectorAll('figure svg[role=img]')].filter((s) =>
  !s.querySelector('title')?.textContent || !s.querySelector('desc')?.textContent).map((s) => s.closest('figure').id);
return {small, outside, overlapping, empty, tainted, bare, figures: document.querySelectorAll('figure').length,
        scroll: document.documentElement.scrollWidth, inner: innerWidth,
        requests: performance.getEntriesByType('resource').map((e) => e.name)};
"""


@browser.needs_browser
class Page(browser.Browser):
    def test_figures_are_complete_and_readable_at_every_width_and_theme(self):
        for kind, width in itertools.product(KINDS, WIDTHS):
            # the other kinds each have the narrowest and the widest every time, and all widths in full
            if width == 800 and not support.FULL and kind not in ("named", "arm"):
                continue
            self.open(kind, width)
            for theme in THEMES:  # the reader's system changes it under an open page
                self.media(theme)
                with self.subTest(kind=kind, width=width, theme=theme):
                    found = self.script(MEASURE, LEAST_TEXT_PX, OVERLAP_PX)
                    self.assertGreaterEqual(found["figures"], FEWEST_FIGURES.get(kind, 8))
                    for law in ("empty", "small", "outside", "overlapping", "tainted", "bare", "requests"):
                        self.assertEqual(found[law], [], law)
                    self.assertEqual(found["scroll"], found["inner"])
                    self.assertEqual(self.browser.get_log("browser"), [])

    @support.needs_diagnoses
    def test_joints_are_folded_and_those_that_lack_something_come_first(self):
        self.open("two_joints", 400)
        self.assertLess(self.script("return document.documentElement.scrollHeight"), TALLEST_OF_JOINTS_PX)
        first, second = (one.text for one in self.browser.find_elements(By.CSS_SELECTOR, "section.joint"))
        self.assertIn("Joint 2\n● Missing physics named", first)
        self.assertIn("Joint 1\n○ Nothing missing", second)
        opened = "return [...document.querySelectorAll('details.of-joint')].map((e) => e.open)"
        self.assertEqual(self.script(opened), [False, False])
        self.browser.find_element(By.CSS_SELECTOR, "details.of-joint > summary").click()
        self.assertEqual(self.script(opened), [True, False])
        self.assertTrue(self.browser.find_element(By.ID, "mismatch_map_joint_2").is_displayed())

    @support.needs_diagnoses
    def test_measured_and_predicted_torque_stand_first(self):
        self.open("named", 800)
        figures = self.script("return [...document.querySelectorAll('figure')].map((e) => e.id)")
        self.assertEqual(figures[0], "trace_1")
        legend = self.browser.find_element(By.CSS_SELECTOR, "#trace_1 .keys").text
        for label in ("measured", "predicted before", "predicted after"):
            self.assertIn(label, legend)

    def test_no_colour_is_baked_in(self):
        for kind in KINDS:
            body = support.page(kind).read_text(encoding="utf-8").split("<body>")[1].split("<script")[0]
            self.assertEqual(re.findall(r"(?:fill|stroke|color)[:=]\s*\"?#[0-9a-fA-F]{3,6}", body), [])

    def test_nothing_is_fetched(self):
        for kind in KINDS:
            text = support.page(kind).read_text(encoding="utf-8")
            self.assertEqual(re.findall(r"https?:|@import|url\((?!#)|<link[^>]+href=\"(?!data:)|\ssrc=", text), [])

    def test_a_page_stays_small_enough_to_mail(self):
        for kind in KINDS:
            self.assertLess(support.page(kind).stat().st_size, MANY_BYTES.get(kind, MOST_BYTES), kind)

    def test_the_first_picture_waits_for_nothing(self):
        """It stands in the page: no script draws it, and nothing else is fetched."""
        for kind in ("many", "minute") if support.DIAGNOSES else ("many",):
            self.assertRegex(
                support.page(kind).read_text(encoding="utf-8"), r'data-layout=(?s:.){0,20000}?<path d="M[^"]{100}'
            )
            self.open(kind)
            self.assertEqual(self.script("return performance.getEntriesByType('resource').length"), 0, kind)

    def test_the_title_is_what_was_found(self):
        for kind in ("crs", "board", *support.VERDICTS):
            self.open(kind)
            self.assertEqual(self.browser.title, self.browser.find_element(By.TAG_NAME, "h1").text.replace("\n", " "))

    def zoom(self, figure, start, stop):
        return self.browser.execute_async_script(
            "const [id, a, b, done] = arguments; const f = document.getElementById(id);"
            "f.zoomTo(a, b).then(() => done());", figure, start, stop)

    def assert_little_is_drawn(self, figure):
        """However many samples a window has: every line of the width that is shown is drawn once, with a few points per
        pixel."""
        for window in ((0, 60), (5, 50), (20, 20.5)):
            for part, is_shown, times, points, pieces, pixels in self.browser.execute_async_script(
                DRAWN_BY_A_ZOOM, figure, *window
            ):
                said = f"{part} {window}"
                self.assertEqual(times, 1 if is_shown else 0, said)
                if is_shown:
                    # a sample beyond each end; a gap in the middle of a pixel begins another piece there
                    self.assertLessEqual(points, MOST_POINTS_PER_PIXEL * (pixels + 2 + pieces), said)

    def test_zooming_a_minute_at_1_khz_draws_little(self):
        self.open("many")
        self.assert_little_is_drawn("torque_trace_train")

    def drawn(self, part, figure="torque_trace_train"):
        return self.script(
            "return [...document.querySelectorAll(`#${arguments[1]} svg[data-layout]`)].find((s) => "
            "s.getBoundingClientRect()"
            ".width)?.querySelector(`[data-part=\"${arguments[0]}\"] path`).getAttribute('d')",
            part,
            figure,
        )

    def test_the_script_draws_what_the_first_picture_showed(self):
        """Same window through both thinnings: the curves lie on each other to a pixel."""
        self.open("crs")
        def heights(d):
            points = [tuple(map(float, pair)) for pair in re.findall(r"(-?[\d.]+)[ ,](-?[\d.]+)", d)]
            inside = [(x, y) for x, y in points if 50 <= x <= 1068]
            return min(y for _, y in inside), max(y for _, y in inside), inside[0], inside[-1]
        before = heights(self.drawn("measured-e1"))
        layout = self.script("return JSON.parse(document.querySelector('#torque_trace_train svg.wide').dataset.layout)")
        self.zoom("torque_trace_train", layout["start"], layout["stop"])
        after = heights(self.drawn("measured-e1"))
        self.assertAlmostEqual(before[0], after[0], delta=1)
        self.assertAlmostEqual(before[1], after[1], delta=1)
        for first, second in zip(before[2:], after[2:]):
            self.assertAlmostEqual(first[0], second[0], delta=2)

    def test_zooming_out_keeps_every_spike(self):
        """The lowest and highest residual of the minute are drawn where they are, however many samples share a
        pixel."""
        self.open("many")
        study = support.study("many")
        residual = study.train.torque - study.train.prediction(study.estimators[0].chosen)
        self.zoom("torque_trace_train", 0, 60)
        row = self.script(
            "return JSON.parse(document.querySelector('#torque_trace_train svg.wide').dataset.layout).rows[1]"
        )
        drawn = [float(y) for y in re.findall(r" (-?[\d.]+)", self.drawn("measured-e0"))]
        for value, pixel in ((residual.max(), min(drawn)), (residual.min(), max(drawn))):
            expected = row["bottom"] - (value - row["low"]) / (row["high"] - row["low"]) * (row["bottom"] - row["top"])
            self.assertAlmostEqual(pixel, expected, delta=0.15)

    def test_the_other_width_shows_the_same_window_once_it_is_shown(self):
        self.open("crs")
        self.zoom("torque_trace_train", 1.0, 2.0)
        self.browser.execute_cdp_cmd("Emulation.setDeviceMetricsOverride",
                                     {"width": 400, "height": 900, "deviceScaleFactor": 1, "mobile": True})
        ticks = self.browser.execute_async_script(
            "const done = arguments[0], svg = document.querySelector('#torque_trace_train svg.narrow'), began = "
            "performance.now();"
            "const read = () => [...svg.querySelectorAll('text')].map((t) => t.textContent);"
            "const look = () => read().includes('1.50') || read().includes('1.5') || performance.now() - began > 3000"
            " ? done(read()) : requestAnimationFrame(look); look();"
        )
        self.assertTrue({"1.5", "1.50"} & set(ticks), ticks)

    def test_laws_hold_after_zooming_too(self):
        for width in WIDTHS:
            self.open("many", width)
            self.zoom("torque_trace_train", 20.03, 20.61)
            found = self.script(MEASURE, LEAST_TEXT_PX, OVERLAP_PX)
            for law in ("small", "outside", "overlapping"):
                self.assertEqual(found[law], [], f"{law} at {width}")

    @support.needs_diagnoses
    def test_zooming_a_diagnosed_minute_draws_little(self):
        self.open("minute")
        self.assert_little_is_drawn("trace_1")

    @support.needs_diagnoses
    def test_the_residual_has_a_gap_wherever_the_joint_turns_round(self):
        """20 reversals in 30 s: 21 pieces, and no line through zero between them."""
        self.assertNotRegex(support.page("minute").read_text(encoding="utf-8"), r'(?i)\bd="[^"]*nan')
        self.open("minute")
        for window in ((0.5, 30.5), (0.5, 15.5)):
            self.zoom("trace_1", *window)
            reversals = len([at for at in np.arange(0.75, 60, 1.5) if window[0] < at < window[1]])
            for part in ("before", "after"):
                self.assertEqual(self.drawn(part, "trace_1").count("M"), reversals + 1)

    @support.needs_diagnoses
    def test_located_regions_stay_with_the_motion_when_zoomed(self):
        """|velocity| <= 0.12 of 2.1 cos: shaded for 2 * 0.12 / 2.1 * 3 / (2 pi) s at every reversal, in every row."""
        self.open("minute")
        self.zoom("trace_1", 1.0, 4.0)
        layout = self.script("return JSON.parse(document.querySelector('#trace_1 svg.wide').dataset.layout)")
        shades = self.script("return [...document.querySelectorAll('#trace_1 svg.wide [data-part=regions] path')]"
                             ".map((p) => p.getAttribute('d'))")
        self.assertEqual(len(shades), 4)  # torque, residuals before and after, position
        per_second = (layout["right"] - layout["left"]) / 3.0
        for shade in shades:
            boxes = [(float(a), float(b)) for a, b in re.findall(r"M(-?[\d.]+) [\d.]+H(-?[\d.]+)V", shade)]
            self.assertEqual(len(boxes), 2)  # reversals at 2.25 s and 3.75 s
            for (left, right), at in zip(boxes, (2.25, 3.75)):
                self.assertAlmostEqual((left + right) / 2, layout["left"] + (at - 1.0) * per_second, delta=1.0)
                self.assertAlmostEqual(right - left, 0.24 / 2.1 * 3 / (2 * np.pi) * per_second, delta=1.0)

    @support.needs_diagnoses
    def test_the_button_copies_the_verdict_of_the_file(self):
        self.open("named")
        kept = self.script("return document.getElementById('verdict-json').textContent")
        self.assertEqual(json.loads(kept), json.loads(support.study("named").diagnosis.verdict_json))
        self.browser.execute_cdp_cmd(
            "Browser.grantPermissions", {"permissions": ["clipboardReadWrite", "clipboardSanitizedWrite"]}
        )
        self.browser.find_element(By.ID, "copy-verdict").click()
        told = self.browser.execute_async_script(
            "const done = arguments[0], began = performance.now();"
            "const look = () => { const told = document.querySelector('#copy-verdict + output').textContent;"
            "const open = document.querySelector('#copy-verdict').parentElement.nextElementSibling.open;"
            "told || open || performance.now() - began > 3000 ? done([told, open]) : requestAnimationFrame(look); "
            "}; look();"
        )
        self.assertIn(told, (["copied", False], ["", True]))

    @support.needs_diagnoses
    def test_hostile_words_are_shown_and_keep_no_script_from_running(self):
        self.browser.get_log("browser")  # of the pages before this one
        self.open("hostile_words")
        self.assertIn(HOSTILE_WORDS, self.script("return document.body.innerText"))
        kept = self.script("return document.getElementById('verdict-json').textContent")
        self.assertEqual(json.loads(kept)["reason"], HOSTILE_WORDS)
        before = self.background()
        self.browser.find_element(By.ID, "theme").click()
        self.assertNotEqual(self.background(), before, "the page's own script runs")
        traces = self.script("return [...document.querySelectorAll('figure')].map((f) => typeof f.zoomTo)")
        self.assertIn("function", traces, "and so does that of the figures")
        self.assertEqual([one for one in self.browser.get_log("browser") if one["level"] == "SEVERE"], [])

    def wait_for_zoom(self, before):
        self.browser.execute_async_script(
            "const [before, done] = arguments; const began = performance.now();"
            "const look = () => "
            "{ const d = document.querySelector('#torque_trace_train svg.wide [data-part=measured] path')"
            ".getAttribute('d'); d !== before || performance.now() - began > 3000 ? done() : "
            "requestAnimationFrame(look); }; look();",
            before,
        )
        return self.drawn("measured")

    def test_a_trace_obeys_the_keyboard(self):
        self.open("crs")
        area = self.browser.find_element(By.CSS_SELECTOR, "#torque_trace_train .trace")
        first = self.drawn("measured")
        seen = [first]
        for key in ("0", "+", Keys.ARROW_RIGHT, "-"):
            area.send_keys(key)
            seen.append(self.wait_for_zoom(seen[-1]))
        self.assertEqual(len(set(seen[1:])), 4)  # home, closer, later, wider: four different pictures
        area.send_keys("0")
        self.assertEqual(self.wait_for_zoom(seen[-1]), seen[1])

    def test_dragging_zooms_and_a_double_click_goes_back(self):
        self.open("crs")
        area = self.browser.find_element(By.CSS_SELECTOR, "#torque_trace_train .trace")
        area.send_keys("0")
        home = self.wait_for_zoom(self.drawn("measured"))
        ActionChains(self.browser).move_to_element_with_offset(area, -200, -80).click_and_hold().move_by_offset(
            150, 0
        ).release().perform()
        closer = self.wait_for_zoom(home)
        self.assertNotEqual(closer, home)
        ActionChains(self.browser).move_to_element_with_offset(area, -200, -80).double_click().perform()
        self.assertEqual(self.wait_for_zoom(closer), home)

    def test_shift_drag_measures(self):
        self.open("crs")
        area = self.browser.find_element(By.CSS_SELECTOR, "#torque_trace_train .trace")
        (ActionChains(self.browser).move_to_element_with_offset(area, -200, -80).key_down(Keys.SHIFT).click_and_hold()
         .move_by_offset(150, 20).release().key_up(Keys.SHIFT).perform())
        told = self.browser.find_element(By.CSS_SELECTOR, "#torque_trace_train output").text
        self.assertRegex(told, r"^Δt 0\.8\d+ s, Δτ −[\d.]+ N m$")

    def test_the_button_overrides_the_system_in_both_directions(self):
        for theme in THEMES:
            self.open("de_only", theme=theme)
            before = self.background()
            self.browser.find_element(By.ID, "theme").click()
            changed = self.background()
            self.assertNotEqual(before, changed)
            self.browser.find_element(By.ID, "theme").click()
            self.assertEqual(self.background(), before)

    def test_paper_is_light_and_shows_the_wide_figures(self):
        self.open("crs", theme="dark")
        self.media("dark", "print")
        self.assertEqual(self.background(), "rgb(255, 255, 255)")
        shown = self.script("return [...document.querySelectorAll('svg.wide,svg.narrow')].map((s) => "
                            "[s.getAttribute('class'), getComputedStyle(s).display])")
        self.assertEqual({tuple(pair) for pair in shown}, {("wide", "block"), ("narrow", "none")})
        self.media("light")
        pdf = base64.b64decode(self.browser.execute_cdp_cmd("Page.printToPDF", {"printBackground": True})["data"])
        self.assertEqual(pdf[:5], b"%PDF-")
        self.assertGreater(pdf.count(b"/Type /Page\n") + pdf.count(b"/Type /Page "), 2)

    def test_what_is_folded_away_is_as_wide_as_its_section(self):
        self.open("crs")
        widths = self.script("return [...document.querySelectorAll('section > details')].map((fold) => "
                             "fold.getBoundingClientRect().width / fold.parentElement.getBoundingClientRect().width)")
        self.assertGreater(len(widths), 1)
        self.assertGreater(min(widths), 0.9)

    def test_no_estimate_is_out_of_sight_on_a_phone(self):
        """Every cell of every table stands inside the window, and so does every error beside its dots."""
        for kind in ("crs", "arm", *(("named", "compared") if support.EXAMPLE_WRITER else ())):
            self.open(kind, width=400)
            self.script("document.querySelectorAll('details').forEach((one) => one.open = true)")
            cut = self.script(
                "return [...document.querySelectorAll('table.stacks :is(td, tbody th)')].filter((cell) => {"
                "  const box = cell.getBoundingClientRect();"
                "  return !box.width || box.right > innerWidth + 0.5 || cell.scrollWidth > cell.clientWidth + 1; })"
                ".map((cell) => cell.textContent)")
            self.assertEqual(cut, [], kind)
            if kind == "compared":
                continue
            figure = {"crs": "relative_error", "arm": "joint_errors"}.get(kind, "error_before_after")
            shown = self.script("return document.querySelector(`#${arguments[0]} svg.narrow`).textContent", figure)
            self.assertRegex(shown, r"[\d.]+ % → [\d.]+ %")
        if support.EXAMPLE_WRITER:
            self.open("named", width=400)
            row = self.browser.find_element(By.CSS_SELECTOR, ".candidates .kept th").text
            self.assertRegex(row, r"(?s)Stribeck friction.*reversal.*CV gain")

    @support.needs_diagnoses
    def test_no_table_is_cut_off_on_paper(self):
        """A4 less its margins is 688 px wide."""
        for kind in ("named", "none", "crs", "replayed"):
            self.open(kind, width=688)
            self.media("light", "print")
            cut = self.script("return [...document.querySelectorAll('table')].map((t) => t.getBoundingClientRect())"
                              ".filter((b) => b.width > 0 && b.right > innerWidth + 0.5).map((b) => b.right)")
            self.assertEqual(cut, [], kind)
        self.media("light")


if __name__ == "__main__":
    support.main()
