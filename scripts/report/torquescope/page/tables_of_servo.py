"""The tables of the page of a set of recordings of servos as finished words; servo.html only sets them."""

import math

from . import quantities as q, words_of_servo as say

BAR_WIDTH = 72  # px of the largest error of a table
REFUSALS = {
    "none": "passes",
    "chance": "replicates gain as much",
    "smaller": "another effect explains more",
    "failed_fit": "its fit failed",
    "at_bound": "a number ends at its bound",
    "not_predicted": "validation recordings are not predicted better",
}


def unit(servo, text):
    """A unit of the file, with the command's in it."""
    if servo.command_unit:
        text = text.replace("per unit", f"per {servo.command_unit}").replace("unit of the command", servo.command_unit)
    return q.unit(text)


def _value(one):
    return q.fixed(one.value, q.decimals_for(one.half_interval, one.value)) if one else "–"


def _interval(one):
    if one is None or not math.isfinite(one.half_interval):
        return "–"
    decimals = q.decimals_for(one.half_interval, one.value)
    return f"{q.fixed(one.lower, decimals)} … {q.fixed(one.upper, decimals)}"


def _gain(value):
    """A D: what is next to nothing is none."""
    return "0" if abs(value) < 0.005 else q.number(value)


def effect_parameters(servo):
    """{"head", "rows"}: a row for each number of the effects that were kept."""
    rows = []
    for effect in servo.kept:
        sure = [_gain(effect.gain), q.number(effect.p, 2)]
        for at, one in enumerate(effect.parameters.values()):
            rows.append([effect.title, one.name, _value(one), unit(servo, one.unit), _interval(one),
                         *(sure if at == 0 else ["", ""])])
        if not effect.parameters:
            rows.append([effect.title, "–", "–", "", "–", *sure])
    return {"head": ["effect", "parameter", "value", "unit", "95 % interval", "D", "p"], "rows": rows}


def parameters(servo):
    """{"head", "rows"}: all numbers of the model, before and after."""
    changed = say.has_after(servo)
    head = (["parameter", "unit", "before", "95 % interval, before", "after", "95 % interval, after"] if changed else
            ["parameter", "unit", "value", "95 % interval"])
    rows = []
    for name, one in {**servo.parameters_before, **servo.parameters}.items():
        sides = [servo.parameters_before.get(name), *([servo.parameters.get(name)] if changed else [])]
        rows.append([name, unit(servo, one.unit), *(text(side) for side in sides
                                                               for text in (_value, _interval))])
    return {"head": head, "rows": rows}


def errors(servo, quantity, rows):
    """{"quantity", "groups", "rows", "changed"}: a row is its value and, for each group (training, validation), a cell
    {"recordings", "before", "after", "bars"} or None."""
    groups = [("training", "train"), ("validation", "validate")]
    groups = [(name, role) for name, role in groups if any(getattr(row, role).recordings for row in rows)]
    return _table(servo, quantity, groups, [(row.value, row) for row in rows])


def left_out(servo, quantity, rows):
    """As errors(), with the means of the rows last."""
    table = _table(servo, quantity, [("left out", "left_out")], [(row.value, row) for row in rows])
    if len(rows) > 1:
        before, after = (sum(getattr(row.left_out, side) for row in rows) / len(rows) for side in ("before", "after"))
        table["rows"].append(("mean", [{"recordings": "", "before": say.error(servo, before),
                                        "after": say.error(servo, after), "bars": []}]))
    return table


def _table(servo, quantity, groups, rows):
    changed = say.has_after(servo)
    known = [getattr(row, role) for _, row in rows for _, role in groups]
    sides = ("before", "after") if changed else ("before",)
    largest = max((getattr(one, side) for one in known for side in sides if math.isfinite(getattr(one, side))),
                  default=0.0)

    def bar(value):
        return round(max(BAR_WIDTH * value / largest, 1.0), 1) if largest > 0 and math.isfinite(value) else 0.0

    def cell(one):
        if not one.recordings:
            return None
        return {"recordings": q.whole(one.recordings), "before": say.error(servo, one.before),
                "after": say.error(servo, one.after), "bars": [bar(getattr(one, side)) for side in sides]}

    return {"quantity": quantity, "groups": [name for name, _ in groups], "changed": changed,
            "rows": [(value, [cell(getattr(row, role)) for _, role in groups]) for value, row in rows]}


def recordings(study):
    """{"head", "rows"}: in the order of the figures."""
    servo = study.servo
    known = say.quantities_told(servo)
    head = ["recording", "role", *known, "samples", f"error, {say.finer(servo)[0]}", "relative error"]
    rows = []
    for _, _, one in say.named_recordings(study):
        shares = [one.relerr_before, one.relerr_after] if say.has_after(servo) else [one.relerr_before]
        rows.append([one.name, "validation" if one.is_validation else "training",
                     *(say.quantity_text(one, key) for key in known), q.whole(one.samples),
                     say.before_after(servo, one),
                     " → ".join(q.percent(value) if math.isfinite(value) else "diverged" for value in shares)])
    return {"head": head, "rows": rows}


def moves(step):
    """{"head", "rows"}: the effects that were tried beside one model."""
    head = ["effect", "D", "D by chance", "p", "error before", "error after", "decision"]
    rows = [[say.plain(one.name), _gain(one.gain), _gain(one.gain_by_chance), q.number(one.p, 2),
             q.percent(one.error_before), q.percent(one.error_after),
             REFUSALS.get(one.refusal, say.plain(one.refusal))] for one in step.moves]
    return {"head": head, "rows": rows}
