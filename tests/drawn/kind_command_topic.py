"""An arm whose commanded positions are in another topic than its joint states, as PlotJuggler and ros2 topic echo
--csv write them. Mistake of the program it draws for: the command taken for the position, another joint's command, or
none. `init --joint NAME` must find all three columns of the joint, and the draft must run as it stands.
"""

from joint import draw_joint, record, write_csv

NAMES = ["shoulder_pan", "elbow", "wrist_roll", "base", "joint_a", "left_knee", "arm_joint_1", "j2"]
TOPICS = ["/joint_commands", "/joint_command", "/desired_joint_states", "/joint_goals", "/target_joint_states",
          "/joint_cmd", "/joint_setpoint"]


def motions(rng, joints):
    """A recording of each joint on one clock: its own motion, and the command that makes it."""
    rate = float(rng.choice([200, 250, 500]))
    return [record(rng, draw_joint(rng), seconds=20.0, rate=rate) for _ in range(joints)]


def plotjuggler(rng, folder, names, arm):
    """Columns of both topics in a drawn order; returns the columns of a joint."""
    topic, field = TOPICS[int(rng.integers(len(TOPICS)))], str(rng.choice(["position", "positions"]))
    states = {f"/joint_states/{name}/{key}": getattr(one, signal) for name, one in zip(names, arm)
              for key, signal in (("position", "position"), ("effort", "torque"))}
    commands = {f"{topic}/{name}/{field}": one.reference for name, one in zip(names, arm)}
    first, second = (states, commands) if rng.random() < 0.5 else (commands, states)
    write_csv(folder / "arm.csv", {"__time": arm[0].time, **first, **second}, form="%.12g")
    return lambda name: (f"/joint_states/{name}/position", f"/joint_states/{name}/effort", f"{topic}/{name}/{field}")


def echo(rng, folder, names, arm):
    """Rows of control_msgs/JointTrajectoryControllerState, old or new, with the effort in the measured point."""
    is_new = rng.random() < 0.5
    rows = []
    for k, time in enumerate(arm[0].time):
        nanoseconds = round(time * 1e9)
        wanted, found, torque = ([f"{getattr(one, key)[k]:.12g}" for one in arm]
                                 for key in ("reference", "position", "torque"))
        error = [f"{one.reference[k] - one.position[k]:.12g}" for one in arm]
        points = [[*wanted, "", "", ""], [*found, "", "", *torque], [*error, "", "", ""]]
        points += [["", "", "", ""]] if is_new else []
        cells = [1768472944 + nanoseconds // 10**9, nanoseconds % 10**9, "base", *names]
        cells += [cell for point in points for cell in (*point, 0, 0)] + ([""] * 3 if is_new else [])
        rows.append(",".join(map(str, cells)))
    (folder / "arm.csv").write_text("\n".join(rows) + "\n")
    return lambda name: (f"{name}/feedback.position", f"{name}/feedback.effort", f"{name}/reference.position")


def draw(rng, folder):
    names = [NAMES[k] for k in rng.permutation(len(NAMES))[:int(rng.integers(1, 6))]]
    write = plotjuggler if rng.random() < 0.6 else echo
    columns_of = write(rng, folder, names, motions(rng, len(names)))
    name = names[int(rng.integers(len(names)))]

    def judge(call):
        made = call("init", "arm.csv", "--joint", name, "--out", "job.toml", json_file=False)
        if made.code != 0:
            return f"init ends with {made.code}: {made.text[-300:]}"
        job = (folder / "job.toml").read_text()
        for channel, column in zip(("position", "torque", "reference"), columns_of(name)):
            if f'{channel} = "{column}"' not in job:
                return f"{channel} is not {column} of {', '.join(names)}"
        checked = call("check", "job.toml")
        return None if checked.code == 0 else f"check ends with {checked.code}: {checked.text[-300:]}"
    return judge
