"""Documents that stay readable and true: their length, the sentences of the README, links, anchors, line widths.

    documents.py ROOT          ROOT: the source tree; every *.md below it but those of build folders is read
"""
import math
import pathlib
import re
import statistics
import sys

MOST_WORDS = {"README.md": 900, "CHANGELOG.md": 1500, "jobs/README.md": 3000, "bench/README.md": 2000}
MEDIAN_WORDS = 16   # of a sentence of the README, at most
LONGEST_WORDS = 34  # of any sentence of the README
WIDEST_LINE = 120   # characters; rows of tables and addresses may be longer, for nothing can break them

FENCE = re.compile(r"^(```|~~~)")
COMMENT = re.compile(r"<!--.*?-->", re.DOTALL)
IMAGE_OR_LINK = re.compile(r"!?\[((?:[^\[\]]|\[[^\]]*\])*)\]\(([^()\s]+(?:\([^()]*\)[^()\s]*)?)\)")
ITEM = re.compile(r"^\s*(?:[-*+]|\d+\.)\s+")
# a full stop, question or exclamation mark (and what closes after it), before a capital, number, code, emphasis or path
SENTENCE_END = re.compile(r"(?<=[.!?])[\"')*_]*\s+(?=[\"'(*_`A-Z0-9]|\w+[/.]\w)")
ABBREVIATION = re.compile(r"\b(?:e\.g|i\.e|vs|cf|Fig|Eq|No|approx)\.$")
HASH = re.compile(r"\b(?=[0-9a-f]*\d)(?=[0-9a-f]*[a-f])[0-9a-f]{7,40}\b")
SEED = re.compile(r"\bseeds? \d+", re.IGNORECASE)


def without_code(text):
    """The text with fenced and indented code blocks emptied, line by line, so that numbers of lines stay."""
    lines, fenced, before = [], False, ""
    for line in text.split("\n"):
        if FENCE.match(line.lstrip()):
            fenced = not fenced
            lines.append("")
        elif fenced or (line.startswith("    ") and not ITEM.match(line) and before == ""):
            lines.append("")
            continue  # an indented block goes on as long as nothing else comes
        else:
            lines.append(line)
        before = lines[-1].strip()
    return "\n".join(lines)


def blocks(text):
    """Paragraphs and items of lists, each as one line; no headings, tables, comments, pictures or code."""
    found, current = [], []
    for line in COMMENT.sub("", without_code(text)).split("\n") + [""]:
        starts = ITEM.match(line)
        apart = not line.strip() or line.lstrip().startswith(("|", "#", "!["))
        if (starts or apart) and current:
            found.append(" ".join(current))
            current = []
        if not apart:
            current.append(ITEM.sub("", line).strip())
    return found


def sentences(text):
    found = []
    for block in blocks(text):
        plain = IMAGE_OR_LINK.sub(r"\1", block)
        start = 0
        for end in SENTENCE_END.finditer(plain):
            if ABBREVIATION.search(plain[start:end.start()]):
                continue
            found.append(plain[start:end.start()])
            start = end.end()
        found.append(plain[start:])
    return [sentence for sentence in found if words(sentence)]


def words(sentence):
    return [word for word in sentence.split() if re.search(r"\w", word)]


def length_faults(name, text):
    """Words as `wc -w` counts them, code and tables too: what people finish."""
    count, most = len(text.split()), MOST_WORDS.get(name, math.inf)
    return [f"{count} words, more than {most}"] if count > most else []


def readme_faults(text):
    found = []
    lengths = {sentence: len(words(sentence)) for sentence in sentences(text)}
    if (median := statistics.median(lengths.values())) > MEDIAN_WORDS:
        found.append(f"the median sentence has {median} words, more than {MEDIAN_WORDS}")
    found += [f"{n} words in one sentence: {sentence}" for sentence, n in lengths.items() if n > LONGEST_WORDS]
    found += [f"names a commit: {commit}" for commit in HASH.findall(text)]
    found += [f"names a seed: {seed}" for seed in SEED.findall(text)]
    return found


def anchors(text):
    """Anchors that GitHub gives to the headings of a document."""
    seen, found = {}, set()
    for line in without_code(text).split("\n"):
        if heading := re.match(r"#{1,6}\s+(.*?)\s*#*$", line):
            plain = IMAGE_OR_LINK.sub(r"\1", heading[1]).lower()
            slug = re.sub(r"[^\w\- ]", "", plain).replace(" ", "-")
            found.add(f"{slug}-{seen[slug]}" if slug in seen else slug)
            seen[slug] = seen.get(slug, 0) + 1
    return found


def links(text):
    """(line, target) of each link and picture that stays in the tree; code is not looked at."""
    for number, line in enumerate(without_code(text).split("\n"), 1):
        line = re.sub(r"`[^`]*`", "", line)
        for link in IMAGE_OR_LINK.finditer(line):
            if not re.match(r"[a-z]+:", link[2]):
                yield number, link[2]


def link_faults(path, documents):
    found = []
    for number, target in links(documents[path]):
        name, _, anchor = target.partition("#")
        there = (path.parent / name).resolve() if name else path
        if there not in documents and not there.exists():
            found.append(f"{number}: there is no {name}")
        elif anchor and anchor not in anchors(documents.get(there, "")):
            found.append(f"{number}: {name or 'this document'} has no heading for #{anchor}")
    return found


def width_faults(text):
    found = []
    for number, line in enumerate(text.split("\n"), 1):
        bare = re.sub(r"<?https?://[^\s>)]*>?", "", IMAGE_OR_LINK.sub(r"[\1]", line))
        if len(bare) > WIDEST_LINE and not line.startswith("|"):
            found.append(f"{number}: {len(bare)} characters, more than {WIDEST_LINE}")
    return found


def teeth():
    """The checker itself: what it must count, find and let pass."""
    text = "# Head\n\nOne two `x y` three. Four\nfive (e.g. Six)? [Seven](a.txt) eight!\n\n- nine ten\n" \
           "- 11.5 twelve\n\n| a | b |\n\n```sh\nnot. These. Words\n```\n\n    nor. These\n\nLast: one\n"
    assert [len(words(s)) for s in sentences(text)] == [5, 4, 2, 2, 2, 2], sentences(text)
    assert readme_faults("A b c d e.\n\n" + "w " * 35 + ".\n\nSee 0a1b2c3 of seed 28.\n")[-3:] != []
    assert len(readme_faults("A b c d e.\n\n" + "w " * 35 + ".\n\nSee 0a1b2c3 of seed 28.\n")) == 3
    assert length_faults("README.md", "w " * 901) == ["901 words, more than 900"]
    assert not length_faults("README.md", "w " * 900) and not length_faults("other/README.md", "w " * 9999)
    assert anchors("# The `run` command, 2nd\n# A\n# A\n```\n# no\n```\n") == {"the-run-command-2nd", "a", "a-1"}
    here = pathlib.Path(__file__).resolve()
    documents = {here.with_name("x.txt"): "# A b\n[1](#a-b) [2](#c) [3](no.txt) [4](https://no.txt) `[5](no)`\n"
                                         "[6](documents.py)"}
    assert [f.split(":")[1] for f in link_faults(here.with_name("x.txt"), documents)] == [
        " this document has no heading for #c", " there is no no.txt"]
    assert width_faults("x" * 121 + "\n|" + "x" * 130 + "\n[a](" + "x" * 130 + ")\n") == [
        "1: 121 characters, more than 120"]


def main(root):
    root = pathlib.Path(root).resolve()
    teeth()
    documents = {path: path.read_text() for path in sorted(root.rglob("*.md"))
                 if not {"build", ".git"} & set(path.relative_to(root).parts)}
    assert root / "README.md" in documents and len(documents) > 5, "too few documents: is this the source tree?"
    assert all(root / name in documents for name in MOST_WORDS), "a document whose words are counted is not there"
    found = [f"README.md: {fault}" for fault in readme_faults(documents[root / "README.md"])]
    for path, text in documents.items():
        name = path.relative_to(root).as_posix()
        found += [f"{name}: {fault}" for fault in length_faults(name, text)]
        found += [f"{name}:{fault}" for fault in link_faults(path, documents) + width_faults(text)]
    print("\n".join(found) or f"{len(documents)} documents: short sentences, links that lead somewhere, narrow lines")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1]))
