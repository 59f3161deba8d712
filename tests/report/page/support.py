"""Where the page's own modules are, and result files made once per process in a folder that goes away."""

import atexit
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from functools import lru_cache
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parents[2] / "scripts" / "report"), str(HERE)]

try:
    import h5py  # noqa: F401
    import jinja2  # noqa: F401
    import matplotlib  # noqa: F401
except ImportError as error:
    print(f"skipped: {error} (Debian: python3-h5py python3-matplotlib python3-jinja2)")
    sys.exit(77)

import make_arm_result  # noqa: E402
import make_board  # noqa: E402
import make_replay  # noqa: E402
import make_result  # noqa: E402
import make_servo  # noqa: E402
import vary_diagnosis  # noqa: E402

FOLDER = Path(tempfile.mkdtemp(prefix="torquescope_page_"))
atexit.register(shutil.rmtree, FOLDER, True)
FULL = bool(os.environ.get("TORQUESCOPE_FULL"))  # scripts/test --full


def every_time(kinds, *chosen):
    """Those that are drawn each time the tests run; all of them in full."""
    assert set(chosen) <= set(kinds)
    return tuple(kinds) if FULL else chosen


KINDS = every_time(make_result.KINDS, "crs", "many")
ARMS = tuple(make_arm_result.KINDS)
BOARDS = every_time(make_board.KINDS, "board")
# the C++ store writes these (tests/report/write_example_diagnosis.cpp); ctest says where the program is
EXAMPLE_WRITER = os.environ.get("TORQUESCOPE_EXAMPLE_DIAGNOSIS")
PAGES = os.environ.get("TORQUESCOPE_PAGES")
VERDICTS = (
    ("named", "class", "partly", "none", "unexplained", "insufficient", "data_fault") if EXAMPLE_WRITER else ()
)
VARIED = every_time(vary_diagnosis.KINDS, "minute", "two_joints") if EXAMPLE_WRITER else ()
DIAGNOSES = VERDICTS + VARIED
REPLAYS = every_time(make_replay.ALONE, "replayed", "replayed_once")  # of `torquescope replay`
ROLLED = every_time(make_replay.ROLLED, "rolled", "rolled_several")  # of estimators that fit simulations
SERVOS = every_time(make_servo.KINDS, "servo", "servo_none")  # of `torquescope diagnose` of many recordings
BESIDE = tuple(kind for kind, of in make_replay.BESIDE.items() if of in (*KINDS, *DIAGNOSES))  # beside other results
COMPARED = ("compared",) if EXAMPLE_WRITER else ()  # results side by side
needs_diagnoses = unittest.skipUnless(
    EXAMPLE_WRITER, "TORQUESCOPE_EXAMPLE_DIAGNOSIS does not name write_example_diagnosis"
)


@lru_cache(maxsize=None)
def result(kind):
    """Path of the file of this kind: made by make_result.py, make_arm_result.py, write_example_diagnosis.cpp,
    vary_diagnosis.py, make_replay.py, make_servo.py or make_board.py."""
    path = FOLDER / f"{kind}.{'json' if kind in make_board.KINDS else 'h5'}"
    if kind in VERDICTS:
        subprocess.run([EXAMPLE_WRITER, path, kind], check=True, capture_output=True)
    elif kind in vary_diagnosis.KINDS:
        source, vary = vary_diagnosis.KINDS[kind]
        shutil.copy(result(source), path)
        with h5py.File(path, "r+") as file:
            vary(file)
    elif kind in make_replay.BESIDE:
        shutil.copy(result(make_replay.BESIDE[kind]), path)
        with h5py.File(path, "r+") as file:
            make_replay.beside(file)
    elif kind in make_replay.ROLLED:
        source, change = make_replay.ROLLED[kind]
        shutil.copy(result(source), path)
        with h5py.File(path, "r+") as file:
            change(file)
    elif kind in make_replay.ALONE:
        make_replay.alone(path, make_replay.ALONE[kind])
    elif kind in make_servo.KINDS:
        make_servo.KINDS[kind](path)
    elif kind in make_board.KINDS:
        make_board.write(kind, path)
    elif kind in ARMS:
        make_arm_result.KINDS[kind](path)
    else:
        make_result.KINDS[kind](path)
    return path


@lru_cache(maxsize=None)
def study(kind):
    from torquescope.page.study import Study
    return Study(result(kind))


@lru_cache(maxsize=None)
def page(kind):
    """Path of the built page: ctest's (make_pages.py), or one of this process."""
    if PAGES and (made := Path(PAGES) / f"{kind}.html").exists():
        return made
    from torquescope.page import board, build, build_board, compare
    path = FOLDER / f"{kind}.html"
    if kind in COMPARED:
        path.write_text(compare.page([result("crs"), result("named"), result("none")]), encoding="utf-8")
        return path
    text = build_board.page(board.Board(result(kind))) if kind in make_board.KINDS else build.page(study(kind))
    path.write_text(text, encoding="utf-8")
    return path


def main():
    """unittest.main with ctest's code for "skipped" when every test was."""
    program = unittest.main(exit=False, verbosity=2)
    everything_skipped = program.result.testsRun and len(program.result.skipped) == program.result.testsRun
    sys.exit(77 if everything_skipped else not program.result.wasSuccessful())
