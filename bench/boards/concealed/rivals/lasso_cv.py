"""LASSO over the columns of all candidates at once, its penalty chosen by cross-validation over blocks of time.

Columns   less what the baseline explains (it is not penalised), scaled to one length
Folds     ten contiguous blocks with guard bands as wide as the filter reaches
Penalty   the largest whose error is within one standard error of the least: the sparser of the two usual rules (the
          penalty of least error names more); no hand-picked number
Names     effects with a coefficient that is not zero, by the energy of their torque; at most as many as the job allows
Source    Tibshirani 1996; Hastie, Tibshirani, Friedman: Elements (2009) section 7.10 (one standard error); scikit-learn
          LassoCV
"""

import warnings

import numpy as np

from .columns import Answer, apart, blocks

NEEDS = "sklearn", "python3-sklearn"


def scaled_columns(columns):
    """-> (matrix of unit columns, owner's index per column), without what the baseline explains."""
    parts, owners = [], []
    for i, candidate in enumerate(columns.candidates):
        raw = columns.train.candidates[candidate.name]
        group = apart(raw, columns.train.regressor)
        for k in range(group.shape[1]):
            size = np.linalg.norm(group[:, k])
            if size > 1e-6 * np.linalg.norm(raw[:, k]):
                parts.append(group[:, k] / size)
                owners.append(i)
    return np.array(parts).T.reshape(len(columns.train), len(parts)), np.array(owners, dtype=int)


def one_standard_error(alphas, paths):
    """alphas: from large to small; paths: [penalty][fold] of mean squared errors."""
    mean, error = paths.mean(axis=1), paths.std(axis=1, ddof=1) / np.sqrt(paths.shape[1])
    least = int(np.argmin(mean))
    return alphas[int(np.flatnonzero(mean <= mean[least] + error[least])[0])]


def by_energy(columns, matrix, owners, coefficients):
    """-> names whose coefficients are not all zero, largest torque first."""
    energy = {}
    for i in np.unique(owners[coefficients != 0.0]):
        mine = owners == i
        energy[columns.candidates[i].name] = float(np.sum((matrix[:, mine] @ coefficients[mine]) ** 2))
    return sorted(energy, key=energy.get, reverse=True)


def answer(columns):
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.linear_model import Lasso, LassoCV

    matrix, owners = scaled_columns(columns)
    if matrix.shape[1] == 0:
        return Answer([])
    n = len(columns.train)
    matrix = matrix * np.sqrt(n)  # columns of unit mean square
    target = apart(columns.train.torque, columns.train.regressor)
    target = target / np.sqrt(np.mean(target**2))
    folds = [fold for fold in blocks(columns.train) if len(fold[0]) > n // 2]
    options = {"fit_intercept": False, "max_iter": 5000, "tol": 1e-4}
    with warnings.catch_warnings():
        # relatives are nearly collinear: small penalties, which are not chosen, need more sweeps
        warnings.simplefilter("ignore", ConvergenceWarning)
        search = LassoCV(eps=1e-3, n_alphas=60, cv=folds, precompute=True, **options).fit(matrix, target)
        alpha = one_standard_error(search.alphas_, search.mse_path_)
        chosen = Lasso(alpha=alpha, precompute=True, **options).fit(matrix, target)
    # at the largest penalty all are zero, but for rounding
    coefficients = chosen.coef_ if alpha < search.alphas_[0] else np.zeros(len(owners))
    names = by_energy(columns, matrix, owners, coefficients)
    return Answer(
        names[: columns.max_effects],
        {},
        names,
        f"penalty {alpha / search.alphas_[0]:.3g} of the smallest that names nothing; {len(names)} effects not zero",
    )
