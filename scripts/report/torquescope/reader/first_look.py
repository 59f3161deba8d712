"""Before this process lets HDF5 open a file that nobody vouches for: its seal is compared, then a child process with
limits opens it, walks all of it and reads it. What ends the child, or breaks the rules of results, ends here in one
ResultError.

    look_first("R.h5")        returns, or raises ResultError

Rules      those of the engine (ResultReader): hard links only, one name for each object, no values in other files, no
           filters but gzip and fletcher32, numbers of 8 bytes and texts of fixed length, no more values than the bytes
           can hold
Values     all are read in the child when the file has no seal or is small; in a large sealed one they lie where the
           writer put them, and HDF5 checks them as they are read
Without fork (Windows) the rules are checked in this process
"""

import contextlib
import os
import stat

import h5py
import numpy as np
from h5py._objects import phil

from ..errors import ResultError
from .content_digest import ABOUT_SCALES
from .file_seal import check_seal

FILTERS = {h5py.h5z.FILTER_DEFLATE, h5py.h5z.FILTER_FLETCHER32}
MOST_STEPS = 32  # each is made again for every object below it
MOST_GZIP_CAN = 1100  # bytes unpacked from one
SMALL = 64 << 20
SECONDS, BYTES_PER_SECOND, MORE_MEMORY = 60, 2 << 20, 10 << 30
WHAT_H5PY_RAISES = (OSError, RuntimeError, KeyError, ValueError, TypeError, MemoryError, OverflowError, IndexError)


def look_first(name):
    name = os.fspath(name)
    try:
        facts = os.stat(name)
        if not stat.S_ISREG(facts.st_mode):  # a pipe would hang, a device could do anything
            raise ResultError(f"{name} is not a file")
        seal = check_seal(name)
    except FileNotFoundError as error:
        raise ResultError(f"there is no file {name}") from error
    except OSError as error:
        raise ResultError(f"cannot read {name}: {error}") from error
    if seal == "broken":
        raise ResultError(f"{name} is damaged: its bytes do not match their sha256")
    read_values = seal == "absent" or facts.st_size <= SMALL
    look = _in_child if hasattr(os, "fork") else _look
    said = look(name, facts.st_size, read_values)
    if said:
        raise ResultError(f"{name} {said}")


def _in_child(name, size, read_values):
    """What is wrong with the file; "" for nothing."""
    ends = os.pipe()
    with phil:  # no other thread may hold the lock of h5py while the process divides
        child = os.fork()
    if child == 0:
        _be_the_child(ends[1], name, size, read_values)
    os.close(ends[1])
    with os.fdopen(ends[0], "rb") as answers:
        answer = answers.read()
    _, status = os.waitpid(child, 0)
    if os.WIFSIGNALED(status):
        return f"is damaged: HDF5 crashed (signal {os.WTERMSIG(status)}) or took too long while reading it"
    if status != 0 or not answer.endswith(b"."):
        return "is damaged: HDF5 ended early while reading it"
    return answer[:-1].decode()


def _be_the_child(answers, name, size, read_values):
    code = 1
    try:
        with contextlib.suppress(ImportError, OSError, ValueError):
            _confine(size)
        os.write(answers, _look(name, size, read_values).encode()[:4000] + b".")
        code = 0
    finally:
        os._exit(code)  # no exit handler of the parent runs


def _confine(size):
    import faulthandler
    import resource

    faulthandler.disable()
    nowhere = os.open(os.devnull, os.O_WRONLY)
    os.dup2(nowhere, 2)  # "free(): invalid pointer" helps nobody
    seconds = SECONDS + size // BYTES_PER_SECOND
    resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
    with open("/proc/self/statm", encoding="ascii") as file:
        in_use = int(file.read().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    _, most = resource.getrlimit(resource.RLIMIT_AS)
    wanted = in_use + MORE_MEMORY
    resource.setrlimit(resource.RLIMIT_AS, (wanted if most == resource.RLIM_INFINITY else min(wanted, most), most))


class _Refused(Exception):
    pass


def _look(name, size, read_values):
    path = "/"
    try:
        with h5py.File(name, "r", locking=False) as file:
            seen, waiting, claimed = set(), ["/"], 0
            while waiting:
                path = waiting.pop()
                if path.count("/") > MOST_STEPS:
                    path = path[:100] + "..."
                    raise _Refused("it lies deeper than anything in a result")
                node = file[path]
                address = h5py.h5o.get_info(node.id).addr
                if address in seen:
                    raise _Refused("it has two names; results never have that")
                seen.add(address)
                _look_at_attributes(node)
                if isinstance(node, h5py.Dataset):
                    claimed += _claimed_bytes(node)
                    if claimed > MOST_GZIP_CAN * size:
                        raise _Refused("it claims more values than the file can hold")
                    if read_values:
                        with contextlib.suppress(OSError):  # a checksum: whoever reads these values is told
                            _read(node)
                elif isinstance(node, h5py.Group):
                    waiting += [f"{path.rstrip('/')}/{child}" for child in _children(node)]
                else:
                    raise _Refused("it is neither a group nor a dataset")
    except _Refused as refused:
        return f"is damaged in {path}: {refused}"
    except WHAT_H5PY_RAISES as error:
        if path == "/":
            return f"is damaged or not an HDF5 file: {error}"
        return f"is damaged in {path}: {error}"
    return ""


def _children(group):
    for child in group:
        link = group.get(child, getlink=True)
        if not isinstance(link, h5py.HardLink):
            raise _Refused(f'"{child}" is a link to elsewhere; results have none')
        yield child


def _look_at_attributes(node):
    for key in node.attrs:
        if key in ABOUT_SCALES and isinstance(node, h5py.Dataset):  # nobody reads them here
            continue
        _check_type(node.attrs.get_id(key).dtype, f'attribute "{key}": ')
        np.asarray(node.attrs[key])


def _check_type(dtype, whose=""):
    fits = dtype.kind == "S" or (dtype.kind in "if" and dtype.itemsize == 8)
    if not fits:
        raise _Refused(f"{whose}it has a type that results never have ({dtype})")


def _claimed_bytes(dataset):
    _check_type(dataset.dtype)
    if dataset.shape is None:
        raise _Refused("it has no shape")
    if dataset.is_virtual or dataset.external:
        raise _Refused("its values lie in another file; results are complete in themselves")
    properties = dataset.id.get_create_plist()
    if any(properties.get_filter(i)[0] not in FILTERS for i in range(properties.get_nfilters())):
        raise _Refused("its filter is none that results have (fletcher32, gzip)")
    claimed = dataset.dtype.itemsize
    for extent in dataset.shape:
        claimed *= max(extent, 1)
    return claimed


def _read(dataset):
    """All of it, some MiB at once."""
    if dataset.ndim == 0 or dataset.size == 0:
        dataset[()]
        return
    rows = max(1, (4 << 20) * len(dataset) // max(1, dataset.size * dataset.dtype.itemsize))
    for first in range(0, len(dataset), rows):
        dataset[first:first + rows]
