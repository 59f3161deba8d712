"""Arms that Pinocchio and MuJoCo get without our code: robots of jobs/robots with drawn inertias, and random URDFs."""
import dataclasses
import math
import tomllib

import numpy as np


def turned(axis, angle):
    """Rodrigues' formula."""
    x, y, z = axis
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(angle) * cross + (1 - math.cos(angle)) * cross @ cross


def pose(rotation, position):
    made = np.eye(4)
    made[:3, :3], made[:3, 3] = rotation, position
    return made


@dataclasses.dataclass
class Body:
    """About the centre of mass, along the axes of the frame that it is given in."""
    mass: float
    centre: np.ndarray
    inertia: np.ndarray

    @staticmethod
    def drawn(random):
        """Ten point masses around a centre: a body of positive density."""
        masses = random.uniform(0.1, 0.8, 10)
        points = random.uniform(-0.3, 0.3, 3) + random.uniform(-0.2, 0.2, (10, 3))
        centre = masses @ points / masses.sum()
        away = points - centre
        inertia = sum(m * (r @ r * np.eye(3) - np.outer(r, r)) for m, r in zip(masses, away))
        return Body(masses.sum(), centre, inertia)

    def six(self):
        return self.inertia[np.triu_indices(3)]  # xx, xy, xz, yy, yz, zz


@dataclasses.dataclass
class Joint:
    """A joint about or along z of a frame, which `place` puts into the frame of the joint before."""
    name: str
    slides: bool
    place: np.ndarray
    body: Body
    drive_inertia: float


@dataclasses.dataclass
class Arm:
    name: str
    text: str            # what our reader gets
    suffix: str
    gravity: np.ndarray
    joints: list         # of a robot of jobs/robots; none of a URDF, which others read themselves
    offsets: np.ndarray  # added to q before the others see it


def dh_arm(path, random):
    """A robot file with drawn inertias. What a standard joint does behind its turn goes before the next one."""
    with open(path, "rb") as file:
        robot = tomllib.load(file)
    is_standard = robot["robot"]["convention"] == "standard_dh"
    lines = ["[robot]", f'convention = "{robot["robot"]["convention"]}"', "gravity = [1.0, -2.0, -9.0]"]
    joints, before = [], np.eye(4)
    for number in robot["joint"]:
        a, alpha, d = (number.get(key, 0.0) for key in ("a_m", "alpha_rad", "d_m"))
        swung = pose(turned((1, 0, 0), alpha), (a, 0, 0))
        raised = pose(np.eye(3), (0, 0, d))
        body, drive = Body.drawn(random), random.uniform(0.1, 1.0)
        behind = raised @ swung
        seen = Body(body.mass, behind[:3, :3] @ body.centre + behind[:3, 3], behind[:3, :3] @ body.inertia
                    @ behind[:3, :3].T) if is_standard else body
        joints.append(Joint(number["name"], number.get("type") == "prismatic",
                            before if is_standard else swung @ raised, seen, drive))
        before = behind if is_standard else np.eye(4)
        lines += ["[[joint]]", f'name = "{number["name"]}"', *(f"{key} = {number[key]!r}" for key in
                  ("a_m", "alpha_rad", "d_m", "offset_rad") if key in number), f"drive_inertia = {drive!r}",
                  f"mass_kg = {float(body.mass)!r}", f"centre_m = {body.centre.tolist()}",
                  f"inertia_kgm2 = {body.six().tolist()}"]
    offsets = np.array([number.get("offset_rad", 0.0) for number in robot["joint"]])
    return Arm(path.stem, "\n".join(lines) + "\n", ".toml", np.array([1.0, -2.0, -9.0]), joints, offsets)


def words(numbers):
    return " ".join(repr(float(number)) for number in numbers)


def origin(random):
    return f'<origin xyz="{words(random.uniform(-0.5, 0.5, 3))}" rpy="{words(random.uniform(-3, 3, 3))}"/>'


def link_text(name, body, random):
    parts = zip(("ixx", "ixy", "ixz", "iyy", "iyz", "izz"), body.six())
    attributes = " ".join(f'{part}="{float(number)!r}"' for part, number in parts)
    # a frame of inertia that is turned is the same body turned: no rule of the reader is spared
    turn = words(random.uniform(-3, 3, 3))
    return (f'<link name="{name}"><inertial><origin xyz="{words(body.centre)}" rpy="{turn}"/>'
            f'<mass value="{float(body.mass)!r}"/><inertia {attributes}/></inertial></link>')


def random_urdf(number, random):
    """1 to 7 moving joints about any axis, fixed ones between them."""
    links, joints = ['<link name="base"/>'], []
    parent = "base"
    for moving in range(1 + random.integers(7)):
        for kind in ["fixed"] * random.integers(3) + [random.choice(["revolute", "continuous", "prismatic"])]:
            name = f"link_{len(joints)}"
            axis = random.normal(size=3)
            limit = '<limit lower="-9" upper="9" effort="9" velocity="9"/>' if kind in ("revolute", "prismatic") else ""
            turns = "" if kind == "fixed" else f'<axis xyz="{words(axis / np.linalg.norm(axis))}"/>'
            joints.append(f'<joint name="joint_{len(joints)}" type="{kind}"><parent link="{parent}"/><child '
                          f'link="{name}"/>{origin(random)}{turns}{limit}</joint>')
            links.append(link_text(name, Body.drawn(random), random))
            parent = name
    text = "\n".join(['<?xml version="1.0"?>', f'<robot name="random_{number}">', *links, *joints, "</robot>"])
    return Arm(f"random URDF {number}", text, ".urdf", np.array([0, 0, -9.81]), [], np.zeros(1))
