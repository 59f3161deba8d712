"""A simulated serial arm of drawn structure, for recordings of arms with a drawn mistake in them.

Joints are placed by a fixed turn and shift and move about, or along, their own z axis. Torques come from the recursive
Newton-Euler equations over all samples at once; motions are sums of sines, so no integration errs. Drives add their
inertia, viscous and Coulomb friction and an offset; sensors add noise and an encoder's steps. No code of the engine.
Units: s, rad (m), rad/s, N m (N), kg. Arrays of a motion have the shape [samples, joints].
"""

import dataclasses

import numpy as np

GRAVITY = np.array([0.0, 0.0, -9.81])


def about(axis, angle):
    """Rotation matrix about x, y or z (0, 1, 2)."""
    cosine, sine = np.cos(angle), np.sin(angle)
    turn = np.eye(3)
    a, b = (axis + 1) % 3, (axis + 2) % 3
    turn[a, a] = turn[b, b] = cosine
    turn[a, b], turn[b, a] = -sine, sine
    return turn


@dataclasses.dataclass(frozen=True)
class Joint:
    """Modified Denavit-Hartenberg numbers, the link behind it in the joint's frame, and the drive."""

    a: float
    alpha: float
    d: float
    offset: float
    slides: bool
    mass: float
    centre: np.ndarray
    inertia: np.ndarray  # about the centre, [3, 3]
    drive: float = 0.0  # inertia of the rotor at the joint
    gear: float = 1.0
    lower: float = -3.0
    upper: float = 3.0
    speed: float = 4.0

    def place(self):
        """Turn and shift from the frame before to that at position 0."""
        turn = about(0, self.alpha)
        return turn @ about(2, self.offset), turn @ np.array([0.0, 0.0, self.d]) + np.array([self.a, 0.0, 0.0])


@dataclasses.dataclass(frozen=True)
class Friction:
    """Each [joints]; stribeck: more Coulomb friction at rest; load: of each N m that the gear carries."""

    viscous: np.ndarray
    coulomb: np.ndarray
    offset: np.ndarray
    stribeck: np.ndarray
    stribeck_speed: float
    load: np.ndarray
    coupled: np.ndarray  # [joints, joints] viscous

    def torque(self, speed, carried):
        level = self.coulomb + self.stribeck * np.exp(-((speed / self.stribeck_speed) ** 2)) + self.load * abs(carried)
        return self.viscous * speed + level * np.sign(speed) + self.offset + speed @ self.coupled.T


@dataclasses.dataclass
class Motion:
    time: np.ndarray
    q: np.ndarray
    dq: np.ndarray
    ddq: np.ndarray


@dataclasses.dataclass
class Push:
    """What surroundings do to the last link: force and moment [samples, 3] about the origin of a frame that `turn` and
    `shift` place in the last joint's, along that frame's axes or along those of the base."""

    force: np.ndarray
    moment: np.ndarray
    turn: np.ndarray
    shift: np.ndarray
    along_base: bool = False


def link_torque(joints, motion, gravity=GRAVITY, push_at_tip=None):
    """Torques [samples, joints] that carry and accelerate the links: recursive Newton-Euler, without drives."""
    n, samples = len(joints), len(motion.q)
    turns, shifts = [], []
    spin, swing = np.zeros((samples, 3)), np.zeros((samples, 3))  # angular velocity and acceleration of the link
    push = np.tile(-np.asarray(gravity), (samples, 1))  # linear acceleration of the link's origin
    forces, moments = [], []
    axis = np.array([0.0, 0.0, 1.0])
    for j, joint in enumerate(joints):
        fixed, shift = joint.place()
        angle = np.zeros(samples) if joint.slides else motion.q[:, j]
        moved = np.zeros((samples, 3, 3))
        moved[:, 0, 0] = moved[:, 1, 1] = np.cos(angle)
        moved[:, 1, 0], moved[:, 0, 1] = np.sin(angle), -np.sin(angle)
        moved[:, 2, 2] = 1.0
        turn = fixed @ moved  # link j seen from the one before
        along = np.tile(shift, (samples, 1))
        rate, change = motion.dq[:, j, None] * axis, motion.ddq[:, j, None] * axis
        if joint.slides:
            along = along + motion.q[:, j, None] * (fixed @ axis)
        origin = push + np.cross(swing, along) + np.cross(spin, np.cross(spin, along))

        def here(vector, turn=turn):
            return np.einsum("sji,sj->si", turn, vector)

        spin, swing, push = here(spin), here(swing), here(origin)
        if joint.slides:
            push = push + change + 2.0 * np.cross(spin, rate)
        else:
            swing = swing + change + np.cross(spin, rate)
            spin = spin + rate
        at_centre = push + np.cross(swing, joint.centre) + np.cross(spin, np.cross(spin, joint.centre))
        forces.append(joint.mass * at_centre)
        moments.append(swing @ joint.inertia + np.cross(spin, spin @ joint.inertia))
        turns.append(turn)
        shifts.append(along)
    torque = np.empty((samples, n))
    force, moment = np.zeros((samples, 3)), np.zeros((samples, 3))
    if push_at_tip:
        into = np.tile(push_at_tip.turn, (samples, 1, 1))  # from the axes of the push to those of the last link
        if push_at_tip.along_base:
            into = np.tile(np.eye(3), (samples, 1, 1))
            for turn in turns:
                into = np.einsum("sji,sjk->sik", turn, into)
        force = -np.einsum("sij,sj->si", into, push_at_tip.force)
        moment = -np.einsum("sij,sj->si", into, push_at_tip.moment) + np.cross(push_at_tip.shift, force)
    for j in reversed(range(n)):
        if j + 1 < n:
            force = np.einsum("sij,sj->si", turns[j + 1], force)
            moment = np.einsum("sij,sj->si", turns[j + 1], moment) + np.cross(shifts[j + 1], force)
        force, moment = force + forces[j], moment + moments[j] + np.cross(joints[j].centre, forces[j])
        torque[:, j] = (force if joints[j].slides else moment)[:, 2]
    return torque


RIGHT = np.pi / 2


def structure(rng, kind, n):
    """(alpha, a, d, offset, slides) of each joint. The first axis is vertical."""
    def length():
        return rng.uniform(0.18, 0.45)

    def some(value):
        return value if rng.random() < 0.5 else 0.0

    first = (0.0, 0.0, rng.uniform(0.1, 0.4), 0.0, False)
    side = rng.choice([-1.0, 1.0])
    shoulder = (side * RIGHT, some(rng.uniform(0.02, 0.15)), some(rng.uniform(-0.1, 0.1)), some(-RIGHT), False)
    elbow = (0.0, length(), some(rng.uniform(-0.08, 0.08)), some(RIGHT), False)
    if kind == "planar":
        return [first, shoulder, elbow, *[(0.0, length(), 0.0, some(RIGHT), False) for _ in range(n - 3)]]
    if kind == "slide":
        out = (side * RIGHT, some(0.05), length(), 0.0, True)
        tail = [(-side * RIGHT, 0.0, 0.0, some(RIGHT), False),
                (side * RIGHT, some(0.06), rng.uniform(0.05, 0.15), 0.0, False)]
        return [first, shoulder, out, *tail][:n]
    roll = (side * RIGHT, some(rng.uniform(0.01, 0.06)), length(), 0.0, False)
    pitch = (-side * RIGHT, 0.0, some(rng.uniform(0.05, 0.1)), 0.0, False)
    last = (side * RIGHT, some(rng.uniform(0.02, 0.08)), rng.uniform(0.05, 0.12), 0.0, False)
    return [first, shoulder, elbow, roll, pitch, last][:n]


def draw_joints(rng, kind=None, n=None):
    """3 to 6 joints: "planar", "wrist" (anthropomorphic) or "slide"."""
    kind = kind or rng.choice(["planar", "wrist", "wrist", "slide"], p=[0.35, 0.25, 0.25, 0.15])
    n = n or int(rng.integers(3, {"planar": 5, "wrist": 7, "slide": 6}[str(kind)]))
    frames = structure(rng, kind, n)
    joints = []
    scale = 10 ** rng.uniform(-0.3, 0.7)
    for j, (alpha, a, d, offset, slides) in enumerate(frames):
        following = frames[j + 1] if j + 1 < n else (0.0, rng.uniform(0.05, 0.2), 0.0, 0.0, False)
        reach = np.array([following[1], -np.sin(following[0]) * following[2], np.cos(following[0]) * following[2]])
        size = max(np.linalg.norm(reach), 0.1)
        mass = scale * 2.5 * 0.7**j * rng.uniform(0.6, 1.6)
        centre = rng.uniform(0.3, 0.6) * reach + rng.uniform(-0.02, 0.02, 3)
        sides = rng.uniform(0.05, 0.12, 3) + np.abs(reach) * rng.uniform(0.8, 1.0)
        box = mass / 12 * np.diag((sides**2).sum() - sides**2)
        turn = np.linalg.qr(np.eye(3) + rng.uniform(-0.1, 0.1, (3, 3)))[0]
        limit = rng.uniform(1.6, 3.0) if not slides else rng.uniform(0.1, 0.2)
        middle = 0.0 if rng.random() < 0.6 else rng.uniform(-0.4, 0.4) * limit
        joints.append(Joint(
            a, alpha, d, offset, slides, mass, centre, turn @ box @ turn.T,
            drive=mass * size**2 * rng.uniform(0.0, 0.5) if rng.random() < 0.7 else 0.0,
            gear=float(rng.choice([50, 80, 100, 101, 120, 160])), lower=middle - limit, upper=middle + limit,
            speed=float(np.round(rng.uniform(2.5, 4.0), 2))))
    return joints


def point_inertia(mass, shift):
    return mass * (shift @ shift * np.eye(3) - np.outer(shift, shift))


def loaded(joints, mass, place):
    """The arm with a small ball at this place of its last link."""
    last = joints[-1]
    whole = last.mass + mass
    centre = (last.mass * last.centre + mass * place) / whole
    moved = point_inertia(last.mass, last.centre - centre) + point_inertia(mass, place - centre)
    inertia = last.inertia + moved + mass * 1e-3 * np.eye(3)
    return [*joints[:-1], dataclasses.replace(last, mass=whole, centre=centre, inertia=inertia)]


def draw_motion(rng, joints, seconds, rate, vigour):
    """Sums of sines within limits; `vigour` is the share of the range that is used."""
    time = np.arange(int(seconds * rate)) / rate
    columns = []
    for joint in joints:
        waves = int(rng.integers(4, 8))
        angular = 2 * np.pi * rng.uniform(0.05, 0.6, waves)
        phases = rng.uniform(0, 2 * np.pi, waves)
        amplitudes = rng.uniform(0.4, 1.0, waves) / (0.3 + angular)
        angles = np.outer(time, angular) + phases
        q, dq = np.sin(angles) @ amplitudes, np.cos(angles) @ (amplitudes * angular)
        ddq = -np.sin(angles) @ (amplitudes * angular**2)
        half = 0.5 * (joint.upper - joint.lower)
        share = min(vigour * half / abs(q).max(), 0.9 * joint.speed / abs(dq).max())
        middle = 0.5 * (joint.upper + joint.lower)
        columns.append((middle + share * q, share * dq, share * ddq))
    return Motion(time, *(np.column_stack(part) for part in zip(*columns)))


def draw_friction(rng, torque, motion, small=0.0):
    """In proportion to the torque of the links and the speeds; nothing but the plain terms."""
    n = torque.shape[1]
    size = np.sqrt((torque**2).mean(0)) + 0.05 * np.sqrt((torque**2).mean(0)).max() + small
    speed = abs(motion.dq).max(0)
    return Friction(
        viscous=size * rng.uniform(0.05, 0.3, n) / speed, coulomb=size * rng.uniform(0.05, 0.25, n),
        offset=size * rng.uniform(-0.05, 0.05, n), stribeck=np.zeros(n), stribeck_speed=0.1, load=np.zeros(n),
        coupled=np.zeros((n, n)))


def full_torque(joints, motion, friction, gravity=GRAVITY):
    links = link_torque(joints, motion, gravity)
    drives = motion.ddq * np.array([joint.drive for joint in joints])
    return links + drives + friction.torque(motion.dq, links)
