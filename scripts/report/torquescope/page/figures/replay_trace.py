"""A recording and its simulation over one time axis: measured and simulated, and their difference below, channel by
channel."""

from dataclasses import dataclass

import numpy as np

from .. import quantities as q, style, traces, words_of_replay, words_of_servo
from ..words_of_replay import YOURS
from . import Case

LOOKS = {"before": ("baseline", "solid", 1.9), "after": ("augmented", "solid", 1.3), "yours": ("ink", (0, (5, 2)), 1.2)}
FRAME = 1.5  # of the measured span: a simulation that goes further beyond leaves the frame
DRAWN = 4.0  # what is further out is not drawn: its neighbours keep their digits in the page's 16 bits
PREFIXES = ((2e-5, "µ", 1e6), (0.02, "m", 1e3))  # of the unit of differences that stay below
PEAK = 6.0  # of what 99 % of the differences stay below: a lone peak beyond leaves the frame
LIVELY = 0.5  # of the motion's rms: a stretch with less of it shows a joint at rest


@dataclass
class Channel:
    """One signal as it is drawn; `sims` [(role, label, values [n], difference [n])], the frame's limits, what leaves
    it."""

    name: str
    symbol: str
    unit: str
    part: str  # begins the names of its samples
    measured: np.ndarray
    sims: list
    rms: str
    low: float
    high: float
    limit: float
    outside: int


def draw(time, channels, window, beyond, width=style.WIDE):
    """channels: [Channel]; beyond: [(start, stop)] in s, shaded: where the simulation cannot be believed."""
    rows = []
    for one in channels:
        lines = [traces.Line(one.part, one.measured, style.LIGHT["measured"], thickness=4, label="measured")]
        below = []
        for at, (role, label, values, difference) in enumerate(one.sims):
            colour, dashes, thickness = LOOKS[role]
            look = {"colour": style.LIGHT[colour], "dashes": dashes, "on_top": role == YOURS, "label": label}
            part = f"d{one.part}{at}"  # samples.js has the simulated as measured less this
            lines.append(traces.Line(f"{one.part}-{part}", values, thickness=thickness, **look))
            below.append(traces.Line(part, difference, thickness=1.1, **look))
        rows.append(traces.Row(f"{one.name} ({one.unit})", one.symbol, one.unit, lines, 150, one.low, one.high))
        if below:
            unit, times = finer(one.unit, one.limit)
            words = (f"measured minus simulated ({unit}), rms {one.rms}" if width >= style.WIDE
                     else f"difference ({unit})")
            rows.append(traces.Row(words, one.symbol, unit, below, 84, -one.limit, one.limit, times=times))
    strip = traces.Line(channels[0].part, channels[0].measured, style.LIGHT["measured"])
    return traces.draw(time, rows, window, strip, width, beyond)


def finer(unit, limit):
    """(unit, how many of it make one of the whole): thousandths or millionths where the differences are that small."""
    found = next(((prefix, times) for below, prefix, times in PREFIXES if limit < below), ("", 1.0))
    return (found[0] + unit, found[1]) if unit[:1].isalpha() else (unit, 1.0)


def cases(study):
    """Validation recordings first; of each one figure with position and effort, and one of the velocity. Of a set of
    recordings of servos, which are many, the first alone."""
    found = {}
    for name, one, caption in _captioned(study) if study.replay else ():
        together = [key for key in ("position", "torque") if key in one.channels]
        for figure, keys in ((name, together or ["velocity"]), (f"{name}_velocity", ["velocity"] if together else [])):
            channels = [_channel(study, one, key) for key in keys if key in one.channels]
            if channels and len(one.time) > 1 and (figure == name or not study.servo):
                sentence = caption if figure == name else "Of the same simulation."
                found[figure] = _case(study.replay, one, channels, sentence)
    return found


def _captioned(study):
    """[(name of its figure, recording, what is said of it)]"""
    if study.servo:
        return words_of_servo.captioned(study)
    return [(name, one, words_of_replay.caption(study.replay, one))
            for name, one in words_of_replay.named_recordings(study.replay)]


def _case(replay, one, channels, sentence):
    window, said = opened(one, channels)
    guide, guided_by = judged(channels)
    series = {}
    for channel in channels:
        series[channel.part] = channel.measured
        series.update({f"d{channel.part}{at}": sim[3] for at, sim in enumerate(channel.sims)})
    sentence += said
    outside = sum(channel.outside for channel in channels)
    if outside:
        sentence += f" Outside of the frames: {q.count(outside, 'value')} of simulations or differences."
    arguments = {"time": one.time, "channels": channels, "window": window,
                 "beyond": [(max(one.horizon_s, one.time[0]), one.time[-1])] if words_of_replay.ends_early(one) else []}
    title = f"{q.listed(channel.name for channel in channels)} of {words_of_replay.called(one)}"
    return Case(draw, arguments, title[0].upper() + title[1:], sentence, wide=True,
                traces={"time": one.time, "series": series, "guide": guide, "guided_by": guided_by})


def _channel(study, one, key):
    symbols = {"position": "q", "velocity": "q\u0307", "torque": study.symbol}
    channel, replay = one.channels[key], study.replay
    roles = [(role, at) for role, at in words_of_replay.roles(replay) if channel.has(at)]
    steady = [channel.simulated[at] for _, at in roles if not one.diverged[at]]
    low, high, limit = _frame(channel.measured, steady)
    sims, outside = [], 0
    for role, at in roles:
        far = np.abs(channel.difference(at)) > DRAWN * (high - low)
        values = np.where(far, np.nan, channel.simulated[at])
        if np.isfinite(values).any():
            sims.append((role, replay.models[at], values, channel.measured - values))
    for values in steady:
        outside += np.count_nonzero((np.abs(channel.measured - values) > limit) | (values < low) | (values > high))
    write = lambda value: q.number(value * finer(q.unit(channel.unit), limit)[1])  # noqa: E731
    rms = words_of_replay.before_after(replay, one, channel.rms, write)
    rms += "".join(f", yours {words_of_replay.figure_of(one, channel.rms, at, write)}"
                   for role, at in roles if role == YOURS)
    name = study.effort if key == "torque" else key
    return Channel(name, symbols[key], q.unit(channel.unit), {"position": "q", "velocity": "v", "torque": "t"}[key],
                   channel.measured, sims, rms, low, high, limit, outside)


def _frame(measured, simulated):
    """Lowest and highest of the picture, and of the differences: all of the measured, and of the simulated what does
    not make it small."""
    low, high = float(np.nanmin(measured)), float(np.nanmax(measured))
    room = FRAME * (high - low) or 1.0
    held = [np.clip(values, low - room, high + room) for values in simulated]
    low, high = traces.scale(np.concatenate([measured, *held]))
    sizes = np.abs(np.concatenate([measured - values for values in simulated])) if simulated else np.empty(0)
    sizes = sizes[np.isfinite(sizes)]
    largest = float(min(sizes.max(), PEAK * np.quantile(sizes, 0.99) or np.inf)) if len(sizes) else 0.0
    return low, high, 1.05 * largest or 0.05 * (high - low)


def judged(channels):
    """(values [n], what they are): the difference of the effort, or what comes nearest to it, with the last of the
    models that are not yours."""
    for channel in reversed(channels):
        ours = [difference for role, _, _, difference in channel.sims if role != YOURS]
        if ours:
            return ours[-1], f"difference of the {channel.name}"
    return channels[0].measured, channels[0].name


def opened(one, channels, length=traces.OPENED_S):
    """((start, stop), what the caption says of it): `length` seconds that are neither the best nor the worst."""
    first, last = float(one.time[0]), float(one.time[-1])
    if last - first <= 1.3 * length:
        return (first, last), ""
    starts = np.arange(first, last - length, length / 4)
    begins, ends = np.searchsorted(one.time, starts), np.searchsorted(one.time, starts + length)

    def energy(values):
        """Of each stretch."""
        summed = np.concatenate([[0.0], np.cumsum(np.nan_to_num(values) ** 2)])
        return summed[ends] - summed[begins]

    motion = channels[0].measured - np.nanmean(channels[0].measured)
    level = LIVELY**2 * np.nanmean(motion**2) * np.maximum(ends - begins, 1)
    usable = energy(motion) >= level
    if np.isfinite(one.horizon_s) and (usable & (starts + length <= one.horizon_s)).any():
        usable &= starts + length <= one.horizon_s
    errors = energy(judged(channels)[0])
    chosen = np.flatnonzero(usable) if usable.any() else np.arange(len(starts))
    ranked = chosen[np.argsort(errors[chosen], kind="stable")]
    start = float(starts[ranked[(len(ranked) - 1) // 2]])
    return (start, start + length), " Opened on six seconds of motion whose error is the median of all."
