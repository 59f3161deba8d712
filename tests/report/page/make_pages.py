"""Builds the page of every kind once, for the tests that ctest tells where they are (support.py): make_pages.py
FOLDER"""

import shutil
import sys
from pathlib import Path

import support

folder = Path(sys.argv[1])
shutil.rmtree(folder, ignore_errors=True)
folder.mkdir(parents=True)
kinds = support.KINDS + support.ARMS + support.DIAGNOSES + support.BOARDS + support.COMPARED
for kind in kinds + support.REPLAYS + support.BESIDE + support.ROLLED + support.SERVOS:
    shutil.copy(support.page(kind), folder)
