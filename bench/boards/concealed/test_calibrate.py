"""The calibration report on made-up records: uniform, too many small p-values, unreadable."""
import contextlib
import io
import json
import pathlib
import random
import sys
import tempfile
import unittest

import h5py

import calibrate

RIG = {"joint": "elbow", "controller": "pd", "noise": "bench", "train": "mixed"}


def record(p, named=(), **rig):
    return {"rig": {**RIG, **rig}, "p": p, "named": list(named), "verdict": "named" if named else "none"}


class Distances(unittest.TestCase):
    def test_even_steps_are_half_a_step_away(self):
        n = 50
        both, above = calibrate.distances([(i + 0.5) / n for i in range(n)])
        self.assertAlmostEqual(both, 0.5 / n)
        self.assertAlmostEqual(above, 0.5 / n)

    def test_sides(self):
        both, above = calibrate.distances([0.0] * 4)
        self.assertEqual((both, above), (1.0, 1.0))
        both, above = calibrate.distances([1.0] * 4)
        self.assertEqual((both, above), (1.0, 0.0))

    def test_critical_value_is_what_uniform_numbers_exceed_once_in_twenty(self):
        draw = random.Random(5)
        n, trials = 40, 4000
        over = sum(
            calibrate.distances([draw.random() for _ in range(n)])[0] > calibrate.critical(n) for _ in range(trials)
        )
        four_sigma = 4 * (0.05 * 0.95 / trials) ** 0.5
        self.assertAlmostEqual(over / trials, 0.05, delta=four_sigma)


class Calibration(unittest.TestCase):
    def test_uniform_records_pass_and_skewed_ones_do_not(self):
        n = 100
        even = [(i + 0.5) / n for i in range(n)]
        found = calibrate.calibration([record({"spring": p, "cogging": p**3}) for p in even])
        spring, cogging = found["effects"]["spring"], found["effects"]["cogging"]
        self.assertLess(spring["D"], spring["critical_5"])
        self.assertEqual(spring["rates"], [0.01, 0.05, 0.10])
        self.assertTrue(spring["chance_of_5"])
        self.assertGreater(cogging["D_plus"], cogging["critical_5"])
        self.assertFalse(cogging["chance_of_5"])
        self.assertIn("not uniform", calibrate.page(found))

    def test_false_names_are_counted_by_record_and_rig(self):
        records = [record({"spring": 0.5}) for _ in range(30)] + [
            record({"spring": 0.001}, ["spring", "delay"], noise="quiet")
        ]
        found = calibrate.calibration(records)
        self.assertEqual((found["false_name"]["hits"], found["false_name"]["of"]), (1, 31))
        self.assertEqual(found["groups"]["noise quiet"], {"records": 1, "rate_5": 1.0, "false_names": 1})
        self.assertEqual(found["names"], ["delay", "spring"])

    def test_spread_comes_from_records_not_from_p_values(self):
        # all effects of a record agree: as many independent facts as records
        rate = calibrate.pooled_rate([{"a": 0.01, "b": 0.01}, {"a": 0.9, "b": 0.9}], 0.05)
        self.assertEqual((rate["rate"], rate["standard_error"]), (0.5, 0.5))


class Files(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.out = pathlib.Path(folder.name)
        for name in ("verdicts", "results"):
            (self.out / name).mkdir()

    def write(self, name, names, values, decisions, expected="none"):
        (self.out / "sealed" / name).mkdir(parents=True)
        (self.out / "sealed" / name / "truth.json").write_text(json.dumps({"expected": expected, "rig": RIG}))
        verdict = {"schema": 1, "verdict": "none", "joints": [{"joint": 1, "effects": []}]}
        (self.out / "verdicts" / f"{name}.json").write_text(json.dumps(verdict))
        with h5py.File(self.out / "results" / f"{name}.h5", "w") as file:
            joint = file.create_group("diagnosis/joint_1")
            joint.attrs["omnibus_p"] = 0.4
            joint.create_group("map/velocity").attrs["p"] = 0.3
            as_texts = lambda words: [word.encode() for word in words]
            table = joint.create_group("candidates")
            table["names"], table["p"], table["decisions"] = as_texts(names), values, as_texts(decisions)

    def run_calibrate(self):
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            code = calibrate.main([str(self.out), "--json", str(self.out / "calibration.json")])
        return code, out.getvalue(), err.getvalue()

    def test_reads_what_was_tested_of_clean_records(self):
        self.write("clean_1", ["spring", "cogging"], [0.25, 1.0], ["no", "not tested"])
        self.write("oak", ["spring"], [0.001], ["named"], "named")
        self.write("clean_2", ["spring"], [0.5], ["no"])
        (self.out / "results" / "clean_2.h5").write_text("damaged")
        code, text, error = self.run_calibrate()
        self.assertEqual(code, 0)
        self.assertIn("left out 1 records", error)
        pooled = json.loads((self.out / "calibration.json").read_text())["pooled"]
        self.assertEqual((pooled["p_values"], pooled["D"]), (1, 0.75))
        self.assertEqual(calibrate.p_values_of(self.out / "results" / "clean_1.h5"),
                         {"(whole mismatch)": 0.4, "(map, velocity)": 0.3, "spring": 0.25})

    def test_nothing_to_read(self):
        self.assertEqual(self.run_calibrate()[0], 66)


if __name__ == "__main__":
    sys.exit(unittest.main())
