"""Models of a diagnosis exported as C, JSON and MJCF: compiled and compared with equations written here by hand.

Use: TORQUESCOPE=... TORQUESCOPE_EXAMPLE_DIAGNOSIS=build/dev/bin/write_example_diagnosis
     /usr/bin/python3 tests/jobs/model_export_cli.py
"""

import json
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as xml

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402

WRITER = os.environ["TORQUESCOPE_EXAMPLE_DIAGNOSIS"]
COMPILER = shutil.which("cc") or shutil.which("gcc")
MAIN = """#include <stdio.h>
int main(void) {
  double q, dq, ddq;
  while (scanf("%lf %lf %lf", &q, &dq, &ddq) == 3) printf("%.17g\\n", joint_1_torque(q, dq, ddq));
  return 0;
}
"""
MOTION = ((0.3, -0.2, 1.5), (-0.7, 0.04, -2.0), (0.1, -0.03, 0.5), (0.2, 1.1, 0.0))


class Models(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="torquescope_models_")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        subprocess.run([WRITER, os.path.join(cls.folder, "told.h5"), "named"], check=True, capture_output=True)

    def export(self, *arguments):
        return program.run("export", "told.h5", *arguments, folder=self.folder)

    def model(self):
        done = self.export("--json", "-")
        self.assertEqual(done.code, 0, done.err)
        return json.loads(done.out)["joints"][0]

    @unittest.skipUnless(COMPILER, "no C compiler here")
    def test_the_c_function_compiles_and_gives_the_torque_of_the_equations(self):
        self.assertEqual(self.export("--c", "model.c").code, 0)
        model = self.model()
        value = {one["name"]: one["value"] for law in model["laws"] for one in law["parameters"]}
        forward, backward = model["friction_sign"]
        self.assertNotEqual(forward, -backward)  # else nothing is tested of it
        source, built = (os.path.join(self.folder, name) for name in ("main.c", "main"))
        with open(source, "w", encoding="utf-8") as file:
            file.write('#include "model.c"\n' + MAIN)
        subprocess.run([COMPILER, "-std=c99", "-Wall", "-Wextra", "-Werror", source, "-lm", "-o", built], check=True)
        given = "\n".join(" ".join(map(repr, row)) for row in MOTION)
        told = subprocess.run([built], input=given, capture_output=True, text=True, check=True).stdout.split()
        for row, found in zip(MOTION, map(float, told), strict=True):
            q, dq, ddq = row
            sign = forward if dq > 0 else backward
            expected = (value["inertia"] * ddq + value["viscous"] * dq + value["offset"]
                        + math.copysign(value["coulomb"], dq)
                        + sign * value["stribeck"]
                        * math.exp(-((abs(dq) / value["stribeck_speed"]) ** value["stribeck_exponent"]))
                        + value["cogging_cos"] * math.cos(value["cogging_order"] * q)
                        + value["cogging_sin"] * math.sin(value["cogging_order"] * q))
            self.assertAlmostEqual(found, expected, places=12)

    def test_the_json_file_has_laws_with_units_and_intervals(self):
        laws = {law["name"]: law for law in self.model()["laws"]}
        self.assertIn("stribeck_speed", laws["stribeck"]["code"])
        first = laws["stribeck"]["parameters"][0]
        self.assertEqual(first["unit"], "N m")
        self.assertLess(first["ci95"][0], first["value"])

    def test_the_mjcf_file_has_friction_and_names_the_rest(self):
        done = self.export("--mjcf", "-")
        self.assertEqual(done.code, 0, done.err)
        joint = xml.fromstring(done.out).find("joint")
        self.assertEqual(joint.get("type"), "hinge")
        self.assertEqual({"armature", "damping", "frictionloss"} - set(joint.attrib), set())
        self.assertIn("stribeck", done.out)

    def test_a_robot_file_of_a_diagnosis_is_refused_with_the_way_out(self):
        done = self.export("--urdf", "arm.urdf")
        self.assertEqual(done.code, 64)
        self.assertIn("has no --urdf", done.said)
        self.assertIn("--c", done.said)
        self.assertFalse(os.path.exists(os.path.join(self.folder, "arm.urdf")))


if __name__ == "__main__":
    unittest.main()
