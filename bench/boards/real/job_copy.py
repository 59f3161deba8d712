"""A job as it is, or with another number of replicates, where its relative paths still lead to its recordings.

A foreign folder is left as it was found. The copy stands in a tree of links: folders on the way to the job are made,
everything beside them is a link to the original.
"""

import hashlib
import json
import os
import re
import tomllib


def with_twins(text, twins):
    """The job with so many replicates; as it was for None."""
    if twins is None:
        return text
    wanted = tomllib.loads(text)
    section = re.search(r"^\[diagnose\][^\n]*\n", text, re.M)
    if not section:
        return f"{text.rstrip()}\n\n[diagnose]\ntwins = {twins}\n"
    head, rest = text[: section.end()], text[section.end():]
    if "twins" in wanted["diagnose"]:
        return head + re.sub(r"^(\s*)twins\s*=\s*\d+", rf"\g<1>twins = {twins}", rest, count=1, flags=re.M)
    return f"{head}twins = {twins}\n{rest}"


def place(folder, job, tree, text):
    """Writes the copy of FOLDER/job into the tree and returns its path."""
    source, made = folder.resolve(), tree
    made.mkdir(parents=True, exist_ok=True)
    for step in job.relative_to(folder).parts:
        for entry in source.iterdir():
            beside = made / entry.name
            if entry.name != step and not os.path.lexists(beside):
                beside.symlink_to(entry)
        source, made = source / step, made / step
        if made.is_symlink():
            made.unlink()  # an earlier job had it beside its way; through the link the original would be written
        if source.is_dir():
            made.mkdir(exist_ok=True)
    made.write_text(text, encoding="utf-8")
    return made


def digest(path, text):
    """Of a job's text and of its recordings as they lie there: their sizes and when they were written."""
    recording = tomllib.loads(text).get("recording", {})
    files = [recording.get("train"), recording.get("validate")]
    facts = [text]
    for name in [one for some in files for one in (some if isinstance(some, list) else [some]) if one]:
        file = path.parent / name
        facts.append([name, file.stat().st_size, file.stat().st_mtime_ns] if file.exists() else [name])
    return hashlib.sha256(json.dumps(facts).encode()).hexdigest()
