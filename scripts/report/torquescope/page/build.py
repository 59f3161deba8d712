"""One self-contained page from a result: look first, read second, dig third.

    build.py R.h5 [--out R.html]

Nothing is fetched when it is opened: pictures, samples, style and script are inside.
"""

import argparse
import re
import sys
from pathlib import Path

import jinja2

from ..errors import ResultError
from . import diagnosed, quantities, readings, style, svg, tables, tables_of_arm, tables_of_diagnosis, tables_of_servo
from . import traces, what_now, words, words_of_arm, words_of_diagnosis, words_of_replay, words_of_rollouts
from . import words_of_servo
from .figures import all_cases
from .study import Study

# what the contents of a page of several joints list
OWN_SECTIONS = (' class="joint"', ' class="next own"', ' class="own"')
HERE = Path(__file__).resolve().parent
SCRIPTS = ("drawing.js", "samples.js", "trace.js", "zoom.js", "chart.js", "chart_zoom.js",
           "page.js")  # one scope, in this order


def page(study):
    """The text of the page."""
    kind = _of_diagnosis if study.diagnosis else _of_arm if study.arm else _of_study
    kind = _of_servo if study.servo else _of_replay if study.is_replay_alone else kind
    body = kind(study)
    if study.replay and not study.servo:  # a servo's pictures stand in its own order
        body["parts"] = ["replay.html", *body["parts"]]
    return render(
        all_cases(study),
        study=study,
        replayed=words_of_replay,
        rollouts=words_of_rollouts,
        tables=tables,
        what_now=what_now,
        **body,
    )


def render(cases, **said):
    """A page of these figures ({name: figures.Case}): `parts` are its templates, the rest is what they say."""
    lines = sum(len(case.traces.get("series", ())) for case in cases.values())
    most = min(traces.MOST_SAMPLES, traces.ALL_SAMPLES // max(1, lines))
    figures, data = {}, {}  # data: {id of the script element: JSON}
    for name, case in cases.items():
        figures[name], read = _figure(name, case, most)
        data.update(read)
        if case.traces:
            data[f"samples-{name}"] = traces.packed(case.traces["time"], case.traces["series"], case.traces["guide"],
                                                    most)
    environment = jinja2.Environment(loader=jinja2.FileSystemLoader(HERE), autoescape=True, trim_blocks=True,
                                     lstrip_blocks=True, undefined=jinja2.StrictUndefined)
    environment.filters["script_json"] = script_json
    script = "\n".join((HERE / name).read_text() for name in SCRIPTS)
    return environment.get_template("page.html").render(
        words=words, q=quantities, figures=figures, data=data, css=(HERE / "page.css").read_text(), js=script,
        light=_variables(0), dark=_variables(1),
        with_contents=with_contents, **said)


def with_contents(body):
    """The sections of a page with an id in each heading, and [(id, heading)]: all of them, or of a page of several
    joints those that begin a joint and those after the last one's."""
    found, per_joint = [], 'class="joint"' in body

    def mark(match):
        heading = jinja2.utils.markupsafe.Markup(match[2])
        name = "-".join(re.findall(r"[a-z0-9]+", heading.striptags().lower())) or "section"
        taken = sum(one == name or one.startswith(f"{name}--") for one, _, _ in found)
        name += f"--{taken + 1}" if taken else ""
        found.append((name, heading, not per_joint or match[1] in OWN_SECTIONS))
        return f'<section{match[1]}>\n<h2 id="{name}">{match[2]}</h2>'

    body = re.sub(r"<section([^>]*)>\n<h2>(.*?)</h2>", mark, str(body), flags=re.S)
    return jinja2.utils.markupsafe.Markup(body), [(name, heading) for name, heading, listed in found if listed]


def script_json(text):
    """JSON as it may stand in a script element: nothing in it ends the element ("</script>") or hides its end
    ("<!--<script>"). JSON has these letters in texts alone, where an escape means the same."""
    for letter in "<>&\u2028\u2029":
        text = text.replace(letter, f"\\u{ord(letter):04x}")
    return jinja2.utils.markupsafe.Markup(text)


def _of_study(study):
    return {"parts": ["study.html", "recording.html"], "verdict": words.verdict(study), "head": words.head(study),
            "numbers": words.big_numbers(study), "verdict_json": ""}


def _of_replay(study):
    return {"parts": ["came_from.html"], "verdict": words_of_replay.verdict(study),
            "head": words_of_replay.head(study), "numbers": words_of_replay.big_numbers(study), "verdict_json": ""}


def _of_servo(study):
    return {"parts": ["servo.html", "came_from.html"], "verdict": words_of_servo.verdict(study),
            "head": words_of_servo.head(study), "numbers": words_of_servo.big_numbers(study), "say": words_of_servo,
            "lists": tables_of_servo, "verdict_json": ""}


def _of_arm(study):
    return {"parts": ["arm.html", "recording.html"], "verdict": words_of_arm.verdict(study),
            "head": words_of_arm.head(study), "numbers": words_of_arm.big_numbers(study), "say": words_of_arm,
            "lists": tables_of_arm, "verdict_json": ""}


def _of_diagnosis(study):
    joints = study.diagnosis.joints
    parts = ["diagnosis.html"] if study.arm else ["diagnosis.html", "recording.html"]  # a recording of one joint
    return {"parts": parts, "verdict": words_of_diagnosis.verdict(study),
            "head": words_of_diagnosis.head(study),
            "numbers": words_of_diagnosis.big_numbers(joints[0]) if len(joints) == 1 else [], "say": words_of_diagnosis,
            "lists": tables_of_diagnosis, "diagnosed": diagnosed,
            "verdict_json": study.diagnosis.verdict_json}


def _figure(name, case, most):
    drawn, labels, read = [], {}, {}
    for width, css_class in ((style.WIDE, "wide"), (style.SMALL, "narrow")) if case.wide else ((style.SMALL, "small"),):
        figure = case.figure(width)
        axes = readings.gather(figure, labels)
        data = {"layout": figure.trace_layout, "samples": name} if case.traces else {}
        if axes:
            data["chart"] = f"chart-{name}-{css_class}"
            read[data["chart"]] = readings.written(axes)
        drawn.append(svg.inline(figure, name, case.title, case.sentence, css_class, data))
    thinned = case.traces and len(case.traces["time"]) > most
    sentence = case.sentence + (
        f" Zooming shows {quantities.whole(most)} of {quantities.whole(len(case.traces['time']))} "
        f"samples: where the {case.traces['guided_by']} is lowest and highest in each stretch."
        if thinned
        else ""
    )
    said = {
        "title": case.title,
        "sentence": sentence,
        "svg": "".join(drawn),
        "wide": case.wide,
        "zooms": bool(case.traces),
        "reads": bool(read),
        "legend": figure.trace_legend if case.traces else readings.legend(figure, labels),
    }
    return said, read


def _variables(theme):
    return "".join(f"--{name}:{pair[theme]};" for name, pair in style.PALETTE.items())


def main(arguments):
    """0, or 65 where the result is at fault."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("result", help="R.h5, complete")
    parser.add_argument("--out", help="R.html (default: the result's name)")
    options = parser.parse_args(arguments)
    out = Path(options.out or Path(options.result).with_suffix(".html"))
    try:
        text = page(Study(options.result))
    except ResultError as error:
        print(f"error: {error}", file=sys.stderr)
        return 65
    out.write_text(text, encoding="utf-8")
    print(f"wrote  {out}  {out.stat().st_size / 1e6:.1f} MB")
    return 0
