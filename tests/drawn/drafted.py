"""What the kinds of `torquescope init` share: the draft is checked and run without an edit, and judged."""

import pathlib
import tomllib

TOLERANCE = 0.15  # of a parameter: the cut-offs are guessed, and they cost more than those of a written job


def draft(call, folder, file, *more):
    """The answer of init, and the sections of the job it wrote."""
    job = pathlib.Path(folder) / "drafted.toml"
    job.unlink(missing_ok=True)
    answer = call("init", file, "--out", "drafted.toml", *more, json_file=False)
    return answer, tomllib.loads(job.read_text()) if job.exists() else {}


def wrong_columns(job, expected):
    """What the job's columns are not, or None. expected: by role; None: there must be none."""
    columns = job.get("recording", {}).get("columns", {})
    for role, column in expected.items():
        if columns.get(role) != column:
            return f"{role} is {columns.get(role)!r}, not {column!r}"
    return None


def wrong_run(call, joint, names=("inertia", "viscous", "coulomb"), scale=1.0):
    """What is wrong with check and run of the draft, or None."""
    check = call("check", "drafted.toml")
    if check.topics("fault"):
        return f"check finds {check.topics('fault')}"
    return call("run", "drafted.toml", "--out", "r.h5").wrong_parameters(joint, dict.fromkeys(names, TOLERANCE), scale)
