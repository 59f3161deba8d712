"""What the figures, the tables and the sentences of a diagnosis share: names of axes, of figures, and what there is to
compare."""

import math
import re

import numpy as np

from . import quantities as q
from .effect_titles import TITLES
from ..reader.read_diagnosis import least_p

AXES = {
    "velocity": "velocity", "position": "position", "acceleration": "acceleration", "load": "load",
    "since_velocity_reversal": "since reversal of motion", "since_torque_reversal": "since reversal of torque",
    "time": "time", "frequency": "frequency", "order": "order of angle",
}
# the axis on which candidates of a family would show first
FAMILY_AXES = {
    "velocity_law": "velocity",
    "reversal": "since_velocity_reversal",
    "static_position": "position",
    "load": "load",
    "time": "time",
    "acceleration": "acceleration",
    "order_locked": "position",
}
Z95 = 1.96  # of a normal spread: 95 % of the replicates


def plain(name):
    """'power_law_viscous' for a person."""
    return name.replace("_", " ")


def axis_title(axis):
    return AXES.get(axis, plain(axis))


def axis_unit(row_or_interval):
    """The unit in words people use: cos(12 q) has 12 waves per turn."""
    if row_or_interval.axis == "order" and row_or_interval.unit == "1/rad":
        return "waves per turn"
    return q.unit(row_or_interval.unit)


def range_words(start, stop, unit):
    """Two digits, or as many as tell the two ends apart."""
    digits = 2
    while digits < 6 and max(_step(start, digits), _step(stop, digits)) > 0.3 * abs(stop - start):
        digits += 1
    return f"{q.tick(float(f'{start:.{digits}g}'))} … {q.tick(float(f'{stop:.{digits}g}'))} {unit}".strip()


def _step(value, digits):
    return 10.0 ** (math.floor(math.log10(abs(value))) - digits + 1) if value else 0.0


def share_words(share):
    """Of a share that other data may make larger than the whole, or negative."""
    return "–" if not math.isfinite(share) else "> 100 %" if share > 1 else "none" if share <= 0 else q.percent(share)


def is_fault(effect):
    """Of a recorded channel, not physics of the joint."""
    return effect.is_fault


def figure_name(study, joint, base):
    """Name of a figure: with the joint's number where there are several."""
    return base if len(study.diagnosis.joints) == 1 else f"{base}_joint_{joint.joint}"


def which_joint(joint):
    """As the verdict's sentences call it (engine/account/name_list.hpp)."""
    return f"the joint of {joint.name}" if joint.name else f"joint {joint.joint}"


def has_after(joint):
    """Something was put into the model: there is an after to set beside the before."""
    after = joint.augmented_train_relerr
    return math.isfinite(after) and after != joint.train_relerr


def after_words(joint):
    """What the model holds after: "with stribeck friction"."""
    names = q.listed(effect_words(effect) for effect in joint.effects)
    return f"with {names or 'what is missing'}"


def effect_words(effect):
    """Of an effect with a title of its own in the file."""
    return _short_title(effect.title) if effect.title else effect_name(effect.name)


def effect_name(name):
    """What an identifier means, in words: "Stribeck friction" for stribeck. Of a later program it may be unknown."""
    return _short_title(TITLES[name]) if name in TITLES else plain(name)


def _short_title(title):
    """Up to its explanation."""
    return re.split(r"[:,]| \(", title)[0]


def rows_drawn(joint):
    """Rows of the map that hold cells."""
    return [row for row in joint.map.values() if len(row.z)]


def is_quiet(row):
    """Nothing was located on it, and the replicates show as much."""
    return not row.regions and not row.is_spectrum and row.p >= 0.05


def strongest_rows(joint):
    """Rows that are no spectra, the one with most residual beyond the replicates first."""
    return sorted(
        (row for row in rows_drawn(joint) if not row.is_spectrum), key=lambda row: -np.nan_to_num(row.energy_share)
    )


def rows_without_effects(joint):
    """[(row, region or None)]: where something is unexplained, else the two axes that hold most."""
    parts = {where.axis: (where.start, where.stop) for where, _ in reversed(joint.unexplained)}
    rows = [(joint.map[axis], region) for axis, region in parts.items() if axis in joint.map and len(joint.map[axis].z)]
    others = [(row, None) for row in strongest_rows(joint) if row.axis not in parts]
    return (rows + others)[:2]


def regions_on(effect, axis):
    """[(from, to)] of an effect on that axis."""
    return [(place.start, place.stop) for place in effect.places if place.axis == axis]


def partial_regions(regions, start, stop):
    """Those worth shading between start and stop: what is everywhere is nowhere in particular."""
    return [region for region in regions if region[0] > start or region[1] < stop]


def effect_row(joint, effect):
    """The row on which an effect is drawn before and after: its region's, or its curve's when the region is in a
    spectrum."""
    row = joint.map.get(effect.region.axis)
    if row is not None and row.is_spectrum and effect.curve is not None:
        row = joint.map.get(effect.curve.range.axis, row)
    return row if row is not None and len(row.z) else None


def quiet_rival(joint, effect, shown=()):
    """(row, candidate or None): a quiet row, that of the strongest candidate which was not named when its row is quiet;
    rows whose axis is in `shown` only when there is no other."""
    own = {effect.region.axis, effect.curve.range.axis if effect.curve else ""}
    quiet = {row.axis: row for row in rows_drawn(joint) if is_quiet(row) and row.axis not in own}
    quiet = {axis: row for axis, row in quiet.items() if axis not in shown} or quiet
    for candidate in joint.candidates:
        row = quiet.get(FAMILY_AXES.get(candidate.family))
        if candidate.decision == "no" and row is not None:
            return row, candidate
    return (max(quiet.values(), key=lambda row: np.nan_to_num(row.p)), None) if quiet else (None, None)


def p_cell(p, is_bound):
    """At most two digits; never zero."""
    if not math.isfinite(p):
        return "–"
    return f"<{q.number(_rounded_up(p), 1)}" if is_bound else q.number(p, 2)


def counted_p_cell(p, replicates):
    """Of a p that is stored without the word whether it is a bound."""
    least = least_p(replicates)
    return p_cell(max(p, least), p <= least * (1 + 1e-9)) if math.isfinite(p) else "–"


def _rounded_up(bound):
    """One digit, never below the bound: 1/401 is below 0.003, as the terminal says."""
    bound = max(bound, 1e-6)
    step = 10.0 ** math.floor(math.log10(bound))
    return math.ceil(bound / step * (1 - 1e-9)) * step


def twins_as_far(joint):
    """How many of the replicates have at least this recording's mismatch; None without replicates."""
    if not joint.twins or not math.isfinite(joint.omnibus_p):
        return None
    return max(round(joint.omnibus_p * (joint.twins + 1)) - 1, 0)


def told_errors(joint):
    """[(before, after, caption)] of training and validation. after: NaN where nothing was put into the model."""
    errors = [(joint.train_relerr, joint.augmented_train_relerr),
              (joint.validation_relerr, joint.augmented_validation_relerr)]
    has = has_after(joint)
    return [(before, after if has else math.nan, f"error {where}, all samples")
            for (before, after), where in zip(errors, ("in training", "in validation")) if math.isfinite(before)]
