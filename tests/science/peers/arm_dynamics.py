"""Dynamics of arms as Pinocchio and MuJoCo of PyPI have them, to 1e-12 of their size. Skipped without the two.

    arm_dynamics.py PROGRAM        PROGRAM is the arm_dynamics of this folder

The others get robots of jobs/robots from a few lines of Python, and random URDFs by their own readers.
"""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[3]
try:
    import numpy as np
    import arms
    import libraries
except ImportError as missing:
    peers = ROOT / "build" / "peers"
    python = str(peers / "bin" / "python")
    if (peers / "installed").exists() and sys.executable != python:
        os.execv(python, [python, *sys.argv])
    print(f"skipped: {missing} (scripts/install-peers fetches Pinocchio and MuJoCo from PyPI)")
    sys.exit(77)

ROBOTS = ROOT / "jobs" / "robots"
BOUND = 1e-12
ASKED = {"torque", "gravity", "mass_matrix", "acceleration", "acceleration_of_base", "regressor"}
states_per_arm, random_urdfs = 20, 40
PINOCCHIO_ORDER = [0, 1, 2, 3, 4, 5, 7, 6, 8, 9]  # it has yy before xz


def all_arms():
    for k, path in enumerate(sorted(ROBOTS.glob("*.toml"))):
        yield arms.dh_arm(path, np.random.default_rng([42, k]))
    for k in range(random_urdfs):
        yield arms.random_urdf(k, np.random.default_rng([43, k]))


def states(size):
    random = np.random.default_rng([44, size])
    return [{key: random.uniform(-reach, reach, size).tolist()
             for key, reach in (("q", 3.0), ("dq", 2.0), ("ddq", 5.0), ("tau", 50.0))} for _ in range(states_per_arm)]


def ours(arm, asked):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / f"robot{arm.suffix}"
        path.write_text(arm.text, encoding="utf-8")
        told = subprocess.run([PROGRAM, path], input=json.dumps(asked), capture_output=True, text=True, check=True)
    return json.loads(told.stdout)


def carried(pose):
    """10 x 10: a body's numbers in a frame, from those in another whose `pose` is seen from the first."""
    columns = []
    for unit in np.eye(10):
        m, x, y, z, xx, xy, xz, yy, yz, zz = unit
        inertia = np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])
        pseudo = np.zeros((4, 4))  # [integral r r' dm, first moment; first moment', mass]
        pseudo[:3, :3], pseudo[:3, 3], pseudo[3, :3], pseudo[3, 3] = (0.5 * np.trace(inertia) * np.eye(3) - inertia,
                                                                      (x, y, z), (x, y, z), m)
        pseudo = pose @ pseudo @ pose.T
        moments = pseudo[:3, :3]
        columns.append([pseudo[3, 3], *pseudo[:3, 3], *(np.trace(moments) * np.eye(3) - moments)[np.triu_indices(3)]])
    return np.array(columns).T


def condition(answers, n):
    """Of the base columns, scaled: an arm that is almost, not quite, at right angles has base parameters of few
    digits."""
    rows = np.vstack([np.reshape(told["regressor"], (n, -1))[:, answers["base"]] for told in answers["states"]])
    return np.linalg.cond(rows / np.linalg.norm(rows, axis=0))


def theirs_of(other, what, state, told):
    """What the other library says, in a row; None where it says nothing."""
    q, dq, ddq, tau = (np.array(state[key]) for key in ("q", "dq", "ddq", "tau"))
    if what == "torque":
        return other.torque(q, dq, ddq)
    if what == "gravity":
        return other.gravity(q)
    if what == "mass_matrix":
        return other.mass_matrix(q).ravel()
    if what.startswith("acceleration"):
        return other.acceleration(q, dq, tau)
    if what == "regressor" and hasattr(other, "regressor_and_frames"):
        columns, frames = other.regressor_and_frames(q, dq, ddq)
        n = len(frames)
        columns = columns.reshape(n, n, 10)[:, :, PINOCCHIO_ORDER]
        mine = [np.reshape(frame, (4, 4)) for frame in told["frames"]]
        links = [columns[:, k] @ carried(np.linalg.inv(frames[k]) @ mine[k]) for k in range(n)]
        return np.hstack([np.stack(links, axis=1).reshape(n, -1), np.diag(ddq)]).ravel()
    return None


class ArmDynamics(unittest.TestCase):
    def compare(self, library):
        worst = {}
        for arm in all_arms():
            other = library(arm)
            asked = states(other.size())
            answers = ours(arm, asked)
            few_digits = max(BOUND, 4 * np.finfo(float).eps * condition(answers, other.size()))
            for what in answers["states"][0]:
                mine = np.array([told[what] for told in answers["states"]])
                theirs = [theirs_of(other, what, *pair) for pair in zip(asked, answers["states"])]
                if theirs[0] is None:
                    continue
                size = np.linalg.norm(theirs) / np.sqrt(len(theirs))
                error = np.linalg.norm(mine - theirs, axis=1).max() / size
                worst[what] = max(worst.get(what, 0.0), error)
                with self.subTest(library=library.name, arm=arm.name, what=what):
                    self.assertLess(error, few_digits if what == "acceleration_of_base" else BOUND)
        print(library.name, {what: f"{size:.1e}" for what, size in worst.items()})
        return worst

    def test_is_that_of_pinocchio(self):
        self.assertEqual(set(self.compare(libraries.Pinocchio)), ASKED)

    def test_is_that_of_mujoco(self):
        self.assertEqual(set(self.compare(libraries.Mujoco)), ASKED - {"regressor"})


if __name__ == "__main__":
    PROGRAM = sys.argv.pop(1)
    unittest.main()
