"""Whether a position follows a command, by numbers: what a name promises is looked at before it counts.

A command leads: of all lags up to LONGEST_LAG the one with the smallest difference counts. A constant difference (the
sag of a joint under gravity) does not.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

LONGEST_LAG = 0.3    # s; a servo answers within a tenth
MOST_LAGS = 40
MOST_ROWS = 20000    # enough for a share of a few percent
FEWEST_ROWS = 30
FOLLOWS = 0.25       # of the position's variance; a loop a quarter of its motion's period late leaves twice all of it
SAME_ROWS = 0.99     # of the rows that are equal bit by bit; a held value may differ now and then


@dataclass(frozen=True)
class Following:
    share: float      # of the position's variance that the command leaves; NaN: too few rows, or a joint at rest
    lag_s: float
    is_copy: bool     # the numbers of the position once more

    @property
    def is_good(self):
        return not self.is_copy and self.share < FOLLOWS


def following(command, position, step_s, is_own=True):
    """How closely `position` [n] follows `command` [n], rows `step_s` apart; is_own: rows that are no value between
    two."""
    is_copy = is_shifted_copy(np.where(is_own, command, np.nan), position, 0)
    known = np.flatnonzero(np.isfinite(command) & np.isfinite(position))
    variance = np.var(position[known]) if len(known) >= FEWEST_ROWS else 0.0
    if not variance > 0:
        return Following(np.nan, np.nan, is_copy)
    rows = known[::max(1, len(known) // MOST_ROWS)]
    longest = min(round(LONGEST_LAG / step_s), len(position) // 10) if step_s > 0 else 0
    best, best_lag = np.inf, 0
    for lag in range(0, longest + 1, max(1, longest // MOST_LAGS)):
        later = rows[rows + lag < len(position)]
        left = np.nanvar(position[later + lag] - command[later]) / variance
        if left < best:
            best, best_lag = left, lag
    return Following(float(best), best_lag * step_s, is_copy)


def is_shifted_copy(command, position, shift):
    """Whether command[t] is position[t + shift], bit by bit, in nearly all rows where the position changes."""
    ahead = position[shift:]
    before = np.concatenate([[np.nan], ahead[:-1]])
    given = command[:len(ahead)]
    rows = np.isfinite(given) & np.isfinite(ahead) & (ahead != before)
    return bool(np.count_nonzero(rows) >= FEWEST_ROWS and np.mean(given[rows] == ahead[rows]) >= SAME_ROWS)
