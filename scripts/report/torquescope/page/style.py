"""What every figure shares: the palette, matplotlib's settings, canvases measured in pixels.

One matplotlib point is one CSS pixel here (72 dpi), so text of size 12 is 12 px on the page and 12 pt on paper.
Figures are drawn in the light colours; svg.py turns each of them into a CSS variable, and dark mode follows.
"""

import io
import math

import matplotlib
from matplotlib import ticker
from matplotlib.colors import to_hex
from matplotlib.figure import Figure

from . import quantities

SMALL = 352  # px: tiles three, two or one to a row, and the phone's version of a wide figure
WIDE = 1080
TEXT = 12
EM = 7.6  # px, a generous mean letter of the figure text: layout must not depend on the reader's font

# name: (light, dark). Estimators are compared with each other and with `measured`: tests/report/page/palette.py
PALETTE = {
    "background": ("#ffffff", "#14171a"),
    "ink": ("#16191d", "#eceff1"),
    "muted": ("#5c6369", "#9aa2aa"),
    "grid": ("#e9ecee", "#262b30"),
    "floor": ("#e4e7eb", "#2b3137"),
    "measured": ("#a3a9b0", "#5d656d"),
    "wls": ("#117755", "#88ffaa"),
    "irls": ("#662211", "#dd6655"),
    "de": ("#8a6a00", "#d8b23f"),
    "fade": ("#5a48b8", "#a99cf7"),
    "cmaes": ("#9c00fc", "#b448fc"),
    # of a diagnosis: before is always orange, after always blue, and nothing else is
    "baseline": ("#c2500a", "#ff9b57"),
    "augmented": ("#0067a8", "#63b8f5"),
    "region": ("#fdf0dc", "#33291a"),
    "quiet": ("#f2f3f5", "#1d2125"),
}
KIND_COLOUR = {"ols": "ink", "wls": "wls", "irls": "irls", "de": "de", "fade": "fade", "cmaes": "cmaes"}
COMPARED = ("measured", *KIND_COLOUR.values())

# nine steps from nothing to much; in the dark the page's background is nothing, so the ramp turns round
RAMP = (
    ("#f4f3fb", "#1d1f2b"),
    ("#e2dff4", "#272743"),
    ("#cdc8ec", "#332f5c"),
    ("#b5aee2", "#413a78"),
    ("#9c92d6", "#514796"),
    ("#8275c8", "#6758b2"),
    ("#6757b4", "#8276c9"),
    ("#4a3a94", "#a59bde"),
    ("#2f2169", "#d0caf3"),
)
PALETTE.update({f"ramp{step}": pair for step, pair in enumerate(RAMP)})

# the mismatch map, from just beyond chance to far beyond it: the model asks too little, too much; of a spectrum: too
# weak
TOO_LITTLE = (("#efe3f1", "#372a40"), ("#d3b6dc", "#65407c"), ("#9f72b0", "#a36fc2"), ("#762a83", "#dcb6ee"))
TOO_MUCH = (("#dff1dc", "#1c3822"), ("#a6dba0", "#27683a"), ("#5aae61", "#4fa863"), ("#1b7837", "#a9e8ac"))
TOO_WEAK = (("#dcdfe3", "#33393f"), ("#b3b9c0", "#5a626a"), ("#737b84", "#949ca5"), ("#2c3237", "#d8dde2"))
for words, steps in (("little", TOO_LITTLE), ("much", TOO_MUCH), ("weak", TOO_WEAK)):
    PALETTE.update({f"{words}{step}": pair for step, pair in enumerate(steps, start=1)})

LIGHT = {name: light for name, (light, _) in PALETTE.items()}

_NAMES = {light.lower(): name for name, light in LIGHT.items()}


def name_of(colour):
    """The name in the palette of a light colour; ink where it is none of it."""
    return _NAMES.get(to_hex(colour).lower(), "ink")


# the estimators beyond the first of a colour are told apart by their dashes (and always by their labels)
DASHES = {"de": (0, (5, 2))}
MORE_DASHES = ((0, (7, 2, 1.5, 2)), (0, (3, 1.5)), (0, (1.5, 1.5)), (0, (10, 3)), (0, (7, 2, 1.5, 2, 1.5, 2)),
               (0, (3, 1.5, 1, 1.5)))

LOOK = {
    "figure.dpi": 72,
    "savefig.dpi": 72,
    "figure.facecolor": "none",
    "axes.facecolor": "none",
    "savefig.facecolor": "none",
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "path.simplify": True,
    "axes.unicode_minus": True,
    "font.family": "DejaVu Sans",
    "font.size": TEXT,
    "text.color": LIGHT["ink"],
    "text.parse_math": False,  # names come from files: a "$" in one is a letter
    "axes.labelsize": TEXT,
    "axes.titlesize": TEXT,
    "xtick.labelsize": TEXT,
    "ytick.labelsize": TEXT,
    "axes.labelcolor": LIGHT["muted"],
    "xtick.color": LIGHT["muted"],
    "ytick.color": LIGHT["muted"],
    "axes.edgecolor": LIGHT["grid"],
    "grid.color": LIGHT["grid"],
    "grid.linewidth": 1,
    "axes.grid": True,
    "axes.axisbelow": True,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.spines.left": False,
    "axes.spines.bottom": False,
    "xtick.major.size": 0,
    "ytick.major.size": 0,
    "xtick.minor.size": 0,
    "ytick.minor.size": 0,
    "xtick.major.pad": 6,
    "ytick.major.pad": 5,
    "lines.linewidth": 1.4,
    "lines.solid_capstyle": "round",
}


def look():
    """A context in which matplotlib draws and saves as the page does; outside of it nothing of matplotlib changes."""
    return matplotlib.rc_context(LOOK)


class Drawing(Figure):
    """A matplotlib Figure that keeps the look of the page where it is saved, and shows itself in a notebook."""

    def savefig(self, *arguments, **options):
        with look():
            return super().savefig(*arguments, **options)

    def _repr_png_(self):
        buffer = io.BytesIO()
        self.savefig(buffer, format="png", dpi=144, facecolor=LIGHT["background"])
        return buffer.getvalue()


def estimator_looks(kinds):
    """[(colour name, dashes)] for estimators of these kinds: the kind's colour, and own dashes when it comes again."""
    colour_of = dict(KIND_COLOUR)
    spare = [name for kind, name in reversed(KIND_COLOUR.items()) if kind not in kinds]
    times, looks = {}, []
    for kind in kinds:
        # a method this page has no colour for takes one that is free and keeps it
        if kind not in colour_of:
            colour_of[kind] = spare.pop(0) if spare else "ink"
        name = colour_of[kind]
        again = times.get(name, 0)
        times[name] = again + 1
        looks.append((name, MORE_DASHES[(again - 1) % len(MORE_DASHES)] if again else DASHES.get(name, "solid")))
    return looks


class Canvas:
    """A figure of `width` x `height` px on which axes are placed by pixels from the top left corner."""

    def __init__(self, width, height):
        self.figure = Drawing(figsize=(width / 72, height / 72), dpi=72)
        self.width, self.height = width, height

    def axes(self, left, top, right, bottom, **options):
        """Axes between these pixel lines (right and bottom count from the left and the top as well)."""
        box = (left / self.width, 1 - bottom / self.height, (right - left) / self.width, (bottom - top) / self.height)
        axes = self.figure.add_axes(box, **options)
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(ticker.FuncFormatter(quantities.tick))
        return axes

    def text(self, x, y, words, **options):
        """Text with its baseline at pixel (x, y) from the top left."""
        options = {"color": LIGHT["muted"], "fontsize": TEXT, **options}
        return self.figure.text(x / self.width, 1 - y / self.height, words, **options)


def few_ticks(axis, most=5):
    axis.set_major_locator(ticker.MaxNLocator(most, steps=[1, 2, 2.5, 5, 10], min_n_ticks=2))


def decades(axis, low, high, most=6):
    """Ticks at every k-th power of ten, without minor ones."""
    first, last = math.floor(math.log10(low)), math.ceil(math.log10(high))
    step = max(1, math.ceil((last - first) / most))
    axis.set_major_locator(ticker.FixedLocator([10.0**e for e in range(last, first - 1, -step)]))
    axis.set_minor_locator(ticker.NullLocator())
    axis.set_major_formatter(ticker.FuncFormatter(quantities.log_tick))


def spread(positions, gap, low, high):
    """Moves label positions apart to at least `gap`, keeping their order, inside [low, high]."""
    order = sorted(range(len(positions)), key=lambda i: positions[i])
    placed = {}
    at = low
    for i in order:
        placed[i] = max(positions[i], at)
        at = placed[i] + gap
    limit = high
    for i in reversed(order):
        placed[i] = min(placed[i], limit)
        limit = placed[i] - gap
    return [placed[i] for i in range(len(positions))]


def fit(text, width_px):
    """The text, cut with an ellipsis where it would not fit."""
    letters = max(int(width_px / EM), 2)
    return text if len(text) <= letters else text[:letters - 1] + "…"


def save(figure, path):
    """PDF or PNG for a paper: light colours on white."""
    metadata = {"CreationDate": None} if str(path).endswith(".pdf") else {}
    figure.savefig(path, dpi=216, facecolor="#ffffff", metadata=metadata)
