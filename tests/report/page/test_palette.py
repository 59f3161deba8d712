"""The palette: whoever sees it, in the light and in the dark, can tell compared colours apart and read the text.

Source     colour vision: Machado, Oliveira, Fernandes 2009, severity 1; contrast: WCAG 2
"""

import itertools
import unittest

import support
import numpy as np
from torquescope.page import style

SEEN_BY = {
    "everybody": np.eye(3),
    "protan": np.array(
        [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]
    ),
    "deutan": np.array(
        [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]
    ),
    "tritan": np.array(
        [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]
    ),
}
LEAST_DISTANCE = 25  # CIELAB units between two colours that must be told apart
LEAST_TEXT_CONTRAST = 4.5  # WCAG AA
LEAST_LINE_CONTRAST = 2.2  # the measured trace is meant to stand back, but not to vanish
RESERVED = {"baseline": ("#c2500a", "#ff9b57"), "augmented": ("#0067a8", "#63b8f5")}  # before and after, light and dark
DIAGNOSIS_COMPARED = ("baseline", "augmented", "measured", "ink")
# the palest step of a map says only "a little beyond chance"; from the next one on its sign must be seen
SIGNED_STEPS = (2, 3, 4)


def linear(colour):
    value = np.array([int(colour[i:i + 2], 16) for i in (1, 3, 5)]) / 255
    return np.where(value <= 0.04045, value / 12.92, ((value + 0.055) / 1.055) ** 2.4)


def lab(rgb):
    xyz = np.array([[0.4124, 0.3576, 0.1805], [0.2126, 0.7152, 0.0722], [0.0193, 0.1192, 0.9505]]) @ rgb
    x, y, z = (np.cbrt(t) if t > 0.008856 else 7.787 * t + 16 / 116 for t in xyz / [0.95047, 1, 1.08883])
    return np.array([116 * y - 16, 500 * (x - y), 200 * (y - z)])


def distance(first, second, seen):
    return np.linalg.norm(lab(np.clip(seen @ linear(first), 0, 1)) - lab(np.clip(seen @ linear(second), 0, 1)))


def contrast(first, second):
    low, high = sorted(float(linear(colour) @ [0.2126, 0.7152, 0.0722]) for colour in (first, second))
    return (high + 0.05) / (low + 0.05)


class Palette(unittest.TestCase):
    def each_theme(self):
        for index, theme in enumerate(("light", "dark")):
            yield theme, {name: pair[index] for name, pair in style.PALETTE.items()}

    def test_compared_colours_differ_for_every_kind_of_eye(self):
        for theme, colour in self.each_theme():
            pairs = [*itertools.combinations(style.COMPARED, 2), *itertools.combinations(DIAGNOSIS_COMPARED, 2),
                     *((f"little{step}", f"much{step}") for step in SIGNED_STEPS)]
            for (who, seen), (a, b) in itertools.product(SEEN_BY.items(), pairs):
                with self.subTest(theme=theme, who=who, a=a, b=b):
                    self.assertGreaterEqual(distance(colour[a], colour[b], seen), LEAST_DISTANCE)

    def test_text_can_be_read(self):
        for theme, colour in self.each_theme():
            for name in ("ink", "muted", "baseline", "augmented", *style.KIND_COLOUR.values()):
                with self.subTest(theme=theme, name=name):
                    self.assertGreaterEqual(contrast(colour[name], colour["background"]), LEAST_TEXT_CONTRAST)

    def test_the_measured_trace_does_not_vanish(self):
        for theme, colour in self.each_theme():
            with self.subTest(theme=theme):
                self.assertGreaterEqual(contrast(colour["measured"], colour["background"]), LEAST_LINE_CONTRAST)

    def test_the_ramp_gets_stronger_with_every_step_in_both_themes(self):
        for theme, colour in self.each_theme():
            steps = [contrast(colour[f"ramp{step}"], colour["background"]) for step in range(9)]
            with self.subTest(theme=theme):
                self.assertEqual(steps, sorted(steps))

    def test_every_colour_of_a_figure_becomes_one_variable(self):
        light = [pair[0] for pair in style.PALETTE.values()]
        self.assertEqual(len(light), len(set(light)))

    def test_before_and_after_stay_reserved(self):
        """Nothing else wears the two colours, and no estimator is drawn in them."""
        for name, pair in style.PALETTE.items():
            if name in RESERVED:
                self.assertEqual(pair, RESERVED[name])
            else:
                self.assertFalse(set(pair) & {colour for kept in RESERVED.values() for colour in kept}, name)
        self.assertFalse(set(style.KIND_COLOUR.values()) & set(RESERVED))

    def test_the_map_gets_stronger_with_every_step_in_both_themes(self):
        for theme, colour in self.each_theme():
            for words in ("little", "much", "weak"):
                steps = [
                    contrast(colour[name], colour["background"])
                    for name in ("quiet", *(f"{words}{k}" for k in range(1, 5)))
                ]
                with self.subTest(theme=theme, words=words):
                    self.assertEqual(steps, sorted(steps))
                    self.assertGreaterEqual(min(b / a for a, b in zip(steps, steps[1:])), 1.05)


if __name__ == "__main__":
    support.main()
