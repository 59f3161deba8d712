"""Truths and verdicts made by hand, for the tests of the scorer and of its page."""


def size(snr):
    return {"snr_eff": snr, "torque_share": 0.01 * snr}


def true_effect(name="stribeck", families=("reversal", "velocity_law"), catalogue_form=True, snr=3.0):
    region = {"axis": "velocity", "edges": [-2.0, -1.0, 0.0, 1.0, 2.0], "occupancy": [0.25] * 4,
              "inside": [False, True, True, False]}
    return {"name": name, "families": list(families), "catalogue_form": catalogue_form, "size": size(snr),
            "parameters": [{"name": "stribeck", "value": 0.5}], "regions": [region]}


def truth(expected="named", effects=None, snr=3.0):
    effects = [true_effect(snr=snr)] if effects is None else effects
    return {
        "case": "x",
        "expected": expected,
        "size": size(snr),
        "effects": effects,
        "relerr": {"validate": {"baseline": 0.11, "oracle": 0.01, "oracle_of_recording": 0.01}},
        "step_error": {"torque": 1e-6, "position": 1e-6},
    }


def clean():
    return truth("none", [], 0.0)


def effect(name="stribeck", family="reversal", equivalent=(), low=-1.0, high=1.0):
    return {
        "name": name,
        "family": family,
        "equivalent": list(equivalent),
        "region": {"axis": "velocity", "from": low, "to": high},
        "parameters": [{"name": "stribeck", "value": 0.55, "ci95": [0.45, 0.65]}],
    }


def verdict(kind="named", effects=()):
    joint = {
        "effects": list(effects),
        "baseline": {"validation_relerr": 0.11},
        "augmented": {"validation_relerr": 0.02},
    }
    return {"schema": 1, "verdict": kind, "joints": [joint]}


def drawn(made, name, wanted_snr=0.0):
    """The truth as one of a drawn case of this name."""
    return {**made, "case": name.replace(":", "_"), "tier": name[:2], "drawn": name, "wanted_snr": wanted_snr,
            "rig": {"joint": "elbow", "controller": "pid", "law": "pid", "noise": "bench", "train": "mixed"}}
