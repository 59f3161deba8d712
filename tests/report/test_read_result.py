"""usage: test_read_result.py PATH/write_example_result FOLDER_OF_read_result.py

The C++ store writes (tests/unit/store/example_result.hpp), Python reads.
"""

import os
import pathlib
import random
import shutil
import subprocess
import sys
import tempfile
import unittest

import h5py
import numpy as np

WRITER, SCRIPTS = sys.argv[1:3]
sys.path.insert(0, SCRIPTS)
import torquescope as ts  # noqa: E402
from torquescope.reader import Result, ResultError, summary  # noqa: E402
from torquescope.reader.content_digest import content_sha256  # noqa: E402


class ReadsWhatTheStoreWrote(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = pathlib.Path(tempfile.mkdtemp())
        cls.name = cls.folder / "R.h5"
        run = subprocess.run([WRITER, cls.name], check=True, capture_output=True, text=True)
        cls.sha256 = run.stdout.strip()
        cls.result = Result(cls.name)

    @classmethod
    def tearDownClass(cls):
        cls.result.close()
        shutil.rmtree(cls.folder)

    def test_root(self):
        self.assertEqual(self.result.format, 3)
        self.assertEqual(self.result.content_sha256, self.sha256)
        self.assertTrue(self.result.creator.startswith("torquescope "))

    def test_a_file_of_format_2_is_read_and_verified(self):
        """It had no scales and called units unit; the digest is taken in the same way."""
        name = self.folder / "format_2.h5"
        shutil.copy(self.name, name)
        with h5py.File(name, "r+") as file:
            file.attrs["format"] = np.int64(2)
            del file.attrs["sealed"]

            def older(_, node):
                if isinstance(node, h5py.Dataset):
                    node.attrs["unit"] = np.bytes_(node.attrs["units"])
                    for key in ("units", "CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST"):
                        node.attrs.pop(key, None)

            file.visititems(older)
            file.attrs["content_sha256"] = np.bytes_(content_sha256(file))
        with Result(name) as result:
            result.verify()
            self.assertEqual(result.estimators["fade"].unit("mse"), "(N m)2")
            self.assertEqual(self.result.estimators["fade"].unit("mse"), "(N m)2")

    def test_texts_are_str(self):
        self.assertEqual(self.result.job.name, "crs_a465_joint")
        self.assertIn("# M\u00fcnchen\n", self.result.job.text[0])
        self.assertEqual(list(self.result.model.names), ["inertia", "viscous"])
        self.assertEqual(self.result.train.recordings, ["a.csv", "b.csv"])

    def test_attributes_are_plain_numbers(self):
        self.assertIs(type(self.result.job.seed), int)
        self.assertIs(type(self.result.train.rate_hz), float)
        np.testing.assert_array_equal(self.result.estimators["fade"].parameters_mean, [0.0036, 0.0164])
        self.assertEqual(self.result.estimators["fade"].attributes()["cr_start"], 0.5)

    def test_estimators_are_in_the_order_of_the_job(self):
        self.assertEqual(list(self.result.estimators), ["ols", "fade"])

    def test_values_are_those_written(self):
        i = np.arange(300)
        np.testing.assert_allclose(self.result.train.torque, np.cos(0.01 * i * i), rtol=0, atol=1e-12)
        fade = self.result.estimators["fade"]
        self.assertEqual(fade.population.shape, (3, 5, 4, 2))
        np.testing.assert_allclose(fade.population.ravel(), np.sin(np.arange(120)), rtol=0, atol=1e-15)
        self.assertEqual(fade.evaluations.dtype, np.int64)
        np.testing.assert_array_equal(fade.evaluations, 4 * np.arange(1, 6) + np.arange(3)[:, None])
        np.testing.assert_array_equal(fade.mse, [0.09, 0.09 + 0.001, 0.09 + 0.002])

    def test_datasets_say_what_they_are(self):
        fade = self.result.estimators["fade"]
        self.assertEqual(fade.unit("mse"), "(N m)2")
        self.assertEqual(fade.long_name("mse"), "mean squared error")

    def test_arrays_are_read_when_asked_for(self):
        fade = Result(self.name).estimators["fade"]
        self.assertEqual(fade._arrays, {})
        self.assertIs(fade.population, fade.population)
        self.assertEqual(fade["population"][2, -1].shape, (4, 2))

    def test_what_is_not_there(self):
        self.assertIsNone(self.result.validate)
        self.assertIsNone(self.result.get("diagnosis"))
        with self.assertRaisesRegex(AttributeError, "/runs/fade has no 'banana'; it has: evaluations, generation"):
            self.result.estimators["fade"].banana

    def test_h5py_reads_it_in_one_line(self):
        with h5py.File(self.name, locking=False) as file:
            self.assertEqual(file["runs/fade/population"][1, 0, 0, 0], np.sin(40.0))
            self.assertEqual(list(file["model/names"].asstr()[:]), ["inertia", "viscous"])
            self.assertEqual(file["runs/fade"].attrs["kind"].decode(), "fade")
            self.assertTrue(file["runs/fade/population"].fletcher32)

    def test_summary_names_every_estimator_and_parameter(self):
        text = "\n".join(summary(self.result))
        for word in ("crs_a465_joint", "300 samples of a.csv, b.csv", "inertia", "0.0036", "ols", "fade"):
            self.assertIn(word, text)

    def test_the_package_opens_it_without_an_engine(self):
        with ts.open(self.name) as result:
            result.verify()
            self.assertEqual(list(result.parameters), list(result.model.names))
            self.assertRegex(repr(result), r"^<Result 'crs_a465_joint': 2 parameters; ols, fade")
            self.assertIn("inertia", result._repr_html_())
            self.assertIsNone(result.verdict)

    def test_command_line(self):
        script = pathlib.Path(SCRIPTS) / "read_result.py"
        good = subprocess.run([sys.executable, "-B", script, self.name], capture_output=True, text=True)
        self.assertEqual((good.returncode, good.stderr), (0, ""))
        bad = subprocess.run([sys.executable, "-B", script, "no.h5"], capture_output=True, text=True)
        self.assertEqual((bad.returncode, bad.stderr), (1, "error: there is no file no.h5\n"))

    def refusal(self, change):
        name = self.folder / "changed.h5"
        shutil.copy(self.name, name)
        change(name)
        with self.assertRaises(ResultError) as caught:
            with Result(name) as result:
                result.estimators["fade"].population
        return str(caught.exception)

    def test_refuses_what_is_no_result(self):
        def set_attribute(key, value):
            def change(name):
                with h5py.File(name, "r+") as file:
                    file.attrs[key] = value

            return change

        def damage(name):
            data = bytearray(name.read_bytes())
            data[data.find(np.sin(1.0).tobytes())] ^= 4
            name.write_bytes(data)

        def link(target):
            def change(name):
                with h5py.File(name, "r+") as file:
                    file["runs/fade/more"] = target

            return change

        for target in (h5py.ExternalLink("other.h5", "/runs/ols"), h5py.SoftLink("/runs/ols")):
            self.assertIn('in /runs/fade: "more" is a link to elsewhere', self.refusal(link(target)))

        def virtual(name):
            layout = h5py.VirtualLayout(shape=(3,), dtype="<f8")
            layout[:] = h5py.VirtualSource("elsewhere.h5", "x", shape=(3,))
            with h5py.File(name, "r+") as file:
                file["runs/ols"].create_virtual_dataset("more", layout)

        def itself(name):
            with h5py.File(name, "r+") as file:
                file["runs/ols/more"] = file["runs"]

        def huge(name):
            with h5py.File(name, "r+") as file:
                file.create_dataset("runs/huge", shape=(1 << 40,), dtype="<f8", chunks=(1024,))

        self.assertIn("its values lie in another file", self.refusal(virtual))
        self.assertIn("it has two names", self.refusal(itself))
        self.assertIn("claims more values than the file can hold", self.refusal(huge))
        self.assertIn("has format 4", self.refusal(set_attribute("format", np.int64(4))))
        self.assertIn("never finished", self.refusal(set_attribute("complete", np.int64(0))))
        self.assertIn("not an HDF5 file", self.refusal(lambda name: name.write_text("t_s,q_rad\n")))
        self.assertIn("damaged in /runs/fade/population", self.refusal(damage))

    def test_a_file_that_crashes_hdf5_ends_in_one_error(self):
        """Whatever happens to the child that looks first, this process lives on."""
        code = (
            "import os, signal, sys; sys.path.insert(0, sys.argv[2])\n"
            "from torquescope import reader\n"
            "from torquescope.reader import first_look\n"
            "first_look._look = lambda *_: os.kill(os.getpid(), getattr(signal, sys.argv[3]))\n"
            "try: reader.Result(sys.argv[1])\n"
            "except reader.ResultError as error: print(error)\n"
        )
        for number in ("SIGSEGV", "SIGXCPU", "SIGKILL"):
            run = subprocess.run([sys.executable, "-B", "-c", code, self.name, SCRIPTS, number],
                                 check=True, capture_output=True, text=True)
            self.assertIn("R.h5 is damaged: HDF5 crashed", run.stdout)

    def test_a_pipe_is_not_waited_for(self):
        os.mkfifo(self.folder / "pipe.h5")
        with self.assertRaisesRegex(ResultError, "pipe.h5 is not a file"):
            Result(self.folder / "pipe.h5")

    def test_of_600_flipped_bits_each_ends_in_one_error_or_changes_nothing(self):
        chance = random.Random(20140606)
        whole = self.name.read_bytes()
        name = self.folder / "flipped.h5"
        refused = harmless = 0
        for _ in range(600):
            place, bit = chance.randrange(len(whole)), chance.randrange(8)
            flipped = bytearray(whole)
            flipped[place] ^= 1 << bit
            name.write_bytes(flipped)
            with self.subTest(place=place, bit=bit):
                try:
                    with Result(name) as result:
                        result.verify()
                        found = []
                        result._file.visititems(lambda path, _: found.append(path))
                        self.assertEqual(content_sha256(result._file), self.sha256)
                    harmless += 1
                except ResultError:
                    refused += 1
        print(f"600 flipped bits: {refused} refused, {harmless} harmless", file=sys.stderr)
        self.assertEqual(harmless, 0, "every byte is covered")

    def test_computes_the_digest_of_the_store(self):
        for case in ("example", "large", "large gzip"):
            name = self.folder / "digest.h5"
            run = subprocess.run([WRITER, name, case], check=True, capture_output=True, text=True)
            with Result(name) as result:
                self.assertEqual(content_sha256(result._file), run.stdout.strip(), case)
                result.verify()

    def test_gzip_is_level_1_without_shuffle_for_every_dataset(self):
        name = self.folder / "gzip.h5"
        subprocess.run([WRITER, name, "large gzip"], check=True, capture_output=True)
        with h5py.File(name, locking=False) as file:
            found = []
            file.visititems(
                lambda path, node: found.append(node) if isinstance(node, h5py.Dataset) and node.chunks else None
            )
            self.assertEqual(
                {(d.compression, d.compression_opts, d.shuffle, d.fletcher32) for d in found},
                {("gzip", 1, False, True)},
            )
            self.assertGreater(len(found), 5)

    def test_the_digest_notices_what_was_changed_on_purpose(self):
        def changes():
            yield lambda file: file["runs/fade/population"].__setitem__((2, 4, 3, 1), 0.5)
            yield lambda file: file["runs/fade/evaluations"].__setitem__((0, 0), 5)
            yield lambda file: file["job"].attrs.__setitem__("seed", np.int64(43))
            yield lambda file: file.create_group("more")
            yield lambda file: file["runs/ols"].move("parameters", "estimates")

        for number, change in enumerate(changes()):
            name = self.folder / "changed.h5"
            shutil.copy(self.name, name)
            with h5py.File(name, "r+") as file:
                change(file)
            with Result(name) as result, self.assertRaisesRegex(
                ResultError, "does not match its sha256", msg=str(number)
            ):
                result.verify()

    def test_what_is_volatile_does_not_count(self):
        name = self.folder / "moved.h5"
        shutil.copy(self.name, name)
        with h5py.File(name, "r+") as file:
            file["provenance"].attrs["host"] = np.bytes_("another")
        with Result(name) as result:
            self.assertEqual(content_sha256(result._file), self.sha256)
            with self.assertRaisesRegex(ResultError, "its seal is missing"):
                result.verify()


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
