"""The recording by scipy's least_squares over mujoco.rollout, a model a trial, one thread; one line of JSON.

    mujoco_peer.py RECORDING
"""
import sys

import mujoco
import numpy as np
from mujoco import rollout

import mujoco_joint
import recording
from first_guess import first_guess
from peer_fit import Trace, by_least_squares, rate, report

MANY, TICKS = 64, 6000  # models of one call, for the rate


def main(path):
    data = recording.read(path)

    def rolled(trials, controls):
        models = [mujoco.MjModel.from_xml_string(mujoco_joint.text(one)) for one in trials]
        start = mujoco_joint.at_rest(models[0], data.position[0])
        return rollout.rollout(models, mujoco.MjData(models[0]), start, controls)[1]

    def simulate(trials):
        sensors = rolled(trials, mujoco_joint.controls(data.reference))
        return sensors[:, :, 0], sensors[:, :, 1]

    trace = Trace(data)
    found = by_least_squares(simulate, trace, first_guess(data), together=False)
    controls = mujoco_joint.controls(data.reference[:TICKS])
    report("scipy, mujoco.rollout", rate(lambda: rolled(np.tile(found, (MANY, 1)), controls), MANY, len(controls)),
           trace, found)


main(sys.argv[1])
