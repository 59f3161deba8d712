"""A short noisy recording of an arm: `consistent` gives links that exist, at a held-out error like that of `wls`.

The exported URDF is read here, and every link must be a body: the second moments of mass about its centre are positive
definite. A file's masses are wrong by up to a half, or there are none.
"""

import xml.etree.ElementTree as ElementTree

import numpy as np
from arm import Motion
from arm_files import Taken, draw_case

# held-out error over that of wls; absolute: a recording that both fit to noise
MOST, FLOOR = 1.1, 0.002


def first_seconds(rng, taken, seconds, noise):
    n = int(seconds / (taken.motion.time[1] - taken.motion.time[0]))
    part = Motion(*(signal[:n] for signal in vars(taken.motion).values()))
    return Taken(part, taken.torque[:n] + noise * taken.torque.std(0) * rng.standard_normal((n, taken.torque.shape[1])))


def no_body(link):
    """What is wrong with a link of a URDF, or None."""
    inertial = link.find("inertial")
    if inertial is None:
        return f"{link.get('name')} has no inertia"
    mass = float(inertial.find("mass").get("value"))
    moment = {name: float(value) for name, value in inertial.find("inertia").attrib.items()}
    about = np.array([[moment["ixx"], moment["ixy"], moment["ixz"]], [moment["ixy"], moment["iyy"], moment["iyz"]],
                      [moment["ixz"], moment["iyz"], moment["izz"]]])
    least = np.linalg.eigvalsh(0.5 * np.trace(about) * np.eye(3) - about)[0]
    return None if mass > 0 and least > 0 else f"{link.get('name')}: mass {mass:.3g}, least second moment {least:.3g}"


def draw(rng, folder):
    seconds, noise, off = rng.uniform(8, 15), rng.uniform(0.02, 0.2), rng.uniform(0.0, 0.5)
    case = draw_case(rng, off=off, is_urdf=True)
    case.train = first_seconds(rng, case.train, seconds, noise)
    case.write(rng, folder)
    with open(folder / "job.toml", "a", encoding="utf-8") as job:
        job.write('\n[[estimator]]\nname = "consistent"\n')
    label = (f"{len(case.joints)} joints {seconds:.1f} s noise {noise:.2g} "
             f"{f'masses off {off:.2g}' if case.inertias else 'no masses'}")

    def judge(call):
        answer = call("run", "job.toml")
        if answer.code:
            return f"{label}: {answer.text[-300:]}"
        wls, ours = answer.document["estimators"]
        pushes = [one["name"] for one in ours["parameters"]
                  if one["name"].startswith(("viscous", "coulomb")) and not one["value"] > 0]
        if pushes:
            return f"{label}: {pushes} push"
        exported = call("export", "job.h5", "--estimator", "consistent", "--urdf", "out.urdf", json_file=False)
        if exported.code:
            return f"{label}: {exported.text[-300:]}"
        links = ElementTree.parse(folder / "out.urdf").getroot().findall("link")
        wrong = [no_body(link) for link in links[1 : len(case.joints) + 1]]  # between the base and the tool
        if any(wrong) or len(wrong) < len(case.joints):
            return f"{label}: {wrong}"
        error, least = (one["arm"]["validation_relerr_all_rows"] for one in (ours, wls))
        return None if error < MOST * least + FLOOR else f"{label}: held-out {100 * error:.2f}, wls {100 * least:.2f} %"

    return judge
