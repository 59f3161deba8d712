"""Recordings as other programs write them: read, or refused with the line that exports them; by the built program.

Use: TORQUESCOPE=build/release/bin/torquescope /usr/bin/python3 tests/jobs/foreign_files.py
Cases      ../shared/cases beside the repository, or TORQUESCOPE_CASES; where they are absent their tests are skipped
"""

import datetime
import gzip
import io
import json
import os
import shlex
import shutil
import sqlite3
import sys
import tempfile
import unittest
import zipfile

import h5py
import numpy as np

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))

import program  # noqa: E402
import recordings  # noqa: E402

HERE = os.path.dirname(os.path.abspath(__file__))
CASES = os.environ.get("TORQUESCOPE_CASES", os.path.join(HERE, "..", "..", "..", "shared", "cases"))
JOB = """
[recording]
train = '%s'
columns = {%s}

[filter]
cutoff_hz = 20

[model]
joint = "revolute"
terms = ["inertia", "viscous", "coulomb_positive", "coulomb_negative"]

[[estimator]]
name = "ols"
"""
COLUMNS = {"time": "t_s", "position": "q_rad", "torque": "tau_Nm"}
ROWS = recordings.good_rows(seconds=5.0)
TEXT = recordings.text_of(ROWS)
DATA = np.array(ROWS, dtype=float)
BEGIN = datetime.datetime(2024, 5, 1, 23, 59, 58)


def stamped(write):
    """The recording with its time in other words."""
    return recordings.text_of([[write(float(t)), q, tau] for t, q, tau in ROWS])


def clock(t):
    return f"{BEGIN + datetime.timedelta(seconds=t):%H:%M:%S.%f}"


def decimal_commas(text, separator):
    return text.replace(",", separator).replace(".", ",")


# the same recording in the dialects that people have
TABLES = {
    "semicolons.csv": decimal_commas(TEXT, ";").encode(),
    "tabs.txt": decimal_commas(TEXT, "\t").encode(),
    "utf16.txt": decimal_commas(TEXT, "\t").replace("\n", "\r\n").encode("utf-16"),
    "old_mac.csv": TEXT.replace("\n", "\r").encode(),
    "marked.csv": b"\xef\xbb\xbf" + TEXT.encode(),
    "units.csv": TEXT.replace("\n", "\ns,rad,Nm\n", 1).encode(),
    "preamble.csv": b"Name,Scope Project\nStart,15.01.2026 10:29:04\nRate,200\n\n" + TEXT.encode(),
    "preamble_units.csv": b"Logger 3\nGain;2\n"
    + decimal_commas(TEXT, ";").replace("\n", "\n[s];[rad];[Nm]\n", 1).encode(),
    "iso.csv": stamped(lambda t: f"{BEGIN + datetime.timedelta(seconds=t):%Y-%m-%dT%H:%M:%S.%fZ}").encode(),
    "blank_iso.csv.gz": gzip.compress(stamped(lambda t: f"{BEGIN + datetime.timedelta(seconds=t)}").encode(), mtime=0),
    "clock_over_midnight.csv": stamped(clock).encode(),
    "torn.csv": TEXT.encode()[:-9],
    "power_cut.csv": TEXT.encode() + bytes(4096),
}


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.mkdtemp(prefix="torquescope_foreign_")
        self.addCleanup(shutil.rmtree, self.folder)

    def path(self, name):
        return os.path.join(self.folder, name)

    def write(self, name, content):
        with open(self.path(name), "wb") as file:
            file.write(content)
        return name

    def job(self, name, columns=None):
        mapping = ", ".join(f'{channel} = "{column}"' for channel, column in (columns or COLUMNS).items())
        return self.write("job.toml", (JOB % (name, mapping)).encode())

    def run_job(self, name, columns=None):
        self.job(name, columns)
        return program.run("run", "job.toml", "--out", "r.h5", "--json", "r.json", folder=self.folder)

    def parameters(self, name, columns=None):
        for old in ("r.h5", "r.json"):
            if os.path.exists(self.path(old)):
                os.remove(self.path(old))
        outcome = self.run_job(name, columns)
        self.assertEqual(outcome.code, 0, f"{name}: {outcome.err}")
        with h5py.File(self.path("r.h5")) as file:
            return file["runs/ols/parameters"][:].ravel()

    def assert_refused(self, name, words, code=65):
        self.job(name)
        outcome = program.run("check", "job.toml", folder=self.folder)
        self.assertEqual(outcome.code, code, outcome.err)
        for word in [words] if isinstance(words, str) else words:
            self.assertIn(word, outcome.said)
        return outcome


class SameNumbers(Folder):
    """Each file holds good.csv: what is identified is the same."""

    def setUp(self):
        super().setUp()
        self.good = self.parameters(self.write("good.csv", TEXT.encode()))
        self.assertAlmostEqual(self.good[0], 0.05, delta=0.005)

    def test_tables_in_other_dialects(self):
        for name, content in TABLES.items():
            with self.subTest(name=name):
                found = self.parameters(self.write(name, content))
                # a stamp of a date is rounded to 2e-7 s; a torn file has a row less
                np.testing.assert_allclose(found, self.good, rtol=2e-3)

    def test_arrays_of_numpy(self):
        values = dict(zip(COLUMNS.values(), DATA.T))
        np.savez(self.path("plain.npz"), **values)
        np.savez_compressed(self.path("packed.npz"), **values)
        structured = np.zeros(len(DATA), dtype=[(name, "f8") for name in values])
        for name, column in values.items():
            structured[name] = column
        np.save(self.path("structured.npy"), structured)
        for name in ("plain.npz", "packed.npz", "structured.npy"):
            with self.subTest(name=name):
                np.testing.assert_array_equal(self.parameters(name), self.good)
        indexed = {channel: f"array[{k}]" for k, channel in enumerate(COLUMNS)}
        for name, array in (("rows", DATA), ("fortran", np.asfortranarray(DATA)), ("big_endian", DATA.astype(">f8"))):
            with self.subTest(name=name):
                name += ".npy"
                np.save(self.path(name), array)
                np.testing.assert_array_equal(self.parameters(name, indexed), self.good)

    def test_stamps_of_ros(self):
        whole = 1768472944
        for second, nanosecond in (("stamp.sec", "stamp.nanosec"), ("secs", "nsecs")):
            rows = [[str(whole + int(float(t))), str(round(float(t) % 1 * 1e9)), q, tau] for t, q, tau in ROWS]
            name = self.write("ros.csv", recordings.text_of(rows, f"{second},{nanosecond},q_rad,tau_Nm").encode())
            np.testing.assert_allclose(self.parameters(name, {**COLUMNS, "time": "stamp"}), self.good, rtol=1e-9)

    def test_rows_of_ros2_topic_echo(self):
        whole = 1768472944
        for row in ("elbow,{q},,{tau}", "elbow,wrist,{q},1.5,,{tau},2.5", "elbow,{q},0.5,{tau}"):
            rows = [f"{whole + int(float(t))},{round(float(t) % 1 * 1e9)},base,{row.format(q=q, tau=tau)}\n"
                    for t, q, tau in ROWS]
            name = self.write("joint_states.csv", "".join(rows).encode())
            columns = {"time": "stamp", "position": "elbow/position", "torque": "elbow/effort"}
            np.testing.assert_allclose(self.parameters(name, columns), self.good, rtol=1e-9)

    def test_exports_of_plotjuggler(self):
        columns = {"time": "__time", "position": "/joint_states/elbow/position", "torque": "/torque/data"}
        names = ",".join(columns.values()) + "\n"
        begin = 1768472944.123456  # it prints six decimals of seconds since 1970, and nine of values
        rows = [f"{begin + t:.6f},{q:.9f},{tau:.9f}\n" for t, q, tau in DATA]
        name = self.write("one_topic.csv", (names + "".join(rows)).encode())
        np.testing.assert_allclose(self.parameters(name, columns), self.good, rtol=1e-4)
        # of two topics every message has a row, with an empty cell for the other; the torque is 1 ms late
        late = np.interp(DATA[:, 0] + 0.001, DATA[:, 0], DATA[:, 2])
        rows = sorted([f"{begin + t:.6f},{q:.9f},\n" for t, q, _ in DATA]
                      + [f"{begin + t + 0.001:.6f},,{tau:.9f}\n" for (t, _, _), tau in zip(DATA, late)])
        name = self.write("two_topics.csv", (names + "".join(rows)).encode())
        np.testing.assert_allclose(self.parameters(name, columns), self.good, rtol=0.02)

    def test_structures_and_pandas_frames_in_hdf5(self):
        table = np.zeros(len(DATA), dtype=[(name, "f8") for name in COLUMNS.values()])
        for name, column in zip(COLUMNS.values(), DATA.T):
            table[name] = column
        with h5py.File(self.path("structures.h5"), "w") as file:
            file["log"] = table
        with h5py.File(self.path("frame.h5"), "w") as file:  # as pandas.DataFrame.to_hdf writes its fixed format
            group = file.create_group("df")
            group.attrs["pandas_type"] = np.bytes_(b"frame")
            group["axis0"] = np.array(list(COLUMNS.values()), dtype="S8")
            group["axis1"] = np.arange(len(DATA))
            group["block0_items"] = np.array(list(COLUMNS.values()), dtype="S8")
            group["block0_values"] = DATA
        with h5py.File(self.path("table.h5"), "w") as file:  # as its table format
            frame = file.create_dataset("df/table", (len(DATA),), [("index", "i8"), ("values_block_0", "f8", (3,))])
            rows = np.zeros(len(DATA), frame.dtype)
            rows["values_block_0"] = DATA
            frame[:] = rows
            names = "".join(f"V{name}\np{k}\na" for k, name in enumerate(COLUMNS.values(), 1))
            frame.attrs["values_block_0_kind"] = np.bytes_(f"(lp0\n{names}.".encode())
        for name in ("structures.h5", "frame.h5", "table.h5"):
            np.testing.assert_array_equal(self.parameters(name), self.good)

    def test_preallocated_datasets_end_where_the_clock_does(self):
        with h5py.File(self.path("zeros.h5"), "w") as file:
            for name, column in zip(COLUMNS.values(), DATA.T):
                file.create_dataset(name, data=np.concatenate([column, np.zeros(500)]))
        np.testing.assert_array_equal(self.parameters("zeros.h5"), self.good)

    def test_hdf5_of_a_killed_writer(self):
        for swmr in (False, True):
            with self.subTest(swmr=swmr):
                file = h5py.File(self.path("open.h5"), "w", libver="latest")
                for name, column in zip(COLUMNS.values(), DATA.T):
                    file.create_dataset(name, data=column, chunks=(100,), maxshape=(None,))
                if swmr:
                    file.swmr_mode = True
                file.flush()
                shutil.copy(self.path("open.h5"), self.path("left_open.h5"))  # as a kill leaves it
                file.close()
                with open(self.path("left_open.h5"), "rb") as left:
                    self.assertNotEqual(left.read(12)[11], 0)
                np.testing.assert_array_equal(self.parameters("left_open.h5"), self.good)


class Refused(Folder):
    def test_files_of_other_kinds_name_the_line_that_exports_them(self):
        workbook = io.BytesIO()
        with zipfile.ZipFile(workbook, "w") as file:
            file.writestr("[Content_Types].xml", "<Types/>")
            file.writestr("xl/workbook.xml", "<workbook/>")
        database = sqlite3.connect(self.path("ros2.db3"))
        database.execute("create table messages (id integer)")
        database.commit()
        database.close()
        for name, content, words in [
            (
                "a.mcap",
                b"\x89MCAP0\r\n" + bytes(50),
                ["is an MCAP file", "pip install '.[ros]'", "-m torquescope convert a.mcap a.mcap.h5"],
            ),
            ("a.bag", b"#ROSBAG V2.0\n" + bytes(50), ["is a bag of ROS 1", "convert a.bag a.bag.h5"]),
            ("ros2.db3", None, ["is a database of SQLite", "convert ros2.db3 ros2.db3.h5"]),
            (
                "a.parquet",
                b"PAR1" + bytes(50),
                ["is a Parquet file", 'read_parquet("a.parquet").to_csv("a.parquet.csv")'],
            ),
            ("a.xlsx", workbook.getvalue(), ["is a workbook of Excel", "read_excel("]),
            ("a.pkl", b"\x80\x04\x95" + bytes(50), ["is a pickle of Python", "read_pickle("]),
            ("a.pdf", b"%PDF-1.7\n", ["is a PDF document"]),
            ("a.png", b"\x89PNG\r\n\x1a\n" + bytes(50), ["is a picture (PNG)"]),
            ("a.urdf", b"<?xml version='1.0'?>\n<robot name='r'/>\n", ["is a URDF file"]),
            ("a.html", b"<!DOCTYPE html>\n<html></html>\n", ["is a web page"]),
            ("a.lfs", b"version https://git-lfs.github.com/spec/v1\noid x\n", ["git lfs pull"]),
            ("echo.txt", b"header:\n  stamp:\n    sec: 1\n    nanosec: 2\n---\n", ["ros2 topic echo --csv"]),
            ("other.toml", b"[experiment]\nname = 'x'\n", ["is a job of Torquescope"]),
        ]:
            with self.subTest(name=name):
                if content is not None:
                    self.write(name, content)
                self.assert_refused(name, words)

    def test_a_line_to_copy_stands_on_one_line(self):
        self.write("my arm's.parquet", b"PAR1" + bytes(50))
        outcome = self.assert_refused_by_init("my arm's.parquet", "is a Parquet file")
        lines = [line for line in outcome.err.splitlines() if line.startswith("    python3 -c '")]
        self.assertEqual(len(lines), 1)
        self.assertTrue(lines[0].endswith(".csv\")'"))
        self.write("my arm's.mcap", b"\x89MCAP0\r\n" + bytes(50))
        outcome = self.assert_refused_by_init("my arm's.mcap", "is an MCAP file")
        line = next(line for line in outcome.err.splitlines() if line.startswith("    python3 -m"))
        self.assertEqual(shlex.split(line)[4:], ["my arm's.mcap", "my arm's.mcap.h5"])

    def test_json_is_a_table_however_it_is_nested(self):
        records = [{"time": 0.01 * k, "joint": {"position": [0.1 * k, 1], "torque": k % 7}} for k in range(40)]
        for text, torque in [(json.dumps(records), "joint/torque"), (json.dumps(records, indent=1), "joint/torque"),
                             ("\n".join(json.dumps(one) for one in records), "joint/torque"),
                             (json.dumps({"meta": "x", "samples": records}), "samples/joint/torque"),
                             (json.dumps({"time": [0.01 * k for k in range(40)], "q_rad": [0.1 * k for k in range(40)],
                                          "tau_Nm": [k % 7 for k in range(40)]}), "tau_Nm")]:
            with self.subTest(text=text[:40]):
                self.write("a.json", text.encode())
                outcome = program.run("init", "a.json", "--joint", "1", folder=self.folder)
                self.assertIn(f'torque = "{torque}"', outcome.out)

    def assert_refused_by_init(self, name, words):
        outcome = program.run("init", name, folder=self.folder)
        self.assertEqual(outcome.code, 65, outcome.err)
        self.assertIn(words, outcome.said)
        return outcome

    def test_a_bag_of_ros_2_is_a_folder(self):
        os.mkdir(self.path("bag"))
        self.write("bag/metadata.yaml", b"rosbag2_bagfile_information:\n")
        self.assert_refused("bag", ["is a folder with a bag of ROS 2", "convert bag bag.h5"])

    def test_two_decimal_marks(self):
        self.write("mixed.csv", b"t_s;q_rad;tau_Nm\n0.5;1;2\n1.0;1,234;2\n1.5;1;2\n")
        self.assert_refused("mixed.csv", "1,234 in line 3 has a decimal comma, a number in line 2 a decimal point")

    def test_lines_cut_short_before_the_end(self):
        lines = TEXT.splitlines(keepends=True)
        self.write("torn.csv", "".join(lines[:400] + ["1.99,0.1\n"] + lines[401:]).encode())
        self.assert_refused("torn.csv", "line 401 has 2 cells, the header 3")

    def test_hdf5_that_was_left_open_before_all_was_saved(self):
        with h5py.File(self.path("whole.h5"), "w", libver="latest") as file:
            file["t_s"] = DATA[:, 0]
            file.flush()
            shutil.copy(self.path("whole.h5"), self.path("open.h5"))
        with open(self.path("open.h5"), "rb") as file:
            content = file.read()
        self.write("part.h5", content[: len(content) // 2])
        self.assert_refused("part.h5", ["was left open by the program that wrote it", "not all of it is in the file"])


class Jobs(Folder):
    def check(self, name):
        return program.run("check", name, folder=self.folder)

    def test_paths_of_windows(self):
        for path in (r"C:\data\x.csv", r"C:\Users\me\x.csv"):
            self.write("job.toml", JOB.replace("'%s'", f'"{path}"').replace("%s", 'position = "q"').encode())
            outcome = self.check("job.toml")
            self.assertEqual(outcome.code, 78)
            self.assertIn(r"write 'C:\data\x.csv' in single quotes", outcome.said)
        self.write("job.toml", (JOB.replace("'%s'", r'"C:\temp\new.csv"') % 'position = "q"').encode())
        outcome = self.check("job.toml")
        self.assertEqual(outcome.code, 66)
        self.assertIn("a path of Windows?", outcome.said)

    def test_a_recording_given_as_a_job(self):
        self.write("good.csv", TEXT.encode())
        outcome = self.check("good.csv")
        self.assertEqual(outcome.code, 78)
        self.assertIn("is a recording (CSV), not a job", outcome.said)
        self.assertIn("torquescope init good.csv", outcome.said)
        for name, content, words in [
            ("arm.urdf", b"<?xml version='1.0'?>\n<robot/>\n", "is XML, not a job"),
            ("good.csv.gz", gzip.compress(TEXT.encode()), "is a recording (CSV), not a job"),
            ("good.bin", bytes(300), "holds no text, not a job"),
        ]:
            self.write(name, content)
            self.assertIn(words, self.check(name).said)

    def test_a_result_cannot_go_through_a_pipe(self):
        self.write("good.csv", TEXT.encode())
        self.job("good.csv")
        outcome = program.run("run", "job.toml", "--out", "-", folder=self.folder)
        self.assertEqual(outcome.code, 64)
        self.assertIn("--json -", outcome.said)
        self.assertFalse(os.path.exists(self.path("-")))

    def test_check_as_data(self):
        self.write("good.csv", TEXT.encode())
        self.job("good.csv")
        outcome = program.run("check", "job.toml", "--json", "-", folder=self.folder)
        self.assertEqual(outcome.code, 0)
        self.assertEqual(json.loads(outcome.out)["schema"], 1)

    def test_a_short_run_tells_no_progress_unless_it_is_asked_to(self):
        self.write("good.csv", TEXT.encode())
        self.job("good.csv")
        self.assertNotIn("progress stage=", program.run("run", "job.toml", folder=self.folder).err)
        asked = program.run("run", "job.toml", "--out", "b.h5", "--progress", "lines", folder=self.folder)
        self.assertIn("progress stage=ols", asked.err)


@unittest.skipUnless(os.path.isdir(CASES), f"no cases of other people in {CASES}")
class Cases(Folder):
    """Files as people had them; README in each folder says what is right: 0.0918, 0.346, 0.599, 0.0405."""

    RIGHT = {"inertia": 0.0918, "viscous": 0.346, "coulomb": 0.599, "offset": 0.0405}

    def identified(self, case, job="job.toml", time=None):
        folder = os.path.join(CASES, case)
        with open(os.path.join(folder, job), encoding="utf-8") as file:
            text = file.read()
        # the folder may be read-only: the job goes elsewhere, with least squares alone
        text = text.replace('train = "', f'train = "{folder}/').split("[[estimator]]")[0]
        if time:
            text = text.replace('time = "stamp.sec"', f'time = "{time}"')
        self.write("job.toml", (text + '[[estimator]]\nname = "ols"\n').encode())
        return self.run_ols()

    def run_ols(self):
        out = self.path("r.h5")
        if os.path.exists(out):
            os.remove(out)
        outcome = program.run("run", "job.toml", "--out", "r.h5", folder=self.folder)
        self.assertEqual(outcome.code, 0, outcome.err)
        with h5py.File(out) as file:
            return file["runs/ols/parameters"][:].ravel()

    def assert_right(self, found, tolerance):
        np.testing.assert_allclose(found, list(self.RIGHT.values()), rtol=tolerance)

    def test_decimal_commas(self):
        found = self.identified("26_decimal_comma")
        with open(os.path.join(CASES, "26_decimal_comma", "data.csv"), encoding="utf-8") as file:
            self.write("data.csv", file.read().replace(",", ".").replace(";", ",").encode())
        job = self.path("job.toml")
        with open(job, encoding="utf-8") as file:
            text = file.read().replace(os.path.join(CASES, "26_decimal_comma") + "/", "")
        self.write("job.toml", text.encode())
        np.testing.assert_array_equal(found, self.run_ols())
        self.assert_right(found, 0.1)  # a shorter piece of it

    def test_hdf5_of_killed_writers(self):
        for job in ("job_good.toml", "job_left_open.toml", "job_left_swmr.toml", "job_preallocated.toml"):
            with self.subTest(job=job):
                self.assert_right(self.identified("22_hdf5_states", job), 0.05)

    def test_table_oddities(self):
        whole = self.identified("43_table_oddities", "job_bom.toml")
        for job, time in (
            ("units_row", None),
            ("preamble", None),
            ("iso", None),
            ("clock", None),
            ("hex_tail", None),
            ("sec_nsec", "stamp"),
        ):
            with self.subTest(job=job):
                found = self.identified("43_table_oddities", f"job_{job}.toml", time)
                np.testing.assert_allclose(found, whole, rtol=0.02)


if __name__ == "__main__":
    unittest.main(verbosity=1)
