"""Wald tests with errors that allow for noise that repeats itself, Benjamini-Hochberg at the job's q.

Errors    Newey-West (Bartlett weights), lags by Andrews' rule with first-order autoregressions of the scores: the lags
          and the weights of the engine's own standard errors (engine/fit/problem/hac.hpp)
Test      W / df against F(df, n - R - df); df counts the linear parameters and the shapes that were searched
Tuning    none: q and the largest number of names are the job's, the bandwidth is Andrews'
Source    Newey, West 1987; Andrews 1991 eq. 6.2, 6.4; Benjamini, Hochberg 1995
"""

import numpy as np
from scipy import stats

from .stepwise import explained, forward

LARGEST_RHO = 0.97  # Andrews, Monahan 1992: beyond it the plug-in has no meaning


def andrews_lags(scores):
    """scores: [n][d], parts of the normal equations per row."""
    above = below = 0.0
    for s in scores.T:
        s = s - s.mean()
        power = float(s[:-1] @ s[:-1])
        if power == 0.0:
            continue
        rho = float(np.clip((s[1:] @ s[:-1]) / power, -LARGEST_RHO, LARGEST_RHO))
        variance = float(np.mean((s[1:] - rho * s[:-1]) ** 2))
        above += 4.0 * rho**2 * variance**2 / ((1.0 - rho) ** 6 * (1.0 + rho) ** 2)
        below += variance**2 / (1.0 - rho) ** 4
    if below == 0.0:
        return 0
    lags = int(np.ceil(1.1447 * (above / below * len(scores)) ** (1.0 / 3.0) - 1.0))
    return int(np.clip(lags, 0, len(scores) - 1))


def long_run_covariance(scores, lags):
    """Sum over rows of s s', Bartlett weights on the lags."""
    total = scores.T @ scores
    for lag in range(1, lags + 1):
        part = scores[lag:].T @ scores[:-lag]
        total += (1.0 - lag / (lags + 1.0)) * (part + part.T)
    return total


def p_value(residual, group, candidate, n_model):
    _, basis = explained(group, residual)
    rank = basis.shape[1]
    free = len(residual) - n_model - candidate.df
    estimate = basis.T @ residual  # of an orthonormal basis: bread is the identity
    scores = basis * (residual - basis @ estimate)[:, None]
    covariance = long_run_covariance(scores, andrews_lags(scores)) * len(residual) / (len(residual) - n_model - rank)
    wald = float(estimate @ np.linalg.solve(covariance, estimate))
    return float(stats.f.sf(wald / candidate.df, candidate.df, free))


def answer(columns):
    return forward(columns, p_value)
