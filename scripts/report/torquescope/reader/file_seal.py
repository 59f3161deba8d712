"""The seal at the end of a result: a SHA-256 of all its bytes but the values, compared before HDF5 sees any of them.

    check_seal("R.h5")        'whole', 'absent' (of an earlier version, or written into by another program) or 'broken'

Source     engine/store/RESULT_FORMAT.md, "Seal"
"""

import hashlib
import os
import struct

LETTERS = b"TORQUESCOPESEAL1"
FOOTER = struct.Struct("<16sQQ32s32s")  # letters, bytes in front of the table, ranges in it, job, sha256
RANGE = struct.Struct("<QQ")  # of values: begin, end
AT_ONCE = 1 << 20


def check_seal(name):
    with open(name, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        if size < FOOTER.size:
            return "absent"
        file.seek(size - FOOTER.size)
        footer = file.read(FOOTER.size)
        letters, hdf5_bytes, count, _, told = FOOTER.unpack(footer)
        if letters != LETTERS:
            return "absent"
        if hdf5_bytes + count * RANGE.size + FOOTER.size != size:
            return "broken"
        file.seek(hdf5_bytes)
        table = file.read(count * RANGE.size)
        ranges = [*RANGE.iter_unpack(table), (hdf5_bytes, hdf5_bytes)]
        digest = hashlib.sha256(footer[:-32] + table)
        place = 0
        for begin, end in ranges:
            if not place <= begin <= end <= hdf5_bytes:
                return "broken"
            _add(digest, file, place, begin)
            place = end
        return "whole" if digest.digest() == told else "broken"


def _add(digest, file, begin, end):
    file.seek(begin)
    while begin < end:
        piece = file.read(min(AT_ONCE, end - begin))
        if not piece:
            raise OSError("the file became shorter while it was read")
        digest.update(piece)
        begin += len(piece)
