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


def write_hdf5(path, seconds, columns, about, sources=None):
    """t_s and a dataset for each column, by its path and in this order; `about` becomes attributes of the file.
    sources: {path: what it was in the bag}, of columns that have another name there."""
    with _whole(path) as part, h5py.File(part, "w", track_order=True) as file:
        file.attrs.update(about)
        file["t_s"] = seconds
        file["t_s"].attrs.update({"units": "s", "long_name": f"time since the first row, {about['clock']} of "
                                                             f"{about['time_of_topic']}"})
        for name, values in columns.items():
            if "/" in name:  # h5py tracks the order of a file's root alone
                _ordered_group(file, name.rpartition("/")[0])
            file[name] = values
        for name, source in (sources or {}).items():
            file[name].attrs["long_name"] = source


def _ordered_group(file, path):
    here = file
    for part in path.split("/"):
        here = here[part] if part in here else here.create_group(part, track_order=True)


def write_csv(path, seconds, columns, about, sources=None):
    """The same as text; what is unknown is an empty cell, and `about` stands in comments."""
    with _whole(path) as part, part.open("w", encoding="utf-8", newline="") as file:
        for key, value in {**about, **{f"source of {name}": text for name, text in (sources or {}).items()}}.items():
            file.write(f"# {key}: {' '.join(str(value).split())}\n")
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["t_s", *columns])
        for row in np.column_stack([seconds, *columns.values()]).tolist():
            writer.writerow(["" if value != value else repr(value) for value in row])
