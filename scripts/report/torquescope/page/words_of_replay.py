"""What the page says of recordings and their simulations. Every number is stored in the file."""

import math

from . import quantities as q
from .words_of_diagnosis import kept_together
from ..reader.read_replay import YOURS as YOUR_NAME, validation_first

BEFORE, AFTER, YOURS = "before", "after", "yours"
FIRST_SHOWN = 2  # recordings; the others are folded
PHRASES = ("as ", "by ", "with ")  # begin the names of models that are no labels of estimators
DRIVEN = {"reference": "Simulated in closed loop from the commanded position",
          "command": "Driven by the drive’s recorded command"}


def roles(replay):
    """[(role, index into models)] of what is drawn, in this order."""
    found = [(BEFORE, replay.before)]
    if replay.after != replay.before:
        found.append((AFTER, replay.after))
    if replay.yours is not None and replay.yours not in (replay.before, replay.after):
        found.append((YOURS, replay.yours))
    return found


def named_recordings(replay):
    """[(name of its figure, recording)], those of validation first."""
    number = {id(one): at for at, one in enumerate(replay.recordings, start=1)}
    return [(f"replay_{number[id(one)]}", one) for one in validation_first(replay)]


def first(replay):
    """The recording that sentences are about: validation if there is one."""
    return next(one for one in validation_first(replay) if one.channels)


def ends_early(one):
    """Whether it cannot be believed to its end."""
    return len(one.time) > 0 and one.horizon_s < one.time[-1]


def called(one):
    return f"{one.name}, {'validation' if one.is_validation else 'training'}"


def caption(replay, one):
    """How it was simulated, by which loop, and until when to believe it."""
    said = [f"{_driven(one)}: all {q.count(one.samples, 'sample')} at {q.tick(one.rate_hz)} Hz.", loop(one)]
    gone = [_with(replay, at) for _, at in roles(replay) if one.diverged[at]]
    if gone:
        ran = f"{q.listed(gone)} it ran away, so there are no numbers."
        said.append(ran[0].upper() + ran[1:])
    if ends_early(one):
        said.append(f"Believe it until {q.seconds(one.horizon_s)}; what comes after is shaded.")
    elif len(gone) < len(roles(replay)):
        said.append("It can be believed to its end.")
    return " ".join(text for text in said if text)


def _driven(one):
    if one.drive != "windows":
        return DRIVEN.get(one.drive, "Simulated")
    of = f"windows of {q.seconds(one.window_s)} that begin" if one.window_s > 0 else "one window that begins"
    return f"No reference was recorded: driven by the recorded torque, in {of} anew at the measured state"


def loop(one):
    """The loop's sentence, and what its controller leaves."""
    words = one.loop_words.strip()
    said = [words[0].upper() + words[1:].rstrip(".") + "."] if words else []
    if math.isfinite(one.loop_error):
        said.append(f"The loop’s controller leaves {q.percent(one.loop_error)} of the recorded torque.")
    return " ".join(said)


def figure_of(one, values, model, write):
    return "diverged" if one.diverged[model] else write(float(values[model]))


def before_after(replay, one, values, write):
    """'0.0123 → 0.0045', or of one model one number."""
    both = [figure_of(one, values, model, write) for model in dict.fromkeys((replay.before, replay.after))]
    return " → ".join(dict.fromkeys(both) if set(both) == {"diverged"} else both)


def table(study):
    """{"head", "rows", "caption"}: of every recording and channel, and one row more for each model that is neither
    before nor after."""
    replay = study.replay
    head = ["recording", "channel", "samples", "rms", "MAE", "relative error", "loop", "believed until"]
    others = [model for model in range(len(replay.models)) if model not in (replay.before, replay.after)]
    rows = []
    for _, one in named_recordings(replay):
        until = q.seconds(one.horizon_s) if ends_early(one) else "its end"
        for key, channel in one.channels.items():
            name, unit = study.effort if key == "torque" else key, q.unit(channel.unit)
            samples = max(channel.samples[replay.before], channel.samples[replay.after])
            rows.append([called(one), f"{name} ({unit})", q.whole(samples),
                         *(before_after(replay, one, values, q.number) for values in (channel.rms, channel.mae)),
                         _percents(replay, one, channel.relerr), one.loop, until])
            for model in others:
                whose = "yours" if model == replay.yours else replay.models[model]
                rows.append([called(one), f"{name}, {whose} ({unit})", q.whole(channel.samples[model]),
                             *(figure_of(one, values, model, write) for values, write in (
                                 (channel.rms, q.number), (channel.mae, q.number), (channel.relerr, q.percent))),
                             one.loop, until])
    labels = " → ".join(replay.models[model] for role, model in roles(replay) if role != YOURS)
    caption = f"Measured minus simulated, over all samples: {labels}"
    if replay.yours in others:
        caption += f"; yours: {YOUR_NAME}"
    return {"head": head, "rows": rows, "caption": f"{caption}. MAE: mean absolute error"}


def answer(study):
    """How far off the first recording's simulation is, channel by channel; of a replay alone its verdict says it."""
    one = first(study.replay)
    said = [f"the {name} {_off(study.replay, one, channel)}" for name, channel in _told(study, one)]
    said = "; ".join(said) if not study.is_replay_alone else ""
    errors = ("over all samples: the rms of the difference over that of the measured signal, of position and velocity "
              "about their mean.")
    return f"On {_which(one)} {said}. Errors are {errors}" if said else f"Errors are {errors}"


def _which(one):
    return f"the {'validation' if one.is_validation else 'training'} recording {one.name}"


def _told(study, one):
    """[(name, channel)] of position and effort."""
    names = {"position": "position", "torque": study.effort}
    found = [(names[key], channel) for key, channel in one.channels.items() if key in names]
    return found or list(one.channels.items())


def _off(replay, one, channel):
    """'runs away as identified and is off by 3.1 % with what was named'"""
    gone = [_with(replay, at) for _, at in roles(replay) if one.diverged[at]]
    off = [f"{q.percent(float(channel.relerr[at]))} {_with(replay, at)}" for _, at in roles(replay)
           if channel.has(at) and not one.diverged[at]]
    said = ([f"runs away {q.listed(gone)}"] if gone else []) + ([f"is off by {q.listed(off)}"] if off else [])
    return q.listed(said) or "is not simulated"


def _with(replay, model):
    """As it follows a number: phrases of the engine as they are, labels of estimators with a "by"."""
    name = replay.models[model]
    if name == YOUR_NAME:
        return f"in {YOUR_NAME}"
    return name if name.startswith(PHRASES) else f"by {name}"


def verdict(study):
    """Of a file that is a replay alone."""
    replay = study.replay
    one = first(replay)
    name, channel = _told(study, one)[0]
    sentence = f"On {_which(one)} the simulated {name} {_off(replay, one, channel)}."
    gone = any(one.diverged[at] for one in replay.recordings for _, at in roles(replay))
    others = [f"The {name} {_off(replay, one, channel)}." for name, channel in _told(study, one)[1:]]
    return {"mark": "▽" if gone else "●", "word": "Replayed, and a simulation ran away" if gone else "Replayed",
            "tone": "ochre" if gone else "ink", "sentence": sentence, "headlines": [kept_together(sentence)],
            "evidence": kept_together(" ".join([*others, loop(one)]))}


def _percents(replay, one, values):
    """One sign for both: '12 → 3.1 %'."""
    both = before_after(replay, one, values, q.percent)
    before, arrow, after = both.partition(" → ")
    return f"{before.removesuffix(' %')}{arrow}{after}" if after.endswith("%") else both


def head(study):
    recordings = study.replay.recordings
    validation = sum(one.is_validation for one in recordings)
    return [study.job.name, f"{study.joint} joint",
            q.count(len(recordings), "recording") + (f", {q.whole(validation)} validation" if validation else "")]


def big_numbers(study):
    """[(number, unit, caption)]: at most four, of the first recording."""
    replay = study.replay
    one = first(replay)
    found = []
    for name, channel in _told(study, one):
        before, after = (figure_of(one, channel.relerr, model, q.percent) for model in (replay.before, replay.after))
        was = f"; {before} {_with(replay, replay.before)}" if replay.after != replay.before else ""
        where = "validation" if one.is_validation else "training"
        found.append((after, "", kept_together(f"error of the {name}, {where}{was}")))
    found.append((q.whole(one.samples), "", "samples, and all of them count"))
    if ends_early(one):
        found.append((q.seconds(one.horizon_s), "", "until then the simulation can be believed"))
    return found[:4]
