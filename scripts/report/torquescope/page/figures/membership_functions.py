"""Small, middle and big of the controller's four inputs and two outputs: Fig. 3 of the seed."""

from .. import readings, style
from . import Case

MEANING = {
    "d11": "d11, from PC",
    "d12": "d12, from FC",
    "d21": "d21, from PC",
    "d22": "d22, from FC",
    "F": "F",
    "CR": "CR",
}
SHADES = (("small", "ramp3", "solid"), ("middle", "ramp5", (0, (5, 2))), ("big", "ramp8", "solid"))


def draw(curves, width=style.WIDE):
    """curves: [(name, universe [k], membership [3][k])]."""
    columns = len(curves) if width >= style.WIDE else 2
    rows = -(-len(curves) // columns)
    # a line of keys on top, then one panel per variable
    panel_height = 142
    canvas = style.Canvas(width, 22 + rows * panel_height)
    panel = width / columns
    for index, (name, universe, membership) in enumerate(curves):
        row, column = divmod(index, columns)
        left, top = column * panel, 22 + row * panel_height
        axes = canvas.axes(left + 26, top + 26, left + panel - 16, top + panel_height - 30)
        for level, (word, colour, dashes) in zip(membership, SHADES):
            axes.plot(universe, level, color=style.LIGHT[colour], linestyle=dashes, linewidth=2, label=word)
        axes.set(xlim=(universe[0], universe[-1]), ylim=(0, 1.02), yticks=[0, 1])
        readings.of(axes, (name, ""), ("membership", ""))
        style.few_ticks(axes.xaxis, 2)
        canvas.text(left, top + 14, MEANING.get(name, name), color=style.LIGHT["ink"], fontweight="bold")
    at = 0
    for word, colour, dashes in SHADES:
        axes = canvas.axes(at, 2, at + 22, 18)
        axes.set_axis_off()
        axes.set(xlim=(0, 1), ylim=(0, 1))
        axes.plot([0, 1], [0.5, 0.5], color=style.LIGHT[colour], linestyle=dashes, linewidth=2)
        canvas.text(at + 28, 14, word)
        at += 28 + style.EM * len(word) + 22
    return canvas.figure


def cases(study):
    found = {}
    for e in study.searches:
        if e.controller is None:
            continue
        curves = [(name, getattr(e.controller, f"{name}_universe"), getattr(e.controller, f"{name}_membership"))
                  for name in MEANING if e.controller.has(f"{name}_membership")]
        if curves:
            sentence = "Degree of membership, 0 to 1. Four inputs made from the population's movement, two outputs."
            found[f"membership_functions_{e.name}"] = Case(
                draw, {"curves": curves}, f"Membership functions of {e.label}", sentence, wide=True
            )
    return found
