"""The protocol's table: what is measured, its pass and stretch level, and whether they hold.

A level holds or not as soon as the one-sided 95 % bounds say so; before, there are too few cases to say. From `enough`
cases on (what the whole suite has) a level is decided by what was measured, or, where the protocol states a bound, by
the bound.
"""

import dataclasses
import itertools

import confidence
import measures

YES, NO, OPEN, NONE = "yes", "no", "too few cases to say", "not measured"
NEARLY = 0.9  # sizes are made to within a tenth: "from SNR_eff 1 on" takes in what came out as 0.9


@dataclasses.dataclass(frozen=True)
class Level:
    text: str           # as the protocol writes it
    low: float = 0.0    # what holds lies between low and high
    high: float = float("inf")


@dataclasses.dataclass(frozen=True)
class Row:
    key: str
    words: str          # for people
    form: str           # "percent", "number", "count" or "seconds"
    measure: object     # list of Judgement -> measures, or None
    passes: Level | None = None
    stretch: Level | None = None
    enough: int = 100
    by_bound: bool = False


def kind(j):
    """Tier of a drawn case; of a sealed one the tier it would belong to."""
    if j.tier:
        return j.tier
    several = min(len(j.found), 3)
    return {"none": "T0", "unexplained": "T4", "insufficient": "T5", "measurement": "T6"}.get(j.expected, f"T{several}")


def unanswered(j):
    return j.verdict in ("missing", "invalid")


def invented(j):
    """Silence must not look like caution: a missing verdict counts as one with a false name."""
    return bool(j.false_names) or unanswered(j)


def size(j):
    """SNR_eff of the smallest effect in it."""
    return min((f.snr for f in j.found), default=j.snr)


def _of(judgements, tiers, snr=0.0):
    return [j for j in judgements if kind(j) in tiers and size(j) >= NEARLY * snr]


def first_answers(j, level):
    return j.reached(level) and j.found[0].first


def among_three(j):
    return bool(j.found) and j.found[0].rank is not None and j.found[0].rank <= 3


def whole_set(j):
    return j.reached("family") and not j.false_names


def false_share(j):
    return 1.0 if unanswered(j) else len(j.false_names) / max(1, j.n_named)


def _share(tiers, test, snr=0.0):
    return lambda js: measures.share(_of(js, tiers, snr), test)


def _found(js, snr=0.0, tiers=("T1", "T2", "T3", "T7")):
    return [f for j in js if kind(j) in tiers for f in j.found if f.snr >= NEARLY * snr]


def gaps(js):
    return [j.gap_closed for j in _of(js, ("T1", "T2", "T3"), 1.0) if j.gap_closed is not None]


def exact_gaps(js):
    return [j.gap_to_exact for j in _of(js, ("T1", "T2", "T3"), 1.0) if j.gap_to_exact is not None]


def overlaps(js):
    return [f.iou for f in _found(js) if f.iou is not None]


def _intervals(js, catalogue_forms=(False, True)):
    return measures.share(
        itertools.chain.from_iterable(f.intervals for f in _found(js) if f.catalogue_form in catalogue_forms), bool
    )


def _errors(probability):
    return lambda js: measures.quantile([f.parameter_error for f in _found(js, 2.0)], probability)


def stated(js):
    return [(sure, right) for j in js for _, _, sure, right in j.names]


def _average(values):
    values = [value for value in values if value is not None]
    return measures.plain(sum(values) / len(values), len(values)) if values else None


def _calibrated(key):
    return lambda js: (lambda c: measures.plain(c[key], c["n"]))(confidence.calibration(stated(js)))


ROWS = (
    Row(
        "clean_false_name",
        "Clean records with a false name",
        "percent",
        _share(("T0",), invented),
        Level("at most 16 of 500 (95 % sure of < 5 %)", high=0.05),
        Level("at most 4 of 500 (95 % sure of < 2 %)", high=0.02),
        500,
        True,
    ),
    Row(
        "decoy_false_name",
        "Measurement decoys named as physics",
        "percent",
        _share(("T6",), invented),
        Level("≤ 5 %", high=0.05),
        Level("≤ 2 %", high=0.02),
        150,
    ),
    Row("any_false_name", "Cases of any tier with a false name", "percent", lambda js: measures.share(js, invented)),
    Row(
        "single_family",
        "One effect, SNR ≥ 1: family of the first name",
        "percent",
        _share(("T1",), lambda j: first_answers(j, "family"), 1.0),
        Level("≥ 92.5 % (95 % sure of > 90 %)", low=0.90),
        Level("≥ 97 % (95 % sure of > 95 %)", low=0.95),
        400,
        True,
    ),
    Row(
        "single_class",
        "One effect, SNR ≥ 1: exact name or class first",
        "percent",
        _share(("T1",), lambda j: first_answers(j, "class"), 1.0),
        Level("≥ 83.5 % (95 % sure of > 80 %)", low=0.80),
        Level("≥ 92.5 % (95 % sure of > 90 %)", low=0.90),
        400,
        True,
    ),
    Row(
        "single_exact",
        "One effect, SNR ≥ 1: exact name first",
        "percent",
        _share(("T1",), lambda j: first_answers(j, "exact"), 1.0),
    ),
    Row(
        "single_top3",
        "One effect, SNR ≥ 0.5: family among three guesses",
        "percent",
        _share(("T1",), among_three, 0.5),
        Level("≥ 90 %", low=0.90),
        Level("≥ 95 %", low=0.95),
        400,
    ),
    Row(
        "single_top3_blind",
        "The same, three blind guesses from the list",
        "percent",
        lambda js: _average([j.found[0].blind for j in _of(js, ("T1",), 0.5) if j.found]),
    ),
    Row(
        "pair_set",
        "Two effects, SNR ≥ 2: whole set by family",
        "percent",
        _share(("T2",), whole_set, 2.0),
        Level("≥ 75 %", low=0.75),
        Level("≥ 88 %", low=0.88),
        130,
    ),
    Row(
        "triple_set",
        "Three effects, SNR ≥ 2: whole set by family",
        "percent",
        _share(("T3",), whole_set, 2.0),
        Level("≥ 55 %", low=0.55),
        Level("≥ 70 %", low=0.70),
        65,
    ),
    Row(
        "recall",
        "Effects of SNR ≥ 1 found (alone, in pairs, in triples)",
        "percent",
        lambda js: measures.share(_found(js, 1.0, ("T1", "T2", "T3")), lambda f: f.level != "missed"),
    ),
    Row(
        "false_share",
        "False share of the names, mean over one to three effects",
        "percent",
        lambda js: measures.mean([false_share(j) for j in _of(js, ("T1", "T2", "T3"))]),
        Level("≤ 5 %", high=0.05),
        Level("≤ 3 %", high=0.03),
        900,
    ),
    Row(
        "region_iou",
        "Overlap of located and true region (IoU), median",
        "number",
        lambda js: measures.quantile(overlaps(js)),
        Level("≥ 0.60", low=0.60),
        Level("≥ 0.75", low=0.75),
    ),
    Row(
        "parameter_median",
        "Main parameter, SNR ≥ 2: relative error, median",
        "percent",
        _errors(0.5),
        Level("≤ 5 %", high=0.05),
        Level("≤ 2 %", high=0.02),
    ),
    Row(
        "parameter_p90",
        "Main parameter, SNR ≥ 2: relative error, 90th percentile",
        "percent",
        _errors(0.9),
        Level("≤ 15 %", high=0.15),
        Level("≤ 8 %", high=0.08),
    ),
    Row(
        "coverage",
        "95 % intervals that hold the truth",
        "percent",
        _intervals,
        Level("92 to 97.5 %", 0.92, 0.975),
        Level("94 to 96 %", 0.94, 0.96),
        400,
    ),
    Row(
        "coverage_same_law",
        "The same, where the concealed law has the catalogue's form",
        "percent",
        lambda js: _intervals(js, (True,)),
    ),
    Row(
        "gap_closed",
        "Gap to the oracle closed on unseen data, SNR ≥ 1, median",
        "percent",
        lambda js: measures.quantile(gaps(js)),
        Level("≥ 80 %", low=0.80),
        Level("≥ 92 %", low=0.92),
    ),
    Row(
        "gap_to_exact",
        "The same, to an oracle that knows the exact motion",
        "percent",
        lambda js: measures.quantile(exact_gaps(js)),
    ),
    Row(
        "loop_ratio",
        "Closed-loop position error, after over before, median",
        "number",
        lambda js: measures.quantile([j.loop_ratio for j in _of(js, ("T1", "T2", "T3"), 1.0)]),
    ),
    Row(
        "outside",
        "Physics outside the catalogue: unexplained",
        "percent",
        _share(("T4",), lambda j: j.right),
        Level("≥ 85 %", low=0.85),
        Level("≥ 95 %", low=0.95),
        150,
    ),
    Row(
        "weak",
        "Weak motion: class or insufficient",
        "percent",
        _share(("T5",), lambda j: j.right),
        Level("≥ 90 %", low=0.90),
        Level("≥ 97 %", low=0.97),
        150,
    ),
    Row("clean_none", "Clean records: nothing missing, and said so", "percent", _share(("T0",), lambda j: j.right)),
    Row("regime", "Rigs out of the ordinary: right", "percent", _share(("T7",), lambda j: j.right)),
    Row("brier", "Stated confidence of a name: Brier score", "number", _calibrated("brier")),
    Row("ece", "Stated confidence of a name: calibration error (ECE)", "percent", _calibrated("ece")),
    Row(
        "equivalent",
        "Names called equivalent to a right one, median",
        "count",
        lambda js: measures.quantile([f.n_equivalent for f in _found(js) if f.level != "missed"]),
    ),
    Row("no_answer", "Cases without an answer", "percent", lambda js: measures.share(js, unanswered)),
    Row("right", "Cases that are right in every respect", "percent", lambda js: measures.share(js, lambda j: j.right)),
    Row("seconds", "Seconds for a diagnosis, median", "seconds", lambda js: measures.quantile([j.seconds for j in js])),
)


def holds(level, measured, enough, by_bound):
    if level is None:
        return ""
    if measured is None:
        return NONE
    inside = lambda value: value is not None and level.low <= value <= level.high
    low, high = measured["low"], measured["high"]
    # the protocol's bounds are one-sided: the other end of the interval may lie anywhere
    one_sided = (level.low == 0.0 or (low is not None and low >= level.low)) and \
                (level.high == float("inf") or (high is not None and high <= level.high))
    if one_sided:
        return YES
    if measured["n"] >= enough:
        return YES if not by_bound and inside(measured["value"]) else NO
    beyond = (high is not None and high < level.low) or (low is not None and low > level.high)
    return NO if beyond else OPEN


def table(judgements):
    """[{key, words, form, value, low, high, n, hits, pass, pass_holds, stretch, stretch_holds}] in the order of
    ROWS."""
    rows = []
    for row in ROWS:
        measured = row.measure(judgements)
        facts = {"value": None, "low": None, "high": None, "n": 0, "hits": None, **(measured or {})}
        rows.append({"key": row.key, "words": row.words, "form": row.form, **facts})
        for name, level in (("pass", row.passes), ("stretch", row.stretch)):
            rows[-1].update(
                {name: level.text if level else "", f"{name}_holds": holds(level, measured, row.enough, row.by_bound)}
            )
    return rows
