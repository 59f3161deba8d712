"""The content digest of a result file, computed anew from what h5py reads (engine/store/RESULT_FORMAT.md, "Digest").

    with h5py.File("R.h5", locking=False) as file:
        assert content_sha256(file) == file.attrs["content_sha256"]
"""

import hashlib
import struct

import h5py
import numpy as np

FIRST_FORMAT = 2  # of files with this digest
BLOCK_BYTES = 65536  # rows of a dataset that are digested together
ABOUT_THE_FILE = (
    "complete",
    "content_sha256",
    "provenance_sha256",
)  # attributes of "/" that say nothing about the content
# of datasets: addresses inside the file, and what stands behind them lies in a heap without a checksum
ABOUT_SCALES = ("CLASS", "NAME", "REFERENCE_LIST", "DIMENSION_LIST")


def _count(number):
    return struct.pack("<Q", number)


def _text(text):
    """The number of its bytes, then the bytes (str or, as h5py gives them, bytes)."""
    raw = text.encode() if isinstance(text, str) else bytes(text)
    return _count(len(raw)) + raw


def _little_endian(values):
    return values.astype("<i8" if values.dtype.kind == "i" else "<f8", copy=False).tobytes()


def _attribute(value):
    if isinstance(value, (str, bytes)):  # h5py gives str for one text alone
        return _text("text") + _text(value)
    if np.ndim(value) == 0:
        return _text("whole" if value.dtype.kind == "i" else "number") + _little_endian(value)
    if value.dtype.kind in "SO":
        return _text("texts") + _count(len(value)) + b"".join(map(_text, value))
    return _text("numbers") + _count(len(value)) + _little_endian(value)


def _blocks(dataset):
    """The bytes of each block of rows."""
    if dataset.size == 0:
        return
    if dataset.dtype.kind == "S":
        yield b"".join(map(_text, dataset[()].ravel()))
    elif dataset.ndim == 0:
        yield _little_endian(dataset[()])
    else:
        row_bytes = 8 * dataset.size // len(dataset)
        step = max(1, BLOCK_BYTES // row_bytes)
        for first in range(0, len(dataset), step):
            yield _little_endian(dataset[first:first + step])


def _dataset(dataset):
    kind = {"f": "number", "i": "whole", "S": "text"}[dataset.dtype.kind]
    yield _text("dataset") + _text(kind) + _count(dataset.ndim) + b"".join(map(_count, dataset.shape))
    for block in _blocks(dataset):
        yield hashlib.sha256(block).digest()


def _object(path, node):
    yield _text("object") + _text(path)
    for name in sorted(node.attrs, key=str.encode):
        about_scales = name in ABOUT_SCALES and isinstance(node, h5py.Dataset)
        if not about_scales and (path != "/" or name not in ABOUT_THE_FILE):
            yield _text("attribute") + _text(name) + hashlib.sha256(_attribute(node.attrs[name])).digest()
    if isinstance(node, h5py.Dataset):
        yield from _dataset(node)


def content_sha256(file):
    """64 letters; `file` is an open h5py.File."""
    paths = ["/"]
    file.visit(lambda name: paths.append("/" + name))
    total = hashlib.sha256()
    for path in sorted(paths, key=str.encode):
        if (path + "/").startswith("/provenance/"):
            continue
        for part in _object(path, file[path]):
            total.update(part)
    return total.hexdigest()
