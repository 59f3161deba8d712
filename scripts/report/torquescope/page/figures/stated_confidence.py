"""Is a stated confidence kept? Names by the confidence they state, and the share of them that was right."""

from .. import quantities, style
from . import Case


def draw(bins, width=style.SMALL):
    """bins: [{from, to, n, stated, right, low, high}] as fractions; low and high are the exact 95 % band of right."""
    canvas = style.Canvas(width, 246)
    axes = canvas.axes(44, 30, width - 14, 200)
    at = range(len(bins))
    axes.bar(
        at,
        [100 * b["high"] - 100 * b["low"] for b in bins],
        0.5,
        [100 * b["low"] for b in bins],
        color=style.LIGHT["floor"],
    )
    dots = {"linestyle": "none", "clip_on": False}
    axes.plot(
        at,
        [100 * b["stated"] for b in bins],
        marker="_",
        markersize=34,
        markeredgewidth=2.4,
        color=style.LIGHT["fade"],
        **dots,
    )
    axes.plot(at, [100 * b["right"] for b in bins], marker="o", markersize=8, color=style.LIGHT["ink"], **dots)
    axes.set(xlim=(-0.6, len(bins) - 0.4), ylim=(0, 100), xlabel="confidence the name states (%)")
    axes.set_xticks(list(at), [f"{100 * b['from']:g}–{100 * b['to']:g}" for b in bins])
    axes.set_yticks([0, 25, 50, 75, 100])
    axes.xaxis.labelpad = 3
    canvas.text(0, 16, "right (% of the names)")
    return canvas.figure


def cases(board):
    confidence = board.ours["confidence"]
    if not confidence["bins"]:
        return {}
    return {
        "stated_confidence": Case(
            draw,
            {"bins": confidence["bins"]},
            "Is a stated confidence kept?",
            f"{quantities.count(confidence['n'], 'name')}; confidence = 1 − q, the false discovery rate it was named "
            "at. "
            f"Bar: stated; dot: right; grey: exact 95 % band. Brier score {quantities.number(confidence['brier'], 2)}.",
        )
    }
