"""What a reader would trip over: OpenMP outside its one file, sources no target lists, machine paths, unfinished promises."""

import pathlib
import re
import sys

PRAGMA_HOME = "engine/base/parallel.cpp"


def listed(path, cmake_text):
    """A source is listed by name, or by its stem in a choices() line of its folder's parent."""
    return re.search(rf"\b{re.escape(path.name)}\b|\b{re.escape(path.stem)}\b", cmake_text) is not None


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
    print("\n".join(found) or "sources are listed, pragmas are at home")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
