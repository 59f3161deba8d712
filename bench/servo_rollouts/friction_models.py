"""The friction models M1 to M6 of Duclusaud, Passault, Padois, Ly 2025 (arXiv:2410.08650), over arrays.

Written from their equations. tm: torque of the motor, te: torque from outside, s = exp(-(|dq| / vs)^a)

    M1  F = Fc                      M4  F = Fc + kl |tm - te| + s (Fs + ks |tm - te|)
    M2  F = Fc + s Fs               M5  F = Fc + |klm tm - kle te| + s (Fs + |ksm tm - kse te|)
    M3  F = Fc + kl |tm - te|       M6  F = M5 + (kqm tm - kqe te)^2

M6 has the square as it is read here: of the loads, with factors of its own, squared together.
"""
import numpy as np

# parameters and the range that a search goes through, even in their logarithms
MOTOR = {"kt": (0.1, 10.0), "resistance": (0.2, 50.0), "armature": (1e-3, 0.2), "viscous": (1e-3, 1.0),
         "Fc": (1e-3, 1.0)}
STRIBECK = {"Fs": (1e-3, 1.0), "vs": (0.01, 10.0), "a": (0.3, 5.0)}
LOAD, LOAD_STRIBECK = {"kl": (1e-4, 1.0)}, {"ks": (1e-4, 1.0)}
TWO_LOADS = {"klm": (1e-4, 1.0), "kle": (1e-4, 1.0), "ksm": (1e-4, 1.0), "kse": (1e-4, 1.0)}
SQUARES = {"kqm": (1e-4, 1.0), "kqe": (1e-4, 1.0)}
MODELS = {
    "M1": MOTOR,
    "M2": MOTOR | STRIBECK,
    "M3": MOTOR | LOAD,
    "M4": MOTOR | LOAD | STRIBECK | LOAD_STRIBECK,
    "M5": MOTOR | STRIBECK | TWO_LOADS,
    "M6": MOTOR | STRIBECK | TWO_LOADS | SQUARES,
}

CONTAINED = {"M2": ["M1"], "M3": ["M1"], "M4": ["M1", "M2", "M3"], "M5": ["M1", "M2", "M3", "M4"],
             "M6": ["M1", "M2", "M3", "M4", "M5"]}


def contains(model, smaller):
    """Whether parameters of this model make it the smaller one."""
    return smaller in CONTAINED.get(model, [])


def parameters(model, unit):
    """Columns of parameters, (members, 1) each, from points of the unit cube."""
    ranges = np.log(np.array(list(MODELS[model].values())))
    values = np.exp(ranges[:, 0] + np.asarray(unit) * (ranges[:, 1] - ranges[:, 0]))
    return {name: values[:, [column]] for column, name in enumerate(MODELS[model])}


class Friction:
    """Level of dry friction at speed dq under tm and te. Arrays are made once; a result holds until the next call."""

    def __init__(self, p, shape):
        self.p, self.level, self.load, self.other = p, *np.empty((3, *shape))

    def __call__(self, dq, tm, te):
        p, level = self.p, self.level
        if "Fs" in p:
            self.stribeck(dq)
            if "ks" in p:
                self.load_of(tm, te)
                level *= np.multiply(self.load, p["ks"], out=self.other).__iadd__(p["Fs"])
                level += np.multiply(self.load, p["kl"], out=self.other)
            elif "ksm" in p:
                level *= self.two_loads(tm, te, "ksm", "kse").__iadd__(p["Fs"])
                level += self.two_loads(tm, te, "klm", "kle")
            else:
                level *= p["Fs"]
            if "kqm" in p:
                squared = self.two_loads(tm, te, "kqm", "kqe")
                level += np.square(squared, out=squared)
            level += p["Fc"]
        elif "kl" in p:
            self.load_of(tm, te)
            np.multiply(self.load, p["kl"], out=level)
            level += p["Fc"]
        else:
            return p["Fc"]
        return level

    def stribeck(self, dq):
        level = self.level
        np.abs(dq, out=level)
        level /= self.p["vs"]
        np.power(level, self.p["a"], out=level)
        np.negative(level, out=level)
        np.exp(level, out=level)

    def load_of(self, tm, te):
        np.abs(np.subtract(tm, te, out=self.load), out=self.load)

    def two_loads(self, tm, te, of_motor, of_outside):
        np.multiply(tm, self.p[of_motor], out=self.load)
        self.load -= np.multiply(te, self.p[of_outside], out=self.other)
        return np.abs(self.load, out=self.load)
