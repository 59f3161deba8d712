"""Every parameter that two results have, as a difference from the first one's, in % of it, with its 95 % interval."""

import math

import numpy as np

from . import Case, parameters
from .. import compared, quantities, style


def cases(sides):
    rows = [row for row in compared.parameter_rows(sides)
            if sum(one is not None for one in row.values) > 1 and _first(row).value != 0]
    if not rows:
        return {}
    origins = np.array([_first(row).value for row in rows])
    groups = []
    for at, side in enumerate(sides):
        values = [row.values[at] for row in rows]
        difference = np.array([one.value if one else math.nan for one in values]) - origins
        half = np.array([one.half_interval if one else math.nan for one in values])
        scale = np.abs(origins) / 100
        groups.append((side.label, difference / scale, half / scale, None, None, None, _ink(side)))
    arguments = {"names": [row.name for row in rows], "units": ["1"] * len(rows), "groups": groups, "published": [],
                 "axis_words": ("difference from the first result that has it, % of the value",
                                "from the first, % of the value"),
                 "values": [_span(row) for row in rows]}
    return {"compared_parameters": Case(parameters.draw, arguments, "Estimates side by side",
                                        "Dots: estimates; bars: 95 % intervals.", wide=True)}


def _first(row):
    return next(one for one in row.values if one is not None)


def _span(row):
    """Lowest and highest estimate."""
    values = [one.value for one in row.values if one is not None]
    decimals = quantities.decimals_for(None, max(values, key=abs))
    text = " … ".join(dict.fromkeys(quantities.fixed(value, decimals) for value in (min(values), max(values))))
    return quantities.with_unit(text, row.unit)


def _ink(side):
    return style.LIGHT[side.colour]
