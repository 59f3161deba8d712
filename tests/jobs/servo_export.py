"""export --c of a diagnosis of servos: the C file, compiled and stepped along each recording's goal, moves as the
program's own simulation does."""
import csv
import ctypes
import json
import pathlib
import subprocess
import tempfile
import unittest

import program

JOB = pathlib.Path(__file__).resolve().parents[2] / "jobs" / "servo_loads.toml"
MOTIONS = ("two_sines", "lift_and_drop")
FEWER = ("m0.5_l150_kp8_lift_and_drop.csv", "m1_l150_kp8_two_sines.csv", "m0.75_l150_kp32_lift_and_drop.csv")


class Known(ctypes.Structure):
    _fields_ = [(name, ctypes.c_double) for name in ("gravity_moment", "inertia", "command_gain", "command_limit",
                                                     "arm_length")]


class State(ctypes.Structure):
    _fields_ = [("q", ctypes.c_double), ("dq", ctypes.c_double), ("goal", ctypes.c_double),
                ("goal_speed", ctypes.c_double), ("lagged", ctypes.c_double), ("goals", ctypes.c_double * 256),
                ("tick", ctypes.c_int)]


def small_job(folder):
    """The shipped job on two of its motions: enough for the effects, quick."""
    with open(JOB.parent / "servo_records" / "manifest.csv", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["motion"] in MOTIONS and row["file"] not in FEWER]
    for row in rows:
        row["file"] = str(JOB.parent / "servo_records" / row["file"])
    with open(folder / "manifest.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)
    text = JOB.read_text().replace("servo_records/manifest.csv", "manifest.csv")
    text = text.replace('effects = "all"', 'effects = "all"\nmax_effects = 3')
    (folder / "job.toml").write_text(text)
    return rows


def stepped(library, known, row):
    """Positions at the samples of a recording."""
    with open(row["file"], newline="") as file:
        lines = [line for line in file if not line.startswith("#")]
    samples = list(csv.DictReader(lines))
    step_s = 1e-3
    state = State()
    first = samples[0]
    library.servo_start(ctypes.byref(state), ctypes.c_double(float(first["q_rad"])),
                        ctypes.c_double(float(first["q_goal_rad"])))
    positions = []
    for sample in samples:
        positions.append(state.q)
        for _ in range(10):
            library.servo_step(ctypes.byref(state), ctypes.byref(known), ctypes.c_double(float(sample["q_goal_rad"])),
                               ctypes.c_double(state.q), ctypes.c_int(int(float(sample["torque_enabled"]))),
                               ctypes.c_double(step_s))
    return positions, [float(sample["q_rad"]) for sample in samples]


class Export(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        cls.rows = small_job(cls.folder)
        done = program.run("diagnose", "job.toml", "--out", "servo.h5", "--json", "servo.json", "-q", folder=cls.folder)
        assert done.code == 0, done.err
        cls.document = json.loads((cls.folder / "servo.json").read_text())

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_compiled_c_follows_the_recordings_as_the_program_does(self):
        done = program.run("export", "servo.h5", "--c", "servo.c", folder=self.folder)
        self.assertEqual(done.code, 0, done.err)
        subprocess.run(["cc", "-std=c99", "-Wall", "-Wextra", "-Werror", "-O2", "-shared", "-fPIC", "servo.c", "-o",
                        "servo.so", "-lm"], cwd=self.folder, check=True)
        library = ctypes.CDLL(str(self.folder / "servo.so"))
        told = {one["name"]: one["after"] for one in self.document["recordings"]}
        for row in self.rows:
            mass, length, supply = (float(row[name]) for name in ("mass_kg", "length_m", "supply_v"))
            known = Known(9.80665 * mass * length, mass * length * length, 0.165 * float(row["kp"]) * supply,
                          0.97 * supply, length)
            simulated, measured = stepped(library, known, row)
            error = sum(abs(a - b) for a, b in zip(simulated, measured)) / len(measured)
            # first order at 1 ms: a few times 1 ms times the speeds of up to 4 rad/s
            self.assertLess(error, told[pathlib.Path(row["file"]).name] + 0.004, row["file"])

    def test_numbers_of_the_job_file_are_those_of_the_document(self):
        done = program.run("export", "servo.h5", "--toml", "-", folder=self.folder)
        self.assertEqual(done.code, 0, done.err)
        for one in self.document["parameters"]:
            self.assertIn(f"{one['name']} = {one['value']:.5g}"[:len(one["name"]) + 7], done.out)

    def test_a_format_of_arms_is_refused(self):
        done = program.run("export", "servo.h5", "--urdf", "-", folder=self.folder)
        self.assertEqual(done.code, 64)
        self.assertIn("--c and --toml", done.said)


if __name__ == "__main__":
    unittest.main()
