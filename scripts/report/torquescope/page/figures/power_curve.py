"""How large must an effect be to be found? Share of the cases found at each size, with its exact 95 % band."""

from .. import style
from . import Case

LOOKS = {"family": ("ink", "solid", 2.4), "exact": ("fade", "solid", 1.8), "guess": ("de", (0, (5, 2)), 1.8)}
LABELS = {"family": "family", "exact": "exact name", "guess": "3 guesses"}
TIERS = {"T1": "One concealed effect", "T2": "Two concealed effects", "T3": "Three concealed effects"}
LABEL_PX = 96


def draw(sizes, curves, width=style.SMALL):
    """sizes [k]: SNR_eff; curves: {family | exact | guess: [(share, low, high)] per size}, the band is that of the
    first."""
    canvas = style.Canvas(width, 252)
    axes = canvas.axes(44, 30, width - LABEL_PX, 208)
    # sizes double from step to step: equal distances
    at = range(len(sizes))
    band = [(low, high) for _, low, high in next(iter(curves.values()))]
    lows, highs = [100 * low for low, _ in band], [100 * high for _, high in band]
    if len(sizes) > 1:
        axes.fill_between(at, lows, highs, color=style.LIGHT["floor"], linewidth=0)
    axes.vlines(at, lows, highs, color=style.LIGHT["measured"], linewidth=1.2)
    ends = []
    for name, points in curves.items():
        colour, dashes, thick = LOOKS[name]
        shares = [100 * share for share, _, _ in points]
        axes.plot(
            at,
            shares,
            color=style.LIGHT[colour],
            linestyle=dashes,
            linewidth=thick,
            marker="o",
            markersize=5,
            clip_on=False,
        )
        ends.append((LABELS[name], shares[-1], colour))
    axes.set(xlim=(-0.25, len(sizes) - 0.75), ylim=(0, 100), xlabel="effect over noise (SNR)")
    axes.set_xticks(list(at), [f"{size:g}" for size in sizes])
    axes.set_yticks([0, 25, 50, 75, 100])
    axes.xaxis.labelpad = 3
    for (label, _, colour), y in zip(ends, style.spread([end for _, end, _ in ends], 10, 2, 98)):
        canvas.text(
            width - LABEL_PX + 8, 208 - (208 - 30) * y / 100 + 4, label, color=style.LIGHT[colour], fontweight="bold"
        )
    canvas.text(0, 16, "found (% of cases)")
    return canvas.figure


def _points(rows, level):
    return [(row[level]["hits"] / row[level]["n"], row[level]["low"], row[level]["high"]) for row in rows]


def cases(board):
    found = {}
    for tier, title in TIERS.items():
        rows = [row for row in board.ours["power"] if row["tier"] == tier]
        if not rows:
            continue
        counts = sorted({row["family"]["n"] for row in rows})
        each = f"{counts[0]}" if len(counts) == 1 else f"{counts[0]} to {counts[-1]}"
        every = "every effect at this size when alone; " if tier != "T1" else ""
        found[f"power_{tier}"] = Case(
            draw,
            {"sizes": [row["size"] for row in rows], "curves": {level: _points(rows, level) for level in LOOKS}},
            title,
            f"{each} cases per size; {every}grey: exact 95 % band of the family. Family and exact name: "
            "everything named, nothing invented. 3 guesses: the family is among the three "
            "strongest candidates, named or not.",
        )
    return found
