"""Is a stated confidence kept? Pairs (stated chance of being right, was right) -> reliability, Brier score, ECE.

The confidence of a name is one minus the false discovery rate it was named at (verdict_record.confidence_of); a name is
right when it answers something concealed at family level or better. Verdicts without names state no confidence.

    Brier   mean of (stated - right)^2; 0 is perfect                       Brier 1950
    ECE     mean over names of |stated - share right| of their bin         Naeini, Cooper, Hauskrecht 2015
"""
import binomial

# names are made at a small false discovery rate: nearly all of the scale that is used lies at its upper end
EDGES = (0.0, 0.5, 0.8, 0.9, 0.95, 0.99, 0.999, 1.0)


def reliability(pairs):
    """[{from, to, n, stated, right, low, high}] of the bins that hold names; low and high: two-sided 95 %."""
    bins = []
    for low, high in zip(EDGES, EDGES[1:]):
        here = [(c, r) for c, r in pairs if low <= c < high or (high == 1.0 and c == 1.0)]
        if here:
            hits, n = sum(r for _, r in here), len(here)
            bins.append({"from": low, "to": high, "n": n, "stated": sum(c for c, _ in here) / n, "right": hits / n,
                         "low": binomial.lower(hits, n, 0.025), "high": binomial.upper(hits, n, 0.025)})
    return bins


def calibration(pairs):
    """-> {n, brier, ece, bins}; brier and ece None without pairs."""
    pairs = [(float(c), bool(r)) for c, r in pairs if c is not None]
    if not pairs:
        return {"n": 0, "brier": None, "ece": None, "bins": []}
    bins, n = reliability(pairs), len(pairs)
    return {"n": n, "brier": sum((c - r) ** 2 for c, r in pairs) / n,
            "ece": sum(b["n"] * abs(b["stated"] - b["right"]) for b in bins) / n, "bins": bins}
