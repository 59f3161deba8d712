"""Measured quantities with exact bounds: {"value", "low", "high", "n"}; rates also have "hits".

low and high are one-sided 95 % bounds each, so together a 90 % interval; None where so few cases bound nothing.

    rate       share of cases                      Clopper and Pearson 1934
    mean       mean of shares between 0 and 1      the same for their sum, rounded away from the middle: conservative,
                                                   since of all quantities between 0 and 1 with this mean yes-or-no
                                                   varies most
    quantile   of whatever distribution            order statistics (Conover 1999, section 3.2)
"""

import math
import statistics

import binomial

ALPHA = 0.05


def rate(hits, n):
    if n == 0:
        return None
    return {
        "value": hits / n,
        "low": binomial.lower(hits, n, ALPHA),
        "high": binomial.upper(hits, n, ALPHA),
        "n": n,
        "hits": hits,
    }


def share(items, test):
    items = list(items)
    return rate(sum(1 for item in items if test(item)), len(items))


def mean(values):
    values = [value for value in values if value is not None]
    if not values:
        return None
    n, total = len(values), sum(values)
    # sums of thirds are not exact: a hair above a whole number is that number
    return {"value": total / n, "low": binomial.lower(math.floor(total + 1e-9), n, ALPHA),
            "high": binomial.upper(math.ceil(total - 1e-9), n, ALPHA), "n": n}


def quantile(values, probability=0.5):
    values = sorted(value for value in values if value is not None)
    if not values:
        return None
    n = len(values)
    value = statistics.median(values) if probability == 0.5 else values[min(n - 1, int(probability * n))]
    # below[k]: chance that k or fewer of n lie below the true quantile
    below = [binomial.at_most(k, n, probability) for k in range(n)]
    low = max((k for k in range(n) if below[k] <= ALPHA), default=None)
    high = min((k for k in range(n) if 1.0 - below[k] <= ALPHA), default=None)
    return {
        "value": value,
        "low": None if low is None else values[low],
        "high": None if high is None else values[high],
        "n": n,
    }


def plain(value, n):
    """A number without bounds."""
    return None if value is None else {"value": value, "low": None, "high": None, "n": n}
