"""Several results side by side: their verdicts, errors and estimates are the columns of one page.

    compare.py A.h5 B.h5 ... [--out compare.html]

Needs no samples in the files. Of a run the first least squares counts, of a diagnosis the model with what was named.
"""

import argparse
import itertools
import math
import sys
from pathlib import Path

from . import build, compared, quantities as q
from ..errors import ResultError, UsageError
from .figures import compared_parameters


def page(paths):
    """The text of the page."""
    if len(paths) < 2:
        raise UsageError("error: two results or more can be compared")
    sides = compared.sides(paths)
    return build.render(
        compared_parameters.cases(sides),
        parts=["compare.html"],
        verdict=_verdict(sides),
        head=[f"{len(sides)} results", *dict.fromkeys(side.job for side in sides)],
        numbers=[],
        verdict_json="",
        sides=sides,
        facts=_facts(sides),
        estimates=_estimates(sides),
        effects=_effects(sides),
    )


def _verdict(sides):
    rows = compared.parameter_rows(sides)
    several = [row for row in rows if sum(one is not None for one in row.values) > 1]
    apart = [row.name for row in several if row.differs]
    told = [row for row in several if row.differs is not None]
    if not told:
        sentence = f"{q.count_word(len(sides)).capitalize()} results; no parameter of two has intervals to compare."
    elif apart:
        sentence = (f"{q.count_word(len(apart)).capitalize()} of {_parameters(told)} "
                    f"differ{'s' if len(apart) == 1 else ''} by more than the 95 % intervals say.")
    else:
        sentence = f"The 95 % intervals of {'all ' if len(told) > 1 else ''}{_parameters(told)} overlap."
    evidence = f"Apart: {q.listed(_plain(name) for name in apart)}." if apart else ""
    moved = list(dict.fromkeys(side.of for side in sides))
    if len(moved) > 1:
        sentence = f"These are results of different joints: {'; '.join(moved)}. {sentence}"
    return {"mark": "◍" if apart else "●", "word": "Side by side", "tone": "ochre" if apart else "ink",
            "sentence": sentence, "headlines": [sentence], "evidence": evidence}


def _parameters(rows):
    return f"{q.count_word(len(rows))} parameter{'' if len(rows) == 1 else 's'}"


def _facts(sides):
    """{"head", "rows"}: what each result is and how well it fits."""
    errors_of = [side.errors_of for side in sides]
    rows = [["verdict", *(side.verdict for side in sides)], ["job", *(side.job for side in sides)],
            ["of", *(side.of for side in sides)],
            ["error in training", *(q.percent(side.train) for side in sides)],
            ["error, validation", *(q.percent(side.validation) for side in sides)],
            *([["errors are of", *(side.errors_of for side in sides)]] if len(set(errors_of)) > 1 else []),
            ["parameters", *(str(len(side.parameters)) for side in sides)],
            ["made", *(side.finished for side in sides)]]
    return {"head": ["", *(side.label for side in sides)], "rows": [row for row in rows if set(row[1:]) != {"–"}],
            "stacks": True}


def _estimates(sides):
    rows = []
    for row in compared.parameter_rows(sides):
        said = {None: "–", True: "no", False: "yes"}[row.differs]
        rows.append([_plain(row.name), q.unit(row.unit), *map(_value, row.values), said])
    return {"head": ["parameter", "unit", *(side.label for side in sides), "intervals overlap"], "rows": rows}


def _value(one):
    if one is None:
        return "–"
    half = one.half_interval
    decimals = q.decimals_for(half, one.value)
    return q.fixed(one.value, decimals) + (f" ± {q.fixed(half, decimals)}" if math.isfinite(half) else "")


def _effects(sides):
    """What each diagnosis says of every effect that one of them names; empty without diagnoses."""
    names = dict.fromkeys(itertools.chain.from_iterable(side.named for side in sides))
    rows = [[compared.effect_title(name), *(side.said_of(name) for side in sides)] for name in names]
    return {"head": ["effect", *(side.label for side in sides)], "rows": rows, "stacks": True}


def _plain(name):
    return name.replace("_", " ")


def main(arguments):
    """0, or 65 where a result is at fault."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", nargs="+", help="R.h5, complete")
    parser.add_argument("--out", help="the page (default: compare.html beside the first result)")
    options = parser.parse_args(arguments)
    out = Path(options.out or Path(options.results[0]).with_name("compare.html"))
    try:
        text = page(options.results)
    except UsageError as error:
        print(error, file=sys.stderr)
        return 64
    except ResultError as error:
        print(f"error: {error}", file=sys.stderr)
        return 65
    out.write_text(text, encoding="utf-8")
    print(f"wrote  {out}  {out.stat().st_size / 1e6:.1f} MB")
    return 0
