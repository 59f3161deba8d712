"""What a reader would trip over: OpenMP outside its one file, sources no target lists, lines wider than 120 characters.

    sources.py ROOT            documents (*.md) are documents.py's
"""

import pathlib
import re
import subprocess
import sys

PRAGMA_HOME = "engine/base/parallel.cpp"
WIDEST_LINE = 120
NO_TEXT = {".png", ".gz", ".h5"}
DEEP_NESTING = "tests/jobs/bad/nesting_"  # jobs that are bad because one line nests without end


def listed(path, cmake_text):
    """A source is listed by name, or by its stem in a choices() line of its folder's parent."""
    return re.search(rf"\b{re.escape(path.name)}\b|\b{re.escape(path.stem)}\b", cmake_text) is not None


def tracked(root):
    """Files of the project: those of git, or without it (an archive) those outside build folders and hidden ones."""
    try:
        listing = subprocess.run(["git", "-C", root, "ls-files", "-z"], check=True, capture_output=True).stdout
        names = [name for name in listing.decode().split("\0") if name]
    except (OSError, subprocess.CalledProcessError):
        names = [path.relative_to(root).as_posix() for path in sorted(root.rglob("*")) if path.is_file()]
        names = [name for name in names if not re.match(r"build/|\.(?!clang)|.*__pycache__", name)]
    return [name for name in names if (root / name).is_file()]


def wide_lines(name, text):
    """Characters count, not bytes: a bar drawn of block characters is as wide as it looks."""
    return [f"{name}:{number}: {len(line)} characters, more than {WIDEST_LINE}"
            for number, line in enumerate(text.split("\n"), 1) if len(line) > WIDEST_LINE]


def main(root):
    root = pathlib.Path(root)
    found = []
    for folder in ("engine", "kernels", "tests", "bench"):
        for path in sorted((root / folder).rglob("*.cpp")):
            name = path.relative_to(root).as_posix()
            text = path.read_text()
            if "#pragma omp" in text and name != PRAGMA_HOME and not name.startswith("bench/"):
                found.append(f"{name}: OpenMP belongs in {PRAGMA_HOME}")
            near = [p / "CMakeLists.txt" for p in path.parents if (p / "CMakeLists.txt").exists() and root in p.parents]
            if not any(listed(path, cmake.read_text()) for cmake in near):
                found.append(f"{name}: no CMakeLists.txt lists it")
    for path in root.rglob("CMakeLists.txt"):
        if "build" not in path.parts and re.search(r"file\s*\(\s*GLOB", path.read_text()):
            found.append(f"{path.relative_to(root)}: sources are listed, not globbed")
    assert wide_lines("a", "█" * 120 + "\n" + "x" * 121) == ["a:2: 121 characters, more than 120"], "no teeth"
    names = [name for name in tracked(root) if pathlib.PurePath(name).suffix not in NO_TEXT | {".md"}]
    assert len(names) > 500, "too few files: is this the source tree?"
    for name in names:
        if not name.startswith(DEEP_NESTING):
            found += wide_lines(name, (root / name).read_text(encoding="utf-8"))
    print("\n".join(found) or f"sources are listed, pragmas are at home, {len(names)} files have narrow lines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
