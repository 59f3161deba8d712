"""One verdict against one truth: what was found, at which level, what was invented. A number of the verdict may be null: unknown.

A reported effect answers a true one exactly (its name), by class (the true name among its equivalents) or by family (its
family is one of those the catalogue puts the true effect into: the own one and those it is also confused with).
Each reported effect answers at most one true effect, better levels first; one that answers none is a false name.
A law whose form is not the catalogue's is found when its family is found (PHYSICS.md section 4).
Expected "insufficient" (weak motion) also accepts a class; expected "measurement" (a fault of the instruments, no physics)
accepts every verdict that claims nothing beyond the names the truth allows.
"""
import dataclasses

LEVELS = ("exact", "class", "family")
VERDICTS = ("none", "named", "class", "unexplained", "insufficient", "data_fault")
MUST_FIND_SNR = 0.3        # below it naming is optional; inventing is not
LARGEST_STEP_ERROR = 0.01  # of the noise floor: a coarser plant is no truth


@dataclasses.dataclass
class Found:
    """What became of one true effect."""
    name: str
    snr: float
    level: str = "missed"
    n_equivalent: int = 0              # effects the answer says fit as well: a class of everything says nothing
    first: bool = False                # answered by the first effect the verdict lists
    iou: float | None = None
    parameter_error: float | None = None  # largest relative error of the true parameters that are reported
    intervals: tuple = ()              # (truth inside the 95 % interval) per reported parameter


@dataclasses.dataclass
class Judgement:
    case: str
    expected: str
    snr: float
    verdict: str                       # one of VERDICTS, "missing" or "invalid"
    right: bool = False
    n_named: int = 0
    false_names: tuple = ()
    found: tuple = ()
    gap_closed: float | None = None
    tier: str = ""
    drawn: str = ""                    # the name a drawn case was made from
    wanted_snr: float = 0.0            # size each of its effects was made with

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
    worst = max(truth["step_error"].values())
    if worst > LARGEST_STEP_ERROR:
        raise ValueError(f"{truth['case']}: step-halving error {worst:.3g} of the noise floor")


def region_iou(region, truth_regions):
    """Shared over joint occupancy of the reported interval and the true region, on the axis of the report."""
    if not region or region.get("from") is None or region.get("to") is None:
        return None
    for true in truth_regions:
        if true["axis"] != region.get("axis"):
            continue
        low, high = region["from"], region["to"]
        both = either = 0.0
        for left, right, share, inside in zip(true["edges"], true["edges"][1:], true["occupancy"], true["inside"]):
            covered = max(0.0, min(high, right) - max(low, left)) / (right - left)
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


def _parameter_score(reported, true):
    values = {p["name"]: p for p in reported.get("parameters", [])}
    errors, inside = [], []
    for parameter in true["parameters"]:
        estimate = values.get(parameter["name"])
        if estimate is None or estimate["value"] is None or parameter["value"] == 0.0:
            continue
        errors.append(abs(estimate["value"] / parameter["value"] - 1.0))
        if estimate.get("ci95") and None not in estimate["ci95"]:
            inside.append(estimate["ci95"][0] <= parameter["value"] <= estimate["ci95"][1])
    return (max(errors) if errors else None), tuple(inside)


def match(reported, true_effects):
    """-> (list of Found, in the order of true_effects; names that answer nothing)."""
    known = [t for t in true_effects if t["name"]]
    found = [Found(t["name"], t["size"]["snr_eff"]) for t in known]
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
    return judgement.verdict in ("named", "class") or not needed


def _gap_closed(joint, oracle):
    before = joint["baseline"]["validation_relerr"]
    after = (joint.get("augmented") or {}).get("validation_relerr")
    if before is None or after is None or before <= oracle:
        return None
    return (before - after) / (before - oracle)


def judge(truth, verdict):
    """verdict: the parsed JSON of `diagnose --json`, or None when there is none."""
    check_truth(truth)
    out = Judgement(truth["case"], truth["expected"], truth["size"]["snr_eff"], "missing")
    out.found = tuple(match([], truth["effects"])[0])
    out.tier, out.drawn, out.wanted_snr = (truth.get(key, default) for key, default in
                                           (("tier", ""), ("drawn", ""), ("wanted_snr", 0.0)))
    if verdict is None:
        return out
    try:
        if verdict["schema"] != 1 or verdict["verdict"] not in VERDICTS:
            raise KeyError("schema or verdict")
        joint = verdict["joints"][0] if verdict["joints"] else {"effects": [], "baseline": {}}
        reported = joint["effects"]
        found, false_names = match(reported, truth["effects"])
        if truth["expected"] == "measurement":
            false_names = _claims(reported, truth["may_name"])
        gap = _gap_closed(joint, truth["relerr"]["validate"]["oracle"]) if truth["effects"] and joint["baseline"] else None
    except (KeyError, TypeError, IndexError):
        out.verdict = "invalid"
        return out
    out.verdict, out.n_named = verdict["verdict"], len(reported)
    out.found, out.false_names, out.gap_closed = tuple(found), false_names, gap
    out.right = _is_right(out, truth)
    return out
