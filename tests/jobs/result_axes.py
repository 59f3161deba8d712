"""Axes of result files: dimension scales as h5py sees them, and the plot that xarray makes of them by itself.

Use: TORQUESCOPE=$PWD/build/dev/bin/torquescope /usr/bin/python3 tests/jobs/result_axes.py
"""

import os
import shutil
import sys
import tempfile
import unittest

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import arm_cli  # noqa: E402
import arm_diagnosis_cli  # noqa: E402
import program  # noqa: E402

SEARCHES = """
[[estimator]]
name = "ols"
[[estimator]]
name = "fade"
population = 8
generations = 12
"""
PLANT = """
[experiment]
name = "axes"
seed = 3
runs = 2
[filter]
cutoff_hz = 20
[model]
terms = ["inertia", "viscous", "coulomb", "offset"]
[model.bounds]
every = [-2, 2]
[simulate]
rate_hz = 500
duration_s = 6
[simulate.plant]
inertia = 0.09
viscous = 0.35
coulomb = 0.6
offset = 0.04
[simulate.controller]
kind = "pd"
rate_hz = 500
[simulate.noise]
torque_std = 0.02
"""
DIAGNOSE = """
[diagnose]
effects = ["stribeck"]
twins = 60
"""
HISTORY = ("run", "generation")
# of every kind of file, what stands along the dimensions of some of its datasets (engine/store/RESULT_FORMAT.md)
AXES = {
    "joint": {
        "runs/fade/F": HISTORY, "runs/fade/gap_history": HISTORY, "runs/fade/evaluations": HISTORY,
        "runs/fade/population": (*HISTORY, "member", "parameter"), "runs/fade/fitness": (*HISTORY, "member"),
        "runs/fade/parameters": ("run", "parameter"), "runs/fade/stop_reason": ("run",),
        "runs/fade/controller/F_surface": ("F_first", "F_second"),
        "runs/fade/controller/F_path": (*HISTORY, "F_input"),
        "runs/fade/controller/d11_membership": ("curve", "d11_universe"),
        "runs/ols/ci95": ("run", "parameter", "bound"),
        "data/train/torque": ("time",), "data/train/regressor": ("time", "parameter"),
        "model/truth": ("parameter",), "data/regressor_health/correlation": ("parameter", "with_parameter"),
    },
    "arm": {
        "runs/ols/joint_relerr": ("joint",), "arm/noise": ("joint",), "arm/seen": ("parameter",),
        "data/train/joint_2/torque": ("time",), "data/train/joint_2/regressor": ("time", "parameter"),
        "robot/kinds": ("joint",), "robot/gathers": ("parameter",),
    },
    "diagnosis": {
        "diagnosis/joint_1/map/velocity/z": ("centre",), "diagnosis/joint_1/candidates/z": ("candidate",),
        "diagnosis/joint_1/baseline/values": ("parameter",), "diagnosis/joint_1/baseline/ci95": ("parameter", "bound"),
        "diagnosis/joint_1/traces/trace_1/before": ("time",), "diagnosis/joint_1/twin_energy": ("twin",),
    },
}


def write(folder, name, text):
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


class Axes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = tempfile.mkdtemp(prefix="torquescope_axes_")
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        write(cls.folder, "joint.toml", PLANT + SEARCHES)
        write(cls.folder, "diagnosis.toml", PLANT + DIAGNOSE)
        write(cls.folder, "arm.csv", arm_diagnosis_cli.recording(seconds=20.0))
        write(cls.folder, "arm_robot.toml", arm_cli.ROBOT)
        write(cls.folder, "arm.toml", arm_cli.JOB.split("[[estimator]]", maxsplit=1)[0] + SEARCHES)
        for name in AXES:
            command = "diagnose" if name == "diagnosis" else "run"
            done = program.run(command, f"{name}.toml", "--out", f"{name}.h5", folder=cls.folder)
            if done.code != 0:
                raise AssertionError(done.err)

    def open(self, name):
        file = h5py.File(os.path.join(self.folder, f"{name}.h5"), locking=False)
        self.addCleanup(file.close)
        return file

    def test_every_dimension_has_the_scale_that_the_document_names(self):
        for name, datasets in AXES.items():
            file = self.open(name)
            for path, wanted in datasets.items():
                found = [one[0].name.rsplit("/", 1)[1] for one in file[path].dims if len(one) == 1]
                self.assertEqual(tuple(found), wanted, path)

    def test_a_scale_has_the_length_of_its_dimension_and_knows_who_uses_it(self):
        for name in AXES:
            scaled = []

            def look(path, node):
                if isinstance(node, h5py.Dataset) and "DIMENSION_LIST" in node.attrs:
                    for place, dimension in enumerate(node.dims):
                        scale = dimension[0]
                        self.assertEqual(scale.shape, (node.shape[place],), path)
                        self.assertEqual(dimension.keys(), [scale.attrs["NAME"].decode()], path)
                        users = [(scale.file[one["dataset"]].name, one["dimension"])
                                 for one in scale.attrs["REFERENCE_LIST"]]
                        self.assertIn(("/" + path, place), users)
                        scaled.append(path)

            self.open(name).visititems(look)
            self.assertGreater(len(scaled), 25, name)

    def test_what_stands_along_an_axis(self):
        joint, arm, diagnosis = self.open("joint"), self.open("arm"), self.open("diagnosis")
        self.assertEqual(list(joint["runs/fade/generation"]), list(range(13)))
        self.assertEqual(list(joint["runs/fade/run"]), [0, 1])
        self.assertEqual(list(joint["runs/ols/parameter"].asstr()), ["inertia", "viscous", "coulomb", "offset"])
        self.assertEqual(list(joint["runs/ols/bound"].asstr()), ["low", "high"])
        self.assertTrue(np.all(joint["runs/ols/ci95"][0, :, 0] < joint["runs/ols/ci95"][0, :, 1]))
        self.assertEqual(list(arm["arm/joint"].asstr()), ["shoulder", "elbow"])
        names = arm["model/names"].asstr()[:]
        own = arm["arm/joint_2/parameters"][:]
        self.assertEqual(list(arm["data/train/joint_2/parameter"].asstr()), list(names[own]))
        found = diagnosis["diagnosis/joint_1/candidates"]
        self.assertEqual(list(found["candidate"]), list(found["names"]))

    def test_files_with_scales_are_verified_whole_whatever_their_storage(self):
        write(self.folder, "packed.toml", PLANT + '[output]\ncompression = "gzip"\n' + SEARCHES)
        done = program.run("run", "packed.toml", "--out", "packed.h5", folder=self.folder)
        self.assertEqual(done.code, 0, done.err)
        self.assertEqual(self.open("packed")["runs/fade/F"].dims[1][0].name, "/runs/fade/generation")
        for name in ("packed", *AXES):
            done = program.run("show", f"{name}.h5", "--verify", folder=self.folder)
            self.assertEqual(done.code, 0, done.err)

    def test_xarray_draws_a_history_with_labelled_axes(self):
        try:
            import matplotlib
            matplotlib.use("Agg")
            import h5netcdf  # noqa: F401
            import xarray
        except ImportError as absent:
            self.skipTest(f"{absent}: scripts/install-deps --full installs it")
        import matplotlib.pyplot as pyplot
        path = os.path.join(self.folder, "joint.h5")
        with xarray.open_dataset(path, group="runs/fade", engine="h5netcdf") as fade:
            fade.F.plot()
            figure = pyplot.gcf()
            labels = {axes.get_xlabel() for axes in figure.axes} | {axes.get_ylabel() for axes in figure.axes}
            pyplot.close(figure)
            self.assertLessEqual({"generation [1]", "run [1]", "mutation factor [1]"}, labels)
            self.assertEqual(dict(fade.sizes), {"run": 2, "generation": 13, "member": 8, "parameter": 4})
        with xarray.open_dataset(path, group="data/train", engine="h5netcdf") as train:
            line, = train.torque.plot()
            self.assertEqual((line.axes.get_xlabel(), line.axes.get_ylabel()), ("time [s]", "torque [N m]"))
            pyplot.close(line.axes.figure)


if __name__ == "__main__":
    unittest.main()
