"""`init`, `check`, `diagnose`, `show`, without an edit, over real recordings that have a header (../shared/recordings).

A draft that `init` calls ready (exit code 0) must pass the other commands. Where `init` ends with 65 or 78 (its own
codes for a recording that tells nothing, and for lines that only a person knows), it must say why, and `check` must
refuse the draft with one of them. By default one recording of each kind of header is drafted and checked; with
TORQUESCOPE_FULL=1 every recording, and each ready draft is diagnosed and shown.
Use: TORQUESCOPE=build/release/bin/torquescope /usr/bin/python3 tests/cases/run_recordings.py [PART OF A PATH...]
"""

import gzip
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
RECORDINGS = pathlib.Path(os.environ.get("TORQUESCOPE_RECORDINGS", ROOT.parent / "shared" / "recordings"))
PROGRAM = os.environ.get("TORQUESCOPE", str(ROOT / "build/release/bin/torquescope"))
FULL = bool(os.environ.get("TORQUESCOPE_FULL"))
NEEDS_A_PERSON = (65, 78)


def header_of(path):
    opened = gzip.open if path.suffix == ".gz" else open
    with opened(path, "rt", encoding="utf-8", errors="replace") as lines:
        return next((line.strip() for line in lines if line.strip() and not line.startswith("#")), "")


def has_names(header):
    return any(character.isalpha() for character in header.split(",")[0])


def chosen(parts):
    paths = sorted(path for path in RECORDINGS.rglob("*") if path.name.endswith((".csv", ".csv.gz")))
    paths = [path for path in paths if not parts or any(part in str(path) for part in parts)]
    headers = {path: header_of(path) for path in paths}
    named = [path for path in paths if has_names(headers[path])]
    if FULL:
        return named
    return list({(path.parent, headers[path]): path for path in reversed(named)}.values())[::-1]


def call(folder, *words):
    result = subprocess.run([PROGRAM, *words, "--color", "never"], cwd=folder, text=True, capture_output=True,
                            timeout=1800, check=False)
    return result.returncode, " ".join((result.stdout + result.stderr).split())


def outcome(path, folder):
    """(is it right, what happened)"""
    code, text = call(folder, "init", str(path), "--out", "job.toml")
    if code not in (0, *NEEDS_A_PERSON):
        return False, f"init ends with {code}: {text[-300:]}"
    check, said = call(folder, "check", "job.toml")
    if check != code and not {check, code} <= set(NEEDS_A_PERSON):
        return False, f"init ends with {code}, check with {check}: {said[-300:]}"
    if code:
        return len(text) > 0, f"needs a person ({code}): {text[-300:]}"
    if not FULL:
        return True, "drafted, checked"
    code, said = call(folder, "diagnose", "job.toml", "--out", "d.h5", "--json", "d.json", "--progress", "none")
    if code:
        return False, f"diagnose ends with {code}: {said[-300:]}"
    shown, said = call(folder, "show", "d.h5")
    verdict = json.loads((pathlib.Path(folder) / "d.json").read_text()).get("verdict", "none told")
    return shown == 0, f"{verdict}" if shown == 0 else f"show ends with {shown}: {said[-300:]}"


def main(parts):
    if not RECORDINGS.is_dir():
        print(f"skipped: {RECORDINGS} is not there (recordings that are not ours to give)")
        return 77
    failed, paths = 0, chosen(parts)
    for path in paths:
        with tempfile.TemporaryDirectory() as folder:
            is_right, words = outcome(path, folder)
        failed += not is_right
        print(f"{'ok  ' if is_right else 'FAIL'} {path.relative_to(RECORDINGS)}: {words}", flush=True)
    print(f"{len(paths) - failed} of {len(paths)} right")
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
