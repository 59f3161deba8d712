"""Recordings for the command-line tests: one good one, and the ways in which files go wrong."""

import gzip
import math
import os
import random

HEADER = "t_s,q_rad,tau_Nm"


def good_rows(seconds=10.0, rate_hz=200.0):
    """A joint of 0.05 kg m2 with friction on two sines; the noise is the same in every run of the tests."""
    noise = random.Random(20140101)
    rows = []
    for k in range(int(seconds * rate_hz)):
        t = k / rate_hz
        q = 0.8 * math.sin(2 * math.pi * 0.5 * t) + 0.3 * math.sin(2 * math.pi * 1.3 * t + 0.4)
        dq = 0.8 * math.pi * math.cos(2 * math.pi * 0.5 * t) + 0.78 * math.pi * math.cos(2 * math.pi * 1.3 * t + 0.4)
        ddq = -0.8 * math.pi**2 * math.sin(2 * math.pi * 0.5 * t) - 2.028 * math.pi**2 * math.sin(
            2 * math.pi * 1.3 * t + 0.4
        )
        tau = 0.05 * ddq + 0.1 * dq + (0.3 if dq > 0 else -0.2) + noise.gauss(0.0, 0.02)
        rows.append([f"{t:.4f}", f"{q:.9f}", f"{tau:.6f}"])
    return rows


def text_of(rows, header=HEADER):
    return "".join(line + "\n" for line in [header] + [",".join(row) for row in rows])


def with_cell(rows, row, column, value):
    changed = [list(cells) for cells in rows]
    for index in row if isinstance(row, range) else [row]:
        changed[index][column] = value
    return changed


def write_recordings(folder):
    """Every recording that a job in bad/ names, and good.csv."""
    rows = good_rows()
    whole = range(len(rows))
    texts = {
        "good.csv": text_of(rows),
        "empty.csv": "",
        "header_only.csv": HEADER + "\n",
        "no_header.csv": text_of(rows[1:], ",".join(rows[0])),
        "nan.csv": text_of(with_cell(rows, range(500, 517), 1, "nan")),
        "text_cell.csv": text_of(with_cell(rows, 700, 2, "high")),
        "ragged.csv": text_of(rows[:300] + [rows[300][:2]] + rows[301:]),
        "backwards.csv": text_of(rows[:810] + rows[:900]),
        "gap.csv": text_of(rows[:150] + rows[-150:]),
        "constant_position.csv": text_of(with_cell(rows, whole, 1, "0.5")),
        "constant_torque.csv": text_of(with_cell(rows, whole, 2, "1.25")),
        "constant_time.csv": text_of(with_cell(rows, whole, 0, "0.0")),
        "too_short.csv": text_of(rows[:4]),
        "short.csv": text_of(rows[:30]),
        "repeated_header.csv": text_of(rows[:500] + [HEADER.split(",")] + rows[500:]),
        "other_rate.csv": text_of(good_rows(10.0, 100.0)),
    }
    for name, text in texts.items():
        with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
            file.write(text)
    good = texts["good.csv"].encode()
    packed = gzip.compress(good, mtime=0)
    contents = {
        "utf16.csv": texts["good.csv"].encode("utf-16")[:-1],
        "zero_bytes.csv": good[:2000] + b"\0" * 200 + good[2200:],
        "broken.h5": b"\x89HDF\r\n\x1a\n" + bytes(range(256)) * 8,
        "cut.csv.gz": packed[: len(packed) // 2],
        "noise.bin": bytes(random.Random(7).randrange(256) for _ in range(5000)),
    }
    for name, content in contents.items():
        with open(os.path.join(folder, name), "wb") as file:
            file.write(content)
    os.mkdir(os.path.join(folder, "folder.csv"))
    os.mkfifo(os.path.join(folder, "fifo.csv"))
