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
    tell(group, name=name, purpose=purpose, rate_hz=float(rate_hz), samples=len(time), drive=drive, window_s=window_s,
         loop=loop, loop_words=loop_words, loop_error=loop_error, horizon_s=horizon_s)
    put(group, "time", time, "s")
    gone = np.array([at in diverged for at in range(len(simulated))])
    put(group, "diverged", gone.astype(np.int64))
    for at, (channel, unit) in enumerate((("position", "rad"), ("velocity", "rad/s"), ("torque", "N m"))):
        if channels is None or channel in channels:
            write_channel(group.create_group(channel), unit, measured[at], simulated[:, at], gone, channel != "torque")


def write_channel(group, unit, measured, simulated, gone, about_mean):
    error = measured - simulated
    about = measured - measured.mean() if about_mean else measured
    signal = np.sqrt((about**2).mean())
    silent = gone | np.isnan(simulated).any(1)
    rms = np.where(silent, np.nan, np.sqrt((error**2).mean(1)))
    tell(group, unit=unit, signal_rms=signal)
    put(group, "measured", measured, unit)
    put(group, "simulated", simulated, unit)
    put(group, "samples", np.where(np.isnan(simulated).any(1), 0, len(measured)).astype(np.int64))
    put(group, "rms", rms, unit)
    put(group, "mae", np.where(silent, np.nan, np.abs(error).mean(1)), unit)
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
    """Two recordings, the training one first in the file; the unseen one is believed for 21 s, and your simulator
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
    """Two training ones of a minute at 1 kHz, two unseen ones: one by the drive's command, one whose model says
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

if __name__ == "__main__":
    alone(sys.argv[2], ALONE[sys.argv[1]])
