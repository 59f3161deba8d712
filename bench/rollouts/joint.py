"""The joint that bench/rollouts simulates: a pendulum with dry friction in a position loop.

    inertia ddq = u - viscous dq - coulomb sign(dq) - offset - gravity_sin sin q - gravity_cos cos q
    u = kp (r - q) - kd dq, within +-LIMIT_NM, held for a tick; sign(0) is all of [-1, 1]: it holds at rest

Units are SI. A vector of parameters has the order of NAMES.
"""
import math

NAMES = ("inertia", "viscous", "coulomb", "offset", "gravity_sin", "gravity_cos", "kp", "kd")
TRUTH = (0.05, 0.2, 0.3, 0.05, 1.2, 0.1, 20.0, 0.5)
TICK_S, SECONDS = 0.001, 60.0
LIMIT_NM = 8.0  # never reached by this motion
TORQUE_NOISE_NM = 0.02
ENCODER_STEP_RAD = 2 * math.pi / 16384
POSITION_NOISE_RAD = ENCODER_STEP_RAD / math.sqrt(12)  # what rounding leaves, rms

# frequencies in Hz, amplitudes in rad, phases in rad
MULTISINE = ((0.1, 0.50, 0.4), (0.3, 0.35, 2.1), (0.7, 0.18, 4.0), (1.1, 0.12, 5.3))
RAMP_S = 0.5


def reference(t):
    """The commanded position: a multisine that fades in from rest."""
    share = min(t / RAMP_S, 1.0)
    fade = share * share * (3.0 - 2.0 * share)
    return fade * sum(size * math.sin(2 * math.pi * hz * t + phase) for hz, size, phase in MULTISINE)
