"""Diagnoses the invented ones do not show: a minute at 1 kHz, two joints, hardly anything measured, effects side by
side, words that would be elements of a page."""

import json

import numpy as np

# a comment that opens, and a script inside: a browser that takes them for its own looks for the end of both
HOSTILE_WORDS = "<!--<script>alert(1)</script> $unmatched"

NOT_MEASURED = ("validation_relerr", "augmented_validation_relerr", "cv_relerr", "augmented_cv_relerr")


def replace(group, name, values):
    """A dataset with other values and the same attributes."""
    attributes = dict(group[name].attrs)
    del group[name]
    group[name] = values
    group[name].attrs.update(attributes)


def a_minute_at_1_khz(file):
    """Noise that does not pack well, twelve seconds of reversals, residuals absent around each."""
    random = np.random.default_rng(5)
    time = np.arange(60000) / 1000
    position, velocity = np.sin(2 * np.pi * time / 3), 2.1 * np.cos(2 * np.pi * time / 3)
    before = 0.1 * np.sign(velocity) * np.exp(-np.abs(velocity) / 0.2) + 0.02 * random.normal(size=len(time))
    before[40000] = 0.7  # one spike: it must be seen at every zoom
    after = 0.02 * random.normal(size=len(time))
    before[np.abs(velocity) < 0.03] = after[np.abs(velocity) < 0.03] = np.nan
    torque = np.sign(velocity) + 0.3 * velocity + 0.02 * random.normal(size=len(time))
    trace = file["diagnosis/joint_1/traces/trace_1"]
    for name, values in (
        ("time", time),
        ("torque", torque),
        ("before", before),
        ("after", after),
        ("velocity", velocity),
        ("position", position),
    ):
        replace(trace, name, values)
    for data in (file["data/train"], file["data/validate"]):
        for name, values in (("time", time), ("torque", torque), ("velocity", velocity), ("position", position)):
            replace(data, name, values)
        replace(data, "acceleration", -4.4 * position)
        replace(data, "recording", np.zeros(len(time), dtype=np.int64))


def two_joints(file):
    """The first lacks nothing; the second has a recording of its own beside the first one's kind, and no validation
    recording. The job has a name of ten thousand letters."""
    found = file["diagnosis"]
    found.copy("joint_1", "joint_2")
    found.attrs["joints"] = np.int64(2)
    found["joint_2"].attrs["joint"] = np.int64(2)
    found["joint_2"].copy("traces/trace_1", "traces/trace_2")
    for joint, verdict in (("joint_1", "none"), ("joint_2", "named")):
        found[joint].attrs["verdict"] = np.bytes_(verdict)
        found[joint].attrs["reason"] = np.bytes_(f"What is said of {joint}.")
    file["job"].attrs["name"] = np.bytes_("x" * 10000)


def hardly_measured(file):
    """NaN wherever the format allows it."""
    joint = file["diagnosis/joint_1"]
    for name in NOT_MEASURED:
        joint.attrs[name] = np.nan
    for name in ("cv_gain", "q"):
        joint[f"candidates/{name}"][...] = np.nan
    joint["augmented/ci95"][...] = np.nan
    for axis in joint["map"].values():
        axis["after_residual"][...] = np.nan
        axis["after_z"][...] = np.nan
        axis.attrs["p"] = np.nan
    for name in ("forward", "twin_energy", "unexplained", "excitation", "traces"):
        del joint[name]
    for effect in joint["effects"].values():
        for name in ("gain_cv", "peak", "rms"):
            effect.attrs[name] = np.nan
        del effect["curve"]
    del file["data/validate"]


def crowded(file):
    """Four effects with long names close together on one axis, one at its very end; numbers far from one."""
    joint = file["diagnosis/joint_1"]
    regions = ((-0.12, 0.12), (-0.1, 0.02), (0.05, 0.2), (0.98, 1.0))
    names = ("stribeck", "position_dependent_friction", "load_dependent_friction", "directional_efficiency")
    for number, (name, (start, stop)) in enumerate(zip(names, regions), start=1):
        path = f"effects/effect_{number}"
        if number > 1:
            if path in joint:
                del joint[path]
            joint.copy("effects/effect_1", path)
        effect = joint[path]
        effect.attrs["name"], effect.attrs["region_from"], effect.attrs["region_to"] = np.bytes_(name), start, stop
    for axis in joint["map"].values():
        for name in ("z", "after_z", "mean_residual", "after_residual", "twin_mean", "twin_std"):
            axis[name][...] *= 1.7e4
    joint["map/velocity"].attrs["energy_share"] = np.nan
    joint["candidates/z"][0] = 4711.0


# name: (the kind it is made of, how)
def hostile_words(file):
    found = file["diagnosis"]
    for key in ("reason", "finding", "way_out"):
        found.attrs[key] = np.bytes_(HOSTILE_WORDS)
    found["joint_1/effects/effect_1"].attrs["title"] = np.bytes_(HOSTILE_WORDS)
    del found["verdict_json"]
    found.create_dataset("verdict_json", data=np.array([json.dumps({"reason": HOSTILE_WORDS}).encode()]))


KINDS = {
    "minute": ("named", a_minute_at_1_khz),
    "two_joints": ("named", two_joints),
    "hardly_measured": ("named", hardly_measured),
    "crowded": ("named", crowded),
    "hostile_words": ("named", hostile_words),
}
