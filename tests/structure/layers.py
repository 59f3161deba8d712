"""Includes only point downwards: engine/layers.txt is the law, this test reads it and every #include of ours.

A folder under engine/ (and kernels/) is a layer; a file may include its own layer and those after its layer's colon.
The picture in engine/README.md is made from the same file:  layers.py ROOT --write  rewrites it.
"""
import pathlib
import re
import sys

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


def layer_of(path):
    parts = pathlib.PurePosixPath(path).parts
    return "kernels" if parts[0] == "kernels" else parts[1]


def violations(sources, allowed):
    """sources: {path relative to the root: text} -> list of "file includes header: why not" """
    found = []
    for path, text in sorted(sources.items()):
        layer = layer_of(path)
        if layer not in allowed:
            found.append(f"{path}: folder is not a layer of engine/layers.txt")
            continue
        for header in INCLUDE.findall(text):
            target = layer_of(header)
            if target != layer and target not in allowed[layer]:
                found.append(f"{path} includes {header}: {layer} may not use {target}")
    return found


def picture(allowed):
    """A mermaid graph of the layers; an arrow that follows from other arrows is left out."""
    lines = ["```mermaid", "flowchart TD"]
    for layer, uses in reversed(allowed.items()):
        near = [one for one in allowed if one in uses and not any(one in allowed[other] for other in uses)]
        lines += [f"  {layer} --> {one}" for one in near] or [f"  {layer}"]
    return "\n".join([*lines, "```"])


def with_picture(text, allowed):
    """The document with the picture between its two marks."""
    pattern = re.compile(r"(<!-- layers: [^\n]*-->\n).*?(<!-- end -->)", re.DOTALL)
    assert pattern.search(text), "engine/README.md has no place for the picture of the layers"
    return pattern.sub(lambda found: f"{found[1]}\n{picture(allowed)}\n\n{found[2]}", text)


def teeth(allowed):
    """The checker itself: an upward include, a foreign folder and an allowed include."""
    sample = {
        "engine/optim/a.cpp": '#include "engine/store/result_writer.hpp"',
        "engine/base/b.cpp": '#  include "kernels/dispatch.hpp"',
        "engine/attic/c.cpp": "",
        "engine/data/d.cpp": '#include "engine/base/error.hpp"\n#include "engine/data/motion.hpp"',
    }
    assert len(violations(sample, allowed)) == 3, "the layer test has lost its teeth"
    chain = {"a": set(), "b": {"a"}, "c": {"a", "b"}}
    assert picture(chain).splitlines()[2:-1] == ["  c --> b", "  b --> a", "  a"], "the picture has lost its arrows"


def main(root, *options):
    root = pathlib.Path(root)
    allowed = read_layers((root / "engine" / "layers.txt").read_text())
    for layer, uses in allowed.items():
        assert uses <= set(allowed), f"{layer} uses unknown layers {uses - set(allowed)}"
    teeth(allowed)
    files = [p for folder in ("engine", "kernels") for p in (root / folder).rglob("*") if p.suffix in (".hpp", ".cpp")]
    assert len(files) > 50, "too few sources found: is this the source tree?"
    sources = {p.relative_to(root).as_posix(): p.read_text() for p in files}
    found = violations(sources, allowed)
    document = root / "engine" / "README.md"
    drawn = with_picture(document.read_text(), allowed)
    if "--write" in options:
        document.write_text(drawn)
    elif drawn != document.read_text():
        found.append("engine/README.md: the picture is not that of engine/layers.txt; run layers.py . --write")
    print("\n".join(found) or f"{len(sources)} files, {len(allowed)} layers: every include points downwards")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
