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
        kept.extend({begin, begin + _finite(np.argmin, piece, np.inf), begin + _finite(np.argmax, piece, -np.inf), end - 1})
    return first + np.unique(kept)


def min_max_pairs(columns_of_y, most):
    """Per row of `columns_of_y` [k][n] its lowest and highest value in each of most/2 buckets, in the order they came.

    Returns (indices [m] of the samples whose x stands for the points, values [k][m]); unchanged when n <= most.
    """
    values = np.atleast_2d(np.asarray(columns_of_y, dtype=float))
    n = values.shape[1]
    if n <= most:
        return np.arange(n), values
    edges = np.linspace(0, n, most // 2 + 1).astype(int)
    indices = np.column_stack([edges[:-1], (edges[:-1] + edges[1:]) // 2]).ravel()
    thinned = np.empty((len(values), len(indices)))
    for bucket, (begin, end) in enumerate(zip(edges[:-1], edges[1:])):
        piece = values[:, begin:end]
        low, high = piece.argmin(axis=1), piece.argmax(axis=1)
        pair = np.column_stack([np.minimum(low, high), np.maximum(low, high)])
        thinned[:, 2 * bucket:2 * bucket + 2] = np.take_along_axis(piece, pair, axis=1)
    return indices, thinned


def _finite(pick, values, instead_of_nan):
    return int(pick(np.where(np.isfinite(values), values, instead_of_nan)))
