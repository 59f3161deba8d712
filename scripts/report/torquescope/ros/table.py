"""A table over time as a file that the program reads as a recording. The file gets its name when it is whole."""

import contextlib
import csv
import os

import h5py
import numpy as np


@contextlib.contextmanager
def _whole(path):
    if path.exists():
        raise FileExistsError(f"error: {path} exists\n  help: delete it, or name another")
    part = path.with_name(path.name + ".part")
    try:
        yield part
        os.replace(part, path)
    finally:
        part.unlink(missing_ok=True)


def write_hdf5(path, seconds, columns, about):
    """t_s and a dataset for each column, by its path; `about` becomes attributes of the file."""
    with _whole(path) as part, h5py.File(part, "w") as file:
        file.attrs.update(about)
        file["t_s"] = seconds
        file["t_s"].attrs.update({"units": "s", "long_name": f"time since the first row, {about['clock']} of "
                                                             f"{about['time_of_topic']}"})
        for name, values in columns.items():
            file[name] = values


def write_csv(path, seconds, columns, about):
    """The same as text; what is unknown is an empty cell, and `about` stands in comments."""
    with _whole(path) as part, part.open("w", encoding="utf-8", newline="") as file:
        for key, value in about.items():
            file.write(f"# {key}: {' '.join(str(value).split())}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t_s", *columns])
        for row in np.column_stack([seconds, *columns.values()]).tolist():
            writer.writerow(["" if value != value else repr(value) for value in row])
