"""F-tests of the residual as if its noise were white and normal, Benjamini-Hochberg at the job's q.

Test      extra sum of squares, F(df, n - R - df); df counts the linear parameters and the shapes that were searched
Tuning    none: q and the largest number of names are the job's
Source    Bates, Watts: Nonlinear Regression Analysis (1988) section 3.5; Benjamini, Hochberg 1995
"""
from scipy import stats

from .stepwise import explained, forward


def p_value(residual, group, candidate, n_model):
    gain, _ = explained(group, residual)
    free = len(residual) - n_model - candidate.df
    left = float(residual @ residual) - gain
    return float(stats.f.sf(gain / candidate.df / (left / free), candidate.df, free))


def answer(columns):
    return forward(columns, p_value)
