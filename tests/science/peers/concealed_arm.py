"""What an arm's joints lack, on recordings of an arm that MuJoCo moves: no line of the engine is in them.

    concealed_arm.py TORQUESCOPE

Three joints under proportional-derivative control follow sums of sines. Torques are logged with noise, positions by an
encoder. One joint has something the model lacks; the answer is its joint and its effect, or a class with it. A complete
arm gets no name. Exit code 77 where MuJoCo is absent (scripts/install-peers).
"""
import json
import math
import os
import pathlib
import subprocess
import sys
import tempfile

try:
    import mujoco
    import numpy as np
except ImportError as missing:
    peers = pathlib.Path(__file__).resolve().parents[3] / "build" / "peers"
    python = str(peers / "bin" / "python")
    if (peers / "installed").exists() and sys.executable != python:
        os.execv(python, [python, *sys.argv])
    print(f"skipped: {missing} (scripts/install-peers fetches MuJoCo from PyPI)")
    sys.exit(77)

RATE_HZ, STEP_S, SECONDS = 250, 0.0005, 24
COUNTS = 262144
STIFFNESS, DAMPING = np.array([900.0, 900.0, 500.0]), np.array([60.0, 60.0, 30.0])
NOISE = np.array([0.15, 0.15, 0.08])  # N m, of the log
# armature, viscous and dry friction, as the model has them. MuJoCo's dry friction turns before the speed does, by half
# of its time constant: 10 ms unless told, which is a delay that the model lacks
JOINT = '<joint axis="0 0 1" armature="{0}" damping="{1}" frictionloss="{2}" solreffriction="0.001 1"/>'
ARM = """
<mujoco>
  <compiler angle="radian"/>
  <option timestep="{step}" gravity="0 0 -9.81" integrator="implicitfast"/>
  <worldbody><body name="waist" pos="0 0 0.3">{waist}
    <inertial pos="0.02 0.01 -0.05" mass="6" diaginertia="0.06 0.06 0.04"/>
    <body name="shoulder" quat="0.7071067811865476 -0.7071067811865476 0 0">{shoulder}
      <inertial pos="0.18 0.01 0.02" mass="4" diaginertia="0.012 0.06 0.06"/>
      <body name="elbow" pos="0.4 0 0">{elbow}
        <inertial pos="0.14 -0.01 0.01" mass="2.2" diaginertia="0.005 0.025 0.025"/>
      </body></body></body></worldbody>
  <actuator/>
</mujoco>
"""
FRICTION = {"waist": (0.4, 3.0, 4.0), "shoulder": (0.4, 3.5, 5.0), "elbow": (0.2, 1.2, 2.0)}
ROBOT = """
[robot]
name = "three joints"
convention = "modified_dh"
[[joint]]
name = "waist"
d_m = 0.3
[[joint]]
name = "shoulder"
alpha_rad = -1.5707963267948966
[[joint]]
name = "elbow"
a_m = 0.4
"""
JOB = """
[experiment]
name = "three_joints"
seed = 5
[recording]
train = "train.csv"
validate = "unseen.csv"
columns = {time = "t_s", reference = "q_ref{j}_rad", position = "q{j}_rad", torque = "tau{j}_Nm"}
[filter]
cutoff_hz = 20
parallel_cutoff_hz = 10
decimate_to_hz = 50
[model]
robot = "robot.toml"
friction = ["viscous", "coulomb", "offset"]
[diagnose]
effects = "all"
twins = 200
"""


def spring(q, _dq, _load):
    return 6.0 * q


def load_friction(_q, dq, load):
    return 0.12 * abs(load) * math.tanh(dq / 0.002)


def stribeck(_q, dq, _load):
    return 3.0 * math.exp(-abs(dq) / 0.12) * math.tanh(dq / 0.002)


# name, joint, torque that the joint takes beyond the model, names that are right
CASES = (
    ("complete", None, None, set()),
    ("spring at the elbow", 3, spring, {"spring", "cable"}),
    ("load at the shoulder", 2, load_friction, {"load_dependent_friction", "directional_efficiency"}),
    ("stribeck at the waist", 1, stribeck, {"stribeck"}),
)


def reference(seed):
    """[samples][3] positions and speeds: sums of sines that fade in."""
    random = np.random.default_rng(seed)
    t = np.arange(SECONDS * RATE_HZ) / RATE_HZ
    q = np.zeros((len(t), 3))
    for joint in range(3):
        for _ in range(4):
            hz = random.uniform(0.1, 0.6)
            q[:, joint] += random.uniform(0.2, 0.35) * np.sin(2 * np.pi * hz * t + random.uniform(0, 2 * np.pi))
    q *= np.minimum(1.0, t / 1.0)[:, None]
    return t, q, np.gradient(q, 1 / RATE_HZ, axis=0)


def record(path, seed, joint=None, law=None):
    model = mujoco.MjModel.from_xml_string(
        ARM.format(step=STEP_S, **{name: JOINT.format(*numbers) for name, numbers in FRICTION.items()}))
    data = mujoco.MjData(model)
    random = np.random.default_rng(1000 + seed)
    t, wanted, wanted_speed = reference(seed)
    data.qpos[:], data.qvel[:] = wanted[0], 0.0
    count, seen_before = 2 * math.pi / COUNTS, None
    mass = np.zeros((3, 3))
    with open(path, "w", encoding="utf-8") as file:
        file.write("t_s," + ",".join(f"q_ref{j}_rad,q{j}_rad,tau{j}_Nm" for j in (1, 2, 3)) + "\n")
        for k in range(len(t)):
            seen = count * np.round(data.qpos / count)
            speed = (seen - seen_before) * RATE_HZ if seen_before is not None else np.zeros(3)
            seen_before = seen
            torque = STIFFNESS * (wanted[k] - seen) + DAMPING * (wanted_speed[k] - speed)
            logged = torque + NOISE * random.standard_normal(3)
            file.write(f"{t[k]:.4f}," + ",".join(
                f"{wanted[k, j]:.9f},{seen[j]:.9f},{logged[j]:.6f}" for j in range(3)) + "\n")
            for _ in range(round(1 / (RATE_HZ * STEP_S))):
                data.qfrc_applied[:] = torque
                if law:
                    mujoco.mj_fullM(model, data, mass)
                    at = joint - 1
                    load = data.qfrc_bias[at] + mass[at] @ data.qacc
                    data.qfrc_applied[at] -= law(data.qpos[at], data.qvel[at], load)
                mujoco.mj_step(model, data)


def said_of(program, folder, case, seed):
    name, joint, law, right = case
    for file, own in (("train.csv", seed), ("unseen.csv", seed + 1)):
        record(folder / file, own, joint, law)
    (folder / "robot.toml").write_text(ROBOT, encoding="utf-8")
    (folder / "job.toml").write_text(JOB, encoding="utf-8")
    (folder / "r.h5").unlink(missing_ok=True)
    subprocess.run([program, "diagnose", "job.toml", "--out", "r.h5", "--json", "said.json", "--quiet"], cwd=folder,
                   check=True, stdout=subprocess.DEVNULL)
    said = json.loads((folder / "said.json").read_text(encoding="utf-8"))
    print(f"{name}: {said['reason']}", flush=True)
    problems = []
    for one in said["joints"]:
        names = [{effect["name"], *effect["equivalent"]} for effect in one["effects"]]
        if one["joint"] == joint:
            if not any(every & right for every in names):
                problems.append(f"{name}: nothing right at joint {joint}")
            after, before = one["augmented"]["validation_relerr"], one["baseline"]["validation_relerr"]
            if after is None or after > 0.8 * before:
                problems.append(f"{name}: the unseen error hardly falls")
        elif names:
            problems.append(f"{name}: a false name at joint {one['joint']}: {names}")
    return problems


def main():
    program = sys.argv[1]
    with tempfile.TemporaryDirectory() as folder:
        problems = [problem for k, case in enumerate(CASES)
                    for problem in said_of(program, pathlib.Path(folder), case, 10 * (k + 1))]
    for problem in problems:
        print(f"error: {problem}", file=sys.stderr)
    return 1 if problems else 0


if __name__ == "__main__":
    sys.exit(main())
