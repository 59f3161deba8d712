"""Forward selection by a test, with Benjamini-Hochberg at every step: what the two testing rivals have in common.

Each candidate alone beside the model is tested; all q at or below the level are discoveries, and the one that explains
most of the residual goes into the model. Then what is left is tested again. Naming every discovery of the first step
instead would name all relatives of one effect; steps are the kinder reading. The first step is the plain procedure: on
a clean recording both name something or neither does.
"""

import numpy as np

from .columns import Answer, apart, model


def benjamini_hochberg(p):
    """-> q in the order of p: the smallest level at which each is rejected."""
    p = np.asarray(p, dtype=float)
    order = np.argsort(p, kind="stable")
    q = p[order] * len(p) / np.arange(1, len(p) + 1)
    q = np.minimum(np.minimum.accumulate(q[::-1])[::-1], 1.0)
    out = np.empty_like(q)
    out[order] = q
    return out


def explained(group, residual):
    """Energy of the residual in the span of columns that are orthogonal to the model already; columns they leave
    nothing of are dropped. -> (energy, orthonormal basis)"""
    u, s, _ = np.linalg.svd(group / np.maximum(np.linalg.norm(group, axis=0), 1e-300), full_matrices=False)
    u = u[:, s > 1e-6 * s[0]] if s.size and s[0] > 0.0 else u[:, :0]
    return float(np.sum((u.T @ residual) ** 2)), u


def forward(columns, p_value):
    """p_value(residual, group, candidate, n_model) -> p; group: the candidate's columns beside the model."""
    record, named, facts, ranking = columns.train, [], {}, []
    while len(named) < columns.max_effects:
        beside = model(record, named)
        residual = apart(record.torque, beside)
        rest = [c for c in columns.candidates if c.name not in named]
        if not rest:
            break
        p, gain = [], []
        for candidate in rest:
            raw = record.candidates[candidate.name]
            group = apart(raw, beside)
            # what the model explains to a millionth is no direction of its own
            keeps = np.linalg.norm(group, axis=0) > 1e-6 * np.linalg.norm(raw, axis=0)
            group = group[:, keeps]
            p.append(p_value(residual, group, candidate, beside.shape[1]) if keeps.any() else 1.0)
            gain.append(explained(group, residual)[0] if keeps.any() else 0.0)
        q = benjamini_hochberg(p + [1.0] * columns.n_not_testable)[: len(rest)]
        if not named:
            ranking = [rest[i].name for i in np.argsort(-np.asarray(gain), kind="stable")]
        found = [i for i in range(len(rest)) if q[i] <= columns.q]
        if not found:
            break
        best = max(found, key=lambda i: gain[i])
        named.append(rest[best].name)
        facts[rest[best].name] = {"p": float(p[best]), "q": float(q[best])}
    return Answer(named, facts, named + [name for name in ranking if name not in named])
