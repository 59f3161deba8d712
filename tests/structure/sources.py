"""What a reader would trip over: OpenMP outside its one file, sources no target lists, lines wider than 120 characters,
references to documents that are not in the tree, leading comments that are pages, old notes above tests that pass.

    sources.py ROOT            documents (*.md) are documents.py's
"""

import pathlib
import re
import subprocess
import sys

PRAGMA_HOME = "engine/base/parallel.cpp"
WIDEST_LINE = 120
NO_TEXT = {".png", ".gz", ".h5", ".csv"}
DEEP_NESTING = "tests/jobs/bad/nesting_"  # jobs that are bad because one line nests without end
FOLDERS = ("engine", "kernels", "tests", "bench", "scripts", "jobs")
SOURCES = (".hpp", ".cpp", ".h", ".py", ".in", ".txt", ".cmake", ".toml", ".sh", ".html", ".js", ".css", ".yml", "")
LONGEST_HEADER = 15  # comment lines; what is longer is a page: engine/diagnose/METHOD.md, or a comment where it belongs
METHOD = "engine/diagnose/METHOD.md"

# files that the examples of engine/README.md tell a reader to write
EXAMPLES = {"effects/effects/eddy_brake.cpp", "optim/optimisers/random_search.cpp", "data/readers/raw64.cpp",
            "engine/a.cpp"}

DOCUMENT = re.compile(r"(?<![\w*{}$])(?:\.{1,2}/|[\w.-]+/)*[\w-]+\.md\b")
SECTION = re.compile(r"\b(METHOD|THEORY)\.md, ([A-Z][\w ,'-]*)")
THEORY = "engine/infer/decision/THEORY.md"  # what is longer than a comment about a decision
PRIVATE = re.compile(r"\b(?:LESSONS|PHYSICS|DESIGN|UX|FADE|STYLE|EVIDENCE)(?:\.md)? (?:items?|sections?) "
                     r"|\bour own prototype\b")
FAILS = re.compile(r"^\s*(?://|#) fails:", re.MULTILINE)


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


def as_prose(text):
    """Comments that continue in the next line as one line."""
    return re.sub(r"\n[ \t]*(?://|#)[ \t]+", " ", text)


def leading_comments(text):
    """Lines of the first comment of a C++ file."""
    count = 0
    for line in text.splitlines():
        if line.startswith("//"):
            count += 1
        elif count or (line.strip() and not line.startswith("#pragma once")):
            break
    return count


def absent_documents(text, documents):
    """Names of documents that are none: `documents` are paths, a name may leave out leading folders."""
    names = {re.sub(r"^(?:\.{1,2}/)+", "", found) for found in DOCUMENT.findall(text)}
    return sorted(name for name in names if not any(f"/{path}".endswith(f"/{name}") for path in documents))


def absent_sources(text, files):
    """Names of C++ files in a document, outside its code blocks, that no file of the tree has."""
    prose = re.sub(r"^```.*?^```", "", text, flags=re.DOTALL | re.MULTILINE)
    names = set(re.findall(r"`((?:[\w-]+/)*[\w-]+\.(?:hpp|cpp))`", prose))
    return sorted(name for name in names if not any(f"/{path}".endswith(f"/{name}") for path in files))


def absent_in_comments(text, files):
    """Names of C++ files in comments that no file of the tree has."""
    said = " ".join(re.findall(r"//.*", text))
    names = set(re.findall(r"(?<![\w./<\"-])((?:[\w-]+/)*[\w-]+\.(?:hpp|cpp))(?![\w.\"])", said))
    return sorted(name for name in names if not any(f"/{path}".endswith(f"/{name}") for path in files))


def lists_nobody_writes(text, cmake_text):
    """Lists of choices() that a source includes and no CMakeLists.txt writes."""
    included = set(re.findall(r'#include "(\w+)_choices\.inc"', text))
    return sorted(included - set(re.findall(r"^choices\(\w+ (\w+)", cmake_text, re.MULTILINE)))


def unknown_sections(text, headings):
    """Sections of the pages that sources name and that none of them has."""
    named = [found for _, found in SECTION.findall(as_prose(text))]
    return [found for found in named if not any(found.startswith(one) for one in headings)]


def complaints(name, text, documents, headings):
    """What is wrong with one source file of the tree."""
    found = [f"{name}: names {one}, which is not in the tree" for one in absent_documents(text, documents)]
    found += [f"{name}: {METHOD} and {THEORY} have no section \"{one}\""
              for one in unknown_sections(text, headings)]
    found += [f"{name}: \"{one.strip()}\" is not in the tree" for one in PRIVATE.findall(as_prose(text))]
    if FAILS.search(text):
        found.append(f"{name}: \"fails:\" above a test that is enabled; say what holds")
    if name.endswith((".hpp", ".cpp", ".h")) and leading_comments(text) > LONGEST_HEADER:
        found.append(f"{name}: {leading_comments(text)} leading comment lines, {LONGEST_HEADER} at most")
    return found


def teeth():
    """The checks themselves find what they are for, and nothing else."""
    md = ".md"
    assert absent_documents(f"see LESSONS{md} and b/NOTES{md}", [f"a/NOTES{md}"]) == [f"LESSONS{md}", f"b/NOTES{md}"]
    assert absent_documents(f"see ../a/NOTES{md}, NOTES{md}", [f"a/NOTES{md}"]) == []
    assert absent_sources("`b/a.hpp`, `c.cpp`\n```\n`d.hpp`\n```\n", ["x/b/a.hpp"]) == ["c.cpp"]
    assert absent_in_comments('#include "e.hpp"\n// see b/a.hpp, c.cpp', ["x/b/a.hpp"]) == ["c.cpp"]
    assert lists_nobody_writes('#include "a_choices.inc"\n#include "b_choices.inc"', "choices(t a x y)") == ["b"]
    assert unknown_sections(f"// METHOD{md}, The\n// search: {md}", ["The search"]) == []
    assert unknown_sections(f"// METHOD{md}, The riddle", ["The search"]) == ["The riddle"]
    assert PRIVATE.search("LESSONS" + " item 3") and not PRIVATE.search("the lessons of item 3")
    assert leading_comments("#pragma once\n// a\n//\n// b\n\n// c\n") == 3
    assert FAILS.search("// " + "fails: because") and not FAILS.search("// what fails: nothing")


def main(root):
    root = pathlib.Path(root)
    teeth()
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
    names = tracked(root)
    lists = "\n".join((root / name).read_text() for name in names if name.endswith("CMakeLists.txt"))
    assert len(names) > 500, "too few files: is this the source tree?"
    documents = [name for name in names if name.endswith(".md")]
    headings = [one for page in (METHOD, THEORY)
                for one in re.findall(r"^#+ (.+)$", (root / page).read_text(), re.MULTILINE)]
    for name in ("engine/README.md", METHOD, THEORY):
        absent = set(absent_sources((root / name).read_text(), names)) - EXAMPLES
        found += [f"{name}: names {one}, which is not in the tree" for one in sorted(absent)]
    for name in names:
        path = pathlib.PurePosixPath(name)
        if path.suffix not in NO_TEXT | {".md"} and not name.startswith(DEEP_NESTING):
            found += wide_lines(name, (root / name).read_text(encoding="utf-8"))
        own = name.startswith("tests/structure/")  # documents that its own checks make up
        if path.parts[0] in FOLDERS and path.suffix in SOURCES and not own:
            text = (root / name).read_text(errors="replace")
            found += complaints(name, text, documents, headings)
            found += [f"{name}: no CMakeLists.txt writes {one}_choices.inc" for one in lists_nobody_writes(text, lists)]
            if path.parts[0] in ("engine", "kernels") and path.suffix in (".cpp", ".hpp"):
                absent = set(absent_in_comments(text, names)) - EXAMPLES
                found += [f"{name}: names {one}, which is not in the tree" for one in sorted(absent)]
    print("\n".join(found) or "sources are listed, lines are narrow, documents exist, leading comments are short")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
