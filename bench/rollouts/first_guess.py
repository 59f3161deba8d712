"""Where the peers start: least squares on the differentiated recording, as a practitioner would do."""
import numpy as np
from scipy import signal

from joint import TICK_S

CUTOFF_HZ = 20.0
SLOWEST = 0.1  # rad/s; rows near a reversal are left out


def first_guess(recording):
    sections = signal.butter(4, CUTOFF_HZ * 2 * TICK_S, output="sos")
    smooth = lambda x: signal.sosfiltfilt(sections, x)  # noqa: E731
    q = smooth(recording.position)
    dq = np.gradient(q, TICK_S)
    torque, error = smooth(recording.torque), smooth(recording.reference - recording.position)
    rows = np.stack([np.gradient(dq, TICK_S), dq, smooth(np.sign(dq)), np.ones_like(q), np.sin(q), np.cos(q)], axis=1)
    moving = np.abs(dq) > SLOWEST
    plant = np.linalg.lstsq(rows[moving], torque[moving], rcond=None)[0]
    gains = np.linalg.lstsq(np.stack([error, -dq], axis=1), torque, rcond=None)[0]
    return np.concatenate([plant, gains])
