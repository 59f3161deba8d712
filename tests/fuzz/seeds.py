"""Small files that the readers accept, or nearly: where fuzzing begins. Made anew each time; none is a real recording.

Use: MAKE_SEGMENT=build/release/bin/make_segment /usr/bin/python3 tests/fuzz/seeds.py FOLDER     one folder per reader
                                                                                                 in it
"""

import glob
import gzip
import json
import os
import shutil
import subprocess
import sys

import h5py
import numpy as np
import scipy.io

HERE = os.path.dirname(os.path.abspath(__file__))
SOURCE = os.path.join(HERE, "..", "..")
sys.path.insert(0, os.path.join(HERE, "..", "jobs"))

import recordings  # noqa: E402

ROWS = recordings.good_rows(seconds=0.2)
DATA = np.array(ROWS, dtype=float)
NAMES = recordings.HEADER.split(",")

# reads a recording like these
JOB = """
[recording]
train = "%s"
columns = {time = "t_s", position = "q_rad", torque = "tau_Nm"}

[model]
joint = "revolute"
terms = ["inertia"]

[[estimator]]
name = "ols"
"""


def jobs(folder):
    for path in glob.glob(f"{SOURCE}/jobs/*.toml") + glob.glob(f"{SOURCE}/tests/jobs/bad/*.toml"):
        with open(path, "rb") as file:
            yield os.path.basename(path), file.read()


def csvs(folder):
    text = recordings.text_of(ROWS)
    yield "comma", text.encode()
    yield "semicolon", text.replace(",", ";").replace("\n", "\r\n").encode()
    yield "tab", ("\ufeff" + text.replace(",", "\t")).encode()
    yield "blanks", ("# " + text.replace(",", "  ")).encode()
    yield "quoted", ('"t_s","q,rad","tau_Nm",\n' + "0.1,nan,-1e-3,\n,2,off,\n" * 3).encode()
    yield "packed", gzip.compress(text.encode(), mtime=0)
    yield "two_members", gzip.compress(text[:900].encode(), mtime=0) + gzip.compress(text[900:].encode(), mtime=0)
    yield "utf16", text.encode("utf-16")
    commas = text.replace(",", ";").replace(".", ",").split("\n", 1)
    yield "decimal_commas", f"Scope;run\nRate;200\n\n{commas[0]}\n[s];[rad];[Nm]\n{commas[1]}".encode("latin-1")
    yield "stamps", "".join(
        f"2024-05-01T12:00:{k:02},{-k}:00,-1.#IND\n" if k else "t,q,tau\n" for k in range(30)
    ).encode()
    yield "clocks", ("t\tq\n" + "".join(f"23:59:{k}.5\t{k}\n" for k in range(50, 60)) + "00:00:00.5\t").encode()


def echoes(folder):
    yield "joints", "".join(f"{k},{k},base,a,b,{k},1,2,nan,3,{-k}e-3\n" for k in range(40)).encode()
    yield "lists_are_empty", ("A message was lost!!!\n" + "".join(f"1,{k},,a,{k},,\n" for k in range(40))).encode()
    yield "other", "".join(f"1,{k},base,{k},text,\n" for k in range(40)).encode()


def hdf5s(folder):
    for library, packing in ((None, {}), (None, {"compression": "gzip", "shuffle": True, "chunks": True}),
                             (("v110", "v110"), {"fletcher32": True, "chunks": True})):
        path = os.path.join(folder, f"{library is None}_{len(packing)}")
        with h5py.File(path, "w", libver=library) as file:
            for name, values in zip(NAMES, DATA.T):
                file.create_dataset(name, data=values, **packing)
            table = file.create_dataset("joints/table", data=DATA.astype("f4"), **packing)
            table.attrs["columns"] = NAMES  # of variable length: in a heap
            file.create_dataset("joints/m", data=DATA.T).attrs["MATLAB_class"] = np.bytes_(b"double")
            file["joints/fixed"] = DATA[:, 0].astype(">i2")
            file["joints/fixed"].attrs["columns"] = np.array([b"a"], dtype="S4")
            file["joints/text"], file["joints/deep"] = "no number", h5py.SoftLink("/t_s")
            file["joints/up"], file["elsewhere"] = file["/"], h5py.ExternalLink("other.h5", "/x")
    return ()


def jsons(_):
    records = [{"t": 0.01 * k, "joint": {"q": [0.1 * k, 1.0], "on": k % 2 == 0}, "note": "a"} for k in range(9)]
    columns = {"meta": {"robot": "r"}, "t": [0.01 * k for k in range(9)], "q": [[k, 2 * k] for k in range(9)]}
    texts = {"records": json.dumps(records), "lines": "\n".join(json.dumps(one) for one in records),
             "columns": json.dumps(columns, indent=1), "not_numbers": '[{"t": NaN, "q": -Infinity}, {"t": null}]'}
    return [(name + ".json", text.encode()) for name, text in texts.items()]


def npzs(folder):
    values = dict(zip(NAMES, DATA[:9].T))
    kinds = np.zeros(9, dtype=[("t_s", "<f8"), ("q", ">f4", (2,)), ("n", "u1"), ("at", "M8[ns]"), ("w", "U3")])
    np.savez(os.path.join(folder, "plain.npz"), **values, f=np.asfortranarray(DATA[:9]))
    np.savez_compressed(os.path.join(folder, "packed.npz"), **values, h=DATA[:9].astype("f2"), text=np.array("abc"))
    np.save(os.path.join(folder, "matrix.npy"), DATA[:9])
    np.save(os.path.join(folder, "structured.npy"), kinds)
    return ()


def mat5s(folder):
    values = dict(zip(NAMES, DATA.T))
    more = {
        "f": DATA.astype("f4"),
        "i": np.arange(9, dtype="i2"),
        "c": np.array([1j]),
        "text": "abc",
        "e": np.zeros((0, 3)),
        "s": {"a": np.array([1, "x"], dtype=object)},
        "cube": np.zeros((2, 2, 2)),
        "b": np.array([[True]]),
        "u": np.uint64([7]),
    }
    scipy.io.savemat(os.path.join(folder, "plain.mat"), values)
    scipy.io.savemat(os.path.join(folder, "kinds.mat"), {**values, **more})
    scipy.io.savemat(os.path.join(folder, "packed.mat"), {**values, **more}, do_compression=True)
    return ()


def copy_plainly(source, target):
    """Everything without filters and chunks: no checksum stands before the numbers."""
    for name, value in source.attrs.items():
        target.attrs.create(name, value, dtype=source.attrs.get_id(name).dtype)
    for name, item in source.items():
        if isinstance(item, h5py.Group):
            copy_plainly(item, target.create_group(name))
        else:
            copied = target.create_dataset(name, data=item[()], dtype=item.dtype)
            for key, value in item.attrs.items():
                copied.attrs.create(key, value, dtype=item.attrs.get_id(key).dtype)


def segments(folder):
    whole, plain = os.path.join(folder, "whole.h5"), os.path.join(folder, "plain.h5")
    subprocess.run([os.environ["MAKE_SEGMENT"], whole], check=True)
    with h5py.File(whole, "r") as source, h5py.File(plain, "w", libver=("v110", "v110")) as target:
        copy_plainly(source, target)
        del target.attrs["sealed"]  # it has none
    return ()


def replaced(group, name, values):
    del group[name]
    group.create_dataset(name, data=values)


# what a file may say of itself though its numbers are not there, or lead outside
LIES = {
    "no_width": lambda f: replaced(f, "parts/de/elapsed_s", np.zeros((2, 0))),
    "no_count": lambda f: replaced(f, "parts/de/nonfinite", np.zeros((2, 0), dtype="i8")),
    "evaluations_in_two_columns": lambda f: replaced(f, "parts/de/evaluations", np.zeros((8, 2), dtype="i8")),
    "evaluations_without_columns": lambda f: replaced(f, "parts/de/evaluations", np.zeros((8, 0), dtype="i8")),
    "few_evaluations": lambda f: replaced(f, "parts/de/evaluations", np.zeros(7, dtype="i8")),
    "wide_parameters": lambda f: replaced(f, "parts/de/parameters", np.zeros((2, 9))),
    "wide_population": lambda f: replaced(f, "parts/de/population", np.zeros((8, 11))),
    "wide_state": lambda f: replaced(f, "parts/de/state_numbers", np.zeros((13, 2))),
    "large_state": lambda f: replaced(f, "parts/de/state_sizes", np.array([10, 1 << 39])),
    "many_states": lambda f: replaced(f, "parts/de/state_entries", np.array([0, 99])),
    "negative_run": lambda f: replaced(f, "parts/de/run", np.array([-1, 2])),
    "beyond_its_runs": lambda f: replaced(f, "parts/de/run", np.array([0, 3])),
    "beyond_its_generations": lambda f: replaced(f, "parts/de/first", np.array([0, 1 << 40])),
    "negative_shape": lambda f: f["parts/de"].attrs.__setitem__("members", np.int64(-5)),
    "overflowing_shape": lambda f: f["parts/de"].attrs.__setitem__("members", np.int64(1 << 62)),
}


def lying_segments(home):
    """A folder of them; every one is to be refused."""
    whole = os.path.join(home, "segment", "plain.h5")
    folder = os.path.join(home, "lies")
    os.mkdir(folder)
    for name, lie in LIES.items():
        shutil.copy(whole, os.path.join(folder, name))
        with h5py.File(os.path.join(folder, name), "r+", libver=("v110", "v110")) as file:
            lie(file)
    return folder


MAKERS = {"job": jobs, "csv": csvs, "hdf5": hdf5s, "json": jsons,
          "mat5": mat5s, "npz": npzs, "ros_echo": echoes, "segment": segments}


def make(home):
    for reader, seeds in MAKERS.items():
        folder = os.path.join(home, reader)
        os.mkdir(folder)
        for name, content in seeds(folder):
            with open(os.path.join(folder, name), "wb") as file:
                file.write(content)


if __name__ == "__main__":
    make(sys.argv[1])
