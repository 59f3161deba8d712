"""Rows of a chain of six hinges by MuJoCo's sysid, in the Python of the peers; prints microseconds a sample.

    mujoco_rows.py SAMPLES
"""
import sys
import time

import mujoco
import numpy as np
from mujoco_sysid.regressors import joint_torque_regressor

JOINTS = 6


def chain(joints):
    text = ""
    for k in range(joints):
        axis = "0 0 1" if k % 2 == 0 else "0 1 0"
        text += (f'<body pos="0 0 0.3"><joint type="hinge" axis="{axis}"/>'
                 '<inertial pos="0 0.01 0.1" mass="2" diaginertia="0.02 0.02 0.01"/>')
    return f"<mujoco><worldbody>{text}{'</body>' * joints}</worldbody></mujoco>"


def main(samples):
    model = mujoco.MjModel.from_xml_string(chain(JOINTS))
    data = mujoco.MjData(model)
    motion = np.random.default_rng(1).uniform(-1, 1, (3, samples, JOINTS))
    start = time.process_time()
    for q, dq, ddq in zip(*motion):
        data.qpos[:], data.qvel[:], data.qacc[:] = q, dq, ddq
        mujoco.mj_inverse(model, data)
        joint_torque_regressor(model, data)
    print(1e6 * (time.process_time() - start) / samples)


main(int(sys.argv[1]))
