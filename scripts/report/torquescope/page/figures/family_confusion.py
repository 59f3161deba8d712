"""Which family is taken for which? Concealed against named first, as shares of what was concealed."""

import numpy as np

from .. import quantities, style
from ..board import plain
from . import Case
from .decision_surface import cells

TITLE = "What was said about each family"
CELL = {True: 17, False: 44}  # px, narrow or wide
ROW = 24


def draw(rows, columns, counts, width=style.WIDE):
    """counts [row][column]: cases; rows: concealed, columns: said first (the first len(rows) are the same families)."""
    narrow = width < style.WIDE
    left = 104 if narrow else 128
    cell = min(CELL[narrow], (width - left) / len(columns))
    head = 14 + max(int(6.4 * max(len(plain(word)) for word in columns)), 60)
    counts = np.asarray(counts)
    canvas = style.Canvas(width, head + ROW * len(rows) + 8)
    right = left + cell * len(columns)
    axes = canvas.axes(left, head, right, head + ROW * len(rows))
    axes.grid(False)
    share = counts / np.maximum(counts.sum(axis=1, keepdims=True), 1)
    level = np.where(counts > 0, np.clip((share * 9).astype(int), 1, 8), 0)
    x, y = np.arange(len(columns) + 1), np.arange(len(rows) + 1)
    for step in range(9):
        cells(axes, (level == step).T, x, y, style.LIGHT[f"ramp{step}"])
    for i, row in enumerate(rows):
        canvas.text(0, head + ROW * (i + 0.5) + 4, plain(row), color=style.LIGHT["ink"])
        for j in range(len(columns)):
            if counts[i][j]:
                axes.text(j + 0.5, i + 0.5, str(counts[i][j]), ha="center", va="center",
                          color=style.LIGHT["background" if level[i][j] > 4 else "ink"])
    for j, column in enumerate(columns):
        canvas.text(left + cell * (j + 0.5) + 4, head - 6, plain(column), rotation=90, ha="center", va="bottom",
                    color=style.LIGHT["ink" if column in rows else "muted"])
    # the diagonal is what is right
    for i in range(len(rows)):
        axes.plot(
            [i, i + 1, i + 1, i, i],
            [i, i, i + 1, i + 1, i],
            color=style.LIGHT["ink"],
            linewidth=1.2,
            clip_on=False,
            zorder=4,
        )
    axes.set(xlim=(0, len(columns)), ylim=(len(rows), 0), xticks=[], yticks=[])
    return canvas.figure


def cases(board):
    matrix = board.ours["confusion"]["families"]
    if not matrix["rows"]:
        return {}
    total = int(np.sum(matrix["counts"]))
    return {
        "family_confusion": Case(
            draw,
            {"rows": matrix["rows"], "columns": matrix["columns"], "counts": matrix["counts"]},
            TITLE,
            f"{quantities.count(total, 'case')} with one concealed effect of any size: its family (rows) and the "
            "family of "
            "the first name, or what was said without a name (columns). Framed: right.",
            wide=True,
        )
    }
