#!/usr/bin/python3
"""Result files for the tests of the page: made with numpy, laid out as engine/store/RESULT_FORMAT.md says.

    make_result.py KIND OUT.h5      KIND is one of the functions in KINDS

The searches are real (a small DE and a fuzzy DE on the same least-squares problem), so are the errors of the least
squares: the pictures look as they will with the engine's own files.
"""

import hashlib
import sys

import h5py
import numpy as np

SEED_OLS = np.array([0.0036, 0.0164, 0.0089, -0.2582])
NAMES = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]
REVOLUTE = {"position": "rad", "velocity": "rad/s", "acceleration": "rad/s2", "torque": "N m",
            "parameters": ["kg m2", "N m s/rad", "N m", "N m"]}
PRISMATIC = {"position": "m", "velocity": "m/s", "acceleration": "m/s2", "torque": "N",
             "parameters": ["kg", "N s/m", "N", "N"]}
RUNS, GENERATIONS, MEMBERS = 30, 100, 30


# ---- recordings

def motion(duration_s, rate_hz, seed, amplitude=1.0):
    """Position, velocity, acceleration [n] of a sum of sines with reversals; time [n] in s."""
    random = np.random.default_rng(seed)
    time = np.arange(int(duration_s * rate_hz)) / rate_hz
    position = velocity = acceleration = 0.0
    for harmonic in range(1, 7):
        omega = 2 * np.pi * 0.11 * harmonic
        size, phase = amplitude * random.normal() / harmonic, random.uniform(0, 2 * np.pi)
        position = position + size * np.sin(omega * time + phase)
        velocity = velocity + size * omega * np.cos(omega * time + phase)
        acceleration = acceleration - size * omega**2 * np.sin(omega * time + phase)
    return time, position, velocity, acceleration


def columns(velocity, acceleration):
    return np.column_stack([acceleration, velocity, velocity > 0, velocity < 0]).astype(float)


def coloured_noise(n, deviation, memory, seed):
    white = np.random.default_rng(seed).normal(size=n)
    noise = np.empty(n)
    last = 0.0
    for i, value in enumerate(white):
        last = memory * last + value
        noise[i] = last
    return noise * deviation / noise.std()


# ---- estimators

def least_squares(phi, torque, weights=None):
    """Estimate, HAC and naive standard errors."""
    w = np.ones(len(torque)) if weights is None else weights
    inverse = np.linalg.inv(phi.T @ (w[:, None] * phi))
    estimate = inverse @ phi.T @ (w * torque)
    score = phi * (w * (torque - phi @ estimate))[:, None]
    meat = score.T @ score
    lags = int(4 * (len(torque) / 100) ** (2 / 9)) + 8
    for lag in range(1, lags + 1):
        cross = score[lag:].T @ score[:-lag]
        meat += (1 - lag / (lags + 1)) * (cross + cross.T)
    hac = np.sqrt(np.diag(inverse @ meat @ inverse))
    variance = np.sum(w * (torque - phi @ estimate) ** 2) / (len(torque) - phi.shape[1])
    return estimate, hac, np.sqrt(variance * np.diag(inverse))


def huber_weights(phi, torque):
    weights = np.ones(len(torque))
    for _ in range(20):
        residual = torque - phi @ least_squares(phi, torque, weights)[0]
        scale = 1.345 * np.median(np.abs(residual)) / 0.6745
        weights = np.minimum(1, scale / np.maximum(np.abs(residual), 1e-30))
    return weights


MEMBERSHIP = {  # sigma, means of small, middle, big; universe
    "d11": (0.25, (0.05, 0.5, 0.9), 1), "d12": (0.35, (0.1, 0.5, 0.9), 1), "d21": (0.5, (0.1, 0.8, 1.5), 2),
    "d22": (0.5, (0.1, 0.8, 1.5), 2), "F": (0.5, (0.3, 0.6, 0.9), 2), "CR": (0.35, (0.4, 0.7, 1.0), 1)}


def membership(name, x):
    sigma, means, _ = MEMBERSHIP[name]
    return np.exp(-((np.asarray(x)[..., None] - np.array(means)) ** 2) / (2 * sigma**2))


def fuzzy_output(output, first_name, first, second_name, second):
    """Mamdani, min and max, centroid; every rule says: output level = the higher of the two input levels."""
    a, b = membership(first_name, first), membership(second_name, second)
    strength = []
    for level in range(3):
        low_a, low_b = a[..., :level + 1].max(-1), b[..., :level + 1].max(-1)
        strength.append(np.maximum(np.minimum(a[..., level], low_b), np.minimum(low_a, b[..., level])))
    universe = np.linspace(0, MEMBERSHIP[output][2], 401)
    curves = membership(output, universe)
    clipped = np.max([np.minimum(curves[:, level], strength[level][..., None]) for level in range(3)], axis=0)
    return (clipped * universe).sum(-1) / clipped.sum(-1)


def squash(change):
    return 1 - (1 + change) * np.exp(-change)


def search(matrix, optimum, floor, lower, upper, fuzzy, seed):
    """RUNS runs of DE/rand/1/bin on floor + (x - optimum)' matrix (x - optimum); with `fuzzy` F and CR adapt.

    All histories [run][G+1]...; target stops some runs early so that NaN tails occur.
    """
    random = np.random.default_rng(seed)
    dimension = len(optimum)

    def gap_of(x):
        return np.einsum("...i,ij,...j->...", x - optimum, matrix, x - optimum)

    history = {"population": np.full((RUNS, GENERATIONS + 1, MEMBERS, dimension), np.nan)}
    for key in ("F", "CR", "PC", "FC", "best", "gap_history"):
        history[key] = np.full((RUNS, GENERATIONS + 1), np.nan)
    history["fitness"] = np.full((RUNS, GENERATIONS + 1, MEMBERS), np.nan)
    history["F_path"] = np.full((RUNS, GENERATIONS + 1, 2), np.nan)
    history["CR_path"] = np.full((RUNS, GENERATIONS + 1, 2), np.nan)
    x = lower + random.random((RUNS, MEMBERS, dimension)) * (upper - lower)
    gap = gap_of(x)
    F, CR = np.full(RUNS, 0.5), np.full(RUNS, 0.9)
    PC = FC = None
    for generation in range(GENERATIONS + 1):
        if generation:
            if fuzzy and PC is not None:
                first, second = squash(PC), squash(FC)
                F = fuzzy_output("F", "d11", first, "d12", second)
                CR = fuzzy_output("CR", "d21", 2 * first, "d22", 2 * second)
                history["F_path"][:, generation] = np.column_stack([first, second])
                history["CR_path"][:, generation] = np.column_stack([2 * first, 2 * second])
            picks = np.argsort(random.random((RUNS, MEMBERS, MEMBERS)) + 9 * np.eye(MEMBERS), axis=2)[:, :, :3]
            row = np.arange(RUNS)[:, None]
            mutant = x[row, picks[:, :, 0]] + F[:, None, None] * (x[row, picks[:, :, 1]] - x[row, picks[:, :, 2]])
            cross = random.random(x.shape) < CR[:, None, None]
            cross |= np.arange(dimension) == random.integers(dimension, size=(RUNS, MEMBERS, 1))
            trial = np.where(cross, mutant, x)
            trial = np.where(trial < lower, (x + lower) / 2, np.where(trial > upper, (x + upper) / 2, trial))
            trial_gap = gap_of(trial)
            better = trial_gap <= gap
            new_x, new_gap = np.where(better[..., None], trial, x), np.where(better, trial_gap, gap)
            PC = np.sqrt(((new_x - x) ** 2).sum((1, 2)) / MEMBERS)
            FC = np.sqrt(((new_gap - gap) ** 2).mean(1))
            x, gap = new_x, new_gap
            for key, value in (("F", F), ("CR", CR), ("PC", PC), ("FC", FC)):
                history[key][:, generation] = value
        history["population"][:, generation] = x
        history["fitness"][:, generation] = floor + gap
        history["gap_history"][:, generation] = gap.min(1)
        history["best"][:, generation] = floor + gap.min(1)
    best = gap.argmin(1)
    history["parameters"] = x[np.arange(RUNS), best]
    return history


# ---- the file

def put(group, name, value, unit="1", long_name=None):
    value = [value] if isinstance(value, str) else value
    is_text = not isinstance(value, np.ndarray) and isinstance(value[0], str)
    data = group.create_dataset(name, data=np.array(value, dtype=h5py.string_dtype()) if is_text else np.asarray(value))
    data.attrs["unit"] = unit
    data.attrs["long_name"] = long_name or name.replace("_", " ")
    return data


def texts(group, key, values):
    group.attrs.create(key, np.array(values, dtype=object), dtype=h5py.string_dtype())


def texts_of_fixed_length(file):
    """As results have them: h5py's own kind is refused by every reader."""

    def change(_, node):
        for key, value in list(node.attrs.items()):
            if isinstance(value, str):
                node.attrs[key] = np.bytes_(value.encode())
            elif getattr(value, "dtype", None) == object:
                node.attrs[key] = np.array([text.encode() for text in value])
        for key in list(node) if isinstance(node, h5py.Group) else ():
            child = node[key]
            if isinstance(child, h5py.Dataset) and h5py.check_string_dtype(child.dtype):
                words, kept = child.asstr()[()], dict(child.attrs)
                del node[key]
                node.create_dataset(key, data=np.array([word.encode() for word in words])).attrs.update(kept)

    change("/", file)
    groups = []
    file.visititems(lambda name, node: groups.append((name, node)) if isinstance(node, h5py.Group) else None)
    for name, node in groups:
        change(name, node)
    file.visititems(lambda name, node: change(name, node) if isinstance(node, h5py.Dataset) else None)


def write_data(group, parts, units, rate_hz, simulated, warnings):
    """parts: [(name, time, position, velocity, acceleration, torque)], one per recording."""
    texts(group, "recordings", [part[0] for part in parts])
    texts(group, "sha256", [hashlib.sha256(part[0].encode()).hexdigest() for part in parts])
    velocity = np.concatenate([part[3] for part in parts])
    rows = len(velocity)
    group.attrs.update({"rate_hz": rate_hz, "kept_rate_hz": rate_hz, "duration_s": rows / rate_hz, "cutoff_hz": 20.0,
                        "order": 4, "parallel_cutoff_hz": 16.0, "simulated": int(simulated),
                        "reversals": int((np.diff(np.sign(velocity)) != 0).sum())})
    put(group, "recording", np.repeat(np.arange(len(parts)), [len(part[1]) for part in parts]))
    put(group, "time", np.concatenate([part[1] for part in parts]), "s")
    for index, key in enumerate(("position", "velocity", "acceleration", "torque"), start=2):
        put(group, key, np.concatenate([part[index] for part in parts]), units[key])
    put(group, "regressor", columns(velocity, group["acceleration"][()]), "1", "Phi after the parallel filter")
    if warnings:
        put(group, "warnings", warnings)


def write_estimator(runs, name, kind, title, result, sets, floor, options):
    group = runs.create_group(name)
    parameters = np.atleast_2d(result["parameters"])
    train, validate = sets
    phi, torque = train["regressor"][()], train["torque"][()]
    residual = torque - parameters @ phi.T
    mse = (residual**2).mean(1)
    gap = result["gap_history"][:, -1] if "gap_history" in result else mse - floor
    relerr = np.sqrt((residual**2).sum(1) / (torque**2).sum())
    if validate is None:
        validation = np.full(len(parameters), np.nan)
    else:
        recorded = validate["torque"][()]
        validation = np.sqrt(((recorded - parameters @ validate["regressor"][()].T) ** 2).sum(1) / (recorded**2).sum())
    evaluations = MEMBERS * (GENERATIONS + 1) * len(parameters) if "population" in result else 0
    group.attrs.update({
        "kind": kind, "title": title, "runs": len(parameters), **options, "mse_median": np.median(mse),
        "mse_best": mse.min(), "mse_worst": mse.max(), "gap_median": np.median(gap), "relerr_median": np.median(relerr),
        "validation_relerr_median": np.median(validation), "residual_std_median": np.median(residual.std(1)),
        "mse_std": mse.std(), "median_run": int(np.argsort(mse, kind="stable")[(len(mse) - 1) // 2]),
        "evaluations_total": evaluations, "parameters_mean": parameters.mean(0)})
    for key, value in (
        ("parameters", parameters),
        ("mse", mse),
        ("gap", gap),
        ("relerr", relerr),
        ("sse", mse * len(torque)),
        ("validation_relerr", validation),
        ("residual_std", residual.std(1)),
        ("residual_mean", residual.mean(1)),
    ):
        put(group, key, value)
    put(group, "stop_reason", result["stop_reason"])
    for key in ("standard_error", "standard_error_naive"):
        if key in result:
            put(group, key, np.atleast_2d(result[key]))
    if "standard_error" in result:
        wide = 1.959964 * np.atleast_2d(result["standard_error"])
        put(group, "ci95", np.stack([parameters - wide, parameters + wide], axis=-1))
        form = np.array(
            [parameters[0, 1], (parameters[0, 2] - parameters[0, 3]) / 2, (parameters[0, 2] + parameters[0, 3]) / 2]
        )
        put(group, "joint_form", form[None])
        put(group, "joint_form_standard_error", np.atleast_2d(result["standard_error"])[:, 1:])
    if "population" in result:
        for key in ("population", "fitness", "F", "CR", "PC", "FC", "best", "gap_history"):
            put(group, key, result[key])
        group["fitness"].attrs["fitness_scale"] = "mse"
        put(group, "evaluations", np.tile(MEMBERS * (np.arange(GENERATIONS + 1) + 1), (len(parameters), 1)))
    if "F_path" in result and np.isfinite(result["F_path"]).any():
        write_controller(group.create_group("controller"), result)


def write_controller(group, result):
    for name, (_, _, end) in MEMBERSHIP.items():
        universe = np.linspace(0, end, 101)
        put(group, f"{name}_universe", universe)
        put(group, f"{name}_membership", membership(name, universe).T)
    for output, inputs, end in (("F", ("d11", "d12"), 1.0), ("CR", ("d21", "d22"), 2.0)):
        axis = np.linspace(0, end, 33)
        put(group, f"{output}_first", axis)
        put(group, f"{output}_second", axis)
        put(group, f"{output}_surface",
            np.array([fuzzy_output(output, inputs[0], np.full(33, a), inputs[1], axis) for a in axis]))
        put(group, f"{output}_path", result[f"{output}_path"])
        texts(group, f"{output}_inputs", inputs)


def write(path, *, name, job_text, units, joint, truth, train, validate, rate_hz, warnings, health_words, estimators,
          study=None):
    """estimators: [(name, kind, title)]; returns nothing, writes the file."""
    with h5py.File(path, "w") as file:
        file.attrs.update({"format": 2, "complete": 1, "creator": "torquescope 0.1.0",
                           "content_sha256": hashlib.sha256(name.encode()).hexdigest()})
        job = file.create_group("job")
        job.attrs.update(
            {"name": name, "seed": 42, "runs": RUNS, "sha256": hashlib.sha256(job_text.encode()).hexdigest()}
        )
        if study:
            job.attrs["study"] = study
        put(job, "text", job_text)
        file.create_group("provenance").attrs.update({
            "started": "2026-11-21T09:12:04Z", "finished": "2026-11-21T09:12:08Z", "seconds": 4.2, "host": "node17",
            "threads": 16, "threads_reason": "SLURM_CPUS_PER_TASK", "vector_target": "AVX2+FMA", "version": "0.1.0",
            "compiler": "GCC 12.2.0", "build_type": "Release", "hdf5_version": "1.10.8", "eigen_version": "3.4.0"})
        model = file.create_group("model")
        effort = "F" if joint == "prismatic" else "tau"
        model.attrs.update(
            {
                "joint": joint,
                "equation": f"{effort} = inertia ddq + viscous dq + coulomb_positive [dq > 0] "
                "+ coulomb_negative [dq < 0]",
            }
        )
        put(model, "names", NAMES)
        put(model, "units", units["parameters"])
        put(model, "truth", truth)
        put(model, "joint_form_names", ["viscous", "coulomb", "offset"])
        put(model, "joint_form_units", [units["parameters"][1], units["torque"], units["torque"]])
        write_data(file.create_group("data/train"), train, units, rate_hz, np.isfinite(truth).all(), warnings)
        if validate:
            write_data(file.create_group("data/validate"), validate, units, rate_hz, np.isfinite(truth).all(), [])
        sets = file["data/train"], file.get("data/validate")
        phi, torque = sets[0]["regressor"][()], sets[0]["torque"][()]
        normed = phi / np.linalg.norm(phi, axis=0)
        health = file.create_group("data/regressor_health")
        health.attrs.update({"condition_number": np.linalg.cond(normed), "words": health_words})
        put(health, "correlation", normed.T @ normed)

        ols, hac, naive = least_squares(phi, torque)
        floor = ((torque - phi @ ols) ** 2).mean()
        lower, upper = -1.0 - 2 * np.abs(ols), 1.0 + 2 * np.abs(ols)
        put(model, "lower", lower)
        put(model, "upper", upper)
        runs = file.create_group("runs")
        texts(runs, "order", [estimator[0] for estimator in estimators])
        for seed, (label, kind, title) in enumerate(estimators):
            options = {}
            if kind in ("ols", "wls", "irls"):
                weights = {"ols": None, "wls": 1 / (0.5 + phi[:, 1] ** 2), "irls": None}[kind]
                weights = huber_weights(phi, torque) if kind == "irls" else weights
                found = (ols, hac, naive) if kind == "ols" else least_squares(phi, torque, weights)
                result = dict(zip(("parameters", "standard_error", "standard_error_naive"), found),
                              stop_reason=["closed form" if kind != "irls" else "weights settled"])
            else:
                result = search(phi.T @ phi / len(torque), ols, floor, lower, upper, kind == "fade", 100 + seed)
                result["stop_reason"] = ["generations"] * RUNS
                options = {
                    "population": MEMBERS,
                    "generations": GENERATIONS,
                    "mutation": "rand/1",
                    "crossover": "binomial",
                }
            write_estimator(runs, label, kind, title, result, sets, floor, options)
        texts_of_fixed_length(file)


CRS_JOB = """# The single joint of the seed: ordinary least squares, DE and FADE, 30 runs each
[experiment]
name = "crs_a465_joint"
seed = 42
runs = 30

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]

[[estimator]]
name = "ols"
[[estimator]]
name = "de"
[[estimator]]
name = "fade"
"""


def crs(path, validate=True, estimators=(("ols", "ols", "OLS"), ("de", "de", "DE"), ("fade", "fade", "FADE"))):
    """The seed's joint: noise projected off the regressor, so that OLS is its Table 3 row and the MSE its Table 4."""
    def part(name, duration_s, seed, exact):
        time, position, velocity, acceleration = motion(duration_s, 200, seed, 1.2)
        phi = columns(velocity, acceleration)
        noise = coloured_noise(len(time), 1.0, 0.55, seed + 1)
        if exact:
            noise -= phi @ np.linalg.lstsq(phi, noise, rcond=None)[0]
        noise *= np.sqrt(0.09259 / (noise**2).mean())
        return name, time, position, velocity, acceleration, phi @ SEED_OLS + noise

    write(
        path,
        name="crs_a465_joint",
        job_text=CRS_JOB,
        units=REVOLUTE,
        joint="revolute",
        truth=SEED_OLS,
        train=[part("simulated", 10, 3, True)],
        validate=[part("simulated, validation", 10, 11, False)] if validate else None,
        rate_hz=200.0,
        warnings=["separable: coulomb_positive and the offset in it cannot be told apart by this model"],
        health_words="",
        estimators=estimators,
        study="crs_a465",
    )


def prismatic(path):
    """A real-looking slide: only OLS, no validation recording, two recordings, warnings."""
    truth = np.array([95.1, 203.5, 20.4 + 3.1, -20.4 + 3.1])
    parts = []
    for number, seed in enumerate((5, 6)):
        time, position, velocity, acceleration = motion(12.5, 100, seed, 0.08)
        stribeck = 6 * np.sign(velocity) * np.exp(-np.abs(velocity) / 0.01)
        force = columns(velocity, acceleration) @ truth + stribeck + coloured_noise(len(time), 1.5, 0.8, seed)
        parts.append((f"slide_{number + 1}.csv", time, position, velocity, acceleration, force))
    write(path, name="slide", job_text="[experiment]\nname = \"slide\"\n", units=PRISMATIC, joint="prismatic",
          truth=np.full(4, np.nan), train=parts, validate=None, rate_hz=100.0,
          warnings=["saturation: force sits at its limit 0.4 % of the time", "jitter: 3 samples were resampled"],
          health_words="inertia and viscous correlate 0.97: wider speeds would help",
          estimators=[("ols", "ols", "OLS")])


def many(path):
    """A minute at 1 kHz with every kind of estimator, two fuzzy ones under names of their own."""
    truth = np.array([0.09, 0.62, 0.80, -0.74])

    def part(name, duration_s, seed):
        time, position, velocity, acceleration = motion(duration_s, 1000, seed)
        torque = columns(velocity, acceleration) @ truth + coloured_noise(len(time), 0.08, 0.9, seed)
        return name, time, position, velocity, acceleration, torque

    write(
        path,
        name="lab_joint_3",
        job_text="[experiment]\nname = \"lab_joint_3\"\n",
        units=REVOLUTE,
        joint="revolute",
        truth=truth,
        train=[part("lab_1.csv", 60, 21)],
        validate=[part("lab_2.csv", 30, 22)],
        rate_hz=1000.0,
        warnings=[],
        health_words="",
        estimators=[
            ("ols", "ols", "OLS"),
            ("wls", "wls", "WLS"),
            ("irls", "irls", "IRLS, Huber"),
            ("de", "de", "DE"),
            ("fade", "fade", "FADE"),
            ("fade_literal", "fade", "FADE, pairing as printed"),
        ],
    )


def de_only(path):
    """A search without any least squares beside it and without a fuzzy controller."""
    crs(path, validate=False, estimators=(("de", "de", "DE"),))


KINDS = {"crs": crs, "prismatic": prismatic, "many": many, "de_only": de_only}

if __name__ == "__main__":
    KINDS[sys.argv[1]](sys.argv[2])
