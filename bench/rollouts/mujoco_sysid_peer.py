"""The recording by MuJoCo's own toolbox, mujoco.sysid, with its own optimiser, one thread; one line of JSON.

    mujoco_sysid_peer.py RECORDING

Residuals are those of the other peers. The toolbox leaves out the last tick of a recording: one more is put behind it.
"""
import sys

import mujoco
import numpy as np
from mujoco import sysid

import joint
import mujoco_joint
import recording
from first_guess import first_guess
from peer_fit import Trace, report

FAR = 0.5  # of a parameter: half of the box


def with_one_more(rows):
    return np.concatenate([rows, rows[-1:]])


def box(guess):
    parameters = sysid.ParameterDict()
    for name, value in zip(joint.NAMES, guess):
        parameters.add(sysid.Parameter(name, value, value - FAR * abs(value), value + FAR * abs(value)))
    return parameters


def sequences(data, guess):
    spec = mujoco.MjSpec.from_string(mujoco_joint.text(guess))
    model = spec.compile()
    controls = with_one_more(mujoco_joint.controls(data.reference))
    measured = with_one_more(np.stack([data.position, data.torque], axis=1))
    times = joint.TICK_S * np.arange(len(measured))
    return sysid.ModelSequences("joint", spec, "recording", mujoco_joint.at_rest(model, data.position[0]),
                                sysid.TimeSeries.from_control_names(times, controls, model),
                                sysid.TimeSeries.from_names(times, measured, model))


def main(path):
    data = recording.read(path)
    trace = Trace(data)
    guess = first_guess(data)

    def weighted(_, predicted, measured, *__, **___):
        position, torque = predicted.data.T
        trace.saw(position, torque)
        return data.weighted(position, torque), predicted, measured

    def model(parameters, _):
        return mujoco.MjModel.from_xml_string(mujoco_joint.text(parameters.as_vector()))

    residuals = sysid.build_residual_fn(models_sequences=[sequences(data, guess)], build_model=model,
                                        modify_residual=weighted, resample_true=False, n_threads=1)
    found, _ = sysid.optimize(box(guess), residuals, verbose=False, x_scale="jac")
    report("mujoco.sysid", None, trace, found.as_vector())


main(sys.argv[1])
