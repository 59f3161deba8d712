"""Sequentially thresholded least squares on bootstrapped rows: the way of PySINDy's ensembles.

Fit       ridge 0.05 (PySINDy's default) on columns of unit mean square, without what the baseline explains; columns
          below the threshold go, the rest is fitted again, until none goes
Threshold in units of the residual's rms: the largest of a grid whose error on ten blocked folds is within one standard
          error of the least, as for LASSO; PySINDy leaves it to its user
Ensemble  20 fits (PySINDy's default) on rows drawn with replacement; an effect is named when one of its columns is in
          more than 60 % of them (the published inclusion), strongest median torque first, at most as many as the job
          allows
Random    numbers of one fixed seed: the same answer every time
Source    Brunton, Proctor, Kutz 2016; Fasel, Kutz, Brunton, Brunton 2022 (E-SINDy); PySINDy 1.7 STLSQ,
          EnsembleOptimizer
"""

import numpy as np

from .columns import Answer, apart, blocks
from .lasso_cv import by_energy, one_standard_error, scaled_columns

RIDGE = 0.05
MODELS = 20
INCLUSION = 0.6
THRESHOLDS = np.geomspace(1.0, 0.01, 15)  # large to small, of the residual's rms


def thresholded(gram, moment, threshold):
    """gram: [k][k], moment: [k], both means over rows."""
    kept = np.ones(len(moment), dtype=bool)
    coefficients = np.zeros(len(moment))
    while kept.any():
        coefficients = np.zeros(len(moment))
        inside = np.ix_(kept, kept)
        coefficients[kept] = np.linalg.solve(gram[inside] + RIDGE * np.eye(kept.sum()), moment[kept])
        next_kept = np.abs(coefficients) >= threshold
        if (next_kept == kept).all():
            return coefficients
        kept = next_kept
    return np.zeros(len(moment))


def moments(matrix, target, weights=None):
    weighted = matrix if weights is None else matrix * weights[:, None]
    total = len(matrix) if weights is None else weights.sum()
    return weighted.T @ matrix / total, weighted.T @ target / total


def chosen_threshold(record, matrix, target):
    errors = []
    for train, test in blocks(record):
        gram, moment = moments(matrix[train], target[train])
        errors.append([float(np.mean((target[test] - matrix[test] @ thresholded(gram, moment, t)) ** 2))
                       for t in THRESHOLDS])
    return one_standard_error(THRESHOLDS, np.array(errors).T)


def answer(columns):
    matrix, owners = scaled_columns(columns)
    if matrix.shape[1] == 0:
        return Answer([])
    n = len(columns.train)
    matrix = matrix * np.sqrt(n)
    target = apart(columns.train.torque, columns.train.regressor)
    target = target / np.sqrt(np.mean(target**2))
    threshold = chosen_threshold(columns.train, matrix, target)
    random = np.random.default_rng(20160412)
    fits = np.array([thresholded(*moments(matrix, target, random.multinomial(n, np.full(n, 1.0 / n)).astype(float)),
                                 threshold) for _ in range(MODELS)])
    inclusion = (fits != 0.0).mean(axis=0)
    median = np.where(inclusion > INCLUSION, np.median(fits, axis=0), 0.0)
    names = by_energy(columns, matrix, owners, median)
    share = {c.name: float(inclusion[owners == i].max(initial=0.0)) for i, c in enumerate(columns.candidates)}
    return Answer(
        names[: columns.max_effects],
        {name: {"inclusion": share[name]} for name in names[: columns.max_effects]},
        names,
        f"threshold {threshold:.3g} of the residual's rms",
    )
