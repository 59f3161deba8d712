"""Friction models from simple to rich, the one with the least error on the unseen recording: the way of BAM.

Models    Coulomb-viscous; Stribeck; load dependent; Stribeck and load dependent; the same with directional efficiency;
          the same with quadratic drag: M1 to M6 of BAM in the catalogue's words. A model whose effect explains nothing
          in training (not in the columns) is left out
Choice    mean absolute error on the unseen recording, as BAM; the simplest model that the best does not beat by two
          standard errors (ten blocks of the difference: what the engine asks of its own effects), else a clean joint
          would nearly always be given a rich one. Without an unseen recording, the last fifth of the training recording
          stands in and the rest is fitted
Can say   friction, nothing else: what is not friction it calls none, or friction
Source    Duclusaud, Passault, Padois, Ly 2024: extended friction models for the physics simulation of servo actuators
          (BAM)
"""

import numpy as np

from .columns import Answer, Record, model, solve

MODELS = ((), ("stribeck",), ("load_dependent_friction",), ("stribeck", "load_dependent_friction"),
          ("stribeck", "load_dependent_friction", "directional_efficiency"),
          ("stribeck", "load_dependent_friction", "directional_efficiency", "speed_drag"))
BLOCKS = 10
BEATEN_BY = 2.0  # standard errors


def part(record, rows):
    return Record(record.torque[rows], record.regressor[rows], {k: v[rows] for k, v in record.candidates.items()},
                  record.rate_hz, record.cutoff_hz, record.at[rows])


def split(columns):
    """-> (record to fit, records to compare on)"""
    if columns.validation:
        return columns.train, columns.validation
    at = columns.train.at
    border = 4 * len(columns.train) // 5
    fitted = np.flatnonzero(at < at[border] - columns.train.guard)
    return part(columns.train, fitted), [part(columns.train, np.arange(border, len(columns.train)))]


def absolute_errors(fitted, compared, names):
    parameters = solve(model(fitted, names), fitted.torque)
    return np.concatenate([np.abs(r.torque - model(r, names) @ parameters) for r in compared])


def choose(errors):
    """errors: [model][row], simple models first -> index."""
    best = int(np.argmin(errors.mean(axis=1)))
    for index in range(best):
        worse = np.array([block.mean() for block in np.array_split(errors[index] - errors[best], BLOCKS)])
        if worse.mean() <= BEATEN_BY * worse.std(ddof=1) / np.sqrt(BLOCKS):
            return index
    return best


def answer(columns):
    known = {candidate.name for candidate in columns.candidates}
    models = [names for names in MODELS if set(names) <= known]
    fitted, compared = split(columns)
    errors = np.array([absolute_errors(fitted, compared, names) for names in models])
    chosen = models[choose(errors)]
    gains = {}
    for name in chosen:
        without = [other for other in chosen if other != name]
        gains[name] = float(np.mean(absolute_errors(fitted, compared, without)))
    names = sorted(chosen, key=gains.get, reverse=True)
    return Answer(names, {}, names, f"{len(models)} models; mean absolute error {errors[0].mean():.4g} to "
                                    f"{errors[models.index(chosen)].mean():.4g}")
