"""One verdict against one truth: what was found, at which level, what was invented.

A number of the verdict may be null: unknown.

A reported effect answers a true one exactly (its name), by class (the true name among its equivalents) or by family
(its family is one of those the catalogue puts the true effect into: the own one and those it is also confused with).
Each reported effect answers at most one true effect, better levels first; one that answers none is a false name.
A law whose form is not the catalogue's is found when its family is found.
Guesses are what is named and then the ranking, without repeats: a true effect's rank is the place of the first guess of
its family.
The main parameter is the first the truth lists; of a pair called ..._sin and ..._cos the vector counts, not its turn.
Names of "partly" are names: where every true effect is among them, that something is said to be left is no fault.
Expected "insufficient" (weak motion) also accepts a class; expected "measurement" (a fault of the instruments, no
physics) accepts every verdict that claims nothing beyond the names the truth allows.
"""

import dataclasses
import math

import verdict_record

LEVELS = ("exact", "class", "family")
MUST_FIND_SNR = 0.3        # below it naming is optional; inventing is not
LARGEST_STEP_ERROR = 0.01  # of the noise floor: a coarser plant is no truth (case_report.hpp says the same)


class Inexact(ValueError):
    """Half the step of the plant would have given another recording: its path, often chaotic, is not its laws' own."""

    def __init__(self, case, step_error):
        super().__init__(f"{case}: step-halving error {step_error:.3g} of the noise floor")
        self.step_error = step_error


@dataclasses.dataclass
class Found:
    """What became of one true effect."""
    name: str
    snr: float
    level: str = "missed"
    n_equivalent: int = 0              # effects the answer says fit as well: a class of everything says nothing
    first: bool = False                # answered by the first effect the verdict lists
    iou: float | None = None
    parameter_error: float | None = None  # relative error of the main parameter
    intervals: tuple = ()              # (truth inside the 95 % interval) per reported parameter
    family: str = ""                   # its own, of those it may answer to
    form: str = ""                     # the law it was made with
    catalogue_form: bool = False       # which is the catalogue's own: every parameter has an exact partner
    rank: int | None = None            # guess that has its family, from 1; None: no guess has
    blind: float | None = None         # chance that three guesses drawn from the list have its family; None: no list


@dataclasses.dataclass
class Judgement:
    case: str
    expected: str
    snr: float
    verdict: str                       # one of verdict_record.VERDICTS, "missing" or "invalid"
    right: bool = False
    n_named: int = 0
    false_names: tuple = ()
    found: tuple = ()
    gap_closed: float | None = None  # to the true laws along the recorded motion
    gap_to_exact: float | None = None  # to the true laws along the exact motion, which nobody knows
    tier: str = ""
    drawn: str = ""                    # the name a drawn case was made from
    wanted_snr: float = 0.0            # size each of its effects was made with
    names: tuple = ()  # (name, family, stated confidence or None, answers something concealed), as listed
    loop_ratio: float | None = None    # closed-loop position error, after over before
    reason: str = ""
    seconds: float | None = None
    rig: dict = dataclasses.field(default_factory=dict)
    seal: str = ""
    concealed: tuple = ()              # what lies in it, also where the catalogue has no name for it

    def reached(self, level):
        """All true effects found at this level or better."""
        return bool(self.found) and all(f.level in LEVELS[: LEVELS.index(level) + 1] for f in self.found)


def check_truth(truth):
    keys = ("case", "expected", "size", "effects", "relerr", "step_error")
    for key in (*keys, "may_name") if truth.get("expected") == "measurement" else keys:
        if key not in truth:
            raise ValueError(f"truth without {key}")
    for effect in truth["effects"]:
        if "families" not in effect:
            raise ValueError(f"{truth['case']}: a true effect without families: made by an older make_case")
    # null is what JSON makes of a loop that has lost its joint
    worst = max(math.inf if error is None else error for error in truth["step_error"].values())
    if worst > LARGEST_STEP_ERROR:
        raise Inexact(truth["case"], worst)


def region_iou(region, truth_regions):
    """Shared over joint occupancy of the reported intervals and the true region, on the axis of the report."""
    places = (region or {}).get("places") or [[(region or {}).get("from"), (region or {}).get("to")]]
    if any(end is None for place in places for end in place):
        return None
    for true in truth_regions:
        if true["axis"] != region.get("axis"):
            continue
        both = either = 0.0
        for left, right, share, inside in zip(true["edges"], true["edges"][1:], true["occupancy"], true["inside"]):
            covered = sum(max(0.0, min(high, right) - max(low, left)) for low, high in places) / (right - left)
            both += share * covered if inside else 0.0
            either += share if inside else share * covered
        return both / either if either > 0.0 else 0.0
    return None


def _answers(reported, true, level):
    if level == "exact":
        return reported["name"] == true["name"]
    if level == "class":
        return true["name"] in reported.get("equivalent", [])
    return reported.get("family") in true["families"]


def _main_error(values, parameters):
    """values: {name: estimate}; relative error of the first of the true parameters, None when it is not reported."""
    if not parameters:
        return None
    stem = parameters[0]["name"].removesuffix("_sin")
    main = [p for p in parameters if p["name"] in (f"{stem}_sin", f"{stem}_cos")] or parameters[:1]
    size = math.hypot(*(p["value"] for p in main))
    if size == 0.0 or any(values.get(p["name"]) is None for p in main):
        return None
    return math.hypot(*(values[p["name"]] - p["value"] for p in main)) / size


def _parameter_score(reported, true):
    """-> (relative error of the main parameter, (truth inside the interval) of each that is reported with one)."""
    reports = {p["name"]: p for p in reported.get("parameters", [])}
    inside = []
    for parameter in true["parameters"]:
        report = reports.get(parameter["name"], {})
        if report.get("ci95") and None not in report["ci95"]:
            inside.append(report["ci95"][0] <= parameter["value"] <= report["ci95"][1])
    return _main_error({name: p["value"] for name, p in reports.items()}, true["parameters"]), tuple(inside)


def guesses(record):
    """Families of the named effects and of the ranking after them, each name once."""
    ranked = {effect["name"]: effect["family"] for effect in [*record["effects"], *record["ranking"]][::-1]}
    order = dict.fromkeys(effect["name"] for effect in [*record["effects"], *record["ranking"]])
    return [ranked[name] for name in order]


def blind_chance(n, n_right, guesses=3):
    """Chance that `guesses` drawn without looking from a list of n hit one of the n_right; None without a list."""
    return 1.0 - math.comb(n - n_right, guesses) / math.comb(n, guesses) if n >= guesses else None


def match(reported, true_effects):
    """-> (list of Found, in the order of true_effects; names that answer nothing)."""
    known = [t for t in true_effects if t["name"]]
    found = [Found(t["name"], t["size"]["snr_eff"], family=t["families"][0], form=t.get("form", ""),
                   catalogue_form=bool(t.get("catalogue_form"))) for t in known]
    free = list(range(len(reported)))
    for level in LEVELS:
        for f, t in zip(found, known):
            index = next((i for i in free if _answers(reported[i], t, level)), None)
            if f.level != "missed" or index is None:
                continue
            free.remove(index)
            f.level, f.first = level, index == 0
            f.n_equivalent = len(reported[index].get("equivalent", []))
            f.iou = region_iou(reported[index].get("region"), t["regions"])
            if level == "exact":
                f.parameter_error, f.intervals = _parameter_score(reported[index], t)
    return found, tuple(reported[i]["name"] for i in free)


def _claims(reported, allowed):
    """Names beyond `allowed`; a class that holds an allowed one does not claim the others."""
    return tuple(r["name"] for r in reported if not {r["name"], *r.get("equivalent", [])} & set(allowed))


def _is_right(judgement, truth):
    if judgement.false_names:
        return False
    if truth["expected"] == "measurement":
        return True
    if truth["expected"] == "insufficient":
        silent = judgement.snr < MUST_FIND_SNR and judgement.verdict == "none"
        return judgement.verdict in ("class", "insufficient") or silent
    if truth["expected"] == "none":
        return judgement.verdict == "none"
    if truth["expected"] == "unexplained":
        return judgement.verdict == "unexplained"
    for f, t in zip(judgement.found, truth["effects"]):
        wanted = LEVELS[:2] if t["catalogue_form"] else LEVELS
        if f.snr >= MUST_FIND_SNR and f.level not in wanted:
            return False
    needed = any(f.snr >= MUST_FIND_SNR for f in judgement.found)
    # some effects are faults of the instruments: a verdict that names them so has found them
    return judgement.verdict in ("named", "class", "partly", "data_fault") or not needed


def _gap_closed(validation, oracle):
    """Share of the way from the baseline's error to the oracle's; an error that stays is a gap that stays."""
    before, after = (None, None) if validation is None else (validation.get("before"), validation.get("after"))
    if before is None or after is None or before <= oracle:
        return None
    return (before - after) / (before - oracle)


def _loop_ratio(loop):
    ratio = loop["after"] / loop["before"] if loop and loop["before"] else math.nan
    return ratio if math.isfinite(ratio) else None


def _concealed(truth):
    """Names of what lies in the case: effects, and the circumstance that stands first in the name of T5, T6 and T7."""
    words = truth.get("drawn", "").split(":")[1:-1]
    drawn = tuple(words[0].split("+")) if words else ()
    return drawn or tuple(t["name"] or t.get("form", "") for t in truth["effects"])


def judge(truth, verdict):
    """verdict: the parsed JSON of `diagnose --json` or of a rival (verdict_record.py), or None when there is none."""
    check_truth(truth)
    out = Judgement(truth["case"], truth["expected"], truth["size"]["snr_eff"], "missing")
    out.found = tuple(match([], truth["effects"])[0])
    out.tier, out.drawn, out.wanted_snr = (truth.get(key, default) for key, default in
                                           (("tier", ""), ("drawn", ""), ("wanted_snr", 0.0)))
    out.rig, out.concealed = truth.get("rig", {}), _concealed(truth)
    if verdict is None:
        return out
    try:
        record = verdict_record.of(verdict)
        reported = record["effects"]
        found, false_names = match(reported, truth["effects"])
        if truth["expected"] == "measurement":
            false_names = _claims(reported, truth["may_name"])
        oracles = truth["relerr"]["validate"]
        gap, exact = (_gap_closed(record["unseen"], oracles[key]) if truth["effects"] else None
                      for key in ("oracle_of_recording", "oracle"))
        families = guesses(record)
        names = tuple(
            (r["name"], r["family"], verdict_record.confidence_of(r), r["name"] not in false_names) for r in reported
        )
        loop = _loop_ratio(record["loop"])
    except (verdict_record.Invalid, KeyError, TypeError, IndexError):
        out.verdict = "invalid"
        return out
    for f, t in zip(found, (t for t in truth["effects"] if t["name"])):
        f.rank = next((i for i, family in enumerate(families, 1) if family in t["families"]), None)
        f.blind = blind_chance(len(families), sum(family in t["families"] for family in families))
    out.verdict, out.n_named, out.names = record["verdict"], len(reported), names
    out.found, out.false_names, out.gap_closed, out.gap_to_exact, out.loop_ratio = (
        tuple(found),
        false_names,
        gap,
        exact,
        loop,
    )
    out.reason, out.seconds = record["reason"], record["seconds"]
    out.right = _is_right(out, truth)
    return out
