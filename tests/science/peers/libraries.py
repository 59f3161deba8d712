"""An arm in Pinocchio and in MuJoCo. Each tells torque, gravity, mass matrix and acceleration of a state."""
import math

import mujoco
import numpy as np
import pinocchio

from arms import words


class Pinocchio:
    name = f"Pinocchio {pinocchio.__version__}"

    def __init__(self, arm):
        if arm.joints:
            self.model = pinocchio.Model()
            parent = 0
            for joint in arm.joints:
                kind = pinocchio.JointModelPZ() if joint.slides else pinocchio.JointModelRZ()
                parent = self.model.addJoint(parent, kind, pinocchio.SE3(joint.place), joint.name)
                body = joint.body
                self.model.appendBodyToJoint(parent, pinocchio.Inertia(body.mass, body.centre, body.inertia),
                                             pinocchio.SE3.Identity())
            self.model.armature = np.array([joint.drive_inertia for joint in arm.joints])
        else:
            self.model = pinocchio.buildModelFromXML(arm.text)
        self.model.gravity.linear = arm.gravity
        self.data = self.model.createData()
        self.offsets = arm.offsets

    def size(self):
        return self.model.nv

    def state(self, q):
        # a continuous joint has a cosine and a sine
        return pinocchio.integrate(self.model, pinocchio.neutral(self.model), np.asarray(q) + self.offsets)

    def torque(self, q, dq, ddq):
        return pinocchio.rnea(self.model, self.data, self.state(q), dq, ddq)

    def gravity(self, q):
        return pinocchio.computeGeneralizedGravity(self.model, self.data, self.state(q))

    def mass_matrix(self, q):
        upper = np.triu(pinocchio.crba(self.model, self.data, self.state(q)))
        return upper + np.triu(upper, 1).T

    def acceleration(self, q, dq, tau):
        return pinocchio.aba(self.model, self.data, self.state(q), dq, tau)

    def regressor_and_frames(self, q, dq, ddq):
        """The regressor, N x 10 N, and where the frames are that it is written in."""
        columns = pinocchio.computeJointTorqueRegressor(self.model, self.data, self.state(q), dq, ddq).copy()
        pinocchio.forwardKinematics(self.model, self.data, self.state(q))
        return columns, [frame.homogeneous for frame in list(self.data.oMi)[1:]]


def quaternion(rotation):
    made = np.zeros(4)
    mujoco.mju_mat2Quat(made, np.ascontiguousarray(rotation).ravel())
    return made / np.linalg.norm(made)


def mjcf(arm):
    opened, closed = [], []
    for joint in arm.joints:
        xx, xy, xz, yy, yz, zz = joint.body.six()
        opened.append(f'<body pos="{words(joint.place[:3, 3])}" quat="{words(quaternion(joint.place[:3, :3]))}">'
                      f'<inertial pos="{words(joint.body.centre)}" mass="{float(joint.body.mass)!r}" '
                      f'fullinertia="{words((xx, yy, zz, xy, xz, yz))}"/><joint axis="0 0 1" '
                      f'type="{"slide" if joint.slides else "hinge"}" armature="{joint.drive_inertia!r}"/>')
        closed.append("</body>")
    return ('<mujoco><compiler angle="radian"/><worldbody>' + "".join(opened + closed) + "</worldbody></mujoco>")


class Mujoco:
    name = f"MuJoCo {mujoco.__version__}"

    def __init__(self, arm):
        self.model = mujoco.MjModel.from_xml_string(mjcf(arm) if arm.joints else arm.text)
        self.model.opt.gravity[:] = arm.gravity
        self.model.opt.disableflags |= (mujoco.mjtDisableBit.mjDSBL_CONSTRAINT | mujoco.mjtDisableBit.mjDSBL_CONTACT)
        self.data = mujoco.MjData(self.model)
        self.offsets = arm.offsets

    def size(self):
        return self.model.nv

    def set(self, q, dq):
        self.data.qpos[:] = np.asarray(q) + self.offsets
        self.data.qvel[:] = dq

    def torque(self, q, dq, ddq):
        self.set(q, dq)
        self.data.qacc[:] = ddq
        mujoco.mj_inverse(self.model, self.data)
        return self.data.qfrc_inverse.copy()

    def gravity(self, q):
        return self.torque(q, 0.0, 0.0)

    def mass_matrix(self, q):
        self.set(q, 0.0)
        mujoco.mj_forward(self.model, self.data)
        full = np.zeros((self.model.nv, self.model.nv))
        mujoco.mj_fullM(self.model, self.data, full)
        return full

    def acceleration(self, q, dq, tau):
        self.set(q, dq)
        self.data.qfrc_applied[:] = tau
        mujoco.mj_forward(self.model, self.data)
        return self.data.qacc.copy()
