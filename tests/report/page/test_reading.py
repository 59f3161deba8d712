"""Values under the pointer, zooming by a drag and legends that hide, of every figure of a study and of a diagnosis."""

import re

import browser
import numpy as np
import support
from vary_diagnosis import HOSTILE_WORDS

try:
    from selenium.webdriver.common.action_chains import ActionChains
    from selenium.webdriver.common.by import By
    from selenium.webdriver.common.keys import Keys
except ImportError:
    pass

PAGES = ("crs", "arm") + (("named", "unexplained") if support.EXAMPLE_WRITER else ())

# where something is drawn in the figure [id, series or note or grid of which axes]: [x, y] from the middle of its area
PLACE = """
const figure = document.getElementById(arguments[0]);
const svg = [...figure.querySelectorAll('svg[data-chart]')].find((one) => one.getBoundingClientRect().width);
const axes = JSON.parse(document.getElementById(svg.dataset.chart).textContent)
  .find((one) => one.series.length || one.notes.length || one.grids.length);
const [left, top, right, bottom] = axes.box;
const along = ({from, to, log}, value) => log ? Math.log(value / from) / Math.log(to / from)
  : (value - from) / (to - from);
const told = axes.series.find((one) => one.x)
  ?? axes.series.find((one) => one.edges)
  ?? {};
const xs = told.x ?? told.edges ?? [], k = Math.floor(xs.length / 2);
const note = axes.notes[0], cell = note?.cell;
const value = arguments[1] ?? (xs.length ? xs[k] : cell ? (cell[0] + cell[1]) / 2 : note ? note.at[0]
  : (axes.x.from + axes.x.to) / 2);
const y = xs.length || !note ? (top + bottom) / 2
  : bottom - along(axes.y, cell ? (cell[2] + cell[3]) / 2 : note.at[1]) * (bottom - top);
figure.scrollIntoView({block: 'center'});
const box = svg.getBoundingClientRect(), area = svg.parentElement.getBoundingClientRect();
const scale = box.width / svg.viewBox.baseVal.width;
return [box.left + (left + along(axes.x, value) * (right - left)) * scale - area.left - area.width / 2,
        box.top + y * scale - area.top - area.height / 2];
"""
DRAWN = "return [...document.querySelectorAll(`#${arguments[0]} svg path`)].map((p) => p.getAttribute('d')).join()"
READ = """
const [id, done] = arguments, began = performance.now();
const look = () => {
  const box = document.querySelector(`#${id} .reading`);
  if (box && !box.hidden) return done([...box.children].map((line) => line.textContent));
  performance.now() - began > 3000 ? done([]) : requestAnimationFrame(look);
};
look();
"""


@browser.needs_browser
class Reading(browser.Browser):
    def area(self, figure):
        return self.browser.find_element(By.CSS_SELECTOR, f"#{figure} :is(.chart, .trace)")

    def point_at(self, figure, value=None):
        x, y = self.script(PLACE, figure, value)
        ActionChains(self.browser).move_to_element_with_offset(self.area(figure), round(x), round(y)).perform()

    def read(self, figure):
        return self.browser.execute_async_script(READ, figure)

    def drag(self, figure, x, y, dx, dy):
        area = self.area(figure)
        self.script("arguments[0].scrollIntoView({block: 'center'})", area)
        (ActionChains(self.browser).move_to_element_with_offset(area, x, y).click_and_hold().move_by_offset(dx, dy)
         .release().perform())

    def drawn(self, figure):
        return self.script(DRAWN, figure)

    def test_every_figure_says_what_is_under_the_pointer(self):
        for kind in PAGES:
            self.open(kind)
            figures = self.script("document.querySelectorAll('details').forEach((one) => one.open = true);"
                                  "return [...document.querySelectorAll('figure')].map((f) => f.id)")
            for figure in figures:
                with self.subTest(kind=kind, figure=figure):
                    if self.script("return Boolean(document.querySelector(`#${arguments[0]} .trace`))", figure):
                        self.script("document.getElementById(arguments[0]).scrollIntoView({block: 'center'})", figure)
                        area = self.area(figure)
                        top = 60 - area.size["height"] // 2
                        ActionChains(self.browser).move_to_element_with_offset(area, 30, top).perform()
                    else:
                        self.point_at(figure)
                    self.assertRegex(" ".join(self.read(figure)), r"\d")
            self.assertEqual([one for one in self.browser.get_log("browser") if one["level"] == "SEVERE"], [])

    @support.needs_diagnoses
    def test_the_value_read_is_that_of_the_file(self):
        row = support.study("named").diagnosis.joints[0].map["velocity"]
        cell = int(np.nanargmax(row.mean_residual))
        self.open("named")
        self.point_at("effect_1_residual", float(row.centre[cell]))
        read = self.read("effect_1_residual")
        self.assertIn(f"baseline {row.mean_residual[cell]:.4g} N m", " ".join(read))
        self.assertRegex(read[0], r"^velocity −?[\d.]+ rad/s$")

    def test_a_trace_reads_the_sample_of_the_file(self):
        self.open("crs")
        area = self.area("torque_trace_train")
        self.script("document.getElementById('torque_trace_train').scrollIntoView({block: 'center'})")
        ActionChains(self.browser).move_to_element_with_offset(area, 30, 60 - area.size["height"] // 2).perform()
        time, *lines = self.read("torque_trace_train")
        study = support.study("crs")
        sample = int(np.argmin(np.abs(study.train.laid_end_to_end - float(time.split()[0]))))
        said = float(re.search(r"measured (−?[\d.]+) N m", lines[0])[1].replace("−", "-"))
        self.assertAlmostEqual(said, study.train.torque[sample], delta=1e-3)
        self.assertEqual(len(lines), 1 + len(study.estimators))

    def test_a_drag_opens_a_box_and_a_double_click_goes_back(self):
        self.open("crs")
        first = self.drawn("residual_by_speed")
        self.drag("residual_by_speed", -40, -40, 90, 60)
        closer = self.drawn("residual_by_speed")
        self.assertNotEqual(closer, first)
        button = self.browser.find_element(By.CSS_SELECTOR, "#residual_by_speed button[data-do=back]")
        self.assertTrue(button.is_displayed())
        ActionChains(self.browser).double_click(self.area("residual_by_speed")).perform()
        self.assertFalse(button.is_displayed())
        numbers = re.compile(r"-?[\d.]+")
        for before, now in zip(numbers.findall(first), numbers.findall(self.drawn("residual_by_speed"))):
            self.assertAlmostEqual(float(before), float(now), delta=0.06)

    def test_after_a_zoom_the_same_place_reads_the_same_value(self):
        """A zoom of the keys is about the place that is read."""
        self.open("crs")
        self.point_at("convergence")
        before = self.read("convergence")
        self.area("convergence").send_keys("+")
        ActionChains(self.browser).move_by_offset(0, 1).perform()
        self.point_at_same("convergence")
        self.assertEqual(self.read("convergence")[1:], before[1:])

    def point_at_same(self, figure):
        """An arrow there and back: the reading of the keys."""
        self.area(figure).send_keys(Keys.ARROW_DOWN, Keys.ARROW_UP)

    def test_an_entry_of_the_legend_hides_what_it_names_and_shows_it_again(self):
        self.open("crs")
        for figure, part in (("convergence", "series-0"), ("torque_trace_train", "e1")):
            keys = self.browser.find_elements(By.CSS_SELECTOR, f"#{figure} button.key")
            self.assertGreater(len(keys), 1, figure)
            shown = ("return [...document.querySelectorAll(`#${arguments[0]} svg [data-part~=\"${arguments[1]}\"]`)]"
                     ".filter((one) => one.style.display !== 'none').length")
            before = self.script(shown, figure, part)
            self.assertGreater(before, 0)
            name = self.script(
                "const [id, part] = arguments;"
                "return [...document.querySelectorAll(`#${id} button.key`)].findIndex((button) => {"
                "  button.click();"
                "  const gone = !document.querySelector(`#${id} svg [data-part=\"${part}\"]:not([style*=none])`);"
                "  if (!gone) button.click();"
                "  return gone; })", figure, part)
            self.assertGreaterEqual(name, 0, figure)
            self.assertEqual(self.script(shown, figure, part), 0)
            self.assertEqual(keys[name].get_attribute("aria-pressed"), "false")
            keys[name].click()
            self.assertEqual(self.script(shown, figure, part), before)

    def test_what_is_hidden_is_not_read(self):
        self.open("crs")
        self.point_at("convergence")
        before = self.read("convergence")
        self.browser.find_element(By.CSS_SELECTOR, "#convergence button.key").click()
        self.point_at("convergence")
        self.assertEqual(len(self.read("convergence")), len(before) - 1)

    def test_a_drag_with_a_height_opens_one_row_of_a_trace(self):
        self.open("crs")
        labels = ("return [...document.querySelectorAll('#torque_trace_train svg.wide text')].filter((t) => "
                  "getComputedStyle(t.parentElement.parentElement.parentElement).display !== 'none').map((t) => "
                  "t.textContent)")
        before = self.script(labels)
        area = self.area("torque_trace_train")
        self.drag("torque_trace_train", -200, 50 - area.size["height"] // 2, 200, 40)
        self.browser.execute_async_script("setTimeout(arguments[0], 300)")
        self.assertNotEqual(self.script(labels), before)
        self.assertEqual(self.script("return document.querySelectorAll('#torque_trace_train svg.wide [data-part=y-axis]"
                                     "[style*=none]').length"), 1)

    def test_without_scripts_the_pictures_and_their_legends_stand(self):
        self.browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": True})
        try:
            self.open("crs")
            self.assertTrue(self.browser.find_element(By.CSS_SELECTOR, "#convergence svg").is_displayed())
            legend = self.browser.find_element(By.CSS_SELECTOR, "#convergence .keys")
            self.assertIn("FADE", legend.text)
            self.assertFalse(self.browser.find_elements(By.CSS_SELECTOR, "button.key"))
        finally:
            self.browser.execute_cdp_cmd("Emulation.setScriptExecutionDisabled", {"value": False})

    @support.needs_diagnoses
    def test_hostile_words_stay_words_in_legends_and_readings(self):
        self.open("hostile_words")
        legends = self.script("return [...document.querySelectorAll('.key')].map((one) => one.textContent).join('|')")
        self.assertIn(HOSTILE_WORDS, legends)
        row = support.study("hostile_words").diagnosis.joints[0].map["velocity"]
        self.point_at("effect_1_residual", float(row.centre[20]))
        self.assertIn(HOSTILE_WORDS, " ".join(self.read("effect_1_residual")))
        self.assertEqual(self.script("return document.querySelectorAll('.reading script, .keys script').length"), 0)


if __name__ == "__main__":
    support.main()
