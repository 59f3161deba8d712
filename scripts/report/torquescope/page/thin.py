"""Thinning that keeps every spike: what is drawn from the thinned samples is the picture of all samples.

M4 keeps the first, lowest, highest and last sample of each pixel column; a line through these covers the same pixels as
a line through all samples. (LTTB looks prettier and drops extremes; the extremes at reversals are the point here.)

Source     Jugel, Jerzak, Hackenbroich, Markl: M4, VLDB 2014
"""

import numpy as np


def m4(x, y, columns, start=None, stop=None):
    """Indices of the samples to draw, ascending. x ascending; `columns` pixel columns over [start, stop]."""
    x = np.asarray(x)
    y = np.asarray(y)
    start = x[0] if start is None else start
    stop = x[-1] if stop is None else stop
    # one sample beyond either edge, so that the line runs on to the frame
    first = max(int(np.searchsorted(x, start, "left")) - 1, 0)
    last = min(int(np.searchsorted(x, stop, "right")) + 1, len(x))
    if last - first <= 4 * columns or stop <= start:
        return np.arange(first, last)
    column = np.clip(np.floor((x[first:last] - start) / (stop - start) * columns), -1, columns).astype(int)
    begins = np.flatnonzero(np.diff(column, prepend=column[0] - 1))
    ends = np.append(begins[1:], len(column))
    kept = []
    for begin, end in zip(begins, ends):
        piece = y[first + begin:first + end]
        kept.extend(
            {begin, begin + _finite(np.argmin, piece, np.inf), begin + _finite(np.argmax, piece, -np.inf), end - 1}
        )
    return first + np.unique(kept)


def min_max_pairs(y, most):
    """Indices of the lowest and the highest sample in each of most/2 buckets, ascending; all of them when n <= most.

    Whole samples, so that other signals taken at the same indices keep their differences from this one.
    """
    y = np.asarray(y, dtype=float)
    if len(y) <= most:
        return np.arange(len(y))
    edges = np.linspace(0, len(y), most // 2 + 1).astype(int)
    kept = [begin + _finite(pick, y[begin:end], instead) for begin, end in zip(edges[:-1], edges[1:])
            for pick, instead in ((np.argmin, np.inf), (np.argmax, -np.inf))]
    return np.unique(kept)


def _finite(pick, values, instead_of_nan):
    return int(pick(np.where(np.isfinite(values), values, instead_of_nan)))
