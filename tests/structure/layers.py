"""Includes only point downwards: engine/layers.txt is the law, this test reads it and every #include of ours.

A folder of engine/ that layers.txt names (and kernels/) is a layer; a file may include its own layer and those after
its layer's colon. The first folder of a layer's path is its room: rooms are few, and form no cycle either.
The picture in engine/README.md is made from the same file:  layers.py ROOT --write  rewrites it.
"""
import pathlib
import re
import sys

MOST_ROOMS = 14  # folders of engine/: as many as one can hold in mind
INCLUDE = re.compile(r'^\s*#\s*include\s+"((?:engine|kernels)/[^"]+)"', re.MULTILINE)


def read_layers(text):
    """layers.txt -> {layer: set of layers it may use}; "all of the above" means what it says. A line that begins with
    a blank goes on with the one before."""
    allowed = {}
    for line in re.sub(r"\n[ \t]+", " ", text).splitlines():
        if not line.strip():
            continue
        name, _, uses = line.partition(":")
        uses = uses.strip()
        allowed[name] = set(allowed) if uses == "all of the above" else set(uses.split())
    return allowed


def layer_of(path, allowed):
    """The innermost folder of the path that is a layer; without one the folder itself."""
    folders = pathlib.PurePosixPath(path.removeprefix("engine/")).parent.parts
    inner = ["/".join(folders[:depth]) for depth in range(len(folders), 0, -1)]
    return next((folder for folder in inner if folder in allowed), inner[0] if inner else "")


def room_of(layer):
    return layer.partition("/")[0]


def rooms_of(allowed):
    """{room: rooms that its layers may use}, in the order of layers.txt"""
    rooms = {}
    for layer, uses in allowed.items():
        rooms.setdefault(room_of(layer), set()).update(map(room_of, uses))
    return {room: uses - {room} for room, uses in rooms.items()}


def everything_below(room, rooms):
    """All rooms that one can come to from this one."""
    found, open_ones = set(), [room]
    while open_ones:
        further = rooms[open_ones.pop()] - found
        found |= further
        open_ones += further
    return found


def faults_of_rooms(allowed):
    rooms = rooms_of(allowed)
    found = [f"engine/{room}: uses itself by way of other rooms" for room in rooms
             if room in everything_below(room, rooms)]
    count = len(rooms.keys() - {"kernels"})
    return found + ([f"engine/ has {count} rooms, more than {MOST_ROOMS}"] if count > MOST_ROOMS else [])


def violations(sources, allowed):
    """sources: {path relative to the root: text} -> list of "file includes header: why not" """
    found = []
    for path, text in sorted(sources.items()):
        layer = layer_of(path, allowed)
        if layer not in allowed:
            found.append(f"{path}: folder is not a layer of engine/layers.txt")
            continue
        for header in INCLUDE.findall(text):
            target = layer_of(header, allowed)
            if target != layer and target not in allowed[layer]:
                found.append(f"{path} includes {header}: {layer} may not use {target}")
    return found


def picture(rooms):
    """A mermaid graph of the rooms; an arrow that follows from other arrows is left out."""
    lines = ["```mermaid", "flowchart TD"]
    below = {room: everything_below(room, rooms) for room in rooms}
    for room in reversed(rooms):
        near = [one for one in rooms if one in below[room] and not any(one in below[other] for other in below[room])]
        lines += [f"  {room} --> {one}" for one in near] or [f"  {room}"]
    return "\n".join([*lines, "```"])


def with_picture(text, allowed):
    """The document with the picture between its two marks."""
    pattern = re.compile(r"(<!-- layers: [^\n]*-->\n).*?(<!-- end -->)", re.DOTALL)
    assert pattern.search(text), "engine/README.md has no place for the picture of the rooms"
    return pattern.sub(lambda found: f"{found[1]}\n{picture(rooms_of(allowed))}\n\n{found[2]}", text)


def teeth():
    """The checker itself: an upward include, a foreign folder, a folder in a folder, a cycle of rooms."""
    allowed = {"base": set(), "data": {"base"}, "data/health": {"base", "data"}, "fit/optim": {"base"}}
    sample = {
        "engine/fit/optim/a.cpp": '#include "engine/data/motion.hpp"',
        "engine/data/b.cpp": '#  include "engine/data/health/finding.hpp"',
        "engine/attic/c.cpp": "",
        "engine/data/readers/d.cpp": '#include "engine/base/error.hpp"\n#include "engine/data/motion.hpp"',
    }
    assert len(violations(sample, allowed)) == 3, "the layer test has lost its teeth"
    assert not faults_of_rooms(allowed) and faults_of_rooms({"a/x": set(), "b": {"a/x"}, "a/y": {"b"}}), "no cycle"
    chain = {"a": set(), "b": {"a"}, "c": {"a", "b"}}
    assert picture(chain).splitlines()[2:-1] == ["  c --> b", "  b --> a", "  a"], "the picture has lost its arrows"


def main(root, *options):
    root = pathlib.Path(root)
    allowed = read_layers((root / "engine" / "layers.txt").read_text())
    for layer, uses in allowed.items():
        assert uses <= set(allowed), f"{layer} uses unknown layers {uses - set(allowed)}"
    teeth()
    files = [p for folder in ("engine", "kernels") for p in (root / folder).rglob("*") if p.suffix in (".hpp", ".cpp")]
    assert len(files) > 50, "too few sources found: is this the source tree?"
    sources = {p.relative_to(root).as_posix(): p.read_text() for p in files}
    found = violations(sources, allowed) + faults_of_rooms(allowed)
    document = root / "engine" / "README.md"
    drawn = with_picture(document.read_text(), allowed)
    if "--write" in options:
        document.write_text(drawn)
    elif drawn != document.read_text():
        found.append("engine/README.md: the picture is not that of engine/layers.txt; run layers.py . --write")
    counts = f"{len(sources)} files, {len(allowed)} layers, {len(rooms_of(allowed))} rooms"
    print("\n".join(found) or f"{counts}: every include points downwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
