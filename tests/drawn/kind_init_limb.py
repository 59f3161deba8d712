"""An arm or leg of a robot whose base floats or that has other limbs, as URDF: `init` names the ends, takes root and
tip, and its draft runs with the error of the fit near the noise.
"""

import numpy as np
from arm_files import draw_case


def other_limb(rng, base):
    """Joints and links of a second limb."""
    text, parent = "", base
    for k in range(int(rng.integers(1, 4))):
        text += (f'<link name="other_{k}"/><joint name="other_joint_{k}" type="revolute"><parent link="{parent}"/>'
                 f'<child link="other_{k}"/><axis xyz="0 1 0"/>'
                 '<limit lower="-1" upper="1" effort="10" velocity="5"/></joint>')
        parent = f"other_{k}"
    return text


def draw(rng, folder):
    case = draw_case(rng, is_urdf=True)
    case.columns = ("t", "{name}_position", "{name}_torque")
    case.write(rng, folder)
    floats, has_other = rng.random() < 0.6, rng.random() < 0.7
    has_other = has_other or not floats
    text = (folder / "arm.urdf").read_text()
    more = other_limb(rng, "base") if has_other else ""
    if floats:
        more += ('<link name="world"/><joint name="free" type="floating"><parent link="world"/><child link="base"/>'
                 "</joint>")
    (folder / "arm.urdf").write_text(text.replace("</robot>", more + "\n</robot>"))
    (folder / "job.toml").unlink()
    tip = f"l{len(case.joints)}"
    label = f"{len(case.joints)} joints, {'floating, ' if floats else ''}{'two limbs' if has_other else 'one limb'}"

    def judge(call):
        asked = call("init", "train.csv", "--robot", "arm.urdf", json_file=False)
        words = " ".join(asked.text.split())
        if asked.code != 78 or (has_other and f'tip = "{tip}"' not in words) or (
                floats and 'root = "base"' not in words):
            return f"{label}: {asked.code} {asked.text[-400:]}"
        made = call("init", "train.csv", "unseen.csv", "--robot", "arm.urdf", "--root", "base", "--tip", tip, "--out",
                    "drafted.toml", json_file=False)
        if made.code:
            return f"{label}: init {made.code} {made.text[-400:]}"
        run = call("run", "drafted.toml", "--out", "drafted.h5")
        if run.code:
            return f"{label}: run {run.code} {run.text[-400:]}"
        errors = np.array(run.document["estimators"][0]["arm"]["validation_joint_relerr"], float)
        return f"{label}: errors {errors}" if errors.max() > 0.2 else None

    return judge
