"""Recordings beside their simulations (/replay of engine/store/RESULT_FORMAT.md), as files of their own and put into
others: a joint with Stribeck friction, simulated with and without it by the loop that moved it.

    make_replay.py KIND OUT.h5      KIND is one of the functions in ALONE
"""

import sys

import h5py
import numpy as np

MODELS = ["as identified", "with what was named", "your simulator"]
INERTIA, VISCOUS, COULOMB, STRIBECK, STRIBECK_SPEED = 0.12, 0.4, 0.8, 0.5, 0.15
STIFFNESS, DAMPING = 40.0, 4.0  # of the loop
LOOP_WORDS = "the loop is a PD law with friction feed-forward, identified from the recording"


def reference(time, seed):
    """Moves and rests, as a robot's day has them."""
    random = np.random.default_rng(seed)
    omega = 2 * np.pi * np.array([0.09, 0.17, 0.31])
    size, phase = random.uniform(0.3, 0.7, 3), random.uniform(0, 6.28, 3)
    return np.sum(size[:, None] * np.sin(omega[:, None] * time + phase[:, None]), axis=0)


def closed_loop(time, wanted, extra, friction=1.0):
    """Position, velocity, torque [n] of the joint; extra: of Stribeck's friction; friction: a factor."""
    step, inner = time[1] - time[0], 4
    speed_wanted = np.gradient(wanted, step)
    position, velocity, out = wanted[0], speed_wanted[0], np.empty((3, len(time)))
    for k in range(len(time)):
        torque = STIFFNESS * (wanted[k] - position) + DAMPING * (speed_wanted[k] - velocity)
        out[:, k] = position, velocity, torque
        for _ in range(inner):
            rubbing = COULOMB + extra * np.exp(-(velocity / STRIBECK_SPEED) ** 2)
            lost = friction * (VISCOUS * velocity + rubbing * np.tanh(velocity / 0.01))
            velocity += step / inner * (torque - lost) / INERTIA
            position += step / inner * velocity
    return out


def recording(seconds, rate_hz, seed, models):
    """time, [measured, [simulated of each model]] of position, velocity, torque."""
    time = np.arange(int(seconds * rate_hz)) / rate_hz
    wanted, noise = reference(time, seed), np.random.default_rng(seed + 100)
    measured = closed_loop(time, wanted, STRIBECK)
    measured += noise.normal(size=measured.shape) * np.array([2e-5, 4e-3, 0.02])[:, None]
    sims = [closed_loop(time, wanted, 0.0), closed_loop(time, wanted, 0.97 * STRIBECK),
            closed_loop(time, wanted, 0.0, 0.6)][:models]
    return time, measured, np.array(sims)


def tell(node, **said):
    """Attributes as results have them: texts of fixed length, whole numbers of 8 bytes."""
    kinds = {str: lambda text: np.bytes_(text.encode()), int: np.int64, float: np.float64}
    node.attrs.update({name: kinds.get(type(value), lambda same: same)(value) for name, value in said.items()})


def put(group, name, value, unit="1"):
    tell(group.create_dataset(name, data=np.asarray(value)), units=unit, long_name=name)


def write_recording(group, name, purpose, rate_hz, signals, *, drive="reference", window_s=0.0, loop="identified",
                    loop_words=LOOP_WORDS, loop_error=0.031, horizon_s=np.nan, diverged=(), channels=None):
    """signals: time, measured [3][n], simulated [M][3][n]; diverged: indices of models."""
    time, measured, simulated = signals
    samples = int(np.isfinite(simulated[0, 0]).sum())
    tell(group, name=name, purpose=purpose, rate_hz=float(rate_hz), samples=samples, drive=drive, window_s=window_s,
         loop=loop, loop_words=loop_words, loop_error=loop_error, horizon_s=horizon_s)
    put(group, "time", time, "s")
    gone = np.array([at in diverged for at in range(len(simulated))])
    put(group, "diverged", gone.astype(np.int64))
    for at, (channel, unit) in enumerate((("position", "rad"), ("velocity", "rad/s"), ("torque", "N m"))):
        if channels is None or channel in channels:
            write_channel(group.create_group(channel), unit, measured[at], simulated[:, at], gone, channel != "torque")


def write_channel(group, unit, measured, simulated, gone, about_mean):
    """What is not simulated is NaN: all of a model that says nothing, or what the job leaves out."""
    error, known = measured - simulated, np.isfinite(simulated)
    about = measured - measured.mean() if about_mean else measured
    signal = np.sqrt((about**2).mean())
    samples = known.sum(1)
    mean = lambda values: np.where(  # noqa: E731
        gone | (samples == 0), np.nan, np.where(known, values, 0.0).sum(1) / np.maximum(samples, 1))
    rms = np.sqrt(mean(error**2))
    tell(group, unit=unit, signal_rms=signal)
    put(group, "measured", measured, unit)
    put(group, "simulated", simulated, unit)
    put(group, "samples", samples.astype(np.int64))
    put(group, "rms", rms, unit)
    put(group, "mae", mean(np.abs(error)), unit)
    put(group, "relerr", rms / signal)


def replay_group(file, models, before, after):
    group = file.create_group("replay")
    tell(group, models=np.array([name.encode() for name in models]), before=before, after=after, joint="revolute")
    return group


def alone(path, write):
    """A file of `torquescope replay`."""
    with h5py.File(path, "w") as file:
        tell(file, format=3, complete=1, creator="torquescope 0.1.0", content_sha256="0" * 64)
        job = file.create_group("job")
        tell(job, name="lab_joint", seed=1, runs=1, sha256="1" * 64)
        put(job, "text", [b"[experiment]\nname = \"lab_joint\"\n"])
        write(file)


def three_models(file):
    """Two recordings, the training one first in the file; the validation one is believed for 21 s, and your simulator
    says nothing of its torque there."""
    group = replay_group(file, MODELS, 0, 1)
    write_recording(group.create_group("recording_1"), "lab_1.csv", "train", 200, recording(20, 200, 1, 3))
    time, measured, simulated = recording(30, 200, 2, 3)
    simulated[2, 2] = np.nan
    write_recording(group.create_group("recording_2"), "lab_2.csv", "validate", 200, (time, measured, simulated),
                    horizon_s=21.0)


def one_model(file):
    """As identified alone, in windows, of one recording without a reference; its position alone."""
    group = replay_group(file, MODELS[:1], 0, 0)
    write_recording(group.create_group("recording_1"), "drive.csv", "train", 200, recording(6, 200, 3, 1),
                    drive="windows", window_s=0.5, loop="none", loop_words="", loop_error=np.nan, channels=["position"])


def diverged(file):
    """The model before grows beyond all bounds, the one after is cut short by no number."""
    group = replay_group(file, MODELS[:2], 0, 1)
    time, measured, simulated = recording(20, 200, 4, 2)
    growing = np.exp(np.minimum(3.0 * time, 60.0))
    simulated[0] = measured + growing
    write_recording(group.create_group("recording_1"), "lab_1.csv", "validate", 200, (time, measured, simulated),
                    diverged=[0])


def all_diverged(file):
    diverged(file)
    one = file["replay/recording_1"]
    one["diverged"][...] = 1
    for channel in ("position", "velocity", "torque"):
        for name in ("rms", "mae", "relerr"):
            one[channel][name][...] = np.nan


def four_recordings(file):
    """Two training ones of a minute at 1 kHz, two validation ones: one by the drive's command, one whose model says
    nothing of the torque."""
    group = replay_group(file, MODELS[:2], 0, 1)
    minute = recording(60, 1000, 5, 2)
    for number in (1, 2):
        write_recording(group.create_group(f"recording_{number}"), f"minute_{number}.csv", "train", 1000, minute,
                        loop="fitted")
    write_recording(group.create_group("recording_3"), "command.csv", "validate", 200, recording(8, 200, 6, 2),
                    drive="command", loop="none", loop_words="The drive was led by its torque command.")
    time, measured, simulated = recording(8, 200, 7, 2)
    simulated[:, 2] = np.nan
    write_recording(group.create_group("recording_4"), "silent.csv", "validate", 200, (time, measured, simulated),
                    loop="given", loop_words="The loop is the one the job gives.")


ALONE = {"replayed": three_models, "replayed_once": one_model, "replayed_diverged": diverged,
         "replayed_all_diverged": all_diverged, "replayed_four": four_recordings}


def beside(file):
    """Into a file that has its own: with the models of a diagnosis, or of a run."""
    group = replay_group(file, MODELS[:2], 0, 1)
    write_recording(group.create_group("recording_1"), "lab_1.csv", "train", 200, recording(10, 200, 8, 2))
    write_recording(group.create_group("recording_2"), "lab_2.csv", "validate", 200, recording(10, 200, 9, 2))


BESIDE = {"named_replayed": "named", "crs_replayed": "crs"}  # what the file is otherwise

# parameters that no row knows: of an effect and of the loop
MORE = {"stribeck": ("N m", 0.49), "stribeck_speed": ("rad/s", 0.149), "stribeck_exponent": ("1", 2.0),
        "loop_kp": ("", 4.1e7), "loop_torque_delay_s": ("s", 0.0)}
LM_TITLE = "Levenberg-Marquardt on rollouts"


def add_parameters(file):
    """To the model; /data keeps the regressor's."""
    model = file["model"]
    for name, more, unit in (("names", list(MORE), "1"), ("units", [unit for unit, _ in MORE.values()], "1"),
                             ("truth", [np.nan] * len(MORE), "SI"), ("lower", [0.0] * len(MORE), "SI"),
                             ("upper", [1e9] * len(MORE), "SI")):
        values = [*model[name][()], *(text.encode() if isinstance(text, str) else text for text in more)]
        del model[name]
        if name == "truth":
            values = np.full(len(values), np.nan)
        put(model, name, values, unit)


def errors_of(file, label, purpose, channel):
    """(mse, relative error, residual's mean and standard deviation, samples) over all samples of these recordings."""
    replay = file["replay"]
    at = [name.decode() for name in replay.attrs["models"]].index(label)
    ones = [one for one in replay.values() if one.attrs["purpose"] == purpose.encode()]
    left = np.concatenate([one[channel]["measured"][()] - one[channel]["simulated"][at] for one in ones])
    left = left[np.isfinite(left)]
    energy = sum(one[channel].attrs["signal_rms"] ** 2 * one[channel]["samples"][at] for one in ones)
    return (left**2).mean(), np.sqrt((left**2).sum() / energy), left.mean(), left.std(), len(left)


def write_rollout_errors(group, file, label, gone=False, channel="torque", unit="N m"):
    """Of the median run; the others do as well as it."""
    runs = len(group["parameters"])
    if gone:
        mse, relerr, mean, std, samples, validation = (np.nan,) * 6
    else:
        mse, relerr, mean, std, samples = errors_of(file, label, "train", channel)
        validation = errors_of(file, label, "validate", channel)[1]
    for name, value, of in (("mse", mse, f"({unit})2"), ("sse", mse * samples, f"({unit})2"), ("relerr", relerr, "1"),
                            ("residual_std", std, unit), ("residual_mean", mean, unit),
                            ("validation_relerr", validation, "1")):
        if name in group:
            del group[name]
        put(group, name, np.full(runs, value), of)
    tell(group, mse_median=mse, mse_best=mse, mse_worst=mse, mse_std=0.0, relerr_median=relerr,
         validation_relerr_median=validation, residual_std_median=std, median_run=0, rollout_error_unit=unit,
         remark="errors are of the torque on all samples, simulated in closed loop; of rows they would be others")


def write_lm(file, values, at_bounds=(), gone=False, **judged):
    """/runs/lm as the last estimator; a parameter at its bound has no error."""
    group = file["runs"].create_group("lm")
    order = [*file["runs"].attrs["order"], b"lm"] if len(file["runs"]) > 1 else [b"lm"]
    tell(file["runs"], order=np.array(order))
    bound = [name.decode() in at_bounds for name in file["model/names"][()]]
    errors = np.where(bound, np.nan, 0.02 * np.abs(values) + 1e-4)
    errors[np.abs(values) > 1e6] *= 100
    tell(group, kind="lm", title=LM_TITLE, runs=1, evaluations_total=312, gap_median=np.nan if gone else 0.314,
         passes=2.0, at_bounds=np.array([name.encode() for name in at_bounds]) if at_bounds else np.array([], "S1"),
         parameters_mean=np.array(values))
    put(group, "parameters", np.array([values]), "SI")
    put(group, "standard_error", errors[None], "SI")
    put(group, "ci95", np.stack([values - 1.959964 * errors, values + 1.959964 * errors], axis=-1)[None], "SI")
    put(group, "gap", [np.nan if gone else 0.314])
    put(group, "stop_reason", [b"diverged" if gone else b"converged"])
    write_rollout_errors(group, file, "lm", gone, **judged)


def replay_of_run(file, models, **other):
    """Three recordings, two of them training ones; the first has a stretch that the job leaves out."""
    group = replay_group(file, models, 0, len(models) - 1)
    for number, (purpose, seconds) in enumerate((("train", 8), ("train", 6), ("validate", 8)), start=1):
        time, measured, simulated = recording(seconds, 200, 10 + number, len(models))
        if number == 1:
            simulated[:, :, 300:400] = np.nan
        write_recording(group.create_group(f"recording_{number}"), f"lab_{number}.csv", purpose, 200,
                        (time, measured, simulated), **other)


def rolled(file, at_bounds=("stribeck_exponent",), diverged=False, judged=None, **other):
    """A run whose only estimator is lm, over more parameters than the regressor has columns."""
    for name in list(file["runs"]):
        del file["runs"][name]
    add_parameters(file)
    replay_of_run(file, ["by least squares", "lm"], diverged=[1] if diverged else [], **other)
    values = np.array([INERTIA, VISCOUS, COULOMB, -COULOMB, *(value for _, value in MORE.values())])
    write_lm(file, values, at_bounds, diverged, **(judged or {}))


def rolled_windows(file):
    """No reference was recorded: errors are of the position."""
    rolled(file, at_bounds=(), judged={"channel": "position", "unit": "rad"}, drive="windows", window_s=0.05,
           loop="none", loop_words="", loop_error=np.nan, channels=["position", "velocity"])


def rolled_several(file):
    """Least squares, DE in rows, FADE and lm on rollouts: of the rows' parameters all."""
    replay_of_run(file, ["by least squares", "fade", "lm"])
    fade = file["runs/fade"]
    tell(fade, fitness_used="rollout")
    write_rollout_errors(fade, file, "fade")
    fade["gap_history"][:, 0] = np.inf  # what ran away
    write_lm(file, np.array([INERTIA, VISCOUS, COULOMB, -COULOMB]))


# {kind: (what the file is otherwise, the change)}
ROLLED = {"rolled": ("crs", rolled), "rolled_windows": ("crs", rolled_windows),
          "rolled_several": ("crs", rolled_several),
          "rolled_away": ("crs", lambda file: rolled(file, at_bounds=(), diverged=True))}

if __name__ == "__main__":
    alone(sys.argv[2], ALONE[sys.argv[1]])
