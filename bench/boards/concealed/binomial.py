"""Exact binomial bounds (Clopper and Pearson 1934) without a library.

lower(k, n): largest rate that would give k or more of n with a chance of at most alpha (one-sided)
upper(k, n): smallest rate that would give k or fewer of n with a chance of at most alpha (one-sided)
"""
import math

BISECTIONS = 60


def at_most(k, n, rate):
    """P(X <= k) for X binomial(n, rate)."""
    if rate <= 0.0:
        return 1.0
    if rate >= 1.0:
        return 1.0 if k >= n else 0.0
    log_choose = [math.lgamma(n + 1) - math.lgamma(i + 1) - math.lgamma(n - i + 1) for i in range(k + 1)]
    return sum(math.exp(c + i * math.log(rate) + (n - i) * math.log1p(-rate)) for i, c in enumerate(log_choose))


def _bisect(is_low):
    low, high = 0.0, 1.0
    for _ in range(BISECTIONS):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if is_low(middle) else (low, middle)
    return 0.5 * (low + high)


def upper(k, n, alpha=0.05):
    return 1.0 if k >= n else _bisect(lambda rate: at_most(k, n, rate) > alpha)


def lower(k, n, alpha=0.05):
    return 0.0 if k <= 0 else _bisect(lambda rate: 1.0 - at_most(k - 1, n, rate) < alpha)
