"""A simulated arm identified, exported in every format far from its robot file, and read again: the same arm.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/arm_export_cli.py
"""

import json
import os
import re
import shutil
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import arm_simulation_cli as simulated  # noqa: E402
import program  # noqa: E402

# the arm of the simulated one, with everything a robot file may say of its joints
ROBOT = simulated.ROBOT
for inertia, effort, gear in (("0.2", 90, 50), ("0.1", 40, 80)):
    ROBOT = ROBOT.replace(f"drive_inertia = {inertia}", f"max_torque = {effort}.0\ngear_ratio = {gear}\n"
                          f"encoder_counts = 4096\ndrive_inertia = {inertia}")
HEAD, excite, SIMULATE = simulated.JOB.partition("[excite]")
SIMULATE = excite + SIMULATE

RECORDING = """
[recording]
train = "recording.csv"
columns = {time = "t_s", position = "q{j}_rad", torque = "tau{j}_Nm"}
"""

FORMATS = ("urdf", "toml", "json", "mjcf")


class Export(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_export_")
        self.addCleanup(shutil.rmtree, self.folder)
        for name in ("lab", "away"):
            os.mkdir(self.path(name))

    def path(self, *names):
        return os.path.join(self.folder, *names)

    def write(self, text, *names):
        with open(self.path(*names), "w", encoding="utf-8") as file:
            file.write(text)

    def read(self, *names):
        with open(self.path(*names), encoding="utf-8") as file:
            return file.read()

    def here(self, *arguments, folder="lab"):
        done = program.run(*arguments, folder=self.path(folder))
        self.assertEqual(done.code, 0, done.err)
        return done

    def job(self, name, robot, drives, rest):
        head = HEAD.replace("arm_robot.toml", robot).replace(
            "friction = ", f"drive_inertia = {'true' if drives else 'false'}\nfriction = ")
        self.write(head + rest, "lab", name + ".toml")

    def identified(self, robot, drives):
        """Simulates and identifies; moves the result away from its robot file, exports it there in every format and
        brings the files back. Returns the distance in standard errors that the export tells."""
        self.write(robot, "lab", "arm_robot.toml")
        self.job("sim", "arm_robot.toml", drives, SIMULATE)
        self.here("excite", "sim.toml", "--out", "motion.csv")
        self.job("sim", "arm_robot.toml", drives, SIMULATE + '\n[simulate.reference]\nfile = "motion.csv"\n')
        self.here("simulate", "sim.toml", "--out", "recording.csv")
        self.job("first", "arm_robot.toml", drives, RECORDING)
        self.here("run", "first.toml", "--out", "first.h5")
        shutil.copy(self.path("lab", "first.h5"), self.path("away", "first.h5"))
        os.remove(self.path("lab", "arm_robot.toml"))
        files = [word for format in FORMATS for word in ("--" + format, "arm." + format)]
        told = self.here("export", "first.h5", *files, folder="away")
        self.assertNotIn("warning", told.err)
        for format in FORMATS:
            shutil.copy(self.path("away", "arm." + format), self.path("lab", "arm_out." + format))
        return float(re.search(r"([\d.e+-]+) standard errors away", told.said)[1])

    def read_again(self, robot, drives):
        """The result of the same recording with the exported file: its regressors and the file's own parameters."""
        self.assertIn("base parameters", self.here("describe", robot).out)
        self.job("again", robot, drives, RECORDING)
        self.here("run", "again.toml", "--out", "again_" + robot.replace(".", "_") + ".h5")
        return self.path("lab", "again_" + robot.replace(".", "_") + ".h5")

    def away_in_standard_errors(self, again):
        """Rigid torque of the exported bodies less that of the estimate, over the noise of each joint, beyond what the
        joint's own friction takes up."""
        squares = 0.0
        with h5py.File(self.path("lab", "first.h5"), "r", locking=False) as first, \
                h5py.File(again, "r", locking=False) as second:
            values = first["runs/wls/parameters"][0]
            for joint, noise in enumerate(first["arm/noise"][:], start=1):
                torque = []
                for file, parameters in ((first, values), (second, second["robot/file_values"][:])):
                    own, base = file[f"arm/joint_{joint}/parameters"][:], len(file["robot/base_parameters"])
                    phi = file[f"data/train/joint_{joint}/regressor"][:]
                    torque.append(phi[:, own < base] @ parameters[own[own < base]])
                    friction = phi[:, own >= base]
                difference = torque[1] - torque[0]
                difference -= friction @ np.linalg.lstsq(friction, difference, rcond=None)[0]
                squares += float((difference**2).sum()) / noise**2
        return squares**0.5

    def test_every_format_is_whole(self):
        self.identified(ROBOT, True)
        joints = xml.fromstring(self.read("lab", "arm_out.urdf").encode()).findall("joint")
        limits = {joint.get("name"): joint.find("limit").attrib for joint in joints if joint.find("limit") is not None}
        self.assertEqual((limits["shoulder"]["lower"], limits["shoulder"]["upper"]), ("-1.2", "1.2"))
        self.assertEqual((limits["elbow"]["effort"], limits["elbow"]["velocity"]), ("40", "2"))
        self.assertEqual(xml.fromstring(self.read("lab", "arm_out.mjcf").encode()).tag, "mujoco")
        self.assertIn("shoulder", json.dumps(json.loads(self.read("lab", "arm_out.json"))))
        toml = self.read("lab", "arm_out.toml")
        for line in ("gear_ratio = 80", "lower = -1.2", "max_torque = 90", "max_acceleration = 9"):
            self.assertIn(line, toml)
        counts = [float(count) for count in re.findall(r"encoder_counts = ([\d.e+]+)", toml)]
        np.testing.assert_allclose(counts, [4096, 4096], rtol=1e-12)

    def test_the_toml_file_has_the_torque_of_the_estimate(self):
        distance = self.identified(ROBOT, True)
        away = self.away_in_standard_errors(self.read_again("arm_out.toml", True))
        self.assertLessEqual(away, 1.01 * distance + 1e-3)
        self.job("resim", "arm_out.toml", True, SIMULATE + '\n[simulate.reference]\nfile = "motion.csv"\n')
        self.here("simulate", "resim.toml", "--out", "recording_again.csv")

    def test_the_urdf_file_has_the_torque_of_the_estimate(self):
        """URDF has no drive inertias: an arm without them loses nothing."""
        distance = self.identified(re.sub(r"drive_inertia = .*\n", "", ROBOT), False)
        away = self.away_in_standard_errors(self.read_again("arm_out.urdf", False))
        self.assertLessEqual(away, 1.01 * distance + 1e-3)


if __name__ == "__main__":
    unittest.main()
