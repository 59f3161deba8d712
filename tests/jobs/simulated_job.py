"""Texts of jobs on one simulated joint, for tests and benchmarks: what they have in common stands here, and only
here."""

import json

COMMON = {
    "experiment": {"name": "simulated", "seed": 7, "runs": 3},
    "filter": {"cutoff_hz": 20},
    "model": {"joint": "revolute", "terms": ["inertia", "viscous", "coulomb", "offset"]},
    "model.bounds": {"every": [-1, 1]},
    "simulate": {"mode": "inverse_dynamics", "rate_hz": 200, "duration_s": 1, "validate": False},
    "simulate.plant": {"inertia": 0.5, "viscous": 0.2, "coulomb": 0.1},
    "simulate.noise": {"torque_std": 0.02},
}


def section(header, settings):
    # JSON writes numbers, texts, lists, true and false as TOML does
    return header + "\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in settings.items())


def job(estimators=(), replaced=(), **changes):
    """`changes` by section ("__" for "."): settings that differ or come in addition; of sections in `replaced` these
    alone."""
    changes = {name.replace("__", "."): settings for name, settings in changes.items()}
    parts = [section(f"[{name}]", {**({} if name in replaced else COMMON.get(name, {})), **changes.get(name, {})})
             for name in [*COMMON, *(name for name in changes if name not in COMMON)]]
    parts += [section("[[estimator]]", settings) for settings in estimators]
    return "\n".join(parts)
