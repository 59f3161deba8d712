"""The palette: whoever sees it, in the light and in the dark, can tell compared colours apart and read the text.

Source     colour vision: Machado, Oliveira, Fernandes 2009, severity 1; contrast: WCAG 2
"""

import itertools
import unittest

import support
import numpy as np
import style

SEEN_BY = {
    "everybody": np.eye(3),
    "protan": np.array([[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]]),
    "deutan": np.array([[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]]),
    "tritan": np.array([[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]]),
}
LEAST_DISTANCE = 25  # Lab units (UX.md section 2)
LEAST_TEXT_CONTRAST = 4.5  # WCAG AA
LEAST_LINE_CONTRAST = 2.2  # the measured trace is meant to stand back, but not to vanish
RESERVED = ("#c2500a", "#ff9b57", "#0067a8", "#63b8f5")  # before and after, light and dark: for the diagnosis only


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
            for (who, seen), (a, b) in itertools.product(SEEN_BY.items(), itertools.combinations(style.COMPARED, 2)):
                with self.subTest(theme=theme, who=who, a=a, b=b):
                    self.assertGreaterEqual(distance(colour[a], colour[b], seen), LEAST_DISTANCE)

    def test_text_can_be_read(self):
        for theme, colour in self.each_theme():
            for name in ("ink", "muted", *style.KIND_COLOUR.values()):
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
        self.assertFalse({colour for pair in style.PALETTE.values() for colour in pair} & set(RESERVED))


if __name__ == "__main__":
    support.main()
