"""A torque column in milliamperes or volts whose factor nobody knows: no command, file or page speaks of N m or kg.

What is said is "N m per mA", what torque_per_unit would be, and "not N m".
"""

import csv
import os
import re
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path

import h5py

PROGRAM = os.environ["TORQUESCOPE"]
SIMULATED = """
[experiment]
name = "{name}"
seed = {seed}
[simulate]
rate_hz = 200
duration_s = 10
validate = false
[simulate.plant]
inertia = 0.09
viscous = 0.35
coulomb = 0.6
spring = 1.5
[simulate.reference]
kind = "multisine"
max_speed = 3.0
[simulate.encoder]
counts_per_revolution = 131072
[simulate.noise]
torque_std = 0.02
"""
JOB = """
[experiment]
name = "units"
[recording]
train = "train.csv"
validate = "validation.csv"
columns = {{time = "t_s", reference = "q_ref_rad", position = "q_rad", torque = "motor_{unit}"}}
{factor}
[filter]
cutoff_hz = 20
decimate_to_hz = 50
[model]
terms = ["inertia", "viscous", "coulomb"]
[[estimator]]
name = "ols"
[diagnose]
twins = 60
effects = ["spring"]
"""
OTHER_UNIT = re.compile(r"(?<!not )N\s?m\b(?! per)|\bkg\b|\d N\b|N·m")


class Page(HTMLParser):
    """What a person reads: text outside of scripts and styles."""

    def __init__(self, path):
        super().__init__()
        self.hidden, self.text = 0, []
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        self.hidden += tag in ("script", "style", "pre")

    def handle_endtag(self, tag):
        self.hidden -= tag in ("script", "style", "pre")

    def handle_data(self, data):
        if not self.hidden:
            self.text.append(data)


class Units(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.folder = Path(self.temporary.name)
        self.addCleanup(self.temporary.cleanup)

    def run_program(self, *words):
        ran = subprocess.run([PROGRAM, *words], cwd=self.folder, capture_output=True, text=True)
        self.assertIn(ran.returncode, (0,), ran.stderr)
        return ran.stdout + ran.stderr

    def record(self, unit):
        for seed, name in ((1, "train"), (2, "validation")):
            (self.folder / f"{name}.toml").write_text(SIMULATED.format(name=name, seed=seed))
            self.run_program("simulate", f"{name}.toml", "--out", f"{name}_nm.csv")
            with open(self.folder / f"{name}_nm.csv", newline="") as file:
                lines = [line for line in file if not line.startswith("#")]
            head, *rows = csv.reader(lines)
            at = head.index("tau_Nm")
            head[at] = f"motor_{unit}"
            for row in rows:
                row[at] = f"{float(row[at]) * 238.0:.6g}"
            with open(self.folder / f"{name}.csv", "w", newline="") as file:
                csv.writer(file).writerows([head, *rows])

    def assert_own_unit(self, text, where):
        found = [text[max(0, one.start() - 60):one.end() + 20] for one in OTHER_UNIT.finditer(text)]
        self.assertEqual(found, [], where)

    def texts_of(self, path):
        """Units and sentences of a result file; what jobs and C code say is the user's and tested elsewhere."""
        found = []

        def add(name, item):
            for key, value in item.attrs.items():
                if isinstance(value, (str, bytes)) and key not in ("meaning", "model_c", "model_mjcf"):
                    found.append(f"{name}@{key}: {value}")
            if isinstance(item, h5py.Dataset) and item.dtype.kind == "O" and "/units" in name:
                found.extend(f"{name}: {one.decode()}" for one in item[()].ravel())

        with h5py.File(path) as file:
            file.visititems(add)
        return [text for text in found if not text.startswith(("job", "provenance"))]

    def everything_about(self, unit, factor=""):
        self.record(unit)
        (self.folder / "job.toml").write_text(JOB.format(unit=unit, factor=factor))
        said = {"run": self.run_program("run", "job.toml", "--out", "run.h5"),
                "replay": self.run_program("replay", "run.h5"),
                "diagnose": self.run_program("diagnose", "job.toml", "--out", "found.h5", "--all", "--json",
                                             "found.json"),
                "json": (self.folder / "found.json").read_text(),
                "show run": self.run_program("show", "run.h5"),
                "show found": self.run_program("show", "found.h5", "--all")}
        for name in ("run", "found"):
            self.run_program("report", f"{name}.h5")
            said[f"page of {name}"] = " ".join(Page(self.folder / f"{name}.html").text)
            said[f"file of {name}"] = "\n".join(self.texts_of(self.folder / f"{name}.h5"))
        return said

    def test_of_a_current(self):
        said = self.everything_about("mA")
        for where, text in said.items():
            self.assert_own_unit(text, where)
        self.assertRegex(said["run"], r"inertia\s+mA s2/rad")
        self.assertRegex(said["run"], r"coulomb\s+mA\s")
        self.assertRegex(said["diagnose"], r"\d mA")

    def test_of_a_voltage_that_is_kept_as_it_is(self):
        said = self.everything_about("V", "torque_per_unit = 1")
        for where, text in said.items():
            self.assert_own_unit(text, where)
        self.assertRegex(said["run"], r"coulomb\s+V\s")
        self.assertRegex(said["diagnose"], r"\d V\b")

    def test_a_known_factor_makes_newton_metres(self):
        self.record("mA")
        (self.folder / "job.toml").write_text(JOB.format(unit="mA", factor="torque_per_unit = 0.0042"))
        self.assertRegex(self.run_program("run", "job.toml", "--out", "run.h5"), r"inertia\s+kg m2")


if __name__ == "__main__":
    unittest.main()
