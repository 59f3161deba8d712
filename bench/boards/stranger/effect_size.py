#!/usr/bin/python3
"""How large is what a case conceals, and how much would the right law buy?

    effect_size.py STRANGER CASE...        each case is made twice in a temporary folder: with and without

Rows    those that move: at rest dry friction is whatever it must be, and no model of its level can know it. What acts
        at reversals is judged on all rows.
SNR     rms of what the effect leaves after mass and friction were fitted again, over the residual without it:
        sqrt(r1^2 - r0^2) / r0, where r1, r0 are the residuals of the baseline with and without the effect
oracle  relerr when the exact column of what is concealed joins the baseline (fitted on train, applied to unseen)
"""

import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

ORDER = 4
AT_REVERSALS = ("presliding", "maxwell_slip", "breakaway_dwell", "backlash")


def low_pass(x, rate, cutoff):
    """Zero-phase Butterworth, forwards and backwards, on the record continued by reflection in its ends."""
    pad = min(len(x) - 1, int(3 * rate / cutoff) + 1)
    y = np.concatenate([2 * x[0] - x[pad:0:-1], x, 2 * x[-1] - x[-2:-pad - 2:-1]])
    f = np.fft.rfftfreq(len(y), 1 / rate)
    return np.fft.irfft(np.fft.rfft(y) / (1 + (f / cutoff) ** (2 * ORDER)), len(y))[pad:pad + len(x)]


def load(folder, name):
    rows = np.loadtxt(Path(folder) / "truth" / name, delimiter=",", skiprows=1)
    return dict(zip(("t", "reference", "position", "torque", "unexplained"), rows.T))


def columns(record, truth):
    """Filtered, decimated: torque, baseline columns, the concealed torque."""
    rate = truth["log_hz"]
    q = low_pass(record["position"], rate, truth["cutoff_hz"])
    v = np.gradient(q) * rate
    a = np.gradient(v) * rate
    base = {"inertia": a, "viscous": v, "coulomb": np.sign(v), "coulomb_positive": (v > 0) * 1.0,
            "coulomb_negative": (v < 0) * -1.0, "offset": np.ones_like(v)}
    stack = []
    for term in truth["terms"]:
        stack += [np.sin(q), np.cos(q)] if term == "gravity" else [base[term]]
    step = round(rate / truth["decimate_to_hz"])
    edge = int(3 * rate / truth["parallel_cutoff_hz"])

    def thin(x):
        return low_pass(x, rate, truth["parallel_cutoff_hz"])[edge:-edge:step]

    # at rest, or a filter's length beside it
    slow = (np.abs(v) < 0.005 * np.max(np.abs(v))) * 1.0
    reach = int(0.7 * rate / truth["parallel_cutoff_hz"])
    sums = np.concatenate([[0.0], np.cumsum(np.pad(slow, reach))])
    moving = (sums[2 * reach + 1:] - sums[:-2 * reach - 1] < 0.5)[edge:-edge:step]
    if any(law["name"] in AT_REVERSALS for law in truth["laws"]):
        moving[:] = True
    return (
        thin(record["torque"])[moving],
        np.stack([thin(c)[moving] for c in stack], 1),
        thin(record["unexplained"])[moving],
    )


def fit(torque, phi):
    return np.linalg.lstsq(phi, torque, rcond=None)[0]


def relerr(torque, phi, theta):
    return np.linalg.norm(torque - phi @ theta) / np.linalg.norm(torque)


def measure(stranger, case, folder, extra=()):
    for name, more in (("with", list(extra)), ("without", ["--without"])):
        subprocess.run([stranger, case, f"{folder}/{name}", *more], check=True)
    truth = json.loads((Path(folder) / "with/truth/truth.json").read_text())
    found = {"case": case}
    tau, phi, hidden = columns(load(f"{folder}/with", "train.csv"), truth)
    tau_u, phi_u, hidden_u = columns(load(f"{folder}/with", "unseen.csv"), truth)
    before = json.loads((Path(folder) / "without/truth/truth.json").read_text())
    tau_0, phi_0, _ = columns(load(f"{folder}/without", "train.csv"), before)
    r1 = np.sqrt(np.mean((tau - phi @ fit(tau, phi)) ** 2))
    r0 = np.sqrt(np.mean((tau_0 - phi_0 @ fit(tau_0, phi_0)) ** 2))
    found["snr"] = float(np.sqrt(max(0.0, r1 ** 2 - r0 ** 2)) / r0)
    theta = fit(tau, phi)
    with_law = np.column_stack([phi, hidden])
    with_law_u = np.column_stack([phi_u, hidden_u])
    best = fit(tau, with_law) if np.any(hidden) else None
    found["train_before"] = float(relerr(tau, phi, theta))
    found["train_oracle"] = float(relerr(tau, with_law, best)) if best is not None else found["train_before"]
    found["unseen_before"] = float(relerr(tau_u, phi_u, theta))
    found["unseen_oracle"] = float(relerr(tau_u, with_law_u, best)) if best is not None else found["unseen_before"]
    found["clean_train"] = float(r0 / np.sqrt(np.mean(tau_0 ** 2)))
    found["parameters"] = [float(x) for x in theta]
    found["torque_rms"] = float(np.sqrt(np.mean(tau ** 2)))
    return found


def main(words):
    stranger, *cases = words
    extra = []
    for option in ("--scale", "--only", "--steps"):
        if option in cases:
            at = cases.index(option)
            extra, cases = extra + cases[at:at + 2], cases[:at] + cases[at + 2:]
    print(
        f"{'case':30} {'snr':>6} {'clean':>7} {'train: before':>13} {'oracle':>7} {'unseen: before':>14} "
        f"{'oracle':>7}  parameters"
    )
    for case in cases:
        with tempfile.TemporaryDirectory() as folder:
            m = measure(stranger, case, folder, extra)
        print(
            f"{case:30} {m['snr']:6.2f} {100 * m['clean_train']:6.2f}% {100 * m['train_before']:12.2f}% "
            f"{100 * m['train_oracle']:6.2f}% "
            f"{100 * m['unseen_before']:13.2f}% {100 * m['unseen_oracle']:6.2f}%  "
            f"{np.array2string(np.array(m['parameters']), precision=4)}"
            f" rms {m['torque_rms']:.3g}",
            flush=True,
        )


if __name__ == "__main__":
    main(sys.argv[1:])
