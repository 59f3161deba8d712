"""The joint as a model of MuJoCo: the step is the tick, so that its position actuator holds the torque as long.

Gravity is a mass of 1 kg next to the axis under a field of 1000 m/s^2; the drive's inertia is armature. The offset is
an actuator that nobody commands. Its dry friction is a soft constraint, as stiff here as the step allows. solver and
island do not change the motion of one joint, and are its fastest. Sensors of step k are of its start.
"""
import mujoco
import numpy as np

from joint import LIMIT_NM, TICK_S

FIELD, BODY = 1000.0, 1e-6  # m/s^2; kg m^2 of the mass itself
TEXT = """<mujoco>
<option timestep="{tick}" gravity="0 0 -{field}" integrator="{integrator}" solver="PGS">
  <flag contact="disable" island="disable"/></option>
<worldbody><body name="link">
  <inertial pos="{x} 0 {z}" mass="1" diaginertia="{body} {body} {body}"/>
  <joint name="joint" type="hinge" axis="0 -1 0" armature="{armature}" damping="{viscous}" frictionloss="{coulomb}"
    solreffriction="{stiffest} 1" solimpfriction="0.9999 0.9999 0.001"/></body></worldbody>
<actuator>
  <position name="drive" joint="joint" kp="{kp}" kv="{kd}" forcelimited="true" forcerange="-{limit} {limit}"/>
  <general name="offset" joint="joint" biastype="affine" gainprm="0" biasprm="{bias} 0 0"/></actuator>
<sensor><jointpos name="position" joint="joint"/><actuatorfrc name="torque" actuator="drive"/></sensor>
</mujoco>"""
INTEGRATOR = "Euler"


def place(gravity_sin, gravity_cos):
    """Of the mass, in the link."""
    return gravity_cos / FIELD, -gravity_sin / FIELD


def armature(inertia, gravity_sin, gravity_cos):
    return inertia - BODY - sum(part**2 for part in place(gravity_sin, gravity_cos))


def text(parameters):
    inertia, viscous, coulomb, offset, gravity_sin, gravity_cos, kp, kd = map(float, parameters)
    x, z = place(gravity_sin, gravity_cos)
    return TEXT.format(tick=TICK_S, field=FIELD, integrator=INTEGRATOR, x=x, z=z, body=BODY, viscous=viscous,
                       armature=armature(inertia, gravity_sin, gravity_cos), coulomb=coulomb, stiffest=2 * TICK_S,
                       kp=kp, kd=kd, limit=LIMIT_NM, bias=-offset)


def controls(reference):
    """Of the two actuators, at every tick."""
    return np.stack([reference, np.zeros_like(reference)], axis=1)


def at_rest(model, position):
    """The state at the start."""
    data = mujoco.MjData(model)
    data.qpos[0] = position
    kind = mujoco.mjtState.mjSTATE_FULLPHYSICS
    state = np.empty(mujoco.mj_stateSize(model, kind))
    mujoco.mj_getState(model, data, state, kind)
    return state
